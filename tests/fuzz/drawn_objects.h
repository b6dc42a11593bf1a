// SPDX-License-Identifier: GPL-3.0-or-later
// Small objects whose faces touch, coincide, have no area, or are tiny or huge.
#pragma once

#include <optional>
#include <vector>

#include "fuzz/byte_source.h"
#include "lodestone/bounds/displacement_bound.h"
#include "lodestone/mesh/indexed_mesh.h"
#include "lodestone/mesh/rigid_motion.h"
#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone::fuzz {

/// A mesh with the arrays that it refers to. It must not be moved.
struct Drawn_object {
  std::vector<double> coordinates = {};
  std::vector<Corners> faces = {};
  std::optional<Indexed_mesh> mesh = {};
  std::optional<std::vector<double>> given = {};  ///< in place of the mesh's coordinates
  std::optional<Rigid_motion> placement = {};
  std::vector<double> shown = {};  ///< where the vertices are: given, placed
  Displacement_promise promise = Displacement_promise();
  bool is_promised = false;
  bool is_removed = false;

  void make_mesh() {
    mesh.emplace(coordinates, faces);
    shown = coordinates;
  }
  std::size_t vertices() const { return coordinates.size() / 3; }
  Triangle triangle(std::size_t face) const;

  /// Takes a change, and computes where the vertices are.
  /// @return false if they would not be finite: the object stays as it was
  bool change(std::vector<double> coordinates_now, std::optional<std::vector<double>> given_now,
              std::optional<Rigid_motion> placement_now);
};

/// Fills an object: cloth, closed bodies, loose or tangled faces, somewhere and of some size.
void draw_object(Byte_source& bytes, Drawn_object& object);

/// Moves one vertex, or all of them, and promises no less than that.
void move_vertices(Byte_source& bytes, Drawn_object& object, const Drawn_object& other);

/// Makes a face a segment or a point.
void collapse_face(Byte_source& bytes, Drawn_object& object);

/// A rotation and a translation, or none.
std::optional<Rigid_motion> draw_placement(Byte_source& bytes);

/// Adds, removes or turns a face. Given coordinates are no longer.
/// @return the faces whose corners are others than before
std::vector<std::uint32_t> change_faces(Byte_source& bytes, Drawn_object& object);

}  // namespace lodestone::fuzz
