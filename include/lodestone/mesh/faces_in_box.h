// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "lodestone/mesh/box.h"
#include "lodestone/mesh/connectivity.h"
#include "lodestone/mesh/coordinate_reader.h"
#include "lodestone/mesh/coordinates.h"
#include "lodestone/mesh/triangle_corners.h"
#include "lodestone/mesh/unset_vector.h"

namespace lodestone {

/// Faces of a mesh whose boxes meet a given box.
struct Faces_in_box {
  Unset_vector<std::uint32_t> faces;  ///< their indices in the mesh, ascending
  Unset_vector<Corners> corners;      ///< of each, as indices into `coordinates`
  Coordinates coordinates;            ///< the memory of the mesh, or `copied`
  std::vector<double> copied;         ///< empty, or nine coordinates per face: then no two faces share a vertex

  Faces_in_box() = default;
  Faces_in_box(const Faces_in_box&) = delete;  // `coordinates` may refer to `copied`
  Faces_in_box& operator=(const Faces_in_box&) = delete;
};

/// The smallest box around all positions. O(V).
/// @return false if a coordinate is not finite; the box is then meaningless
bool bound_positions(Coordinates coordinates, Box& box);

/// The sides of a box that a position lies beyond, a bit for each; 0: it lies inside. A triangle's own box misses the
/// box exactly where its three corners have a bit in common.
std::uint8_t sides_beyond(const double* position, const Box& box);
/// The same for all positions. O(V).
Unset_vector<std::uint8_t> sides_beyond(Coordinates coordinates, const Box& box);
/// The same, in the memory of the caller.
void sides_beyond(Coordinates coordinates, const Box& box, Unset_vector<std::uint8_t>& sides);

/// Those faces whose boxes meet a smaller box. They refer to the same coordinates. O(V + faces).
/// @param found  empty so far; valid as long as `faces`
void select_faces(const Faces_in_box& faces, const Box& part, Faces_in_box& found);

/// Reads a mesh of which only a part matters, without numbering it: once all positions, then the faces in a box.
///
/// What a numbering refuses, this refuses too, but without a message: `Mesh_numbering` has them.
template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
class Box_reader {
 public:
  /// @param mesh  must outlive this
  Box_reader(const Mesh& mesh, Points points) : mesh_(&mesh), points_(std::move(points)) {}

  /// Reads all positions. O(V).
  /// @return false: no face, too many of them, removed elements, or a coordinate that is not finite
  bool read_positions();
  /// The smallest box around all vertices, once they have been read.
  const Box& box() const { return box_; }

  /// Reads the faces whose boxes meet a box. O(V + F), once per mesh.
  /// @param part   an empty box: no face is listed, but all are checked, in a mesh without border by their number alone
  /// @param found  empty so far; valid as long as the mesh stays as it is
  /// @return false if a face is no triangle, or has been removed
  bool read_faces(const Box& part, Faces_in_box& found) const;

 private:
  static constexpr bool in_memory = Coordinate_reader<Mesh, Points>::in_memory;

  Coordinates memory() const requires in_memory { return Coordinate_reader<Mesh, Points>::memory(*mesh_, points_); }
  /// Whether the numbers of faces and edges prove that every face is a triangle, if none has less than three edges.
  /// They can if there is no border. O(1).
  bool all_triangles_by_count() const {
    if constexpr (requires { num_halfedges(*mesh_); }) return num_halfedges(*mesh_) == 3 * num_faces(*mesh_);
    return false;
  }
  template <class Use>
  bool for_each_face(Use use) const;
  template <class Use>
  bool use_triangle(std::uint32_t index, Face<Mesh> f, bool all_triangles, Use use) const;
  bool select(std::span<const std::uint8_t> sides, Faces_in_box& found) const;

