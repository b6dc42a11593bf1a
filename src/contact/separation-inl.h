// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_SEPARATION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_SEPARATION_INL_H
#undef LODESTONE_SEPARATION_INL_H
#else
#define LODESTONE_SEPARATION_INL_H
#endif

#include <hwy/highway.h>

#include "lodestone/contact/crossing.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// One triangle against as many others as a vector has lanes.
using Lanes = hn::CappedTag<double, widest>;
using Numbers = hn::Vec<Lanes>;
using Truths = hn::Mask<Lanes>;

HWY_INLINE Numbers all(double value) { return hn::Set(Lanes(), value); }

struct Vector3 {
  Numbers x, y, z;
};

HWY_INLINE Vector3 operator-(const Vector3& p, const Vector3& q) {
  return {hn::Sub(p.x, q.x), hn::Sub(p.y, q.y), hn::Sub(p.z, q.z)};
}
HWY_INLINE Vector3 operator+(const Vector3& p, const Vector3& q) {
  return {hn::Add(p.x, q.x), hn::Add(p.y, q.y), hn::Add(p.z, q.z)};
}
HWY_INLINE Vector3 cross(const Vector3& u, const Vector3& v) {
  return {hn::Sub(hn::Mul(u.y, v.z), hn::Mul(u.z, v.y)), hn::Sub(hn::Mul(u.z, v.x), hn::Mul(u.x, v.z)),
          hn::Sub(hn::Mul(u.x, v.y), hn::Mul(u.y, v.x))};
}
HWY_INLINE Numbers dot(const Vector3& u, const Vector3& v) {
  return hn::Add(hn::Add(hn::Mul(u.x, v.x), hn::Mul(u.y, v.y)), hn::Mul(u.z, v.z));
}
HWY_INLINE Vector3 sizes(const Vector3& u) { return {hn::Abs(u.x), hn::Abs(u.y), hn::Abs(u.z)}; }
HWY_INLINE Vector3 greater(const Vector3& u, const Vector3& v) {
  return {hn::Max(u.x, v.x), hn::Max(u.y, v.y), hn::Max(u.z, v.z)};
}

/// At least the length of a vector, also where its square is beyond the normal doubles.
HWY_INLINE Numbers length_bound(const Vector3& u) {
  const auto squared = dot(u, u);
  const auto normal = hn::And(hn::Gt(squared, all(1e-280)), hn::Lt(squared, all(1e300)));
  const auto sum = hn::Add(hn::Add(hn::Abs(u.x), hn::Abs(u.y)), hn::Abs(u.z));
  return hn::Mul(all(1.00000000000001), hn::IfThenElse(normal, hn::Sqrt(squared), sum));
}

/// Two triangles per lane, seen from a's first corner.
struct Two_triangles {
  Vector3 a1, a2, b0, b1, b2;
  Vector3 reach;  ///< the largest coordinates, without sign
  double margin;

  /// Whether the projections of the two onto an axis are apart by more than the margin, whatever the rounding.
  ///
  /// The axis may be any: its own rounding does not matter. A rounded difference is off by 2^-53 of its size, a dot
  /// product of three terms by less than 4 x 2^-53 of the sum of their sizes, which is at most |axis| . reach: so a gap
  /// between two of them is off by less than 2e-15 of it. Twice that is allowed for, and 1e-300 for products below the
  /// normal doubles. Infinities and what comes of them prove nothing.
  HWY_INLINE Truths apart_along(const Vector3& axis) const {
    const auto zero = hn::Zero(Lanes());
    const auto pa1 = dot(axis, a1), pa2 = dot(axis, a2);
    const auto pb0 = dot(axis, b0), pb1 = dot(axis, b1), pb2 = dot(axis, b2);
    const auto low_a = hn::Min(hn::Min(pa1, pa2), zero), high_a = hn::Max(hn::Max(pa1, pa2), zero);
    const auto low_b = hn::Min(hn::Min(pb0, pb1), pb2), high_b = hn::Max(hn::Max(pb0, pb1), pb2);
    auto needed = hn::Add(hn::Mul(all(4e-15), dot(sizes(axis), reach)), all(1e-300));
    if (margin > 0) needed = hn::Add(needed, hn::Mul(all(margin), length_bound(axis)));
    const auto apart = hn::Or(hn::Gt(hn::Sub(low_b, high_a), needed), hn::Gt(hn::Sub(low_a, high_b), needed));
    // A projection that is not a number could be missing from the minima and maxima.
    return hn::And(apart, hn::Lt(needed, all(1e308)));
  }
};

/// What the edges of two triangles tell about them, one pair per lane.
struct Edge_verdict {
  Truths apart;      ///< proven, whatever the rounding
  Numbers crossing;  ///< a `Crossing`
};

