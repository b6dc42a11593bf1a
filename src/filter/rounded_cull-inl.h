// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_ROUNDED_CULL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_ROUNDED_CULL_INL_H
#undef LODESTONE_ROUNDED_CULL_INL_H
#else
#define LODESTONE_ROUNDED_CULL_INL_H
#endif

#include <hwy/highway.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "filter/face_filter_kernel.h"
#include "filter/filter_scratch.h"
#include "filter/pair_list-inl.h"
#include "filter/rounded_corners-inl.h"
#include "filter/rounding-inl.h"
#include "filter/separation-inl.h"
#include "simd/compress-inl.h"
#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// By how much more the gap of two triangles must be along an axis of `greatest_gap` because their corners are rounded.
///
/// Let M be the largest coordinates and r the reaches, both rounded. A corner is off by less than 1.01 x 2^-24 M along
/// each coordinate axis: reaches that a gap is told for are above 1e-9, so M is far above the smallest normal float.
/// (Corners beyond all floats have a reach of 0, or one beyond what a gap is told for.) The axis of a gap, that of the
/// rounded corners, has an x of at most 8 r_y r_z, and likewise y and z. So two triangles whose gap is greater than 2
/// x 1.01 x 2^-24 x 8 (M_x r_y r_z + r_x M_y r_z + r_x r_y M_z) were apart before rounding. The allowance is nearly
/// twice that.
HWY_INLINE Floats gap_lost_by_rounding(const Rounded_vector& reach, const Rounding& rounding) {
  const Float_lanes d;
  const Rounded_vector largest = in_all_lanes(d, rounding.largest);
  const auto yz = hn::Mul(reach.y, reach.z), xz = hn::Mul(reach.x, reach.z), xy = hn::Mul(reach.x, reach.y);
  return hn::Mul(hn::Set(d, 0x1p-19F), dot(largest, Rounded_vector{yz, xz, xy}));
}

/// The reach of two triangles whose corners are rounded, for `apart_along`.
///
/// Let u = 2^-24. A corner is off by less than 1.01 u of the largest coordinate M, or by 2^-149 where that is below the
/// normal floats: a gap by twice that for each unit of the axis. `apart_along` allows for 36 u of the reach: an eighth
/// of M more is 4.5 u M, and 1e-30 more is 2e-36. Rounded corners beyond what is safe may have been beyond all floats.
HWY_INLINE Rounded_vector reach_when_rounded(const Two_triangles<Float_lanes>& two, const Rounding& rounding) {
  const Float_lanes d;
  const auto longer = [&](Floats reach, float largest) HWY_ATTR {
    const bool safe = largest < Safe_range<float>::most;
    return hn::Add(reach, hn::Set(d, safe ? largest / 8 + 1e-30F : std::numeric_limits<float>::infinity()));
  };
  return {longer(two.reach.x, rounding.largest[0]), longer(two.reach.y, rounding.largest[1]),
          longer(two.reach.z, rounding.largest[2])};
}

/// The rounded triangles of a vector of listed pairs.
HWY_INLINE Two_triangles<Float_lanes> load_rounded_pairs(const Leaf_input& a, const Leaf_input& b, std::size_t first,
                                                         const Filter_scratch& scratch) {
  return Two_triangles<Float_lanes>(load_rounded_corners(a, scratch.pairs_a + first).of,
                                    load_rounded_corners(b, scratch.pairs_b + first).of);
}

/// Removes the listed pairs that a direction proves farther apart than the margin, whatever rounding lost: see
/// `not_apart_by_planes`.
/// @return number of pairs left
HWY_NOINLINE inline std::size_t cull_by_rounded_planes(const Leaf_input& a, const Leaf_input& b,
                                                       const Rounding& rounding, std::size_t count,
                                                       Filter_scratch& scratch) {
  const Float_lanes d;
  if (count == 0) return 0;
  pad_pairs(count, scratch);
  std::size_t kept = 0;
  for (std::size_t first = 0; first < count; first += float_lanes) {
    const auto two = load_rounded_pairs(a, b, first, scratch);
    const auto left =
        not_apart_by_planes(two, reach_when_rounded(two, rounding), rounding.margin, hn::FirstN(d, count - first));
    kept = keep_pairs(first, mask_bits(d, left), kept, scratch);
  }
  return kept;
}

/// Writes a candidate for each chosen lane. Writes a whole vector of them.
/// @param crossing  their guesses
/// @return number of candidates
HWY_INLINE std::size_t store_candidates(const std::uint8_t* pairs_a, const std::uint8_t* pairs_b, Floats crossing,
                                        hn::Mask<Float_lanes> chosen, Face_candidate* candidates) {
  static_assert(std::endian::native == std::endian::little && sizeof(Face_candidate) == 4,
                "a candidate is written as one number");
  const Float_lanes d;
  const Index_lanes numbers;
  const hn::Rebind<std::uint8_t, Float_lanes> bytes;
  const auto guess = hn::BitCast(numbers, hn::ConvertTo(hn::Rebind<std::int32_t, Float_lanes>(), crossing));
  const auto index_a = hn::PromoteTo(numbers, hn::LoadU(bytes, pairs_a));
  const auto index_b = hn::PromoteTo(numbers, hn::LoadU(bytes, pairs_b));
  const auto packed = hn::Or(index_a, hn::Or(hn::ShiftLeft<8>(index_b), hn::ShiftLeft<16>(guess)));
  const std::uint32_t bits = mask_bits(d, chosen);
  std::uint32_t found[most_float_lanes] = {};
  compress_store(packed, hn::RebindMask(numbers, chosen), bits, found);
  std::memcpy(candidates, found, sizeof found);
  return hwy::PopCount(bits);
}

struct Sorted_pairs {
  std::size_t crossing;  ///< candidates written
  std::size_t unclear;   ///< pairs left in the list
};

/// Sorts the listed pairs by their rounded corners, with margin 0: pairs proven apart are removed, pairs that overlap
/// by more than rounding become candidates, with a guess at their crossing, and the others stay in the list.
HWY_INLINE Sorted_pairs sort_by_rounded_corners(const Leaf_input& a, const Leaf_input& b, const Rounding& rounding,
                                                std::size_t count, Filter_scratch& scratch,
                                                Face_candidate* candidates) {
  const Float_lanes d;
  Sorted_pairs sorted{0, 0};
  if (count == 0) return sorted;
  pad_pairs(count, scratch);
  for (std::size_t first = 0; first < count; first += float_lanes) {
    const auto two = load_rounded_pairs(a, b, first, scratch);
    const auto of = determinants(two);
    const auto gap = greatest_gap(of);
    // A product of three reaches, and its last digit, are floats within this limit.
    const auto telling = hn::Add(telling_gap(two, 1e9F), gap_lost_by_rounding(two.reach, rounding));
    const auto crossing = find_crossing(of, gap);
    const auto left = hn::AndNot(hn::Gt(gap, telling), hn::FirstN(d, count - first));
    const auto deep = hn::And(left, hn::Lt(gap, hn::Neg(telling)));
    const auto crosses = hn::And(deep, hn::Lt(crossing, hn::Set(d, float{no_crossing})));
    sorted.crossing += store_candidates(scratch.pairs_a + first, scratch.pairs_b + first, crossing, crosses,
                                        candidates + sorted.crossing);
    sorted.unclear = keep_pairs(first, mask_bits(d, hn::AndNot(crosses, left)), sorted.unclear, scratch);
  }
  return sorted;
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
