// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lodestone/queries/ray_tree.h"
#include "queries/ray_walk_kernel.h"
#include "triangles/ray_depth.h"

namespace lodestone {

/// A ray in the relative coordinates of a tree, and how depths are converted.
class Relative_ray {
 public:
  Relative_ray(const Ray_tree& tree, const Ray_frame& frame) : scale_(tree.scale()) {
    place_origin(tree, frame);
    find_slopes(frame);
    skip_to_box();
  }

  /// False: its origin is so far away that single precision is not enough.
  bool is_near() const { return is_near_; }
  /// False: it surely misses the surface.
  bool meets_box() const { return skipped_ <= last_; }
  /// How deep the walk has to go for a depth along the ray. No point of the surface is deeper than 4.
  float walk_depth(double depth) const {
    return static_cast<float>(std::min(depth * scale_ - skipped_ + kernel::walk_error, 8.0));
  }

  kernel::Ray_walk walk() const {
    kernel::Ray_walk walk;
    std::copy_n(axes_.begin(), 3, walk.axes);
    const std::size_t z = axes_[2];
    const double sign = slope_[z], start = (origin_[z] + skipped_ * sign) * sign;
    walk.start = static_cast<float>(start);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double entry = origin_[axis] + skipped_ * true_slope_[axis],
                   error = kernel::walk_error * std::abs(inverse_[axis]);
      walk.slope[axis] = static_cast<float>(slope_[axis]);
      walk.inverse[axis] = static_cast<float>(inverse_[axis]);
      walk.enter[axis] = static_cast<float>(entry * inverse_[axis] + error);
      walk.leave[axis] = static_cast<float>(entry * inverse_[axis] - error);
      walk.across[axis] = static_cast<float>(entry - slope_[axis] * start);
      const std::size_t low = axis * ray_tree_width, high = low + 3 * ray_tree_width;
      walk.near_side[axis] = inverse_[axis] < 0 ? high : low;
      walk.far_side[axis] = inverse_[axis] < 0 ? low : high;
    }
    return walk;
  }

 private:
  static constexpr double farthest = 0x1p24;   ///< beyond, the error of an origin in double is above 2^-28
  static constexpr double wall = 1 + 0x1p-10;  ///< of the box that rays start at, with room for errors
  static constexpr double least_slope = 0x1p-40;

  void place_origin(const Ray_tree& tree, const Ray_frame& frame) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      origin_[axis] = (frame.origin[static_cast<int>(axis)] - tree.middle()[axis]) * scale_;
      is_near_ &= std::abs(origin_[axis]) < farthest;
    }
  }

  /// A ray that is nearly orthogonal to an axis is tilted where it enters the box: inside, that is far below the error.
  void find_slopes(const Ray_frame& frame) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t axis = axes_[i] = static_cast<std::size_t>(frame.axes[i]);
      const double slope = i < 2 ? frame.shear[i] * frame.sign : frame.sign;
      true_slope_[axis] = slope;
      slope_[axis] = std::copysign(std::max(std::abs(slope), least_slope), slope);
      inverse_[axis] = i < 2 ? 1 / slope_[axis] : slope;
    }
  }

  void skip_to_box() {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double to_low = (-wall - origin_[axis]) * inverse_[axis], to_high = (wall - origin_[axis]) * inverse_[axis];
      skipped_ = std::max(skipped_, std::min(to_low, to_high));
      last_ = std::min(last_, std::max(to_low, to_high));
    }
  }

  double scale_;
  std::array<std::size_t, 3> axes_;
  std::array<double, 3> origin_, true_slope_, slope_, inverse_;
  bool is_near_ = true;
  double skipped_ = 0;                                     ///< depth at which the walk starts, at the box
  double last_ = std::numeric_limits<double>::infinity();  ///< depth at which the ray leaves the box
};

}  // namespace lodestone
