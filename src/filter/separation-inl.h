// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_SEPARATION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_SEPARATION_INL_H
#undef LODESTONE_SEPARATION_INL_H
#else
#define LODESTONE_SEPARATION_INL_H
#endif

#include <hwy/highway.h>

#include <limits>

#include "lodestone/triangles/crossing.h"
#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Two triangles per lane, seen from a's first corner.
template <class Tag>
struct Two_triangles {
  Vector3<Tag> a1, a2, b0, b1, b2;
  Vector3<Tag> reach;  ///< the largest coordinates, without sign

  HWY_INLINE Two_triangles(const Vector3<Tag> (&a)[3], const Vector3<Tag> (&b)[3])
      : a1(a[1] - a[0]), a2(a[2] - a[0]), b0(b[0] - a[0]), b1(b[1] - a[0]), b2(b[2] - a[0]) {
    reach = greater(greater(greater(absolute(a1), absolute(a2)), greater(absolute(b0), absolute(b1))), absolute(b2));
  }
};

/// Within which products of a few numbers are known to their last digits: `least` is far above the smallest normal
/// number, `most` far below the largest one. Sums of squares are known to theirs from `least_square` on.
template <class T>
struct Safe_range;
template <>
struct Safe_range<double> {
  static constexpr double least = 1e-300, least_square = 1e-280, most = 1e290;
};
template <>
struct Safe_range<float> {
  static constexpr float least = 1e-36F, least_square = 1e-28F, most = 1e30F;
};

/// At least the length of a vector, also where its square is beyond the normal numbers.
template <class Tag>
HWY_INLINE hn::Vec<Tag> length_bound(const Vector3<Tag>& u) {
  using T = hn::TFromD<Tag>;
  const Tag d;
  const auto squared = dot(u, u);
  const auto normal = hn::And(hn::Gt(squared, hn::Set(d, Safe_range<T>::least_square)),
                              hn::Lt(squared, hn::Set(d, Safe_range<T>::most)));
  const auto sum = hn::Add(hn::Add(hn::Abs(u.x), hn::Abs(u.y)), hn::Abs(u.z));
  const auto length = hn::IfThenElse(normal, hn::Sqrt(squared), sum);
  return hn::Mul(hn::Set(d, 1 + 32 * std::numeric_limits<T>::epsilon()), length);
}

/// Whether the projections of two triangles onto an axis prove them farther apart than the margin.
///
/// The axis may be any: its own rounding does not matter. Let u be half the distance from 1 to the next number. A
/// difference is off by u of its size, a dot product of three terms by less than 4 u of the sum of their sizes, which
/// is at most |axis| . reach: so a gap between two of them is off by less than 18 u of it. Twice that is allowed for,
/// and `least` for what products lose below the normal numbers. Infinities and what comes of them prove nothing.
/// @param reach  of the triangles; more, if their corners are off by more than a difference is
template <class Tag>
HWY_INLINE hn::Mask<Tag> apart_along(const Two_triangles<Tag>& two, const Vector3<Tag>& reach, hn::TFromD<Tag> margin,
                                     const Vector3<Tag>& axis) {
  using T = hn::TFromD<Tag>;
  const Tag d;
  const auto zero = hn::Zero(d);
  const auto pa1 = dot(axis, two.a1), pa2 = dot(axis, two.a2);
  const auto pb0 = dot(axis, two.b0), pb1 = dot(axis, two.b1), pb2 = dot(axis, two.b2);
  const auto low_a = hn::Min(hn::Min(pa1, pa2), zero), high_a = hn::Max(hn::Max(pa1, pa2), zero);
  const auto low_b = hn::Min(hn::Min(pb0, pb1), pb2), high_b = hn::Max(hn::Max(pb0, pb1), pb2);
  const auto share = hn::Set(d, 18 * std::numeric_limits<T>::epsilon());
  auto needed = hn::Add(hn::Mul(share, dot(absolute(axis), reach)), hn::Set(d, Safe_range<T>::least));
  if (margin > 0) needed = hn::Add(needed, hn::Mul(hn::Set(d, margin), length_bound(axis)));
  const auto gap = hn::Max(hn::Sub(low_b, high_a), hn::Sub(low_a, high_b));
  // A projection that is not a number could be missing from the minima and maxima.
  return hn::And(hn::Gt(gap, needed), hn::Lt(needed, hn::Set(d, Safe_range<T>::most)));
}

/// Determinants of two triangles, by corner i of a and j of b. Edge i goes from corner i to the next: e of a, f of b.
/// The normals are m and n.
template <class Tag>
struct Determinants {
  using Numbers = hn::Vec<Tag>;

