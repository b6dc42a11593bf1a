// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "lodestone/mesh/pairs.h"
#include "lodestone/mesh/unset_vector.h"
#include "lodestone/tree/node_pair.h"
#include "lodestone/tree/tree_view.h"
#include "lodestone/triangles/clearance.h"
#include "queries/clearance_kernel.h"

namespace lodestone {

/// Finds the clearance of one object from another along any direction. Each search is branch and bound over node pairs,
/// those with the largest clearance first. Leaves are read once, then kept for the next direction.
///
/// Coordinates are scaled by a power of two, such that the largest is about 1, and counted from a corner of both
/// objects. So neither products nor differences overflow, and rounding is relative to the size of the objects.
class Clearance_search {
 public:
  /// @param a, b  with boxes; must outlive this
  Clearance_search(const Layout_view& a, const Layout_view& b);

  /// An upper bound on the clearance of a from b: the largest of those of their face pairs. It depends neither on the
  /// trees nor on the order in which they hold the faces. It allows for the rounding of the coordinates of a, when it
  /// is moved.
  /// @param direction  unit vector
  /// @param limit      in scaled units
  /// @return in scaled units; none if it is not below the limit
  std::optional<Clearance> operator()(const Eigen::Vector3d& direction, double limit);

  /// A length or a vector in units of the coordinates. Infinite if it exceeds the largest double.
  double unscaled(double length) const { return std::ldexp(length, exponent_); }
  Eigen::Vector3d unscaled(const Eigen::Vector3d& vector) const {
    return vector.unaryExpr([this](double x) { return unscaled(x); });
  }
  /// Of the boxes of both objects, in scaled units.
  Eigen::Vector3d centre_difference() const { return box(a_, 0).center() - box(b_, 0).center(); }

 private:
  /// The scaled corners of the faces of a leaf, as `kernel::Corner_columns`. Empty: it has not been read yet.
  using Leaf = std::vector<double>;
  struct Side {
    const Layout_view* view;
    std::vector<Leaf> leaves = {};
  };
  struct Candidate {
    double bound;
    Node_pair pair;
    bool operator<(const Candidate& other) const { return bound < other.bound; }  // the largest is on top
  };
  /// Two faces of two leaves, and a bound on their clearance.
  struct Clearance_candidate {
    double bound;
    kernel::Face_slots slots;
  };
  /// Of a direction: see `kernel::span_faces` and `kernel::In_line`.
  struct Seen_along {
    double axes[3][3];
    double slack[3];
  };

  static Seen_along seen_along(const Way& way);
  Eigen::Vector3d scaled(const double* p) const {
    return {scale_ * p[0] - origin_[0], scale_ * p[1] - origin_[1], scale_ * p[2] - origin_[2]};
  }
  Box box(const Side& side, std::uint32_t node) const {
    const Aabb& box = side.view->boxes[node];
    return {scaled(box.low), scaled(box.high)};
  }
  kernel::Corner_columns corners_of(Side& side, std::uint32_t leaf) const;
  Boxed_triangle triangle(const Side& side, std::uint32_t leaf, std::uint8_t face) const;
  void push(Node_pair pair);
  void try_leaves(std::uint32_t leaf_a, std::uint32_t leaf_b);
  void list_candidates(std::uint32_t leaf_a, std::uint32_t leaf_b);
  void try_faces(Face_pair faces, const Boxed_triangle& a, const Boxed_triangle& b);
  bool witnesses_reach() const;
  bool overlap_across(const Boxed_triangle& a, const Boxed_triangle& b) const;

  int exponent_ = 0;  ///< a scaled coordinate is one of the object's times 2^-exponent
  double scale_ = 1;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();  ///< scaled
  double slack_ = 0;                                  ///< see `Way`
  Side a_, b_;

  // Of the current search.
  Way way_{Eigen::Vector3d::UnitX(), 0};
  Seen_along seen_ = {};
  double limit_ = 0;
  Clearance best_ = {};
  Face_pair best_faces_ = {};
  std::pair<Boxed_triangle, Boxed_triangle> best_triangles_ = {};
  std::priority_queue<Candidate> queue_;

  // Memory of `try_leaves`.
  std::vector<Node_pair> below_;
  kernel::Face_spans spans_a_, spans_b_;
  Unset_vector<kernel::Face_slots> in_line_;
  std::vector<Clearance_candidate> candidates_;

  /// The face pairs with the largest clearance in earlier searches, the last of them first to be tried: along a
  /// direction nearby, one of them often reaches the limit at once.
  std::vector<std::pair<Boxed_triangle, Boxed_triangle>> witnesses_;
};

}  // namespace lodestone
