// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_SEPARATION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_SEPARATION_INL_H
#undef LODESTONE_SEPARATION_INL_H
#else
#define LODESTONE_SEPARATION_INL_H
#endif

#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

struct Axis {
  double x, y, z;
};

HWY_INLINE Axis difference(const double* p, const double* q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }
HWY_INLINE Axis cross(const Axis& u, const Axis& v) {
  return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}
HWY_INLINE double dot(const Axis& u, const Axis& v) { return u.x * v.x + u.y * v.y + u.z * v.z; }
HWY_INLINE double lesser(double p, double q) { return p < q ? p : q; }
HWY_INLINE double greater(double p, double q) { return p > q ? p : q; }
HWY_INLINE double greatest_size(double p, double q, double r, double s, double t) {
  return greater(greater(greater(std::fabs(p), std::fabs(q)), greater(std::fabs(r), std::fabs(s))), std::fabs(t));
}

/// At least the length of a vector, also where its square is beyond the normal doubles.
HWY_INLINE double length_bound(const Axis& u) {
  const double squared = dot(u, u);
  if (squared > 1e-280 && squared < 1e300) return 1.00000000000001 * std::sqrt(squared);
  return 1.00000000000001 * (std::fabs(u.x) + std::fabs(u.y) + std::fabs(u.z));
}

/// Two triangles, seen from a's first corner.
struct Two_triangles {
  Axis a1, a2, b0, b1, b2;
  Axis reach;  ///< the largest coordinates, without sign
  double margin;

  /// Whether the projections of the two onto an axis are apart by more than the margin, whatever the rounding.
  ///
  /// The axis may be any: its own rounding does not matter. A rounded difference is off by 2^-53 of its size, a dot
  /// product of three terms by less than 4 x 2^-53 of the sum of their sizes, which is at most |axis| . reach: so a gap
  /// between two of them is off by less than 2e-15 of it. Twice that is allowed for, and 1e-300 for products below the
  /// normal doubles. Infinities and what comes of them prove nothing.
  HWY_INLINE bool apart_along(const Axis& axis) const {
    const double pa1 = dot(axis, a1), pa2 = dot(axis, a2);
    const double pb0 = dot(axis, b0), pb1 = dot(axis, b1), pb2 = dot(axis, b2);
    const double low_a = lesser(lesser(pa1, pa2), 0), high_a = greater(greater(pa1, pa2), 0);
    const double low_b = lesser(lesser(pb0, pb1), pb2), high_b = greater(greater(pb0, pb1), pb2);
    const double gap = greater(low_b - high_a, low_a - high_b);
    const double size = std::fabs(axis.x) * reach.x + std::fabs(axis.y) * reach.y + std::fabs(axis.z) * reach.z;
    double needed = 4e-15 * size + 1e-300;
    if (margin > 0) needed += margin * length_bound(axis);
    return gap > needed;
  }
};

/// Whether floating point proves that two triangles are farther apart than the margin (0: have no point in common).
HWY_INLINE bool proven_apart(const double* a0, const double* a1, const double* a2, const double* b0, const double* b1,
                             const double* b2, double margin) {
  Two_triangles two{
      difference(a1, a0), difference(a2, a0), difference(b0, a0), difference(b1, a0), difference(b2, a0), {}, margin};
  two.reach = {greatest_size(two.a1.x, two.a2.x, two.b0.x, two.b1.x, two.b2.x),
               greatest_size(two.a1.y, two.a2.y, two.b0.y, two.b1.y, two.b2.y),
               greatest_size(two.a1.z, two.a2.z, two.b0.z, two.b1.z, two.b2.z)};
  const Axis normal_a = cross(two.a1, two.a2);
  if (two.apart_along(normal_a)) return true;
  const Axis f0 = difference(b1, b0), f1 = difference(b2, b1), f2 = difference(b0, b2);
  const Axis normal_b = cross(f0, f1);
  if (two.apart_along(normal_b)) return true;
  // Nearly coplanar ones lie apart within their plane.
  const Axis e1 = difference(a2, a1);
  return two.apart_along(cross(normal_a, two.a1)) || two.apart_along(cross(normal_a, e1)) ||
         two.apart_along(cross(normal_a, two.a2)) || two.apart_along(cross(normal_b, f0)) ||
         two.apart_along(cross(normal_b, f1)) || two.apart_along(cross(normal_b, f2));
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
