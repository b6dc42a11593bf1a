// SPDX-License-Identifier: GPL-3.0-or-later
#include "partitions/row_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>

#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Bad_argument(file.string() + ": cannot be read");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// @return length of the lines that end with a line break
std::size_t whole_lines(std::string_view text) { return text.rfind('\n') + 1; }

bool is_row(const Row_file::Row& json) { return json.is_object() && json.contains("id") && json["id"].is_string(); }

/// @return length of the lines before the first one that is no row
std::size_t whole_rows(std::string_view text) {
  std::size_t whole = 0;
  for (std::size_t end = 0; (end = text.find('\n', whole)) != std::string_view::npos; whole = end + 1)
    if (!is_row(Row_file::Row::parse(text.substr(whole, end - whole), nullptr, false))) break;
  return whole;
}

std::map<std::string, Row_file::Row> parsed(const std::filesystem::path& file, std::string_view lines) {
  std::map<std::string, Row_file::Row> rows;
  for (std::size_t number = 1; !lines.empty(); ++number) {
    const std::size_t end = lines.find('\n');
    auto row = Row_file::Row::parse(lines.substr(0, end), nullptr, false);
    if (!is_row(row)) throw Bad_argument(fmt::format("{}:{}: is no row of a sweep", file.string(), number));
    const auto id = row["id"].get<std::string>();
    rows.emplace(id, std::move(row));
    lines.remove_prefix(end + 1);
  }
  return rows;
}

}  // namespace

std::map<std::string, Row_file::Row> read_rows(const std::filesystem::path& file) {
  const std::string text = content_of(file);
  return parsed(file, std::string_view(text).substr(0, whole_lines(text)));
}

Row_file::Row_file(std::filesystem::path file, Damage damage) : file_(std::move(file)) {
  std::error_code error;
  std::filesystem::create_directories(file_.parent_path(), error);
  if (error) throw Bad_output(file_.parent_path().string() + ": cannot make the folder: " + error.message());
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail("cannot be opened");
  try {
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0)
      fail(errno == EWOULDBLOCK ? "is in use by another sweep" : "cannot be locked");
    const std::string text = content_of(file_);
    const std::size_t whole = damage == Damage::drop ? whole_rows(text) : whole_lines(text);
    rows_ = parsed(file_, std::string_view(text).substr(0, whole));
    if (whole < text.size() && ::ftruncate(descriptor_, static_cast<off_t>(whole)) != 0) fail("cannot be mended");
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

Row_file::~Row_file() { ::close(descriptor_); }

void Row_file::clear() {
  if (::ftruncate(descriptor_, 0) != 0) fail("cannot be emptied");
  rows_.clear();
}

void Row_file::add(const Row& row) {
  const auto id = row.at("id").get<std::string>();
  if (has(id)) return;
  const std::string line = row.dump() + "\n";
  const off_t before = ::lseek(descriptor_, 0, SEEK_END);
  for (std::string_view rest = line; !rest.empty();) {
    const auto written = ::write(descriptor_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int cause = errno;
      // A half-written line would be dropped when the file is next opened: it may stay if it cannot be taken back.
      [[maybe_unused]] const int taken_back = ::ftruncate(descriptor_, before);
      errno = cause;
      fail("cannot be written");
    }
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  if (::fdatasync(descriptor_) != 0) fail("cannot be written");
  rows_.emplace(id, row);
}

void Row_file::fail(const char* action) const {
  throw Bad_output(file_.string() + ": " + action + ": " + std::strerror(errno));
}

}  // namespace lodestone
