// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace lodestone {

/// Smallest ball around a set of points, kept as the at most four points that determine it.
class Support {
 public:
  explicit Support(const Eigen::Vector3d& point) : points_{point}, centre_(point) {}

  const Eigen::Vector3d& centre() const { return centre_; }
  double squared_radius() const { return squared_radius_; }

  /// Grows the ball to the smallest one around its points and a point outside, and drops points that it no longer
  /// needs.
  /// @return whether it has grown; false, and no change, only because of rounding
  bool add(const Eigen::Vector3d& point);

 private:
  Eigen::Vector3d points_[4];
  int size_ = 1;
  Eigen::Vector3d centre_;
  double squared_radius_ = 0;
};

}  // namespace lodestone
