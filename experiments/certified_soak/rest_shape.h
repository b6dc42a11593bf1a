// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "certified_soak/random.h"
#include "lodestone/io/shapes/shapes.h"

namespace lodestone {

/// A random ellipsoid around a place.
/// @param may_be_flat  now and then it has no thickness, so that vertices coincide
inline Surface_mesh random_ellipsoid(const Eigen::Vector3d& centre, std::size_t frequency, bool may_be_flat,
                                     Random& random) {
  const double x_size = random.number(0.3, 2);
  const double y_size = may_be_flat && random.one_in(10) ? 0 : random.number(0.2, 1.2);
  Surface_mesh mesh = icosphere(frequency);
  for (auto& p : mesh.points()) p = Point(p.x() * x_size + centre.x(), p.y() * y_size + centre.y(), p.z() + centre.z());
  return mesh;
}

inline std::vector<double> coordinates_of(const Surface_mesh& mesh) {
  std::vector<double> coordinates;
  for (const Point& p : mesh.points()) coordinates.insert(coordinates.end(), {p.x(), p.y(), p.z()});
  return coordinates;
}

}  // namespace lodestone
