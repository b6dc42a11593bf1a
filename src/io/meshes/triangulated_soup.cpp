// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/meshes/triangulated_soup.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
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

using Side = std::pair<std::size_t, std::size_t>;  // two corners, the lower first

/// Sides of which an odd number lie on each other. Two lie there where a polygon with a hole is cut open: the surface
/// is on both sides.
using Outline = std::set<Side>;

Side side_between(std::size_t a, std::size_t b) { return std::minmax(a, b); }

/// Inserts corners and sides. A vertex of the plane knows the last of the corners there.
/// @param polygon  the mesh vertex of each corner: corners at one place must be one vertex
/// @return nothing unless each side is one edge of the plane, and none cross
std::optional<Outline> insert_outline(const std::vector<Kernel::Point_2>& flat, const Polygon& polygon,
                                      Plane_triangulation& plane) {
  std::vector<Plane_triangulation::Vertex_handle> vertices;
  plane.infinite_vertex()->info() = flat.size();  // no corner
  for (std::size_t corner = 0; corner < flat.size(); ++corner) {
    const std::size_t before = plane.number_of_vertices();
    vertices.push_back(plane.insert(flat[corner]));
    const bool is_new = plane.number_of_vertices() > before;
    if (!is_new && polygon[vertices.back()->info()] != polygon[corner]) return {};
    vertices.back()->info() = corner;
  }
  if (plane.dimension() != 2) return {};
  Outline outline;
  try {
    for (std::size_t corner = 0; corner < flat.size(); ++corner) {
      const auto a = vertices[corner], b = vertices[(corner + 1) % flat.size()];
      if (a == b) return {};
      plane.insert_constraint(a, b);
      if (!plane.is_edge(a, b)) return {};  // a corner lies on it
      if (const auto [at, added] = outline.insert(side_between(a->info(), b->info())); !added) outline.erase(at);
    }
  } catch (const Plane_triangulation::Intersection_of_constraints_exception&) {
    return {};
  }
  return outline;
}

/// Marks the triangles inside the outline: those that every path from outside reaches through an odd number of sides.
void mark_inside(Plane_triangulation& plane, const Outline& outline) {
  std::set<Plane_triangulation::Face_handle> seen{plane.infinite_face()};
  std::vector<Plane_triangulation::Face_handle> waiting(seen.begin(), seen.end());
  while (!waiting.empty()) {
    const auto face = waiting.back();
    waiting.pop_back();
    for (int side = 0; side < 3; ++side) {
      const auto next = face->neighbor(side);
      if (!seen.insert(next).second) continue;
      const auto a = face->vertex(plane.cw(side)), b = face->vertex(plane.ccw(side));
      next->info().value = face->info().value != outline.contains(side_between(a->info(), b->info()));
      waiting.push_back(next);
    }
  }
}

/// @return nothing for a polygon that crosses itself in its plane, that has a corner on another side, or that falls
/// into
///         parts which touch in a corner
Polygon_triangles triangulate_in_plane(std::span<const Point> corners, const Polygon& polygon) {
  Plane_triangulation plane;
  const auto outline = insert_outline(flattened(corners), polygon, plane);
  if (!outline) return {};
  mark_inside(plane, *outline);
  Polygon_triangles triangles;
  for (const auto face : plane.finite_face_handles())
    if (face->info().value)
      triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  // Parts that touch in a corner alone give other numbers.
  if (triangles.size() != corners.size() - 2) return {};
  return triangles;
}

Polygon_triangles triangulate(const Polygon& polygon, const std::vector<Point>& points) {
  std::vector<Point> corners;
  for (const auto vertex : polygon) corners.push_back(points[vertex]);
  if (corners.size() == 4) return cut_quad({corners[0], corners[1], corners[2], corners[3]});
  auto triangles = triangulate_in_plane(corners, polygon);
  return triangles.empty() ? fan(corners.size()) : triangles;
}

}  // namespace

Mesh_soup triangulated(Polygon_soup soup) {
  Mesh_soup result{.points = std::move(soup.points),
                   .faces = {},
                   .file_face = {},
                   .joined = std::move(soup.joined),
                   .parts = std::move(soup.parts),
                   .not_read = std::move(soup.not_read),
                   .ignored_extensions = std::move(soup.ignored_extensions),
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
