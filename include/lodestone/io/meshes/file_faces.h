// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace lodestone {

/// The faces of a file whose triangles a mesh has.
struct File_faces {
  std::size_t count = 0;  ///< how many they are
  std::size_t cut = 0;    ///< faces of more than three corners, which were cut into triangles
};

/// Counts the faces that triangles were cut from. O(F).
/// @param file_face  see Mesh_file::file_face
constexpr File_faces count_file_faces(std::span<const std::uint32_t> file_face) {
  File_faces faces;
  for (std::size_t first = 0, next = 0; first < file_face.size(); first = next) {
    while (next < file_face.size() && file_face[next] == file_face[first]) ++next;
    ++faces.count;
    faces.cut += next - first > 1 ? 1 : 0;
  }
  return faces;
}

}  // namespace lodestone
