// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_VECTOR_TYPES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_VECTOR_TYPES_INL_H
#undef LODESTONE_VECTOR_TYPES_INL_H
#else
#define LODESTONE_VECTOR_TYPES_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <cstring>
#include <type_traits>

#include "simd/widest_vector.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// As many doubles as the widest vector holds.
using Lanes = hn::CappedTag<double, widest>;
using Numbers = hn::Vec<Lanes>;
using Truths = hn::Mask<Lanes>;

HWY_INLINE Numbers all(double value) { return hn::Set(Lanes(), value); }

template <class Tag>
struct Vector3 {
  hn::Vec<Tag> x, y, z;
};

template <class Tag>
HWY_INLINE Vector3<Tag> operator-(const Vector3<Tag>& p, const Vector3<Tag>& q) {
  return {hn::Sub(p.x, q.x), hn::Sub(p.y, q.y), hn::Sub(p.z, q.z)};
}
template <class Tag>
HWY_INLINE Vector3<Tag> cross(const Vector3<Tag>& u, const Vector3<Tag>& v) {
  return {hn::Sub(hn::Mul(u.y, v.z), hn::Mul(u.z, v.y)), hn::Sub(hn::Mul(u.z, v.x), hn::Mul(u.x, v.z)),
          hn::Sub(hn::Mul(u.x, v.y), hn::Mul(u.y, v.x))};
}
template <class Tag>
HWY_INLINE hn::Vec<Tag> dot(const Vector3<Tag>& u, const Vector3<Tag>& v) {
  return hn::Add(hn::Add(hn::Mul(u.x, v.x), hn::Mul(u.y, v.y)), hn::Mul(u.z, v.z));
}
template <class Tag>
HWY_INLINE Vector3<Tag> sizes(const Vector3<Tag>& u) {
  return {hn::Abs(u.x), hn::Abs(u.y), hn::Abs(u.z)};
}
template <class Tag>
HWY_INLINE Vector3<Tag> greater(const Vector3<Tag>& u, const Vector3<Tag>& v) {
  return {hn::Max(u.x, v.x), hn::Max(u.y, v.y), hn::Max(u.z, v.z)};
}

/// One side of as many boxes as a vector holds, in steps.
using Box_lanes = hn::CappedTag<std::int16_t, most_box_lanes>;
using Sides = hn::Vec<Box_lanes>;
/// As many vertices as a vector has floats.
using Vertex_lanes = hn::CappedTag<std::uint32_t, most_float_lanes>;

/// As many rounded coordinates as a vector holds.
using Float_lanes = hn::Rebind<float, Vertex_lanes>;
using Floats = hn::Vec<Float_lanes>;

/// One bit per lane.
template <class Tag>
HWY_INLINE std::uint32_t mask_bits(Tag d, hn::Mask<Tag> mask) {
  constexpr std::size_t count = hn::MaxLanes(Tag());
  std::conditional_t<count <= 8, std::uint8_t, std::conditional_t<count <= 16, std::uint16_t, std::uint32_t>> bits;
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  std::memcpy(&bits, bytes, sizeof bits);
  return bits;
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
