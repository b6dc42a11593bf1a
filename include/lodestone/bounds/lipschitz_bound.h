// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "lodestone/bounds/motion_bound.h"
#include "lodestone/mesh/computed_points.h"
#include "lodestone/mesh/errors.h"
#include "lodestone/tree/node_anchors.h"
#include "lodestone/tree/tree_layout.h"
#include "lodestone/volumes/aabb.h"

namespace lodestone {

/// Boxes from a promise: no two vertices are farther apart than L times their distance at rest. Computes one position
/// per node, its anchor. A model of Motion_bound.
///
/// With the anchor p of a node, and rho the distance at rest from there to the node's farthest vertex, the node lies
/// within L rho of p. The promise is about positions as they are computed; the radii of anchors, 10^-9 longer than they
/// must be, cover the rounding of L rho, and the ends are rounded outwards.
///
/// The map from rest to pose has such an L if its derivative is nowhere larger. L is 1 for rigid motions, the factor
/// for a scaling; where maps follow each other, their constants multiply.
template <Computed_points Points>
class Lipschitz_bound {
 public:
  /// O(V).
  /// @param points         must outlive this
  /// @param layout         of the same vertices
  /// @param rest           3 V coordinates, finite
  /// @param constant       L: finite, >= 0
  /// @throws Bad_argument  L is out of range, `layout` has other vertices than `points`, `rest` has the wrong length
  Lipschitz_bound(const Points& points, const Tree_layout& layout, Coordinates rest, double constant)
      : points_(&points) {
    check_layout(layout, points.vertex_count());
    if (rest.size() != 3 * std::size_t{points.vertex_count()})
      throw Bad_argument("the positions at rest are not three coordinates for each vertex");
    anchors_ = find_anchors(layout, rest);
    set_constant(constant);
  }

  /// Promises another L, for the poses to come.
  /// @throws Bad_argument  it is not finite or below 0; the bound stays as it was
  void set_constant(double constant) {
    if (!(constant >= 0) || !std::isfinite(constant))
      throw Bad_argument("a Lipschitz constant must be >= 0 and finite");
    constant_ = constant;
  }

  std::size_t node_count() const { return anchors_.size(); }
  /// The box of a node in the current pose: one position.
  Aabb box(std::uint32_t node) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double smallest = 1e-150;  // shorter distances have squares that underflow
    const Eigen::Vector3d anchor = (*points_)(anchors_[node].vertex);
    const double radius = constant_ * (anchors_[node].radius + smallest);
    Aabb box{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double at = anchor[static_cast<Eigen::Index>(axis)];
      box.low[axis] = std::nextafter(at - radius, -infinity);
      box.high[axis] = std::nextafter(at + radius, infinity);
      open_if_not_finite(box, axis);
    }
    return box;
  }

 private:
  const Points* points_;
  std::vector<Node_anchor> anchors_;
  double constant_ = 1;
};

}  // namespace lodestone
