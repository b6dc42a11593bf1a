// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace lodestone {

/// Smallest ball around a few points: at most four, each of which it needs.
class Support {
 public:
  explicit Support(const Eigen::Vector3d& point) : points_{point}, centre_(point) {}

  const Eigen::Vector3d& centre() const { return centre_; }
  double squared_radius() const { return squared_radius_; }

  /// Makes it the smallest ball around its points and one outside of it, and forgets those that it no longer needs.
  /// @return whether it has grown, as it does but for rounding; else nothing has changed
  bool add(const Eigen::Vector3d& point);

 private:
  Eigen::Vector3d points_[4];
  int size_ = 1;
  Eigen::Vector3d centre_;
  double squared_radius_ = 0;
};

}  // namespace lodestone
