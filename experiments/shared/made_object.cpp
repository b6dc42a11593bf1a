// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/made_object.h"

#include <numeric>
#include <utility>

namespace lodestone {

Scene_object made_object(std::string name, Surface_mesh mesh, std::vector<Deformation> deformations) {
  Scene_object object;
  object.name = std::move(name);
  object.mesh = std::move(mesh);
  object.file_vertices = object.mesh.number_of_vertices();
  object.file_vertex.resize(object.file_vertices);
  std::iota(object.file_vertex.begin(), object.file_vertex.end(), 0U);
  object.motion = deform({object.mesh.points().begin(), object.mesh.points().end()}, std::move(deformations));
  return object;
}

}  // namespace lodestone
