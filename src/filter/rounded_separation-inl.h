// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_ROUNDED_SEPARATION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_ROUNDED_SEPARATION_INL_H
#undef LODESTONE_ROUNDED_SEPARATION_INL_H
#else
#define LODESTONE_ROUNDED_SEPARATION_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "filter/face_filter_kernel.h"
#include "filter/filter_scratch.h"
#include "filter/leaf_pose-inl.h"
#include "filter/near_boxes-inl.h"
#include "filter/separation-inl.h"
#include "lodestone/volumes/leaf_faces.h"
#include "simd/lane_lookup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Rounded_vector = Vector3<Float_lanes>;

/// The rounded corners of a face of one leaf per lane.
struct Rounded_corners {
  Rounded_vector of[3];
};

#if HWY_TARGET <= HWY_AVX3
HWY_INLINE Rounded_corners load_corners(const Leaf_input& leaf, const std::uint8_t* faces) {
  const Vertex_lanes d;
  const auto places = hn::PromoteTo(d, hn::LoadU(hn::Rebind<std::uint8_t, Vertex_lanes>(), faces));
  const auto packed = look_up(d, leaf.faces->corners, leaf.faces->count, places).of[0];
  const auto ten_bits = hn::Set(d, 0x3ff);
  const hn::Vec<Vertex_lanes> corners[]{hn::And(packed, ten_bits), hn::And(hn::ShiftRight<10>(packed), ten_bits),
                                        hn::ShiftRight<20>(packed)};
  Rounded_corners rounded;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const auto [x, y, z] = look_up(d, leaf.faces->positions, leaf.vertex_count, corners[corner]).of;
    rounded.of[corner] = {x, y, z};
  }
  return rounded;
}
#else
HWY_INLINE Rounded_corners load_corners(const Leaf_input& leaf, const std::uint8_t* faces) {
  const Float_lanes d;
  alignas(64) float of[3][3][hn::MaxLanes(d)];
  for (std::size_t lane = 0; lane < hn::MaxLanes(d); ++lane)
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

/// What the rounded corners of two leaves are judged by.
struct Rounding {
  float largest[4] = {};  ///< coordinates within the boxes of the leaves, without sign
  float margin;

  HWY_INLINE Rounding(const Filter_request& request, const Aabb& a, const Aabb& b) : margin(request.rounded_margin) {
    const D d;
    for (std::size_t i = 0; i < vectors; ++i) {
      const auto origin = hn::LoadU(d, request.origin + i * lanes);
      const auto distance = [&](const double* corner)
                                HWY_ATTR { return hn::Abs(hn::Sub(hn::Load(d, corner + i * lanes), origin)); };
      const auto farthest =
          hn::Max(hn::Max(distance(a.low), distance(a.high)), hn::Max(distance(b.low), distance(b.high)));
      hn::StoreU(rounded(d, request, hn::Zero(d), farthest), hn::Rebind<float, D>(), largest + i * lanes);
    }
  }
};

/// Writes those lanes that are asked for next to each other, and anything after them.
HWY_INLINE void store_chosen(hn::Vec<Vertex_lanes> numbers, hn::Mask<Vertex_lanes> chosen, std::uint32_t bits,
                             std::uint32_t* to) {
  const Vertex_lanes d;
#if HWY_TARGET <= HWY_AVX3
  static_cast<void>(bits);
  hn::StoreU(hn::Compress(numbers, chosen), d, to);
#else
  // Without an instruction for it, Highway's `Compress` has GCC 12 write a table of a kilobyte each time.
  static_assert(hn::MaxLanes(Vertex_lanes()) <= 8, "what the table has");
  static_cast<void>(chosen);
  const auto lanes_of = hn::PromoteTo(d, hn::LoadU(hn::Rebind<std::uint8_t, Vertex_lanes>(), lane_lists[bits].data()));
  hn::StoreU(hn::TableLookupLanes(numbers, hn::IndicesFromVec(d, lanes_of)), d, to);
#endif
}

/// By how much more two triangles must be apart along an axis of `greatest_gap` because their corners are rounded.
///
/// Let M be the largest coordinates and r the reaches, both rounded. A corner is off by less than 1.01 x 2^-24 M along
/// each coordinate axis: reaches that a gap is told for are above 1e-9, so M is far above the smallest normal float.
/// (Of corners beyond all floats the reach is 0 or beyond what a gap is told for.) The axis of a gap, that of the
/// rounded corners, has an x of at most 8 r_y r_z, and likewise y and z. So two triangles whose gap is greater than 2
/// x 1.01 x 2^-24 x 8 (M_x r_y r_z + r_x M_y r_z + r_x r_y M_z) were apart before. Nearly twice that is allowed for.
HWY_INLINE Floats gap_lost_by_rounding(const Rounded_vector& reach, const Rounding& rounding) {
  const Float_lanes d;
  const auto in_all_lanes = [&](std::size_t axis) HWY_ATTR { return hn::Set(d, rounding.largest[axis]); };
  const Rounded_vector largest{in_all_lanes(0), in_all_lanes(1), in_all_lanes(2)};
  const auto yz = hn::Mul(reach.y, reach.z), xz = hn::Mul(reach.x, reach.z), xy = hn::Mul(reach.x, reach.y);
  return hn::Mul(hn::Set(d, 0x1p-19F), dot(largest, Rounded_vector{yz, xz, xy}));
}

/// The reach of two triangles whose corners are rounded, for `apart_along`.
///
/// With u = 2^-24 a corner is off by less than 1.01 u of the largest coordinate M, or by 2^-149 where that is below the
/// normal floats: a gap by twice that for each unit of the axis. `apart_along` allows for 36 u of the reach: an eighth
/// of M more is 4.5 u M, and 1e-30 more is 2e-36. Corners beyond what is safe may have been beyond all floats.
HWY_INLINE Rounded_vector reach_when_rounded(const Two_triangles<Float_lanes>& two, const Rounding& rounding) {
  const Float_lanes d;
  const auto longer = [&](Floats reach, float largest) HWY_ATTR {
    const bool safe = largest < Safe_range<float>::most;
    return hn::Add(reach, hn::Set(d, safe ? largest / 8 + 1e-30F : std::numeric_limits<float>::infinity()));
  };
  return {longer(two.reach.x, rounding.largest[0]), longer(two.reach.y, rounding.largest[1]),
          longer(two.reach.z, rounding.largest[2])};
}

/// Keeps some of the listed pairs in the list, given as bits from the `first`th on.
/// @param kept  number of pairs kept so far, at most `first`
/// @return the same with these
HWY_INLINE std::size_t keep_listed(std::size_t first, std::uint32_t bits, std::size_t kept, Filter_scratch& scratch) {
  for (; bits != 0; bits &= bits - 1) {
    const std::size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(bits);
    scratch.pairs_a[kept] = scratch.pairs_a[first + lane];
    scratch.pairs_b[kept] = scratch.pairs_b[first + lane];
    ++kept;
  }
  return kept;
}

/// Drops the listed pairs that normals of their rounded faces, and directions across edges within their planes, prove
/// farther apart than the margin.
/// @return how many stay in the list
HWY_INLINE std::size_t drop_apart_by_rounded_planes(const Leaf_input& a, const Leaf_input& b, const Rounding& rounding,
                                                    std::size_t count, Filter_scratch& scratch) {
  const Float_lanes d;
  if (count == 0) return 0;
  fill_up(count, scratch);
  std::size_t kept = 0;
  for (std::size_t first = 0; first < count; first += hn::Lanes(d)) {
    const Two_triangles<Float_lanes> two(load_corners(a, scratch.pairs_a + first).of,
                                         load_corners(b, scratch.pairs_b + first).of);
    const auto left =
        not_apart_by_planes(two, reach_when_rounded(two, rounding), rounding.margin, hn::FirstN(d, count - first));
    kept = keep_listed(first, mask_bits(d, left), kept, scratch);
  }
  return kept;
}

struct Sorted_pairs {
  std::size_t crossing, unclear;
};

/// Sorts out the listed pairs by their rounded corners: those proven apart are dropped, those that overlap by more than
/// rounding are written to `near`, with a guess, and the others stay in the list. With margin 0.
HWY_INLINE Sorted_pairs sort_by_rounded_corners(const Leaf_input& a, const Leaf_input& b, const Rounding& rounding,
                                                std::size_t count, Filter_scratch& scratch, Face_candidate* near) {
  static_assert(std::endian::native == std::endian::little && sizeof(Face_candidate) == 4,
                "they are written as numbers");
  const Float_lanes d;
  const Vertex_lanes numbers;
  const hn::Rebind<std::uint8_t, Float_lanes> bytes;
  Sorted_pairs sorted{0, 0};
  if (count == 0) return sorted;
  fill_up(count, scratch);
  for (std::size_t first = 0; first < count; first += hn::Lanes(d)) {
    const std::uint8_t* const places_a = scratch.pairs_a + first;
    const std::uint8_t* const places_b = scratch.pairs_b + first;
    const Two_triangles<Float_lanes> two(load_corners(a, places_a).of, load_corners(b, places_b).of);
    const auto of = determinants(two);
    const auto gap = greatest_gap(of);
    // A product of three reaches, and its last digit, are floats within this limit.
    const auto telling = hn::Add(telling_gap(two, 1e9F), gap_lost_by_rounding(two.reach, rounding));
    const auto crossing = find_crossing(of, gap);
    const auto left = hn::AndNot(hn::Gt(gap, telling), hn::FirstN(d, count - first));
    const auto deep = hn::And(left, hn::Lt(gap, hn::Neg(telling)));
    const auto crosses = hn::And(deep, hn::Lt(crossing, hn::Set(d, float{no_crossing})));

    const auto guess = hn::BitCast(numbers, hn::ConvertTo(hn::Rebind<std::int32_t, Float_lanes>(), crossing));
    const auto place_a = hn::PromoteTo(numbers, hn::LoadU(bytes, places_a));
    const auto place_b = hn::PromoteTo(numbers, hn::LoadU(bytes, places_b));
    const std::uint32_t bits = mask_bits(d, crosses);
    std::uint32_t found[most_float_lanes] = {};
    const auto codes = hn::Or(place_a, hn::Or(hn::ShiftLeft<8>(place_b), hn::ShiftLeft<16>(guess)));
    store_chosen(codes, hn::RebindMask(numbers, crosses), bits, found);
    std::memcpy(near + sorted.crossing, found, sizeof found);
    sorted.crossing += hwy::PopCount(bits);

    sorted.unclear = keep_listed(first, mask_bits(d, hn::AndNot(crosses, left)), sorted.unclear, scratch);
  }
  return sorted;
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
