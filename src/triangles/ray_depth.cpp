// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/ray_depth.h"

#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lodestone {

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

/// Where the line of a ray meets a triangle, in exact numbers.
template <class Number>
class Exact_meeting {
 public:
  using Depth = CGAL::Quotient<Number>;

  Exact_meeting(const Ray_frame& frame, const Triangle& triangle) : frame_(frame) {
    const std::array p{position(triangle[0]), position(triangle[1]), position(triangle[2])};
    // If the line meets the plane in a point, the three areas are the weights of the corners there.
    const std::array weights{cross(p[1], p[2]), cross(p[2], p[0]), cross(p[0], p[1])};
    const Number sum = weights[0] + weights[1] + weights[2];
    if (const auto side = CGAL::sign(sum); side != CGAL::ZERO) {
      const auto opposite = [side](const Number& weight) { return CGAL::sign(weight) == -side; };
      if (std::ranges::none_of(weights, opposite))
        extend(weights[0] * p[0].depth + weights[1] * p[1].depth + weights[2] * p[2].depth, sum);
      return;
    }
    // Otherwise the first and the last common point are on edges.
    for (int i = 0; i < 3; ++i) extend_by_edge(p[i], p[(i + 1) % 3]);
  }

  /// The least depth on the ray; none if the ray does not meet the triangle.
  std::optional<Depth> first() const {
    if (!low_ || CGAL::sign(*high_) == CGAL::NEGATIVE) return std::nullopt;
    const Depth first = CGAL::sign(*low_) == CGAL::NEGATIVE ? Depth(Number(0)) : *low_;
    if (std::isfinite(frame_.length) &&
        first > Depth(Number(frame_.length) * Number(std::abs(frame_.direction[frame_.axes[2]]))))
      return std::nullopt;
    return first;
  }

 private:
  /// A point in the coordinates of a ray, with x and y scaled by d_z, so that nothing is divided.
  struct Position {
    Number x, y, depth;
  };

  Position position(const Point& p) const {
    const auto [x, y, z] = frame_.axes;
    const auto along = [&](int axis) { return Number(Number(p[axis]) - Number(frame_.origin[axis])); };
    const Number a_z = along(z), d_z = frame_.direction[z];
    return {along(x) * d_z - a_z * Number(frame_.direction[x]), along(y) * d_z - a_z * Number(frame_.direction[y]),
            frame_.sign > 0 ? a_z : Number(-a_z)};
  }

  /// Twice the signed area of the origin, a and b in the plane of x and y.
  static Number cross(const Position& a, const Position& b) { return a.x * b.y - a.y * b.x; }

  void extend(const Number& numerator, const Number& denominator) {
    const Depth depth(numerator, denominator);
    if (!low_ || depth < *low_) low_ = depth;
    if (!high_ || depth > *high_) high_ = depth;
  }
  void extend_by_edge(const Position& a, const Position& b) {
    if (CGAL::sign(cross(a, b)) != CGAL::ZERO || CGAL::sign(Number(a.x * b.x + a.y * b.y)) == CGAL::POSITIVE) return;
    const bool by_x = a.x != b.x;
    if (!by_x && a.y == b.y) {
      // Both ends are on the line.
      extend(a.depth, 1);
      extend(b.depth, 1);
      return;
    }
    const Number part = by_x ? a.x : a.y, whole = by_x ? a.x - b.x : a.y - b.y;
    extend(a.depth * whole + part * (b.depth - a.depth), whole);
  }

  const Ray_frame& frame_;
  std::optional<Depth> low_, high_;  ///< of the line; none if it does not meet the triangle
};

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
  return Exact_meeting<Exact_depth::NT>(frame, triangle).first();
}

double rounded_quotient(const Exact_depth& depth, double divisor, const Ray_frame& frame, const Triangle& triangle) {
  const double numerator = CGAL::to_double(depth.numerator()), denominator = CGAL::to_double(depth.denominator());
  const double quotient = numerator / denominator / divisor;
  const auto moderate = [](double x) { return std::abs(x) > 0x1p-900 && std::abs(x) < 0x1p900; };
  if (numerator == 0 && CGAL::is_zero(depth.numerator())) return 0;
  if (moderate(numerator) && moderate(denominator) && moderate(numerator / denominator) && moderate(quotient))
    return quotient;
  const auto exact = *Exact_meeting<CGAL::Exact_rational>(frame, triangle).first();
  return CGAL::to_double(CGAL::Exact_rational(exact.numerator() / exact.denominator() / CGAL::Exact_rational(divisor)));
}

}  // namespace lodestone
