// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/ray_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lodestone {

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

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
  const Eigen::Vector3d size = direction.cwiseAbs();
  int z = size[1] > size[0] ? 1 : 0;
  z = size[2] > size[z] ? 2 : z;
  axes = {(z + 1) % 3, (z + 2) % 3, z};
  shear = {direction[axes[0]] / direction[z], direction[axes[1]] / direction[z]};
  sign = std::copysign(1.0, direction[z]);
  least_limit = most_limit = endless;
  if (length == endless) return;
  const double limit = length * size[z];
  least_limit = std::nextafter(limit, 0.0);
  most_limit = std::nextafter(limit, endless);
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