  Numbers height_a[3], height_b[3];  ///< of the corners beyond the plane of the other triangle: n.(a - b0), m.(b - a0)
  Numbers third_a[3];                ///< -m.f_j: how far a's third corner is beyond an edge of a along e x f_j
  Numbers third_b[3];                ///< n.e_i: how far b's third corner is beyond an edge of b along e_i x f
  Numbers side[3][3];                ///< det(e_i, f_j, b_j - a_i): how far f_j is beyond e_i along the cross product
};

/// All of them come of b_j x b_j+1: seen from a0, with s_j = a1.(b_j x b_j+1) and t_j the same of a2, the sides are
/// -s_j, s_j - t_j - m.f_j and t_j, and n.a1 and n.a2 are the sums of the s and of the t.
template <class Tag>
HWY_INLINE Determinants<Tag> determinants(const Two_triangles<Tag>& two) {
  const Vector3<Tag> b[]{two.b0, two.b1, two.b2};
  const Vector3<Tag> moments[]{cross(b[0], b[1]), cross(b[1], b[2]), cross(b[2], b[0])};
  const auto normal_a = cross(two.a1, two.a2);
  Determinants<Tag> of;
  for (std::size_t j = 0; j < 3; ++j) of.height_b[j] = dot(normal_a, b[j]);
  for (std::size_t j = 0; j < 3; ++j) {
    const auto s = dot(two.a1, moments[j]), t = dot(two.a2, moments[j]);
    of.third_a[j] = hn::Sub(of.height_b[j], of.height_b[(j + 1) % 3]);
    of.side[0][j] = hn::Neg(s);
    of.side[1][j] = hn::Add(hn::Sub(s, t), of.third_a[j]);
    of.side[2][j] = t;
  }
  const auto minus_s = hn::Add(hn::Add(of.side[0][0], of.side[0][1]), of.side[0][2]);
  const auto t = hn::Add(hn::Add(of.side[2][0], of.side[2][1]), of.side[2][2]);
  of.height_a[0] = hn::Neg(dot(b[0], moments[1]));
  of.height_a[1] = hn::Sub(of.height_a[0], minus_s);
  of.height_a[2] = hn::Add(of.height_a[0], t);
  of.third_b[0] = hn::Neg(minus_s);
  of.third_b[1] = hn::Add(t, minus_s);
  of.third_b[2] = hn::Neg(t);
  return of;
}

template <class V>
HWY_INLINE V least(const V (&numbers)[3]) {
  return hn::Min(hn::Min(numbers[0], numbers[1]), numbers[2]);
}
template <class V>
HWY_INLINE V most(const V (&numbers)[3]) {
  return hn::Max(hn::Max(numbers[0], numbers[1]), numbers[2]);
}

/// By how much the triangles are apart along their normals and the cross products of an edge of each: the greatest of
/// the eleven gaps. Along e x f the ends of an edge are in one place.
template <class Tag>
HWY_INLINE hn::Vec<Tag> greatest_gap(const Determinants<Tag>& of) {
  const auto zero = hn::Zero(Tag());
  auto gap = hn::Max(hn::Max(least(of.height_a), hn::Neg(most(of.height_a))),
                     hn::Max(least(of.height_b), hn::Neg(most(of.height_b))));
  for (std::size_t i = 0; i < 3; ++i) {
    const auto low_b = hn::Min(of.third_b[i], zero), high_b = hn::Max(of.third_b[i], zero);
    for (std::size_t j = 0; j < 3; ++j) {
      const auto low_a = hn::Min(of.third_a[j], zero), high_a = hn::Max(of.third_a[j], zero);
      gap = hn::Max(
          gap, hn::Max(hn::Sub(hn::Add(of.side[i][j], low_b), high_a), hn::Sub(low_a, hn::Add(of.side[i][j], high_b))));
    }
  }
  return gap;
}

