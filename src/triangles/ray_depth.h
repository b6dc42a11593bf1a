// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Quotient.h>

#include <Eigen/Core>
#include <array>
#include <limits>
#include <optional>

#include "lodestone/triangles/triangle_intersection.h"
#include "triangles/ray_depth_kernel.h"

/// Where a ray meets a triangle: in floating point as far as that proves anything, and exactly.
namespace lodestone {

/// Not reduced: greatest common divisors take longer than all the rest.
using Exact_depth = CGAL::Quotient<Kernel::Exact_kernel_rt::FT>;

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
  return reach < kernel::most_reach ? kernel::error_per_reach * reach + kernel::error_of_underflow
                                    : std::numeric_limits<double>::infinity();
}

/// Describes a ray and a triangle for `estimate_depths`.
/// @param i  which question it is
inline void ask(const Ray_frame& frame, const Triangle_corners& corners, kernel::Depth_questions& questions,
                std::size_t i) {
  for (int c = 0; c < 3; ++c) {
    const auto along = [&](int axis) { return corners[c][axis] - frame.origin[axis]; };
    questions.x[c][i] = along(frame.axes[0]);
    questions.y[c][i] = along(frame.axes[1]);
    questions.z[c][i] = along(frame.axes[2]);
  }
  questions.shear[0][i] = frame.shear[0];
  questions.shear[1][i] = frame.shear[1];
  questions.sign[i] = frame.sign;
  questions.least_limit[i] = frame.least_limit;
  questions.most_limit[i] = frame.most_limit;
}

/// The least depth at which the ray meets the triangle, which is a closed set and may be a segment or a point; none if
/// it does not meet it.
std::optional<Exact_depth> exact_depth(const Ray_frame& frame, const Triangle& triangle);

/// The same depth over a divisor; relative error below 2^-50 if it is a normal number.
/// @param depth    of the triangle
/// @param divisor  > 0
double rounded_quotient(const Exact_depth& depth, double divisor, const Ray_frame& frame, const Triangle& triangle);

}  // namespace lodestone
