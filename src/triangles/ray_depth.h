// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <Eigen/Core>
#include <array>
#include <optional>

#include "lodestone/triangles/triangle_intersection.h"

/// Where a ray meets a triangle: in floating point as far as that proves anything, and exactly.
namespace lodestone {

using Exact_depth = CGAL::Exact_predicates_exact_constructions_kernel::FT;

/// A ray in coordinates of its own, those of \cite woop2013. Let z be the axis along which its direction d is largest.
/// A point p with a = p - origin has the coordinates x = a_x - (d_x / d_z) a_z, likewise y, and the depth a_z, with the
/// sign of d_z. So the line of the ray is x = y = 0, and the ray is where the depth is from 0 to `length` |d_z|.
struct Ray_frame {
  /// @param direction  finite, not zero
  /// @param length     >= 0, in multiples of `direction`
  Ray_frame(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double length);

  Eigen::Vector3d origin, direction;
  double length;
  std::array<int, 3> axes;      ///< x, y and z
  std::array<double, 2> shear;  ///< d_x / d_z and d_y / d_z, each rounded once; at most 1 in size
  double sign;                  ///< of d_z
  double least_limit;           ///< lower and upper bound on the largest depth
  double most_limit;
};

/// Bound on the error of x and of y, as computed from coordinates in double. With u = 2^-53 and all |a| at most m, up
/// to terms of order u^2: a_x has the error u m; the quotient, a_z and their product have one of u m each; the
/// difference is at most 2 m, and has a rounding of 2 u m. That makes 6 u m. What underflows is covered by 2^-1000.
/// @param reach  m, as computed; infinity if it is too large for products of these numbers
inline double frame_error(double reach) {
  constexpr double largest = 1e150;
  return reach < largest ? 0x1p-50 * reach + 0x1p-1000 : std::numeric_limits<double>::infinity();
}

/// What floating point can tell about a ray and a triangle.
struct Depth_estimate {
  enum class Meets { no, unsure, yes };
  Meets meets = Meets::no;
  double low = 0, high = 0;  ///< the depth of the first common point, if there is any, is between these
};
Depth_estimate estimate_depth(const Ray_frame& frame, const Triangle_corners& corners);

/// The least depth at which the ray meets the triangle, which is a closed set and may be a segment or a point; none if
/// it does not meet it.
std::optional<Exact_depth> exact_depth(const Ray_frame& frame, const Triangle& triangle);

}  // namespace lodestone
