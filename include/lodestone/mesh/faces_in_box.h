// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "lodestone/mesh/box.h"
#include "lodestone/mesh/coordinate_reader.h"
#include "lodestone/mesh/coordinates.h"
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
  /// @param part   an empty box: no face is listed, but all are checked
  /// @param found  empty so far; valid as long as the mesh stays as it is
  /// @return false if a face is no triangle
  bool read_faces(const Box& part, Faces_in_box& found) const;

 private:
  static constexpr bool in_memory = Coordinate_reader<Mesh, Points>::in_memory;

  Coordinates memory() const requires in_memory {
    return Coordinate_reader<Mesh, Points>::memory(*mesh_, points_);
  }
  /// Whether the numbers of faces and edges prove that every face is a triangle, which they can if there is no border:
  /// a face has at least three edges. O(1).
  bool all_triangles_by_count() const {
    if constexpr (requires { num_halfedges(*mesh_); }) return num_halfedges(*mesh_) == 3 * num_faces(*mesh_);
    return false;
  }
  template <class Use>
  bool for_each_face(Use use) const;

  const Mesh* mesh_;
  Points points_;
  Box box_;
};

template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
bool Box_reader<Mesh, Points>::read_positions() {
  constexpr std::size_t limit = std::numeric_limits<std::uint32_t>::max() - 1;
  if constexpr (requires { mesh_->has_garbage(); })
    if (mesh_->has_garbage()) return false;
  if (num_faces(*mesh_) == 0 || num_faces(*mesh_) > limit || num_vertices(*mesh_) > limit) return false;
  if constexpr (in_memory) {
    return bound_positions(memory(), box_);
  } else {
    Eigen::Vector3d zero = Eigen::Vector3d::Zero();
    for (const auto v : vertices(*mesh_)) {
      const Eigen::Vector3d position = coordinates(get(points_, v));
      box_.extend(position);
      zero += 0 * position;  // stays zero unless a coordinate is not finite
    }
    return zero.isZero(0);
  }
}

/// Calls `use(face, p, q, r)` with the index and the corners of each face.
/// @return false if a face is no triangle
template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
template <class Use>
bool Box_reader<Mesh, Points>::for_each_face(Use use) const {
  const bool all_triangles = all_triangles_by_count();
  std::uint32_t face = 0;
  for (const auto f : faces(*mesh_)) {
    const auto first = halfedge(f, *mesh_);
    const auto second = next(first, *mesh_);
    const auto third = next(second, *mesh_);
    if (!all_triangles && next(third, *mesh_) != first) return false;
    use(face++, target(first, *mesh_), target(second, *mesh_), target(third, *mesh_));
  }
  return true;
}

template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
bool Box_reader<Mesh, Points>::read_faces(const Box& part, Faces_in_box& found) const {
  if (part.isEmpty()) return all_triangles_by_count() || for_each_face([](auto&&...) {});
  if constexpr (in_memory) {
    const auto beyond = sides_beyond(memory(), part);
    found.coordinates = memory();
    found.faces.resize(num_faces(*mesh_));
    found.corners.resize(num_faces(*mesh_));
    std::size_t count = 0;
    // Every face is written, and kept by counting it: whether it is kept can hardly be predicted.
    const bool triangles = for_each_face([&, faces = found.faces.data(), corners = found.corners.data(),
                                          sides = beyond.data()](std::uint32_t face, auto p, auto q, auto r) {
      faces[count] = face;
      corners[count] = {p, q, r};
      count += (sides[p] & sides[q] & sides[r]) == 0 ? 1 : 0;
    });
    found.faces.resize(count);
    found.corners.resize(count);
    return triangles;
  } else {
    const bool triangles = for_each_face([&](std::uint32_t face, auto... corners) {
      const Eigen::Vector3d positions[]{coordinates(get(points_, corners))...};
      std::uint8_t common = 0xff;
      for (const auto& position : positions) common &= sides_beyond(position.data(), part);
      if (common != 0) return;
      const auto first = static_cast<std::uint32_t>(3 * found.faces.size());
      found.faces.push_back(face);
      found.corners.push_back({first, first + 1, first + 2});
      for (const auto& position : positions)
        found.copied.insert(found.copied.end(), position.data(), position.data() + 3);
    });
    found.coordinates = found.copied;
    return triangles;
  }
}

}  // namespace lodestone