/// A `Crossing`: edge k passes the edges of the other triangle all on the one side, and its ends are on both sides of
/// the plane. None for triangles that touch or are coplanar, whose gap is 0: told by signs alone, it would be any.
/// @param gap  the greatest
template <class Tag>
HWY_INLINE hn::Vec<Tag> find_crossing(const Determinants<Tag>& of, hn::Vec<Tag> gap) {
  const Tag d;
  const auto none = hn::Set(d, hn::TFromD<Tag>{no_crossing});
  const hn::RebindToSigned<Tag> integers;
  const auto is_signed = [&](hn::Vec<Tag> bits) HWY_ATTR {
    return hn::RebindMask(d, hn::Lt(hn::BitCast(integers, bits), hn::Zero(integers)));
  };
  auto crossing = none;
  for (std::size_t k = 0; k < 6; ++k) {
    const auto side = [&](std::size_t i) HWY_ATTR { return k < 3 ? of.side[k][i] : of.side[i][k - 3]; };
    const auto& height = k < 3 ? of.height_a : of.height_b;
    const auto from = height[k % 3], to = height[(k + 1) % 3];
    const auto below = hn::Or3(side(0), side(1), side(2));
    const auto above = hn::And(hn::And(side(0), side(1)), side(2));
    const auto down = hn::AndNot(hn::Or(below, from), to);
    const auto up = hn::AndNot(to, hn::And(above, from));
    crossing = hn::IfThenElse(is_signed(down), hn::Set(d, static_cast<hn::TFromD<Tag>>(k)), crossing);
    crossing = hn::IfThenElse(is_signed(up), hn::Set(d, static_cast<hn::TFromD<Tag>>(6 + k)), crossing);
  }
  return hn::IfThenElse(hn::Lt(gap, hn::Zero(d)), crossing, none);
}

/// How large the greatest gap must be to prove two triangles apart (by more than 0), whatever the rounding; infinite
/// where nothing would.
///
/// Let V be the product of the three reaches and u half the distance from 1 to the next number. The coordinates,
/// differences, are off by u of their size. A determinant of three of them has six products, which are at most V and
/// gather 8 roundings each, those of the coordinates and of the sums included: it is at most 6 V, and off by less than
/// 48 u V. By these and the roundings of their sums heights are off by less than 250, sides by at most 241, the thirds
/// of a by less than 110 and those of b by less than 390 u V; a gap that consists of them, with roundings of sums up to
/// 72 V, by less than 900 u V. Twice that is allowed for.
/// @param limit  of reaches, which must be above its inverse too: then what products lose below the normal numbers is
///               far less than the rest, and nothing overflows
template <class Tag>
HWY_INLINE hn::Vec<Tag> telling_gap(const Two_triangles<Tag>& two, hn::TFromD<Tag> limit) {
  using T = hn::TFromD<Tag>;
  const Tag d;
  const hn::Vec<Tag> reaches[]{two.reach.x, two.reach.y, two.reach.z};
  const auto measurable =
      hn::And(hn::Gt(least(reaches), hn::Set(d, 1 / limit)), hn::Lt(most(reaches), hn::Set(d, limit)));
  const auto volume = hn::Mul(hn::Mul(two.reach.x, two.reach.y), two.reach.z);
  const auto allowed = hn::Mul(hn::Set(d, 900 * std::numeric_limits<T>::epsilon()), volume);
  return hn::IfThenElse(measurable, allowed, hn::Set(d, std::numeric_limits<T>::infinity()));
}

/// The lanes, of those `among` which is asked, where no direction that is tried proves them farther apart than the
/// margin. Tried are both normals, the directions across the edges within the planes, and with a margin the direction
/// from centre to centre, which comes near the best for triangles that are small beside the margin.
/// @param reach  see `apart_along`
template <class Tag>
HWY_INLINE hn::Mask<Tag> not_apart_by_planes(const Two_triangles<Tag>& two, const Vector3<Tag>& reach,
                                             hn::TFromD<Tag> margin, hn::Mask<Tag> among) {
  const Tag d;
  const auto apart = [&](const Vector3<Tag>& axis) HWY_ATTR { return apart_along(two, reach, margin, axis); };
  const auto normal_a = cross(two.a1, two.a2);
  among = hn::AndNot(apart(normal_a), among);
  if (hn::AllFalse(d, among)) return among;
  const auto f0 = two.b1 - two.b0, f1 = two.b2 - two.b1;
  const auto normal_b = cross(f0, f1);
  among = hn::AndNot(apart(normal_b), among);
  if (hn::AllFalse(d, among)) return among;
  if (margin > 0) {
    among = hn::AndNot(apart((two.b0 + two.b1 + two.b2) - (two.a1 + two.a2)), among);
    if (hn::AllFalse(d, among)) return among;
  }
  // Nearly coplanar ones lie apart within their plane.
  among = hn::AndNot(apart(cross(normal_a, two.a1)), among);
  among = hn::AndNot(apart(cross(normal_a, two.a2 - two.a1)), among);
  among = hn::AndNot(apart(cross(normal_a, two.a2)), among);
  if (hn::AllFalse(d, among)) return among;
  among = hn::AndNot(apart(cross(normal_b, f0)), among);
  among = hn::AndNot(apart(cross(normal_b, f1)), among);
  return hn::AndNot(apart(cross(normal_b, two.b0 - two.b2)), among);
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
