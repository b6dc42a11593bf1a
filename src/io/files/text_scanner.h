// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "io/files/file_bytes.h"

namespace lodestone {

/// Walks through a text file line by line and word by word, and knows the line for the error message.
///
/// Words are separated by blanks; a line ends with LF or CR LF and may be of any length.
class Text_scanner {
 public:
  /// @param comment  character from which on the rest of a line is ignored; 0: none
  explicit Text_scanner(const File_bytes& file, char comment = '\0') : file_(&file), comment_(comment) {}

  /// Moves to the next line that holds a word; false at the file's end.
  bool next_line();
  /// Next word of the current line; empty at the line's end.
  std::string_view next_word();
  /// Next word of the current line or a later one; empty at the file's end.
  std::string_view next_word_of_file();
  void skip_rest_of_line() { line_ = {}; }

  /// Number of bytes before the first line not yet looked at.
  std::size_t offset() const { return next_; }
  /// Number of bytes not yet looked at, those of the current line included.
  std::size_t bytes_left() const { return file_->view().size() - next_ + line_.size(); }

  /// `word` as a number.
  /// @throws Bad_mesh when it is none, infinite, or too large or too small for a double
  double number(std::string_view word) const;
  /// `word` as a number of things.
  /// @throws Bad_mesh when it is negative, no integer or beyond 64 bits
  std::size_t count(std::string_view word) const;

  /// @throws Bad_mesh, always: `NAME:LINE: cause`
  [[noreturn]] void fail(std::string_view cause) const;

 private:
  const File_bytes* file_;
  char comment_;
  std::size_t next_ = 0;         // offset of the next line
  std::size_t line_number_ = 0;  // from 1; 0 before the first line
  std::string_view line_;        // what is left of the current line
};

}  // namespace lodestone
