// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/files/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>
#include <system_error>
#include <tuple>

#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 20;

/// Whether a name leads, by links, to what the system shows of a process or a device, as `/dev/stdout` does. What it
/// leads to in the end may be a regular file, and the link would be replaced in its place.
bool is_of_the_system(std::filesystem::path name) {
  std::error_code error;
  for (int links = 0; links < 40; ++links) {
    const auto folder =
        std::filesystem::canonical(std::filesystem::absolute(name, error).parent_path(), error).string();
    // Memory that is shared among processes holds files like any other.
    const bool is_shared_memory = (folder + "/").starts_with("/dev/shm/");
    for (const auto* system : {"/dev/", "/proc/"})
      if ((folder + "/").starts_with(system) && !is_shared_memory) return true;
    const auto link = std::filesystem::read_symlink(name, error);
    if (error) return false;
    name = name.parent_path() / link;
  }
  return false;
}

/// Of the file that is replaced; none where there is none.
std::optional<mode_t> permissions_of(const std::filesystem::path& replaced) {
  struct ::stat found {};
  if (::lstat(replaced.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return std::nullopt;
  return found.st_mode & 0777U;
}

}  // namespace

void check_replaceable(const std::filesystem::path& target) {
  std::error_code error;
  if (target.filename().empty() || std::filesystem::is_directory(target, error))
    throw Bad_output(target.string() + ": is a folder, expected a file name");
  std::ignore = std::filesystem::status(target, error);
  if (error == std::errc::filename_too_long) throw Bad_output(target.string() + ": " + error.message());
  if ((std::filesystem::exists(target, error) && !std::filesystem::is_regular_file(target, error)) ||
      is_of_the_system(target))
    throw Bad_output(target.string() + ": is no regular file, which alone is replaced");
}

Atomic_file::Atomic_file(std::filesystem::path target, std::filesystem::path name)
    : target_(std::move(target)), name_(std::move(name)) {
  check_replaceable(target_);
  if (target_.has_parent_path()) made_folders_.emplace(target_.parent_path());
  const auto permissions = permissions_of(name_);
  // O_EXCL: never opens an existing file or link, which another user may have put there.
  for (int attempt = 0; descriptor_ < 0 && attempt < 100; ++attempt) {
    temporary_ = target_;
    // The name can be as long as names may be.
    temporary_.replace_filename("." + target_.filename().string().substr(0, 200) + "." + std::to_string(::getpid()) +
                                "." + std::to_string(attempt));
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, permissions ? 0600 : 0666);
    if (descriptor_ < 0 && errno != EEXIST) break;
  }
  if (descriptor_ < 0) fail("cannot be created");
  if (permissions) std::ignore = ::fchmod(descriptor_, *permissions);  // else it is readable by its owner alone
}

Atomic_file::~Atomic_file() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  ::unlink(temporary_.c_str());
}

void Atomic_file::write(std::string_view bytes) {
  buffer_ += bytes;
  if (buffer_.size() >= buffer_size) flush();
}

void Atomic_file::flush() {
  std::string_view rest = buffer_;
  while (!rest.empty()) {
    const auto written = ::write(descriptor_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("cannot be written");
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  buffer_.clear();
}

void Atomic_file::finish() {
  flush();
  if (::fsync(descriptor_) != 0) fail("cannot be written");
}

void Atomic_file::commit() {
  finish();
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail("cannot be renamed into place");
  ::close(descriptor_);
  descriptor_ = -1;
}

void Atomic_file::fail(const char* action) const {
  throw Bad_output(name_.string() + ": " + action + ": " + std::strerror(errno));
}

void write_whole(const std::filesystem::path& target, std::string_view bytes) {
  Atomic_file file(target);
  file.write(bytes);
  file.commit();
}

}  // namespace lodestone
