// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/volumes/oriented_box.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "lodestone/volumes/bounding_volume.h"
#include "volumes/infinity.h"
#include "volumes/principal_axes.h"
#include "volumes/slab_kernel.h"

namespace lodestone {

static_assert(Bounding_volume<Oriented_box>);

namespace {

// Properties of axes that are orthonormal up to 3e-15, in exact arithmetic, for use below. Let A be the matrix with the
// axes as its rows, u = 2^-53, and H the sum of a box's half-widths.
//
// 1. The singular values of A are within 5e-15 of 1, so a point v of a box about the origin has |v| <= H (1 + 5e-15).
// 2. Let d be a vector of length at most 1 + 3e-15, and lambda_i its dot products with the axes, each with an error
//    of at most 5 u. Then |d - sum lambda_i axes[i]| < 1e-14, since A^T A differs from 1 by at most 9e-15.
// 3. So d . v is at most sum |lambda_i| half[i] + 1.1e-14 H.

using Vector = Eigen::Vector3d;
using Axes = Eigen::Matrix3d;  // as rows

constexpr double least_normal = std::numeric_limits<double>::min();

Vector centre_of(const Oriented_box& box) { return Vector(box.centre); }
Vector half_of(const Oriented_box& box) { return Vector(box.half); }
Axes axes_of(const Oriented_box& box) { return Eigen::Matrix<double, 3, 3, Eigen::RowMajor>::Map(&box.axes[0][0]); }
double sum(const Vector& v) { return v.x() + v.y() + v.z(); }

/// The points between limits along three axes, relative to an origin.
struct Box_limits {
  Axes axes;
  Vector low, high;

  /// Half the surface area, in units of the reach.
  double surface(double reach) const {
    const Vector width = (high - low) / reach;
    return width.x() * width.y() + width.y() * width.z() + width.z() * width.x();
  }
};

Oriented_box everything() { return {{0, 0, 0}, {infinity, infinity, infinity}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}; }

/// The box with the given limits, expressed about its centre and widened by `error` times `reach` on every side.
///
/// @param reach  at least the size of the limits; 0 only if they are 0 and exact
/// @param error  at least 10 u more than the error of the limits, as a share of the reach. The 10 u cover the offset
///               from the origin to the centre (u of its size), its dot products with the axes (4 u), and the last
///               difference and sum (u of the reach and the offset each). The loss to subnormal numbers is less than
///               the smallest normal double.
Oriented_box box_about_middle(const Vector& origin, const Box_limits& limits, double reach, double error) {
  const Vector middle = limits.low / 2 + limits.high / 2;
  const Vector centre = origin + limits.axes.transpose() * middle;
  const Vector way = centre - origin;
  const Vector shift = limits.axes * way;
  const double slack = reach > 0 ? error * (reach + way.lpNorm<1>()) + least_normal : 0;
  Oriented_box box;
  bool bounded = true;
  for (int i = 0; i < 3; ++i) {
    box.centre[i] = centre[i];
    box.half[i] = std::max(limits.high[i] - shift[i], shift[i] - limits.low[i]) + slack;
    bounded &= box.half[i] < 1e307;
    for (int k = 0; k < 3; ++k) box.axes[i][k] = limits.axes(i, k);
  }
  return bounded && std::isfinite(slack) ? box : everything();
}

/// Two boxes, relative to the centre of a.
struct Two_boxes {
  Axes axes_a, axes_b;
  Vector half_a, half_b;
  Vector way;    ///< to the centre of b
  double reach;  ///< bounds all coordinates of both, up to a factor of 1 + 1e-14

  Two_boxes(const Oriented_box& a, const Oriented_box& b)
      : axes_a(axes_of(a)),
        axes_b(axes_of(b)),
        half_a(half_of(a)),
        half_b(half_of(b)),
        way(centre_of(b) - centre_of(a)) {
    reach = sum(half_a) + sum(half_b) + way.lpNorm<1>();
  }

  /// Limits of both, with an error of less than 1.3e-14 of the reach: see 3. above.
  Box_limits limits(const Axes& along) const {
    const Vector a = (along * axes_a.transpose()).cwiseAbs() * half_a;
    const Vector b = (along * axes_b.transpose()).cwiseAbs() * half_b;
    const Vector shift = along * way;
    return {along, (-a).cwiseMin(shift - b), a.cwiseMax(shift + b)};
  }

  /// Principal axes of two solid boxes of equal mass.
  Axes joint_axes() const {
    if (!(reach > 1e-290 && reach < 1e290)) return axes_a;
    const Axes a = (half_a / reach).asDiagonal() * axes_a, b = (half_b / reach).asDiagonal() * axes_b;
    const Vector step = way / reach;
    return principal_axes((a.transpose() * a + b.transpose() * b) / 3 + step * step.transpose() / 2);
  }
};

}  // namespace

void Oriented_box::enclose(const Leaf_faces& faces) {
  const double* origin = faces.position(faces.vertices.size() - 1);
  kernel::Frame frame{{origin[0], origin[1], origin[2]}, {}};
  const Axes principal = principal_axes(faces);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) frame.axes[i][k] = principal(i, k);
  const auto found = kernel::frame_limits(faces, frame);
  const Box_limits upright{Axes::Identity(), Vector(found.low), Vector(found.high)};
  const Box_limits turned{principal, Vector(found.low + 3), Vector(found.high + 3)};
  // The difference of a vertex and the origin has an error of u of its size, its dot products 3 u: 5 u of the
  // allowed 16.
  const double reach = sum(upright.high.cwiseMax(-upright.low));
  const auto& best = turned.surface(reach) < upright.surface(reach) ? turned : upright;
  *this = box_about_middle(Vector(origin), best, reach, 0x1p-49);
}

