// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_PLANE_HEIGHT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_PLANE_HEIGHT_INL_H
#undef LODESTONE_PLANE_HEIGHT_INL_H
#else
#define LODESTONE_PLANE_HEIGHT_INL_H
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <limits>

#include "simd/double_double-inl.h"
#include "triangles/most_planes.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// One plane per lane.
using Plane_lanes = hn::CappedTag<double, most_planes>;
using Planes = hn::Vec<Plane_lanes>;
using Plane_mask = hn::Mask<Plane_lanes>;
using Number = Double_double<Planes>;
using Difference = std::array<Number, 3>;

HWY_INLINE Planes all(double x) { return hn::Set(Plane_lanes(), x); }

HWY_INLINE std::array<Planes, 3> load(const double (&vector)[3][most_planes], std::size_t lane) {
  const Plane_lanes d;
  return {hn::LoadU(d, vector[0] + lane), hn::LoadU(d, vector[1] + lane), hn::LoadU(d, vector[2] + lane)};
}

HWY_INLINE Difference operator-(const std::array<Planes, 3>& p, const std::array<Planes, 3>& q) {
  return {exact_difference(p[0], q[0]), exact_difference(p[1], q[1]), exact_difference(p[2], q[2])};
}

HWY_INLINE Difference cross(const Difference& u, const Difference& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

/// The largest absolute coordinate. Infinite if products of three numbers of this size could overflow or lose digits
/// that count.
HWY_INLINE Planes size(const Difference& v) {
  const Planes largest = hn::Max(hn::Max(hn::Abs(v[0].high), hn::Abs(v[1].high)), hn::Abs(v[2].high));
  const Plane_mask moderate = hn::And(hn::Gt(largest, all(0x1p-250)), hn::Lt(largest, all(0x1p250)));
  return hn::IfThenElse(moderate, largest, all(std::numeric_limits<double>::infinity()));
}

/// The plane of a triangle.
struct Plane {
  std::array<Planes, 3> corner;
  Difference normal;  ///< not of unit length; the error of each coordinate is below 2^-99 `size`
  Planes size;        ///< product of the sizes of the two edges that span the plane
};

/// normal . (p - corner), with a bound of its error.
struct Height {
  Number value;
  Planes error;
};

/// Let s be the size of the plane times that of p - corner. The error of each product is below (2^-99 + 2^-100) s. Each
/// of the two sums, of numbers below 6 s together, adds at most 2^-103 12 s. In all that is below 2^-96 s.
HWY_INLINE Height height(const Plane& plane, const std::array<Planes, 3>& p) {
  const Difference w = p - plane.corner;
  const Difference& n = plane.normal;
  return {n[0] * w[0] + n[1] * w[1] + n[2] * w[2], hn::Mul(all(0x1p-96), hn::Mul(plane.size, size(w)))};
}

/// The plane through three points.
HWY_INLINE Plane plane_through(const std::array<Planes, 3>& p, const std::array<Planes, 3>& q,
                               const std::array<Planes, 3>& r) {
  const Difference u = q - p, v = r - p;
  return {p, cross(u, v), hn::Mul(size(u), size(v))};
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
