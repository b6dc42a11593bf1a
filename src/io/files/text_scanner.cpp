// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/text_scanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "lodestone/mesh/errors.h"

namespace lodestone {
namespace {

constexpr std::string_view blanks = " \t\r\n\v\f";
/// Far longer than any line of a mesh: refuses a huge binary file before all of it is searched for a line end.
constexpr std::size_t longest_line = std::size_t{1} << 26U;

/// std::from_chars does not accept a leading plus, which is legal in every text format.
std::string_view without_plus(std::string_view word) {
  const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
  return plus ? word.substr(1) : word;
}

template <class Number>
std::errc parse(std::string_view word, Number& value) {
  const auto digits = without_plus(word);
  const auto end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  return stop == end ? error : std::errc::invalid_argument;
}

}  // namespace

bool Text_scanner::next_line() {
  comment_is_text_ = false;
  while (continued_) read_line();  // what the caller has not read of the last one
  while (read_line())
    if (continued_ || line_.find_first_not_of(blanks) != std::string_view::npos) return true;
  line_ = {};
  return false;
}

/// Some programs still end lines as old Macintosh computers did. Bytes after the text can hold any character, so the
/// first line decides.
char Text_scanner::line_end_of(std::string_view text) {
  const auto first = text.substr(0, longest_line).find_first_of("\r\n");
  return first == text.npos || text[first] == '\n' || text.substr(first).starts_with("\r\n") ? '\n' : '\r';
}

bool Text_scanner::read_line() {
  const auto text = file_->view();
  continued_ = false;
  if (next_ >= text.size()) return false;
  ++line_number_;
  line_ = text.substr(next_, longest_line);
  line_ = line_.substr(0, line_.find(line_end_));
  if (line_.size() == longest_line) fail("the line is longer than 64 MiB, this is not text");
  end_ = next_ + line_.size();
  next_ = std::min(end_ + 1, text.size());
  if (comment_ != '\0' && !comment_is_text_) line_ = line_.substr(0, line_.find(comment_));
  continued_ = cut_continuation();
  return true;
}

void Text_scanner::read_comment_as_text() {
  comment_is_text_ = true;
  if (line_.data() == nullptr) return;  // the line has ended
  const auto text = file_->view();
  const auto begin = static_cast<std::size_t>(line_.data() - text.data());
  line_ = text.substr(begin, end_ - begin);
  continued_ = cut_continuation();
}

bool Text_scanner::cut_continuation() {
  if (continuation_ == '\0') return false;
  const auto last = line_.find_last_not_of(blanks);
  if (last == std::string_view::npos || line_[last] != continuation_) return false;
  line_ = line_.substr(0, last);
  return true;
}

std::string_view Text_scanner::next_word() {
  while (continued_ && line_.find_first_not_of(blanks) == std::string_view::npos)
    if (!read_line()) line_ = {};
  const auto begin = std::min(line_.find_first_not_of(blanks), line_.size());
  const auto end = std::min(line_.find_first_of(blanks, begin), line_.size());
  const auto word = line_.substr(begin, end - begin);
  line_.remove_prefix(end);
  return word;
}

std::string_view Text_scanner::next_word_of_file() {
  auto word = next_word();
  while (word.empty() && next_line()) word = next_word();
  return word;
}

double Text_scanner::number(std::string_view word) const {
  double value = 0;
  const auto error = parse(word, value);
  if (error == std::errc::result_out_of_range)
    fail(fmt::format("{} is outside the range of a double", in_quotes(word)));
  if (error != std::errc()) fail(fmt::format("expected a number, found {}", in_quotes(word)));
  if (!std::isfinite(value)) fail(fmt::format("{} is not a finite number", in_quotes(word)));
  return value;
}

std::size_t Text_scanner::count(std::string_view word) const {
  std::uint64_t value = 0;
  if (parse(word, value) != std::errc()) fail(fmt::format("expected a count, found {}", in_quotes(word)));
  return value;
}

void Text_scanner::fail(std::string_view cause) const {
  throw Bad_mesh(fmt::format("{}:{}: {}", file_->name(), std::max<std::size_t>(line_number_, 1), cause));
}

}  // namespace lodestone