void Oriented_box::enclose(const Oriented_box& a, const Oriented_box& b) {
  const Two_boxes two(a, b);
  Box_limits best = two.limits(two.joint_axes());
  for (const Axes* along : {&two.axes_a, &two.axes_b}) {
    const Box_limits limits = two.limits(*along);
    if (limits.surface(two.reach) < best.surface(two.reach)) best = limits;
  }
  *this = box_about_middle(centre_of(a), best, two.reach, 2e-14);
}

/// The extent along each axis follows from 3. The added slack covers the error in 3., the rounding of the sums, and the
/// rounding of the last sum, which is at most u of the centre and the reach.
Aabb Oriented_box::bounds() const {
  const Vector reach = axes_of(*this).cwiseAbs().transpose() * half_of(*this);
  const double size = sum(half_of(*this));
  Aabb box{};
  for (int k = 0; k < 3; ++k) {
    const double slack = size > 0 ? 2e-14 * size + 0x1p-51 * std::abs(centre[k]) + least_normal : 0;
    box.low[k] = size < infinity ? centre[k] - (reach[k] + slack) : -infinity;
    box.high[k] = size < infinity ? centre[k] + (reach[k] + slack) : infinity;
  }
  return box;
}

/// The gap along an axis is the distance of the centres along it minus the reach of both boxes from their centres.
///
/// Axes of the boxes are known exactly. The reach of the other box along such an axis has an error of less than
/// 1.3e-14 H, by 3. and the rounding of its sums. The distance of the centres has an error of 6 u of its size.
///
/// For cross products, let r_ij = a_i . b_j and t_k = a_k . way, where `way` goes from the centre of a to that of b.
///
/// - The cross product of a_i and b_j has length at most 1 + 1e-14. By 2., it differs from that of a_i and
///   sum_k r_kj a_k by at most 1.1e-14.
/// - A cross product of two axes differs from the third, or its opposite, by at most 2e-14, since the cofactor matrix
///   of A is det A times the inverse of its transpose.
/// - So the computed reach of a along the cross product has an error of less than 6e-14 H, and so does that of b. The
///   distance of the centres is a determinant of three vectors, two of them expressed in a's axes; its error is less
///   than 5e-14 of its size.
///
/// `doubt` allows for 1e-13 of all three, and for 1e-300 because of subnormal products. If a limit or distance is not
/// finite, `doubt` is infinite or NaN, and nothing is separated.
bool near(const Oriented_box& a, const Oriented_box& b, double margin) {
  const auto dot = [](const double* p, const double* q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; };
  const double way[3]{b.centre[0] - a.centre[0], b.centre[1] - a.centre[1], b.centre[2] - a.centre[2]};
  const double reach = (a.half[0] + a.half[1] + a.half[2]) + (b.half[0] + b.half[1] + b.half[2]) +
                       (std::abs(way[0]) + std::abs(way[1]) + std::abs(way[2]));
  const double doubt = 1e-13 * reach + 1e-300;
  const double needed = doubt + 1.00000000000001 * margin;

  double r[3][3], size[3][3], t[3];
  for (int i = 0; i < 3; ++i) {
    t[i] = dot(a.axes[i], way);
    for (int j = 0; j < 3; ++j) size[i][j] = std::abs(r[i][j] = dot(a.axes[i], b.axes[j]));
    if (std::abs(t[i]) - (a.half[i] + dot(size[i], b.half)) > needed) return false;
  }
  for (int j = 0; j < 3; ++j) {
    const double reach_a = size[0][j] * a.half[0] + size[1][j] * a.half[1] + size[2][j] * a.half[2];
    if (std::abs(dot(b.axes[j], way)) - (b.half[j] + reach_a) > needed) return false;
  }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double distance = std::abs(t[i2] * r[i1][j] - t[i1] * r[i2][j]);
      const double reach_a = a.half[i1] * size[i2][j] + a.half[i2] * size[i1][j];
      const double reach_b = b.half[j1] * size[i][j2] + b.half[j2] * size[i][j1];
      const double gap = distance - (reach_a + reach_b);
      // The root is the length of the cross product, whose square is 1 - r^2 up to rounding.
      if (gap > doubt && gap > doubt + 1.00000000000001 * margin * std::sqrt(std::abs(1 - r[i][j] * r[i][j]) + 2e-14))
        return false;
    }
  return true;
}

}  // namespace lodestone
