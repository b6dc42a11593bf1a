// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_VECTOR_TYPES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_VECTOR_TYPES_INL_H
#undef LODESTONE_VECTOR_TYPES_INL_H
#else
#define LODESTONE_VECTOR_TYPES_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "simd/widest_vector.h"

// The vectors of all kernels. `X_lanes` is a tag of Highway's; `Xs` is a vector with these lanes.
HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Double_lanes = hn::CappedTag<double, most_double_lanes>;
using Doubles = hn::Vec<Double_lanes>;
using Double_mask = hn::Mask<Double_lanes>;
constexpr std::size_t double_lanes = hn::MaxLanes(Double_lanes());

using Float_lanes = hn::CappedTag<float, most_float_lanes>;
using Floats = hn::Vec<Float_lanes>;
constexpr std::size_t float_lanes = hn::MaxLanes(Float_lanes());

/// Indices of as many elements as a vector holds floats.
using Index_lanes = hn::Rebind<std::uint32_t, Float_lanes>;
using Indices = hn::Vec<Index_lanes>;

/// One side of several boxes, in steps.
using Side_lanes = hn::CappedTag<std::int16_t, most_side_lanes>;
using Sides = hn::Vec<Side_lanes>;
constexpr std::size_t side_lanes = hn::MaxLanes(Side_lanes());

/// x, y and z of one position, and padding: one vector of four lanes, two of two, or four of one.
using Position_lanes = hn::CappedTag<double, 4>;
using Position_vector = hn::Vec<Position_lanes>;
constexpr std::size_t position_lanes = hn::MaxLanes(Position_lanes());
constexpr std::size_t position_vectors = 4 / position_lanes;

/// One vector of space per lane.
template <class Tag>
struct Vector3 {
  hn::Vec<Tag> x, y, z;
};

/// One vector of space, in every lane.
template <class Tag, class T>
HWY_INLINE Vector3<Tag> in_all_lanes(Tag d, const T* vector) {
  return {hn::Set(d, vector[0]), hn::Set(d, vector[1]), hn::Set(d, vector[2])};
}

template <class Tag>
HWY_INLINE Vector3<Tag> operator+(const Vector3<Tag>& p, const Vector3<Tag>& q) {
  return {hn::Add(p.x, q.x), hn::Add(p.y, q.y), hn::Add(p.z, q.z)};
}
template <class Tag>
HWY_INLINE Vector3<Tag> operator-(const Vector3<Tag>& p, const Vector3<Tag>& q) {
  return {hn::Sub(p.x, q.x), hn::Sub(p.y, q.y), hn::Sub(p.z, q.z)};
}
template <class Tag>
HWY_INLINE Vector3<Tag> cross(const Vector3<Tag>& u, const Vector3<Tag>& v) {
  return {hn::Sub(hn::Mul(u.y, v.z), hn::Mul(u.z, v.y)), hn::Sub(hn::Mul(u.z, v.x), hn::Mul(u.x, v.z)),
          hn::Sub(hn::Mul(u.x, v.y), hn::Mul(u.y, v.x))};
}
/// (x + y) + z, each product and sum rounded.
template <class Tag>
HWY_INLINE hn::Vec<Tag> dot(const Vector3<Tag>& u, const Vector3<Tag>& v) {
  return hn::Add(hn::Add(hn::Mul(u.x, v.x), hn::Mul(u.y, v.y)), hn::Mul(u.z, v.z));
}
template <class Tag>
HWY_INLINE Vector3<Tag> absolute(const Vector3<Tag>& u) {
  return {hn::Abs(u.x), hn::Abs(u.y), hn::Abs(u.z)};
}
template <class Tag>
HWY_INLINE Vector3<Tag> greater(const Vector3<Tag>& u, const Vector3<Tag>& v) {
  return {hn::Max(u.x, v.x), hn::Max(u.y, v.y), hn::Max(u.z, v.z)};
}

template <class Vector>
HWY_INLINE Vector greatest(Vector a, Vector b, Vector c) {
  return hn::Max(hn::Max(a, b), c);
}
template <class Vector>
HWY_INLINE Vector least(Vector a, Vector b, Vector c) {
  return hn::Min(hn::Min(a, b), c);
}

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
