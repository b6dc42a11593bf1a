// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/files/text_scanner.h"

namespace lodestone {

enum class Ply_format { ascii, binary_little_endian, binary_big_endian };

/// The number types of PLY. Each has two names, such as `uchar` and `uint8`.
enum class Ply_type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t bytes_of(Ply_type type);
bool is_integer(Ply_type type);

struct Ply_property {
  std::string name;
  Ply_type type = Ply_type::float32;   ///< of the value, or of each item of a list
  std::optional<Ply_type> count_type;  ///< of the item count; none: not a list
};

struct Ply_element {
  std::string name;
  std::size_t count = 0;
  std::vector<Ply_property> properties;
};

struct Ply_header {
  Ply_format format = Ply_format::ascii;
  std::vector<Ply_element> elements;
};

/// Reads a PLY header. Afterwards `text` is at the first byte of the data.
/// @throws Bad_mesh
Ply_header read_ply_header(Text_scanner& text);

}  // namespace lodestone
