// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_ROUNDED_CORNERS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_ROUNDED_CORNERS_INL_H
#undef LODESTONE_ROUNDED_CORNERS_INL_H
#else
#define LODESTONE_ROUNDED_CORNERS_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "filter/face_columns.h"
#include "filter/face_filter_kernel.h"
#include "lodestone/volumes/leaf_faces.h"
#include "simd/lane_lookup-inl.h"
#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Rounded_vector = Vector3<Float_lanes>;

/// The rounded corners of one face per lane.
struct Rounded_corners {
  Rounded_vector of[3];
};

/// @param faces  indices in the leaf, a whole vector of them
#if HWY_TARGET <= HWY_AVX3
HWY_INLINE Rounded_corners load_rounded_corners(const Leaf_input& leaf, const std::uint8_t* faces) {
  const Index_lanes d;
  const auto indices = hn::PromoteTo(d, hn::LoadU(hn::Rebind<std::uint8_t, Index_lanes>(), faces));
  const auto packed = look_up(d, leaf.faces->corners, leaf.faces->count, indices).of[0];
  const auto ten_bits = hn::Set(d, 0x3ff);
  const Indices corners[]{hn::And(packed, ten_bits), hn::And(hn::ShiftRight<10>(packed), ten_bits),
                          hn::ShiftRight<20>(packed)};
  Rounded_corners rounded;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const auto [x, y, z] = look_up(d, leaf.faces->positions, leaf.vertex_count, corners[corner]).of;
    rounded.of[corner] = {x, y, z};
  }
  return rounded;
}
#else
HWY_INLINE Rounded_corners load_rounded_corners(const Leaf_input& leaf, const std::uint8_t* faces) {
  const Float_lanes d;
  alignas(64) float of[3][3][float_lanes];
  for (std::size_t lane = 0; lane < float_lanes; ++lane)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t vertex = leaf.corners[faces[lane]][corner];
      for (std::size_t axis = 0; axis < 3; ++axis) of[corner][axis][lane] = leaf.faces->positions[axis][vertex];
    }
  Rounded_corners rounded;
  for (std::size_t corner = 0; corner < 3; ++corner)
    rounded.of[corner] = {hn::Load(d, of[corner][0]), hn::Load(d, of[corner][1]), hn::Load(d, of[corner][2])};
  return rounded;
}
#endif

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
