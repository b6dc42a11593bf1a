// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_SEPARATION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_SEPARATION_INL_H
#undef LODESTONE_SEPARATION_INL_H
#else
#define LODESTONE_SEPARATION_INL_H
#endif

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

/// In which lanes floating point does not prove that a and b are farther apart than the margin (0: have no point in
/// common), of those in `asked`.
HWY_INLINE Truths not_proven_apart(const Vector3& a0, const Vector3& a1, const Vector3& a2, const Vector3& b0,
                                   const Vector3& b1, const Vector3& b2, double margin, Truths asked) {
  Two_triangles two{a1 - a0, a2 - a0, b0 - a0, b1 - a0, b2 - a0, {}, margin};
  two.reach =
      greater(greater(greater(sizes(two.a1), sizes(two.a2)), greater(sizes(two.b0), sizes(two.b1))), sizes(two.b2));
  const Lanes d;
  const auto normal_a = cross(two.a1, two.a2);
  auto left = hn::AndNot(two.apart_along(normal_a), asked);
  if (hn::AllFalse(d, left)) return left;
  const auto f0 = b1 - b0, f1 = b2 - b1;
  const auto normal_b = cross(f0, f1);
  left = hn::AndNot(two.apart_along(normal_b), left);
  if (hn::AllFalse(d, left)) return left;
  // Nearly coplanar ones lie apart within their plane.
  left = hn::AndNot(two.apart_along(cross(normal_a, two.a1)), left);
  left = hn::AndNot(two.apart_along(cross(normal_a, a2 - a1)), left);
  left = hn::AndNot(two.apart_along(cross(normal_a, two.a2)), left);
  if (hn::AllFalse(d, left)) return left;
  left = hn::AndNot(two.apart_along(cross(normal_b, f0)), left);
  left = hn::AndNot(two.apart_along(cross(normal_b, f1)), left);
  return hn::AndNot(two.apart_along(cross(normal_b, b0 - b2)), left);
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
