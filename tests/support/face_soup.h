// SPDX-License-Identifier: GPL-3.0-or-later
// Objects as the trees take them: faces and coordinates by index.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lodestone/io/shapes/shapes.h"
#include "lodestone/queries/exhaustive.h"
#include "lodestone/tree/tree_surface.h"
#include "lodestone/triangles/triangle_intersection.h"
#include "support/test_meshes.h"

namespace lodestone {

/// Faces and coordinates, which need not form a half-edge mesh.
struct Face_soup {
  std::vector<Corners> faces;
  std::vector<double> coordinates;

  Face_soup() = default;
  Face_soup(const Surface_mesh& mesh) {
    const Numbered_mesh numbered(mesh);
    faces.assign(numbered.faces.begin(), numbered.faces.end());
    coordinates.assign(numbered.positions.data(), numbered.positions.data() + numbered.positions.size());
  }

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(coordinates.size() / 3); }
  Point point(std::uint32_t vertex) const {
    const double* p = coordinates.data() + 3 * std::size_t{vertex};
    return {p[0], p[1], p[2]};
  }
  Triangle triangle(std::size_t face) const {
    const auto& [a, b, c] = faces[face];
    return {point(a), point(b), point(c)};
  }
  Positions positions() const { return Eigen::Map<const Positions>(coordinates.data(), vertex_count(), 3); }
};

/// Faces around one vertex, the first: a disc of radius 1, or a cone whose tip is that vertex.
/// @param height  of the tip above the rim
inline Face_soup fan_of_faces(std::uint32_t count, const Point& tip, double height) {
  Face_soup soup;
  soup.coordinates = {tip.x(), tip.y(), tip.z()};
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    soup.coordinates.insert(soup.coordinates.end(),
                            {tip.x() + std::cos(angle), tip.y() + std::sin(angle), tip.z() - height});
    soup.faces.push_back({0, 1 + i, 1 + (i + 1) % count});
  }
  return soup;
}

/// Takes every vertex p to `map(p)`.
template <class Map>
void deform(Face_soup& soup, Map map) {
  for (std::uint32_t v = 0; v < soup.vertex_count(); ++v) {
    const Point p = map(soup.point(v));
    for (int axis = 0; axis < 3; ++axis) soup.coordinates[3 * std::size_t{v} + axis] = p[axis];
  }
}

/// Moved by a vector.
Face_soup moved(Face_soup soup, double x, double y, double z);

/// Shapes that coincide, or touch in corners, edges, or parts of their faces.
/// @param detail  how fine they are; > 1
std::vector<std::pair<Face_soup, Face_soup>> touching_soups(std::size_t detail);

/// Coordinates times `factor`, plus `offset`.
Face_soup placed(Face_soup soup, double factor, double offset = 0);

/// Rotates about a random axis through the origin by any angle, then moves by at most `distance` along each axis.
Face_soup posed_at_random(Face_soup soup, double distance, std::mt19937_64& random);

/// Moves every coordinate at random.
Face_soup crumpled(Face_soup soup, double distance, std::uint64_t seed);

Face_soup joined(Face_soup a, const Face_soup& b);

/// The same triangles with vertices, faces and the corners of each face in random order.
Face_soup shuffled(const Face_soup& soup, std::uint64_t seed);

/// Faces with any corners among the points of a lattice with `size` points a side: many share vertices, touch, lie in
/// one plane, lie on each other or have no area.
Face_soup lattice_soup(std::size_t faces, std::uint32_t vertices, std::uint64_t size, std::uint64_t seed);

/// Small triangles anywhere in [-1, 1]^3, no two of which share a vertex.
Face_soup loose_triangles(std::uint32_t count, double size, std::uint64_t seed);

/// Eight regions, by the octant around the mean vertex.
std::vector<Region_index> octants(const Face_soup& soup);

/// Objects of several kinds, each some hundred faces of about the size of the unit sphere.
std::vector<std::pair<std::string, Face_soup>> small_objects();

/// An object with its faces and coordinates. Not movable, since trees refer to both.
class Posed_object {
 public:
  explicit Posed_object(Face_soup soup, std::size_t leaf_faces = 16, bool divided = true)
      : soup_(std::move(soup)), object_(soup_.faces) {
    object_.build(divided ? octants(soup_) : std::vector<Region_index>(soup_.vertex_count()), soup_.coordinates,
                  {.leaf_faces = leaf_faces});
  }
  Posed_object(const Posed_object&) = delete;
  Posed_object& operator=(const Posed_object&) = delete;

  const Face_soup& soup() const { return soup_; }
  const Tree_surface& object() const { return object_; }
  Tree_view view() const { return object_.view(); }

  /// Takes the current pose as that at rest.
  void keep_rest() { object_.keep_rest(); }
  /// Moves the vertices to those of `pose`.
  void move_to(const Face_soup& pose) {
    soup_.coordinates = pose.coordinates;
    Workers alone(1);
    Tree_surface* const objects[]{&object_};
    const Coordinates now[]{soup_.coordinates};
    refit(objects, now, alone);
  }

 private:
  Face_soup soup_;
  Tree_surface object_;
};

/// All intersecting face pairs, by exhaustive checking.
std::vector<Face_pair> true_pairs(const Face_soup& a, const Face_soup& b);

}  // namespace lodestone
