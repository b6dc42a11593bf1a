// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>

#include "io/files/file_bytes.h"
#include "io/files/text_scanner.h"
#include "lodestone/io/formats/file_part.h"

/// One guard per format: it checks the whole file before CGAL's reader sees any of it.
///
/// CGAL 5.5's readers index past the end of arrays, allocate what a header claims, stop early without an error, or
/// refuse legal statements. So a guard gives them a copy with the same vertices and faces in the plainest form of the
/// format. It also computes the checksums with which `read_mesh_soup` verifies that they were read completely.
namespace lodestone {

/// A checksum that depends on every number added and on their order.
class Checksum {
 public:
  /// Zero and minus zero are equal, as in the welding of STL corners.
  void add_coordinate(double value) { add(std::bit_cast<std::uint64_t>(value + 0.0)); }
  void add_corner(std::uint64_t vertex) { add(vertex); }
  bool operator==(const Checksum&) const = default;

 private:
  void add(std::uint64_t bits) {
    sum_ = (sum_ ^ bits) * 0x9E3779B97F4A7C15U;  // 2^64 / golden ratio: odd, with well-mixed bits
    sum_ ^= sum_ >> 32U;
  }
  std::uint64_t sum_ = 0;
};

/// The result of a guard.
struct Guarded_mesh {
  std::string plain;         ///< the copy for CGAL's reader
  std::size_t vertices = 0;  ///< 0 for STL, whose vertices are known only after welding
  std::size_t faces = 0;
  Checksum coordinates;            ///< of the vertices in order; STL: of every corner of every face
  Checksum corners;                ///< per face, the vertex indices of its corners and their number; nothing for STL
  File_parts parts;                ///< that the file names
  std::set<std::string> not_read;  ///< what else the file holds, such as `texture coordinates`
};

/// @param max_faces  the face limit
/// @throws Bad_mesh
Guarded_mesh guard_off(const File_bytes& file, std::size_t max_faces);
Guarded_mesh guard_obj(const File_bytes& file, std::size_t max_faces);
Guarded_mesh guard_ply(const File_bytes& file, std::size_t max_faces);
Guarded_mesh guard_stl(const File_bytes& file, std::size_t max_faces);

/// Error text for a header with impossible counts: fewer bytes are left than its items need at least.
std::string too_short_for(std::size_t count, const std::string& things, std::size_t bytes_left);
/// Error text for a file with too many faces.
std::string too_many_faces(std::size_t faces, std::size_t max_faces);
/// Error text for a face of fewer than three corners, or of more than three where the format has triangles only.
std::string wrong_corners(std::size_t face, std::size_t corners, std::string_view expected);

/// Checks the next three coordinates of the current line and adds them to the plain copy, with a line end.
void copy_coordinates(Text_scanner& text, Guarded_mesh& mesh);

}  // namespace lodestone
