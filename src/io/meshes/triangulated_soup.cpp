// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/meshes/triangulated_soup.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace lodestone {
namespace {

using Polygon = std::vector<std::size_t>;
using Polygon_triangle = std::array<std::size_t, 3>;  // corners of a polygon, from 0
using Polygon_triangles = std::vector<Polygon_triangle>;
using Vector = Kernel::Vector_3;

struct Is_inside {
  bool value = false;
};
using Vertex_base = CGAL::Triangulation_vertex_base_with_info_2<std::size_t, Kernel>;
using Face_base =
    CGAL::Constrained_triangulation_face_base_2<Kernel, CGAL::Triangulation_face_base_with_info_2<Is_inside, Kernel>>;
/// Refuses sides that cross: their intersection would not be a corner.
using Plane_triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex_base, Face_base>,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;

Polygon_triangles fan(std::size_t corners) {
  Polygon_triangles triangles;
  for (std::size_t corner = 2; corner < corners; ++corner) triangles.push_back({0, corner - 1, corner});
  return triangles;
}

/// The scalar product of the triangles' normals is greatest where both are large and face the same way; it is negative
/// for a diagonal outside a concave quad. In a parallelogram both diagonals are equally good. Then it must not depend
/// on rounding which of them is taken, or the same quads in two formats would be two surfaces.
Polygon_triangles cut_quad(const std::array<Point, 4>& p) {
  const auto normal = [&](int a, int b, int c) { return CGAL::cross_product(p[b] - p[a], p[c] - p[a]); };
  constexpr double rounding = 1e-3;  // of coordinates with seven digits, of a quad that is far from the origin
  const double along_1_3 = normal(1, 2, 3) * normal(3, 0, 1), along_0_2 = normal(0, 1, 2) * normal(2, 3, 0);
  if (along_1_3 - along_0_2 > rounding * (std::abs(along_1_3) + std::abs(along_0_2))) return {{0, 1, 3}, {1, 2, 3}};
  return {{0, 1, 2}, {0, 2, 3}};
}

/// Twice the vector area (Newell's normal).
Vector normal_of(std::span<const Point> corners) {
  Vector normal(0, 0, 0);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    normal = normal + CGAL::cross_product(corners[i] - corners[0], corners[i + 1] - corners[0]);
  return normal;
}

/// The corners in the coordinate plane that faces the normal most, counter-clockwise if the polygon is simple there.
std::vector<Kernel::Point_2> flattened(std::span<const Point> corners) {
  const auto normal = normal_of(corners);
  int up = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(normal[axis]) > std::abs(normal[up])) up = axis;
  int x = (up + 1) % 3, y = (up + 2) % 3;
  if (normal[up] < 0) std::swap(x, y);
  std::vector<Kernel::Point_2> flat;
  flat.reserve(corners.size());
  for (const Point& corner : corners) flat.emplace_back(corner[x], corner[y]);
  return flat;
}

/// Inserts corners and sides.
/// @return whether the sides are those of a simple polygon
bool insert_outline(const std::vector<Kernel::Point_2>& flat, Plane_triangulation& plane) {
  std::vector<Plane_triangulation::Vertex_handle> vertices;
  for (std::size_t corner = 0; corner < flat.size(); ++corner) {
    vertices.push_back(plane.insert(flat[corner]));
    vertices.back()->info() = corner;
  }
  if (plane.dimension() != 2 || plane.number_of_vertices() != flat.size()) return false;
  try {
    for (std::size_t corner = 0; corner < flat.size(); ++corner)
      plane.insert_constraint(vertices[corner], vertices[(corner + 1) % flat.size()]);
  } catch (const Plane_triangulation::Intersection_of_constraints_exception&) {
    return false;
  }
  return true;
}

/// Marks the triangles inside the outline: those that every path from outside reaches through a side.
void mark_inside(Plane_triangulation& plane) {
  for (const auto face : plane.all_face_handles()) face->info().value = true;
  std::vector<Plane_triangulation::Face_handle> outside{plane.infinite_face()};
  outside.back()->info().value = false;
  while (!outside.empty()) {
    const auto face = outside.back();
    outside.pop_back();
    for (int side = 0; side < 3; ++side) {
      const auto next = face->neighbor(side);
      if (face->is_constrained(side) || !next->info().value) continue;
      next->info().value = false;
      outside.push_back(next);
    }
  }
}

/// @return nothing for a polygon that is not simple in its plane
Polygon_triangles triangulate_in_plane(std::span<const Point> corners) {
  Plane_triangulation plane;
  if (!insert_outline(flattened(corners), plane)) return {};
  mark_inside(plane);
  Polygon_triangles triangles;
  for (const auto face : plane.finite_face_handles())
    if (face->info().value)
      triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  // A corner on another side gives other numbers.
  if (triangles.size() != corners.size() - 2) return {};
  return triangles;
}

Polygon_triangles triangulate(const Polygon& polygon, const std::vector<Point>& points) {
  std::vector<Point> corners;
  for (const auto vertex : polygon) corners.push_back(points[vertex]);
  if (corners.size() == 4) return cut_quad({corners[0], corners[1], corners[2], corners[3]});
  auto triangles = triangulate_in_plane(corners);
  return triangles.empty() ? fan(corners.size()) : triangles;
}

}  // namespace

Mesh_soup triangulated(Polygon_soup soup) {
  Mesh_soup result{.points = std::move(soup.points),
                   .faces = {},
                   .file_face = {},
                   .parts = std::move(soup.parts),
                   .not_read = std::move(soup.not_read),
                   .files = std::move(soup.files)};
  result.faces.reserve(soup.faces.size());
  result.file_face.reserve(soup.faces.size());
  for (std::uint32_t face = 0; face < soup.faces.size(); ++face) {
    auto& polygon = soup.faces[face];
    if (polygon.size() == 3) {
      result.faces.push_back(std::move(polygon));
      result.file_face.push_back(face);
      continue;
    }
    for (const auto& [a, b, c] : triangulate(polygon, result.points)) {
      result.faces.push_back({polygon[a], polygon[b], polygon[c]});
      result.file_face.push_back(face);
    }
  }
  return result;
}

}  // namespace lodestone