  const Mesh* mesh_;
  Points points_;
  Box box_;
};

template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
bool Box_reader<Mesh, Points>::read_positions() {
  constexpr std::size_t limit = std::numeric_limits<std::uint32_t>::max() - 1;
  if (holds_removed_faces(*mesh_)) return false;
  if (num_faces(*mesh_) == 0 || num_faces(*mesh_) > limit || num_vertices(*mesh_) > limit) return false;
  if constexpr (in_memory) {
    return bound_positions(memory(), box_);
  } else {
    Eigen::Vector3d zero = Eigen::Vector3d::Zero();
    std::size_t count = 0;
    for (const auto v : vertices(*mesh_)) {
      ++count;
      const Eigen::Vector3d position = coordinates(get(points_, v));
      box_.extend(position);
      zero += 0 * position;  // stays zero unless a coordinate is not finite
    }
    return zero.isZero(0) && count == num_vertices(*mesh_);  // removed vertices may be counted, but are not listed
  }
}

/// Calls `use(face, p, q, r)` with the index and the corners of a face.
/// @return false if it is no triangle of vertices
template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
template <class Use>
bool Box_reader<Mesh, Points>::use_triangle(std::uint32_t index, Face<Mesh> f, bool all_triangles, Use use) const {
  if constexpr (requires { mesh_->has_corners(f); })
    if (!mesh_->has_corners(f)) return false;
  const auto first = halfedge(f, *mesh_);
  // Operations of CGAL can make faces of two edges.
  if (all_triangles ? next(next(first, *mesh_), *mesh_) == first : !is_triangle(first, *mesh_)) return false;
  const auto [p, q, r] = triangle_corners(first, *mesh_);
  use(index, p, q, r);
  return true;
}

/// The same for each face.
/// @return false if a face is no triangle, or has been removed
template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
template <class Use>
bool Box_reader<Mesh, Points>::for_each_face(Use use) const {
  const bool all_triangles = all_triangles_by_count();
  std::uint32_t index = 0;
  for (const auto f : faces(*mesh_))
    if (!use_triangle(index++, f, all_triangles, use)) return false;
  return index == num_faces(*mesh_);  // removed faces may be counted, but are not listed
}

/// Lists the faces whose corners do not all lie beyond one side. For positions in memory.
/// @param sides  of each vertex
/// @return false if a face is no triangle
template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
bool Box_reader<Mesh, Points>::select(std::span<const std::uint8_t> sides, Faces_in_box& found) const {
  static_assert(Vertex_table<Mesh>::by_index);  // no face has been removed: to ask before each face takes time
  constexpr std::size_t block = 1024;
  const bool all_triangles = all_triangles_by_count();
  const std::size_t face_count = num_faces(*mesh_);
  std::size_t count = 0;
  for (std::size_t first = 0; first < face_count; first += block) {
    // Most faces lie outside the box: room for all at once would be memory that nobody needs.
    if (found.faces.size() < count + block) {
      found.faces.resize(2 * count + 4 * block);
      found.corners.resize(2 * count + 4 * block);
    }
    // Every face is written, and kept by counting it: whether it is kept can hardly be predicted.
    const auto add = [&count, faces = found.faces.data(), corners = found.corners.data(), beyond = sides.data()](
                         std::uint32_t face, auto p, auto q, auto r) {
      faces[count] = face;
      corners[count] = {p, q, r};
      count += (beyond[p] & beyond[q] & beyond[r]) == 0 ? 1 : 0;
    };
    const auto end = static_cast<std::uint32_t>(std::min(first + block, face_count));
    for (auto face = static_cast<std::uint32_t>(first); face < end; ++face)
      if (!use_triangle(face, Face<Mesh>(face), all_triangles, add)) return false;
  }
  found.faces.resize(count);
  found.corners.resize(count);
  return true;
}

template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
bool Box_reader<Mesh, Points>::read_faces(const Box& part, Faces_in_box& found) const {
  if (part.isEmpty()) return all_triangles_by_count() || for_each_face([](auto&&...) {});
  if constexpr (in_memory) {
    found.coordinates = memory();
    return select(sides_beyond(memory(), part), found);
  } else {
    bool countable = true;
    const bool triangles = for_each_face([&](std::uint32_t face, auto... corners) {
      const Eigen::Vector3d positions[]{coordinates(get(points_, corners))...};
      std::uint8_t common = 0xff;
      for (const auto& position : positions) common &= sides_beyond(position.data(), part);
      if (common != 0) return;
      constexpr std::size_t most_faces = std::numeric_limits<std::uint32_t>::max() / 3;
      countable = countable && found.faces.size() < most_faces;
      if (!countable) return;
      const auto first = static_cast<std::uint32_t>(3 * found.faces.size());
      found.faces.push_back(face);
      found.corners.push_back({first, first + 1, first + 2});
      for (const auto& position : positions)
        found.copied.insert(found.copied.end(), position.data(), position.data() + 3);
    });
    found.coordinates = found.copied;
    return triangles && countable;
  }
}

}  // namespace lodestone
