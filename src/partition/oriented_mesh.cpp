// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/oriented_mesh.h"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>

#include <array>
#include <cmath>
#include <numeric>

#include "lodestone/mesh/scaled_positions.h"

namespace lodestone {

namespace {

/// Records of which vertex each added one is a copy, and which polygons were turned.
struct Changes : CGAL::Polygon_mesh_processing::Default_orientation_visitor {
  std::vector<std::uint32_t>* indices = nullptr;
  std::vector<bool>* turned = nullptr;

  void duplicated_vertex(std::size_t original, std::size_t copy) const {
    if (copy >= indices->size()) indices->resize(copy + 1);
    (*indices)[copy] = (*indices)[original];
  }
  void polygon_orientation_reversed(std::size_t polygon) const { turned->at(polygon) = !turned->at(polygon); }
};

double rounded(double x) { return std::ldexp(std::nearbyint(std::ldexp(x, 50)), -50); }

std::vector<Point> rounded_points(const Positions& positions) {
  const Positions scaled = scaled_positions(positions);
  std::vector<Point> points;
  points.reserve(positions.rows());
  for (const auto& row : scaled.rowwise()) points.emplace_back(rounded(row[0]), rounded(row[1]), rounded(row[2]));
  return points;
}

}  // namespace

Oriented_mesh oriented_mesh(const Numbered_surface& surface) {
  Oriented_mesh result;
  auto points = rounded_points(surface.positions);
  std::vector<std::uint32_t> faces;  // those with three different corners
  std::vector<std::array<std::size_t, 3>> polygons;
  for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
    const auto& [a, b, c] = surface.faces[f];
    if (a == b || b == c || c == a) continue;
    polygons.push_back({a, b, c});
    faces.push_back(f);
  }

  result.vertex_indices.resize(points.size());
  std::iota(result.vertex_indices.begin(), result.vertex_indices.end(), 0);
  std::vector<bool> turned(polygons.size(), false);
  Changes changes;
  changes.indices = &result.vertex_indices;
  changes.turned = &turned;
  CGAL::Polygon_mesh_processing::orient_polygon_soup(points, polygons, CGAL::parameters::visitor(changes));

  using Index = Surface_mesh::Vertex_index;
  const auto index = [](std::size_t i) { return Index(static_cast<Surface_mesh::size_type>(i)); };
  for (const auto& point : points) result.mesh.add_vertex(point);
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    const auto face = result.mesh.add_face(index(polygons[p][0]), index(polygons[p][1]), index(polygons[p][2]));
    if (face == Surface_mesh::null_face()) continue;
    result.face_indices.push_back(faces[p]);
    result.turned.push_back(turned[p]);
  }
  return result;
}

}  // namespace lodestone
