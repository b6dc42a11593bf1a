// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/ray_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lodestone {

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

/// Eight roundings of a double.
constexpr double eight_roundings = 0x1p-50;

/// A point in the coordinates of a ray, with x and y scaled by d_z, so that nothing is divided.
struct Exact_position {
  Exact_depth x, y, depth;
};

Exact_position exact_position(const Ray_frame& frame, const Point& p) {
  const auto [x, y, z] = frame.axes;
  const auto along = [&](int axis) { return Exact_depth(p[axis]) - Exact_depth(frame.origin[axis]); };
  const Exact_depth a_z = along(z), d_z = frame.direction[z];
  return {along(x) * d_z - a_z * Exact_depth(frame.direction[x]),
          along(y) * d_z - a_z * Exact_depth(frame.direction[y]), frame.sign > 0 ? a_z : Exact_depth(-a_z)};
}

/// Twice the signed area of the origin, a and b in the plane of x and y.
Exact_depth cross(const Exact_position& a, const Exact_position& b) { return a.x * b.y - a.y * b.x; }

/// The depths at which the line of the ray meets something.
struct Depth_range {
  std::optional<Exact_depth> low, high;

  void extend(const Exact_depth& depth) {
    if (!low || depth < *low) low = depth;
    if (!high || depth > *high) high = depth;
  }
  /// Extends by where the line meets a segment.
  void extend(const Exact_position& a, const Exact_position& b) {
    if (CGAL::sign(cross(a, b)) != CGAL::ZERO || CGAL::sign(a.x * b.x + a.y * b.y) == CGAL::POSITIVE) return;
    const bool by_x = a.x != b.x;
    if (!by_x && a.y == b.y) {
      // Both ends are on the line.
      extend(a.depth);
      extend(b.depth);
      return;
    }
    const Exact_depth part = by_x ? a.x / (a.x - b.x) : a.y / (a.y - b.y);
    extend(a.depth + part * (b.depth - a.depth));
  }
};

/// Where the line of the ray meets a triangle. If it meets the plane in a point, the three areas are the weights of the
/// corners there. Otherwise the first and the last common point are on edges.
Depth_range exact_range(const std::array<Exact_position, 3>& p) {
  Depth_range range;
  const std::array weights{cross(p[1], p[2]), cross(p[2], p[0]), cross(p[0], p[1])};
  const Exact_depth sum = weights[0] + weights[1] + weights[2];
  if (const auto side = CGAL::sign(sum); side != CGAL::ZERO) {
    const auto opposite = [side](const Exact_depth& weight) { return CGAL::sign(weight) == -side; };
    if (std::ranges::none_of(weights, opposite))
      range.extend((weights[0] * p[0].depth + weights[1] * p[1].depth + weights[2] * p[2].depth) / sum);
    return range;
  }
  for (int i = 0; i < 3; ++i) range.extend(p[i], p[(i + 1) % 3]);
  return range;
}

}  // namespace

Ray_frame::Ray_frame(const Eigen::Vector3d& ray_origin, const Eigen::Vector3d& ray_direction, double ray_length)
    : origin(ray_origin), direction(ray_direction), length(ray_length) {
  int z = 0;
  direction.cwiseAbs().maxCoeff(&z);
  axes = {(z + 1) % 3, (z + 2) % 3, z};
  shear = {direction[axes[0]] / direction[z], direction[axes[1]] / direction[z]};
  sign = direction[z] > 0 ? 1 : -1;
  const double limit = length * std::abs(direction[z]);
  least_limit = std::isfinite(length) ? std::nextafter(limit, 0.0) : endless;
  most_limit = std::nextafter(limit, endless);
}

/// A weight of a corner is the cross product of the positions of the other two. With positions of size r at most, and
/// with errors of e each, it has an error of 4 e r + 2 e^2, and 5 u r^2 from rounding. As r is at most 2 m + e, and e
/// is 8 u m, this is below 8 e (r + e). If all three weights have the same sign beyond it, the ray passes through the
/// interior. If two have opposite signs, it misses the triangle.
///
/// With errors of w each, the weights relative to their sum s are wrong by 6 w / s in total, so the depth is wrong by
/// at most 3 w / s of the range of depths, and by some roundings of the largest.
Depth_estimate estimate_depth(const Ray_frame& frame, const Triangle_corners& corners) {
  double x[3], y[3], depth[3], reach = 0, size = 0;
  for (int i = 0; i < 3; ++i) {
    const auto along = [&](int axis) { return corners[i][axis] - frame.origin[axis]; };
    const double a_x = along(frame.axes[0]), a_y = along(frame.axes[1]), a_z = along(frame.axes[2]);
    x[i] = a_x - frame.shear[0] * a_z;
    y[i] = a_y - frame.shear[1] * a_z;
    depth[i] = frame.sign * a_z;
    reach = std::max({reach, std::abs(a_x), std::abs(a_y), std::abs(a_z)});
    size = std::max({size, std::abs(x[i]), std::abs(y[i])});
  }
  const double error = frame_error(reach);
  if (!(error < endless)) return {Depth_estimate::Meets::unsure, -endless, endless};

  const auto [nearest, farthest] = std::minmax({depth[0], depth[1], depth[2]});
  const double largest = std::max(std::abs(nearest), std::abs(farthest));
  Depth_estimate estimate{Depth_estimate::Meets::no, nearest - eight_roundings * largest,
                          farthest + eight_roundings * largest};
  if (farthest < 0 || nearest > frame.most_limit) return estimate;  // one rounding changes neither

  const double weights[]{x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
  const double weight_error = 8 * error * (size + error) + 0x1p-1000;
  const auto [least, most] = std::minmax({weights[0], weights[1], weights[2]});
  if (least < -weight_error && most > weight_error) return estimate;
  estimate.meets = Depth_estimate::Meets::unsure;
  if (!(least > weight_error) && !(most < -weight_error)) return estimate;

  const double sum = weights[0] + weights[1] + weights[2];
  const double middle = depth[0] + weights[1] / sum * (depth[1] - depth[0]) + weights[2] / sum * (depth[2] - depth[0]);
  const double depth_error =
      4 * (weight_error / std::abs(sum)) * (farthest - nearest) + 4 * eight_roundings * largest + 0x1p-1000;
  estimate.low = std::max(estimate.low, middle - depth_error);
  estimate.high = std::min(estimate.high, middle + depth_error);
  if (estimate.high < 0 || estimate.low > frame.most_limit)
    estimate.meets = Depth_estimate::Meets::no;
  else if (estimate.low >= 0 && estimate.high <= frame.least_limit)
    estimate.meets = Depth_estimate::Meets::yes;
  return estimate;
}

std::optional<Exact_depth> exact_depth(const Ray_frame& frame, const Triangle& triangle) {
  const Depth_range range = exact_range(
      {exact_position(frame, triangle[0]), exact_position(frame, triangle[1]), exact_position(frame, triangle[2])});
  if (!range.low || CGAL::sign(*range.high) == CGAL::NEGATIVE) return std::nullopt;
  const Exact_depth first = CGAL::sign(*range.low) == CGAL::NEGATIVE ? Exact_depth(0) : *range.low;
  if (std::isfinite(frame.length) &&
      first > Exact_depth(frame.length) * Exact_depth(std::abs(frame.direction[frame.axes[2]])))
    return std::nullopt;
  return first;
}

}  // namespace lodestone
