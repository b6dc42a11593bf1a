// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/standard_input.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

#include "lodestone/io/files/atomic_file.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

/// The file of the standard input, also after it has disappeared: errors are told then.
std::string& kept_path() {
  static std::string path;
  return path;
}

void copy_standard_input(Atomic_file& file) {
  std::array<char, 1 << 16> bytes{};
  for (;;) {
    const auto count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
    if (count == 0) return;
    if (count < 0 && errno != EINTR)
      throw Bad_mesh(fmt::format("the standard input cannot be read: {}", std::generic_category().message(errno)));
    if (count > 0) file.write({bytes.data(), static_cast<std::size_t>(count)});
  }
}

}  // namespace

Temporary_folder::Temporary_folder() {
  auto name = (std::filesystem::temp_directory_path() / "lodestone.XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw Bad_output(fmt::format("{}: cannot be created: {}", name, std::generic_category().message(errno)));
  path_ = name;
}

Temporary_folder::~Temporary_folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

Standard_input::Standard_input(const std::string& format) : file_(folder_.path() / ("standard_input." + format)) {
  kept_path() = file_.string();
  Atomic_file file(file_);
  copy_standard_input(file);
  file.commit();
}

std::string naming_standard_input(std::string message) {
  const std::string& path = kept_path();
  if (path.empty()) return message;
  for (auto at = message.find(path); at != std::string::npos; at = message.find(path, at))
    message.replace(at, path.size(), "standard input");
  return message;
}

void replace_standard_input(std::vector<std::filesystem::path*> inputs, const std::string& format,
                            std::optional<Standard_input>& kept) {
  std::erase_if(inputs, [](const auto* input) { return *input != "-"; });
  if (inputs.empty() && format.empty()) return;
  if (inputs.empty()) throw Bad_argument("--format is for a mesh on the standard input: give - as its name");
  if (inputs.size() > 1) throw Bad_argument("the standard input (-) can be only one of the inputs");
  if (format.empty()) throw Bad_argument("a mesh on the standard input (-) needs its format, such as --format obj");
  kept.emplace(format);
  *inputs.front() = kept->file();
}

}  // namespace lodestone
