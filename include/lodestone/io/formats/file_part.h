// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace lodestone {

/// Faces that a file keeps together under a name: an object of an OBJ file (`o`, or `g` if there is no `o`), or a node
/// of a glTF file that shows a mesh.
struct File_part {
  std::string name;              ///< faces of several parts with one name belong together; may be empty
  std::uint32_t first_face = 0;  ///< in the file; the part ends where the next begins
};

/// Ascending by their first faces; empty: the file names none.
using File_parts = std::vector<File_part>;

/// Begins a part at a face. A part that is without faces so far is gone.
inline void begin_part(std::string name, std::uint32_t first_face, File_parts& parts) {
  if (!parts.empty() && parts.back().first_face == first_face) parts.pop_back();
  parts.push_back({.name = std::move(name), .first_face = first_face});
}

}  // namespace lodestone
