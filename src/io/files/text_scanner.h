// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "io/files/file_bytes.h"

namespace lodestone {

/// Some programs begin files in UTF-8 with it.
inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// Reads a text file line by line and word by word, and keeps the line number for error messages.
///
/// Words are separated by blanks; a line ends with LF or CR LF, or with CR if the first one does. A byte order mark is
/// skipped. Where the format has them, a line that ends with the continuation character goes on in the next line.
class Text_scanner {
 public:
  /// @param comment       character that starts a comment to the end of the line; 0: none
  /// @param continuation  character at the end of a line that goes on in the next one; 0: none
  explicit Text_scanner(const File_bytes& file, char comment = '\0', char continuation = '\0')
      : file_(&file),
        comment_(comment),
        continuation_(continuation),
        line_end_(line_end_of(file.view())),
        next_(file.view().starts_with(byte_order_mark) ? byte_order_mark.size() : 0) {}

  /// Moves to the next line with a word; false at the end of the file. Continued lines count as one line.
  bool next_line();
  /// Next word of the current line; empty at the end of the line.
  std::string_view next_word();
  /// Next word of the current line or a later one; empty at the end of the file.
  std::string_view next_word_of_file();
  /// Takes the comment of the current line, and of those in which it goes on, as part of its rest, for names: the
  /// comment character can be in them.
  void read_comment_as_text();
  void skip_rest_of_line() {
    line_ = {};
    continued_ = comment_is_text_ = false;
  }

  /// Offset in bytes of the first unread line.
  std::size_t offset() const { return next_; }
  /// Number of unread bytes, including those of the current line.
  std::size_t bytes_left() const { return file_->view().size() - next_ + line_.size(); }

  /// `word` as a floating-point number.
  /// @throws Bad_mesh  not a number, infinite, or too large or too small for a double
  double number(std::string_view word) const;
  /// `word` as a count.
  /// @throws Bad_mesh  negative, not an integer, or beyond 64 bits
  std::size_t count(std::string_view word) const;

  /// @throws Bad_mesh, always: `NAME:LINE: cause`
  [[noreturn]] void fail(std::string_view cause) const;

 private:
  static char line_end_of(std::string_view text);
  bool read_line();
  /// Cuts the continuation character off the current line.
  /// @return whether there was one
  bool cut_continuation();

  const File_bytes* file_;
  char comment_, continuation_, line_end_;
  std::size_t next_;             // offset of the next line
  std::size_t line_number_ = 0;  // from 1; 0 before the first line
  std::string_view line_;        // the unread rest of the current line
  std::size_t end_ = 0;          // offset of the end of the current line, comment included
  bool continued_ = false;       // the current line goes on in the next one
  bool comment_is_text_ = false;  // in this line, and in those in which it goes on
};

}  // namespace lodestone
