// SPDX-License-Identifier: GPL-3.0-or-later
#include "threads/moving_pair.h"

#include <algorithm>
#include <cmath>

#include "lodestone/io/motion/deformation.h"
#include "lodestone/io/shapes/shapes.h"

namespace lodestone {

namespace {

Surface_mesh sphere_of(std::size_t triangles) {
  return icosphere(static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(triangles) / 20))));
}

Motion wobble(const Surface_mesh& mesh, double phase) {
  return deform({mesh.points().begin(), mesh.points().end()}, {Wobble{.amplitude = 0.04, .waves = 2, .phase = phase}});
}

}  // namespace

Moving_pair::Moving_pair(std::size_t triangles)
    : meshes_{sphere_of(triangles / 2), sphere_of(triangles / 2)},
      motions_{wobble(meshes_[0], 0), wobble(meshes_[1], 0.3)},
      positions_(meshes_[0].number_of_vertices()) {}

void Moving_pair::pose(std::size_t frame, Place place) {
  motions_[0].pose(frame, positions_);
  std::ranges::copy(positions_, meshes_[0].points().begin());
  const double right = positions_.empty() ? 0 : std::ranges::max_element(positions_, {}, &Point::x)->x();

  motions_[1].pose(frame, positions_);
  const double left = std::ranges::min_element(positions_, {}, &Point::x)->x();
  const double gap = place == Place::apart ? 0.01 : -1.0 / 3;
  const double scale = place == Place::inside ? 0.5 : 1, shift = place == Place::inside ? 0 : right - left + gap;
  for (auto& p : positions_) p = Point(scale * p.x() + shift, scale * p.y(), scale * p.z());
  std::ranges::copy(positions_, meshes_[1].points().begin());
}

}  // namespace lodestone
