// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "lodestone/tree/node_pair.h"
#include "lodestone/tree/tree_view.h"
#include "lodestone/triangles/clearance.h"

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
  Eigen::Vector3d centre_difference() const { return a_.boxes[0].center() - b_.boxes[0].center(); }

 private:
  /// A face of a leaf.
  struct Face {
    std::uint32_t index;
    Boxed_triangle triangle;
  };
  /// One object, in scaled coordinates.
  struct Side {
    const Layout_view* view;
    std::vector<Box> boxes = {};                 ///< per node
    std::vector<std::vector<Face>> leaves = {};  ///< an empty one has not been read yet; others stay as they are
  };
  struct Candidate {
    double bound;
    Node_pair pair;
    bool operator<(const Candidate& other) const { return bound < other.bound; }  // the largest is on top
  };

  Eigen::Vector3d scaled(const double* p) const {
    return {scale_ * p[0] - origin_[0], scale_ * p[1] - origin_[1], scale_ * p[2] - origin_[2]};
  }
  Box scaled(const Aabb& box) const { return {scaled(box.low), scaled(box.high)}; }
  const std::vector<Face>& faces_of(Side& side, std::uint32_t leaf) const;
  void push(Node_pair pair);
  void try_leaves(Node_pair pair);
  void keep_facing(const std::vector<Face>& faces, const Box& other, bool of_a, std::vector<const Face*>& kept) const;
  void try_faces(const Face& a, const Face& b);
  bool witnesses_reach(double limit) const;

  int exponent_ = 0;  ///< a scaled coordinate is one of the object's times 2^-exponent
  double scale_ = 1;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();  ///< scaled
  Side a_, b_;

  // Of the current search.
  Way way_ = {};
  Clearance best_ = {};
  const Face *best_a_ = nullptr, *best_b_ = nullptr;
  std::priority_queue<Candidate> queue_;
  std::vector<Node_pair> below_;
  std::vector<const Face*> facing_a_, facing_b_;

  /// The face pairs with the largest clearance in earlier searches, the last of them first to be tried: along a
  /// direction nearby, one of them often reaches the limit at once.
  std::vector<std::pair<const Face*, const Face*>> witnesses_;
};

}  // namespace lodestone
