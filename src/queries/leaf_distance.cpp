// SPDX-License-Identifier: GPL-3.0-or-later
#include "queries/leaf_distance.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "lodestone/queries/leaf_triangle.h"
#include "queries/point_leaf_kernel.h"
#include "triangles/point_distance.h"

namespace lodestone {

double relative_squared_distance(const Leaf_faces& leaf, const Aabb& box, const Eigen::Vector3d& point, double radius) {
  const Query_point query(Point(point.x(), point.y(), point.z()), box.low, box.high);
  const double scale = query.scale, reach = scale * radius;
  double most = reach * reach;
  std::uint8_t candidates[most_leaf_faces];
  const std::size_t count = kernel::list_near_faces(
      leaf, {{scale * point.x(), scale * point.y(), scale * point.z(), 0}, scale}, most, candidates);
  if (count == 0) return std::numeric_limits<double>::infinity();
  if (count == 1) {  // the kernel has not measured it
    const auto [p, q, r] = leaf.corners[candidates[0]];
    const auto estimate = estimate_distance(query, leaf_triangle(leaf, candidates[0]),
                                            {leaf.vertices[p], leaf.vertices[q], leaf.vertices[r]});
    if (estimate.low > most) return std::numeric_limits<double>::infinity();
    most = std::min(most, estimate.high);
  }
  return most / (reach * reach);
}

}  // namespace lodestone
