// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/component_objects.h"

#include <fmt/format.h>

#include <limits>
#include <string>

#include "lodestone/io/meshes/mesh_file.h"
#include "lodestone/mesh/components.h"

namespace lodestone {

namespace {

/// The faces of one component. Their corners are numbered within the component.
struct Component_faces {
  std::vector<Point> points;
  std::vector<std::uint32_t> file_vertex;  ///< per point
  std::vector<Corners> faces;
  std::vector<std::uint32_t> file_face;  ///< per face
};

/// The corners of all faces, by file vertex.
std::vector<Corners> file_corners(const Scene_object& object) {
  std::vector<Corners> faces;
  faces.reserve(object.mesh.number_of_faces());
  for (const auto f : object.mesh.faces()) {
    auto corner = faces.emplace_back().begin();
    for (const auto v : object.mesh.vertices_around_face(object.mesh.halfedge(f))) *corner++ = object.file_vertex[v];
  }
  return faces;
}

std::vector<Point> file_points(const Scene_object& object) {
  std::vector<Point> points(object.file_vertices);
  for (const auto v : object.mesh.vertices()) points[object.file_vertex[v]] = object.mesh.point(v);
  return points;
}

std::vector<Component_faces> separated_faces(const Scene_object& object) {
  const auto points = file_points(object);
  const auto faces = file_corners(object);
  const auto component = component_of_faces(static_cast<std::uint32_t>(points.size()), faces);
  constexpr std::uint32_t unnumbered = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(points.size(), unnumbered);
  std::vector<Component_faces> parts;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (component[f] == parts.size()) parts.emplace_back();
    auto& part = parts[component[f]];
    Corners corners = faces[f];
    for (auto& corner : corners) {
      const auto vertex = corner;
      if (number[vertex] == unnumbered) {
        number[vertex] = static_cast<std::uint32_t>(part.points.size());
        part.points.push_back(points[vertex]);
        part.file_vertex.push_back(vertex);
      }
      corner = number[vertex];
    }
    part.faces.push_back(corners);
    part.file_face.push_back(object.file_face[f]);
  }
  return parts;
}

Scene_object object_of(const Component_faces& part, std::string name, const Scene_object& whole) {
  auto built = mesh_of(part.points, part.faces, name);
  for (auto& vertex : built.file_vertex) vertex = part.file_vertex[vertex];
  return {.name = std::move(name),
          .mesh = std::move(built.mesh),
          .file_vertex = std::move(built.file_vertex),
          .file_vertices = whole.file_vertices,
          .file_face = part.file_face,
          .motion = whole.motion,
          .particles = whole.particles,
          .collision = whole.collision,
          .scattered_side = whole.scattered_side,
          .files = whole.files};
}

}  // namespace

std::vector<Scene_object> component_objects(const Scene_object& object) {
  std::vector<Scene_object> objects;
  for (const auto& part : separated_faces(object))
    objects.push_back(object_of(part, fmt::format("{}_{}", object.name, objects.size() + 1), object));
  return objects;
}

}  // namespace lodestone
