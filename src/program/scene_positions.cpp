// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/scene_positions.h"

namespace lodestone {

Positions positions_of(const Surface_mesh& mesh) {
  Positions positions(mesh.number_of_vertices(), 3);
  for (const auto v : mesh.vertices()) positions.row(v) = coordinates(mesh.point(v));
  return positions;
}

void move_to(const Positions& positions, Surface_mesh& mesh) {
  for (const auto v : mesh.vertices()) {
    const auto row = static_cast<Eigen::Index>(v.idx());
    mesh.point(v) = {positions(row, 0), positions(row, 1), positions(row, 2)};
  }
}

std::vector<Positions> positions_in(Scene& scene, std::size_t frame) {
  std::vector<Positions> positions;
  for (auto& object : scene.objects) {
    const Positions now = positions_of(object.mesh);
    pose(object, frame);
    positions.push_back(positions_of(object.mesh));
    move_to(now, object.mesh);
  }
  return positions;
}

}  // namespace lodestone
