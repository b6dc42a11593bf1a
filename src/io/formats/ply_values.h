// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstddef>
#include <string_view>

#include "io/files/file_bytes.h"
#include "io/files/text_scanner.h"
#include "io/formats/ply_header.h"

/// Reads the values of a PLY file in order, with the same interface for text and binary.
namespace lodestone {

class Ply_text_values {
 public:
  explicit Ply_text_values(const Text_scanner& after_header) : text_(after_header) {}

  /// @throws Bad_mesh  at the end of the file, and for anything but a finite number
  double next(Ply_type type);
  /// Skips a value without checking it.
  void skip(Ply_type type);
  bool at_end() { return text_.next_word_of_file().empty(); }
  std::size_t bytes_left() const { return text_.bytes_left(); }
  /// The minimum size of a value: a digit and a blank.
  static std::size_t least_bytes(Ply_type) { return 2; }
  [[noreturn]] void fail(std::string_view cause) const { text_.fail(cause); }

 private:
  std::string_view next_word();
  Text_scanner text_;
};

class Ply_binary_values {
 public:
  Ply_binary_values(const File_bytes& file, std::size_t first, std::endian order)
      : file_(file), at_(first), end_(first), order_(order) {}

  double next(Ply_type type);
  void skip(Ply_type type);
  bool at_end() const { return bytes_left() == 0; }
  std::size_t bytes_left() const { return file_.view().size() - end_; }
  static std::size_t least_bytes(Ply_type type) { return bytes_of(type); }
  [[noreturn]] void fail(std::string_view cause) const { file_.fail_at(at_, cause); }

 private:
  const File_bytes& file_;
  std::size_t at_, end_;  // offsets of the value last read and of the one after it
  std::endian order_;
};

}  // namespace lodestone
