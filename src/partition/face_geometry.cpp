// SPDX-License-Identifier: GPL-3.0-or-later
#include "partition/face_geometry.h"

#include <Eigen/Geometry>

#include "lodestone/mesh/scaled_positions.h"
#include "partition/parallel_sides.h"

namespace lodestone {

Face_geometry face_geometry(const Numbered_surface& surface) {
  const auto count = static_cast<Eigen::Index>(surface.faces.size());
  Face_geometry result{.normals = Positions::Zero(count, 3), .areas = std::vector<double>(count, 0)};
  const Positions scaled = scaled_positions(surface.positions);
  const double extent = (scaled.colwise().maxCoeff() - scaled.colwise().minCoeff()).maxCoeff();
  if (extent == 0) return result;
  for (Eigen::Index f = 0; f < count; ++f) {
    const auto& [a, b, c] = surface.faces[f];
    const Eigen::RowVector3d first = (scaled.row(b) - scaled.row(a)) / extent;
    const Eigen::RowVector3d second = (scaled.row(c) - scaled.row(a)) / extent;
    const Eigen::RowVector3d area_normal = first.cross(second);
    if (parallel_sides(first, second, area_normal)) continue;
    const double length = area_normal.norm();
    result.normals.row(f) = area_normal / length;
    result.areas[f] = length / 2;
  }
  return result;
}

}  // namespace lodestone
