// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/meshes/mesh_file.h"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <fmt/format.h>

#include <utility>

#include "io/meshes/read_mesh_soup.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

/// A soup on its way to a mesh, with the file vertex of each point.
struct Tracked_soup {
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> faces;
  std::vector<std::uint32_t> file_vertex;

  /// Adds a copy of a file vertex and returns the copy's index.
  std::size_t add(const Mesh_soup& soup, std::size_t vertex) {
    points.push_back(soup.points[vertex]);
    file_vertex.push_back(static_cast<std::uint32_t>(vertex));
    return points.size() - 1;
  }
};

/// Keeps the vertices that faces use, in file order.
/// @return per file vertex: its index in `tracked`; unspecified for unused vertices
std::vector<std::size_t> add_used_vertices(const Mesh_soup& soup, Tracked_soup& tracked) {
  std::vector<bool> used(soup.points.size());
  for (const auto& face : soup.faces)
    for (const auto vertex : face) used[vertex] = true;
  std::vector<std::size_t> number(soup.points.size());
  for (std::size_t vertex = 0; vertex < used.size(); ++vertex)
    if (used[vertex]) number[vertex] = tracked.add(soup, vertex);
  return number;
}

/// A face that names one vertex twice is a legal triangle of zero area, but not a legal face of a half-edge mesh: the
/// later corners get copies of the vertex.
Tracked_soup with_distinct_corners(const Mesh_soup& soup) {
  Tracked_soup tracked;
  const auto number = add_used_vertices(soup, tracked);
  tracked.faces.reserve(soup.faces.size());
  for (const auto& face : soup.faces) {
    std::vector<std::size_t> corners = {number[face[0]], number[face[1]], number[face[2]]};
    if (face[1] == face[0]) corners[1] = tracked.add(soup, face[1]);
    if (face[2] == face[0] || face[2] == face[1]) corners[2] = tracked.add(soup, face[2]);
    tracked.faces.push_back(std::move(corners));
  }
  return tracked;
}

/// Records the originals of CGAL's copies of non-manifold vertices. Each copy is the next point appended.
struct Copy_recorder : PMP::Default_orientation_visitor {
  explicit Copy_recorder(std::vector<std::uint32_t>& origin) : file_vertex(&origin) {}
  void duplicated_vertex(std::size_t original, std::size_t) { file_vertex->push_back((*file_vertex)[original]); }

  std::vector<std::uint32_t>* file_vertex;
};

}  // namespace

Mesh_file mesh_of(const Mesh_soup& soup, const std::string& name) {
  auto tracked = with_distinct_corners(soup);
  PMP::orient_polygon_soup(tracked.points, tracked.faces,
                           CGAL::parameters::visitor(Copy_recorder(tracked.file_vertex)));

  Mesh_file result{.mesh = {},
                   .file_vertex = std::move(tracked.file_vertex),
                   .file_vertices = soup.points.size(),
                   .file_face = soup.file_face,
                   .joined = soup.joined,
                   .parts = soup.parts,
                   .ignored_extensions = soup.ignored_extensions,
                   .files = soup.files};
  PMP::polygon_soup_to_polygon_mesh(tracked.points, tracked.faces, result.mesh);
  if (num_faces(result.mesh) != soup.faces.size() || num_vertices(result.mesh) != result.file_vertex.size())
    throw Bad_mesh(fmt::format("{}: only {} of {} faces fit into a half-edge mesh", name, num_faces(result.mesh),
                               soup.faces.size()));
  return result;
}

Mesh_file mesh_of(std::span<const Point> points, std::span<const Corners> faces, const std::string& name) {
  Mesh_soup soup{.points = {points.begin(), points.end()}, .faces = {}, .file_face = {}};
  soup.faces.reserve(faces.size());
  for (const auto& face : faces) {
    soup.file_face.push_back(static_cast<std::uint32_t>(soup.faces.size()));
    soup.faces.emplace_back(face.begin(), face.end());
  }
  return mesh_of(soup, name);
}

Mesh_file read_mesh(const std::filesystem::path& file, const Mesh_file_options& options) {
  return mesh_of(read_mesh_soup(file, options), file.string());
}

}  // namespace lodestone