/// Compares each edge of one triangle with each of the other: whether the triangles are apart (by more than 0) along
/// the cross product of the two, and which edge passes through the other triangle.
///
/// Let e be an edge of a and f one of b. Along e x f the ends of an edge are in one place. With the normals m and n,
/// the third corner of a is -m.f beyond e, that of b is n.e beyond f, and f is det(e, f, f0 - e0) beyond e.
///
/// All of these are determinants, or differences of two, of vectors whose coordinates are below twice the reach, and
/// off by less than 2^-52 of that. A determinant has 6 products of three coordinates; with the rounding of products and
/// sums it is off by less than 48 x 11 x 2^-53 of the product of the three reaches, and what a gap consists of by less
/// than 2000 x 2^-53 of it altogether. Nearly twice that is allowed for.
HWY_INLINE Edge_verdict compare_edges(const Two_triangles& two, const Vector3& normal_a, const Vector3& normal_b) {
  const auto zero = hn::Zero(Lanes());
  const Vector3 origin{zero, zero, zero};
  const Vector3 a[]{origin, two.a1, two.a2}, b[]{two.b0, two.b1, two.b2};
  const Numbers height_a[]{dot(normal_b, origin - b[0]), dot(normal_b, a[1] - b[0]), dot(normal_b, a[2] - b[0])};
  const Numbers height_b[]{dot(normal_a, b[0]), dot(normal_a, b[1]), dot(normal_a, b[2])};

  const auto& reach = two.reach;
  // Within these limits what products lose below the normal doubles is far less than that.
  const auto least = hn::Min(hn::Min(reach.x, reach.y), reach.z), most = hn::Max(hn::Max(reach.x, reach.y), reach.z);
  const auto measurable = hn::And(hn::Gt(least, all(1e-90)), hn::Lt(most, all(1e90)));
  const auto needed = hn::Mul(all(4e-13), hn::Mul(hn::Mul(reach.x, reach.y), reach.z));

  Truths apart = hn::Lt(zero, zero);  // none
  // Whether an edge passes all three of the other triangle on the one side, or all on the other.
  Truths left[6], right[6];
  for (std::size_t k = 0; k < 6; ++k) left[k] = right[k] = hn::Not(apart);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3 e = a[(i + 1) % 3] - a[i];
    const auto third_b = hn::Sub(height_a[(i + 1) % 3], height_a[i]);
    for (std::size_t j = 0; j < 3; ++j) {
      const auto f_from_e = dot(cross(e, b[(j + 1) % 3] - b[j]), b[j] - a[i]);
      const auto third_a = hn::Sub(height_b[j], height_b[(j + 1) % 3]);
      const auto high_a = hn::Max(third_a, zero), low_a = hn::Min(third_a, zero);
      const auto high_b = hn::Add(f_from_e, hn::Max(third_b, zero)), low_b = hn::Add(f_from_e, hn::Min(third_b, zero));
      apart = hn::Or(apart, hn::Or(hn::Gt(hn::Sub(low_b, high_a), needed), hn::Gt(hn::Sub(low_a, high_b), needed)));
      const auto is_left = hn::Gt(f_from_e, zero), is_right = hn::Lt(f_from_e, zero);
      left[i] = hn::And(left[i], is_left), right[i] = hn::And(right[i], is_right);
      left[3 + j] = hn::And(left[3 + j], is_left), right[3 + j] = hn::And(right[3 + j], is_right);
    }
  }
  auto crossing = all(no_crossing);
  for (std::size_t k = 0; k < 6; ++k) {
    const auto* height = k < 3 ? height_a : height_b;
    const auto from = height[k % 3], to = height[(k + 1) % 3];
    const auto down = hn::And(left[k], hn::And(hn::Gt(from, zero), hn::Lt(to, zero)));
    const auto up = hn::And(right[k], hn::And(hn::Lt(from, zero), hn::Gt(to, zero)));
    crossing = hn::IfThenElse(down, all(static_cast<double>(k)), crossing);
    crossing = hn::IfThenElse(up, all(static_cast<double>(6 + k)), crossing);
  }
  return {hn::And(apart, measurable), crossing};
}

/// In which lanes floating point does not prove that a and b are farther apart than the margin (0: have no point in
/// common), of those in `asked`.
/// @param one_mesh  they are faces of one mesh
/// @param crossing  is set to a `Crossing` for each of them
HWY_INLINE Truths not_proven_apart(const Vector3& a0, const Vector3& a1, const Vector3& a2, const Vector3& b0,
                                   const Vector3& b1, const Vector3& b2, double margin, bool one_mesh, Truths asked,
                                   Numbers& crossing) {
  Two_triangles two{a1 - a0, a2 - a0, b0 - a0, b1 - a0, b2 - a0, {}, margin};
  two.reach =
      greater(greater(greater(sizes(two.a1), sizes(two.a2)), greater(sizes(two.b0), sizes(two.b1))), sizes(two.b2));
  const Lanes d;
  crossing = all(no_crossing);
  const auto normal_a = cross(two.a1, two.a2);
  auto left = hn::AndNot(two.apart_along(normal_a), asked);
  if (hn::AllFalse(d, left)) return left;
  const auto f0 = b1 - b0, f1 = b2 - b1;
  const auto normal_b = cross(f0, f1);
  left = hn::AndNot(two.apart_along(normal_b), left);
  if (hn::AllFalse(d, left)) return left;

  // Nearly coplanar ones lie apart within their plane.
  const auto not_apart_within_planes = [&](Truths among) HWY_ATTR {
    among = hn::AndNot(two.apart_along(cross(normal_a, two.a1)), among);
    among = hn::AndNot(two.apart_along(cross(normal_a, a2 - a1)), among);
    among = hn::AndNot(two.apart_along(cross(normal_a, two.a2)), among);
    if (hn::AllFalse(d, among)) return among;
    among = hn::AndNot(two.apart_along(cross(normal_b, f0)), among);
    among = hn::AndNot(two.apart_along(cross(normal_b, f1)), among);
    return hn::AndNot(two.apart_along(cross(normal_b, b0 - b2)), among);
  };
  // So do most that are near each other on one surface.
  if (one_mesh || margin > 0) left = not_apart_within_planes(left);
  if (margin > 0 || hn::AllFalse(d, left)) return left;
  const auto verdict = compare_edges(two, normal_a, normal_b);
  left = hn::AndNot(verdict.apart, left);
  crossing = verdict.crossing;
  const auto unclear = hn::And(left, hn::Eq(crossing, all(no_crossing)));
  if (one_mesh || hn::AllFalse(d, unclear)) return left;
  // What comes of one lane must not depend on the others: their number differs between instruction sets.
  return hn::Or(hn::AndNot(unclear, left), not_apart_within_planes(unclear));
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
