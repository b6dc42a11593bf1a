// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/standard_input.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "lodestone/io/files/atomic_file.h"
#include "lodestone/mesh/errors.h"
#include "program/progress.h"

namespace lodestone {

namespace {

/// The file of the standard input, also after it has disappeared: errors are told then.
std::string& kept_path() {
  static std::string path;
  return path;
}

/// Waits until `read` returns at once. The system starts `read` again after a signal, so an interrupt would not end it.
/// @throws Interrupted
void wait_for_standard_input() {
  constexpr int milliseconds = 100;  // a signal that comes just before `poll` does not end it either
  pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
  int ready = 0;
  while (ready == 0 || (ready < 0 && errno == EINTR)) {
    check_interrupt();
    ready = ::poll(&input, 1, milliseconds);
  }
}

void copy_standard_input(Atomic_file& file, std::uintmax_t most_bytes) {
  std::array<char, 1 << 16> bytes{};
  for (std::uintmax_t copied = 0;;) {
    wait_for_standard_input();
    const auto count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
    if (count == 0) return;
    if (count < 0 && errno == EINTR) continue;
    if (count < 0)
      throw Bad_mesh(fmt::format("the standard input cannot be read: {}", std::generic_category().message(errno)));
    copied += static_cast<std::size_t>(count);
    if (copied > most_bytes)
      throw Bad_mesh(fmt::format("the standard input has more than the {} bytes that are allowed", most_bytes));
    file.write({bytes.data(), static_cast<std::size_t>(count)});
  }
}

/// The system's place for temporary files.
std::filesystem::path temporary_place() {
  std::error_code error;
  auto place = std::filesystem::temp_directory_path(error);
  if (!error) return place;
  const char* named = nullptr;
  for (const char* variable : {"TMPDIR", "TMP", "TEMP", "TEMPDIR"})
    if (named == nullptr) named = std::getenv(variable);
  throw Bad_output(
      fmt::format("{}: cannot hold temporary files: {}", named == nullptr ? "/tmp" : named, error.message()));
}

}  // namespace

Temporary_folder::Temporary_folder() {
  auto name = (temporary_place() / "lodestone.XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw Bad_output(fmt::format("{}: cannot be created: {}", name, std::generic_category().message(errno)));
  path_ = name;
}

Temporary_folder::~Temporary_folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

Standard_input::Standard_input(const std::string& format, std::uintmax_t most_bytes)
    : file_(folder_.path() / ("standard_input." + format)) {
  try {
    Atomic_file file(file_);
    copy_standard_input(file, most_bytes);
    file.commit();
  } catch (const Bad_output& error) {
    throw Bad_output(fmt::format("the standard input cannot be kept: {} (TMPDIR names another folder)", error.what()));
  }
  // Only now: an error before this one is about the folder, which its message must name.
  kept_path() = file_.string();
}

std::string naming_standard_input(std::string message) {
  const std::string& path = kept_path();
  if (path.empty()) return message;
  for (auto at = message.find(path); at != std::string::npos; at = message.find(path, at))
    message.replace(at, path.size(), "standard input");
  return message;
}

std::string shown_name(const std::filesystem::path& file) {
  return file.string() == kept_path() ? "standard input" : file.filename().string();
}

void replace_standard_input(std::vector<std::filesystem::path*> inputs, const std::string& format,
                            std::uintmax_t max_bytes, std::optional<Standard_input>& kept) {
  std::erase_if(inputs, [](const auto* input) { return *input != "-"; });
  if (inputs.empty() && format.empty()) return;
  if (inputs.empty()) throw Bad_argument("--format is for a mesh on the standard input: give - as its name");
  if (inputs.size() > 1) throw Bad_argument("the standard input (-) can be only one of the inputs");
  if (format.empty()) throw Bad_argument("a mesh on the standard input (-) needs its format, such as --format obj");
  kept.emplace(format, max_bytes);
  *inputs.front() = kept->file();
}

}  // namespace lodestone
