// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lodestone/bounds/motion_bound.h"
#include "lodestone/bounds/node_bound.h"
#include "lodestone/mesh/position_source.h"
#include "lodestone/tree/node_anchors.h"
#include "lodestone/volumes/aabb.h"

namespace lodestone {

class Lipschitz_promise;

/// Boxes from a Lipschitz_promise. Reads one position per node, its anchor. A model of Reading_bound.
///
/// With the anchor p of a node, and rho the distance at rest from there to the node's farthest vertex, the node lies
/// within L rho + 2 e of p.
///
/// *Rounding.* Radii of anchors are 10^-9 longer than rho, and 2 e is made so too: that covers the rounding of
/// L rho + 2 e, of which each term is rounded twice. The ends are moved outwards by one double, since their own
/// rounding is at most half of that. Squares of distances below 10^-150 underflow, so 10^-150 is added to rho.
class Lipschitz_bound {
 public:
  /// O(V).
  /// @param promise        must outlive this, as must the positions
  /// @throws Bad_argument  `object` has other vertices than its positions; the rest has the wrong length
  Lipschitz_bound(const Lipschitz_promise& promise, const Bounded_object& object);

  /// Number of nodes of the tree.
  std::size_t node_count() const { return anchors_.size(); }
  /// The box of a node in the current pose: one position.
  Aabb box(std::uint32_t node) const { return box_around_anchor(node, anchor(node)); }
  /// The same; adds that position.
  Aabb box(std::uint32_t node, std::vector<Eigen::Vector3d>& read) const {
    read.push_back(anchor(node));
    return box_around_anchor(node, read.back());
  }

 private:
  Eigen::Vector3d anchor(std::uint32_t node) const { return (*positions_)(anchors_[node].vertex); }
  Aabb box_around_anchor(std::uint32_t node, const Eigen::Vector3d& anchor) const;

  const Lipschitz_promise* promise_;
  const Position_source* positions_;
  std::vector<Node_anchor> anchors_;
};

/// A promise: no two vertices are farther apart than L times their distance at rest. A model of Motion_promise.
///
/// The map from rest to pose has such an L if its derivative is nowhere larger on a convex set around the vertices at
/// rest. L is 1 for rigid motions, the factor for a scaling; where maps follow each other, their constants multiply.
///
/// With e = 0 the promise is about positions as they are computed. Otherwise it is about exact ones, and computed ones
/// are within e of them. Where vertices lie close together and far from the origin, rounding moves them apart by more
/// than any useful L, so there e is needed.
class Lipschitz_promise {
 public:
  /// @throws Bad_argument  as `set_constant`
  explicit Lipschitz_promise(double constant = 1, double error = 0) { set_constant(constant, error); }
  Lipschitz_promise(const Lipschitz_promise&) = delete;
  Lipschitz_promise& operator=(const Lipschitz_promise&) = delete;

  /// Promises another L, for the poses to come.
  /// @param constant       L: >= 0; infinite: nothing is promised
  /// @param error          e: how far a position may be from the exact one, in units of the coordinates; >= 0
  /// @throws Bad_argument  one of them is less, or no number; the promise stays as it was
  void set_constant(double constant, double error = 0);
  /// L.
  double constant() const { return constant_; }
  /// The distance e, in units of the coordinates.
  double error() const { return error_; }

  /// The bound for one object, which this must outlive. O(V).
  Lipschitz_bound bound(const Bounded_object& object) const { return {*this, object}; }

 private:
  double constant_ = 1, error_ = 0;
};

}  // namespace lodestone
