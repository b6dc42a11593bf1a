// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scenes/object_of.h"

#include <numeric>
#include <utility>

namespace lodestone::detail {

Scene_object object_of(Mesh_file&& file) {
  Scene_object object;
  object.mesh = std::move(file.mesh);
  object.file_vertex = std::move(file.file_vertex);
  object.file_vertices = file.file_vertices;
  object.file_face = std::move(file.file_face);
  object.parts = std::move(file.parts);
  object.ignored_extensions = std::move(file.ignored_extensions);
  object.files = std::move(file.files);
  return object;
}

Scene_object object_of(Surface_mesh&& shape) {
  Scene_object object;
  object.file_vertices = shape.number_of_vertices();
  object.file_vertex.resize(object.file_vertices);
  std::iota(object.file_vertex.begin(), object.file_vertex.end(), 0U);
  object.file_face.resize(shape.number_of_faces());
  std::iota(object.file_face.begin(), object.file_face.end(), 0U);
  object.mesh = std::move(shape);
  return object;
}

std::vector<Corners> file_corners(const Scene_object& object) {
  std::vector<Corners> faces;
  faces.reserve(object.mesh.number_of_faces());
  for (const auto f : object.mesh.faces()) {
    auto corner = faces.emplace_back().begin();
    for (const auto v : object.mesh.vertices_around_face(object.mesh.halfedge(f))) *corner++ = object.file_vertex[v];
  }
  return faces;
}

}  // namespace lodestone::detail
