// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/frame_impacts.h"

#include "lodestone/mesh/box.h"
#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

namespace {

Positions positions_of(const Surface_mesh& mesh) {
  Positions positions(mesh.number_of_vertices(), 3);
  Eigen::Index row = 0;
  for (const auto v : mesh.vertices()) positions.row(row++) = coordinates(mesh.point(v));
  return positions;
}

void put_back(const Positions& positions, Surface_mesh& mesh) {
  Eigen::Index row = 0;
  for (const auto v : mesh.vertices()) {
    mesh.point(v) = {positions(row, 0), positions(row, 1), positions(row, 2)};
    ++row;
  }
}

/// Where an object is between two frames.
struct Step {
  Positions end;
  Box swept;  ///< around all of its way
};

Step step_to(Scene_object& object, std::size_t next) {
  const Positions start = positions_of(object.mesh);
  pose(object, next);
  Step step{.end = positions_of(object.mesh), .swept = {}};
  put_back(start, object.mesh);
  for (const Positions* positions : std::initializer_list<const Positions*>{&start, &step.end}) {
    step.swept.extend(positions->colwise().minCoeff().transpose());
    step.swept.extend(positions->colwise().maxCoeff().transpose());
  }
  return step;
}

}  // namespace

std::vector<Pair_impact> impacts_until(Scene& scene, std::size_t next, Scene_detector& detector,
                                       const std::function<bool(Object_pair)>& may_meet) {
  std::vector<Step> steps;
  for (auto& object : scene.objects) steps.push_back(step_to(object, next));
  std::vector<Pair_impact> impacts;
  for (Object_id a = 0; a < steps.size(); ++a)
    for (Object_id b = a; b < steps.size(); ++b) {
      if (!may_meet({a, b}) || !steps[a].swept.intersects(steps[b].swept)) continue;
      const auto found = a == b ? detector.first_self_impact(a, steps[a].end)
                                : detector.first_impact(a, steps[a].end, b, steps[b].end);
      if (found) impacts.push_back({a, b, *found});
    }
  return impacts;
}

}  // namespace lodestone
