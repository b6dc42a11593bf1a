// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_NEAR_SLABS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_NEAR_SLABS_INL_H
#undef LODESTONE_NEAR_SLABS_INL_H
#else
#define LODESTONE_NEAR_SLABS_INL_H
#endif

#include <hwy/highway.h>

#include <cmath>
#include <cstddef>
#include <limits>

#include "filter/face_filter_kernel.h"
#include "filter/filter_scratch.h"
#include "filter/near_box_pairs-inl.h"
#include "filter/near_boxes-inl.h"
#include "filter/rounded_separation-inl.h"
#include "filter/separation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// The near faces of a leaf are a patch that mostly is nearly flat: it lies within a thin slab across its normal. Where
// two surfaces pass through each other, few of the other leaf's near faces meet that slab.

/// The normal of one of the near faces, at its rounded corners. Whatever it is, it is a direction.
struct Slab_normal {
  float of[3];

  HWY_INLINE Slab_normal(const Leaf_input& leaf, const Face_list& near) {
    const auto [p, q, r] = leaf.corners[near.places[near.count / 2]];
    float u[3], v[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& column = leaf.faces->positions[axis];
      u[axis] = column[q] - column[p];
      v[axis] = column[r] - column[p];
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
      of[axis] = u[next] * v[last] - u[last] * v[next];
    }
  }

  HWY_INLINE Rounded_vector in_all_lanes() const {
    const Float_lanes d;
    return {hn::Set(d, of[0]), hn::Set(d, of[1]), hn::Set(d, of[2])};
  }
};

/// How far apart projections onto a normal must be to prove corners farther apart than the margin.
///
/// With u = 2^-24, a rounded corner is off by 1.01 u of the largest coordinate, and its projection by less than 4 u of
/// the sum of the sizes of its terms: two projections together by less than 11 u |normal| . largest. Nearly thrice that
/// is allowed for, and what is lost below the normal floats. Infinite where a projection could be beyond all floats.
HWY_INLINE float slab_allowance(const Slab_normal& normal, const Rounding& rounding) {
  using Range = Safe_range<float>;
  float allowed = Range::least;
  bool safe = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float largest = rounding.largest[axis];
    safe &= largest < Range::most;
    allowed += std::abs(normal.of[axis]) * (0x1p-19F * largest + rounding.margin + Range::least);
  }
  return safe && allowed < Range::most ? allowed : std::numeric_limits<float>::infinity();
}

/// Between which projections the corners of each of some faces are.
struct Face_intervals {
  alignas(64) float low[most_leaf_faces + most_float_lanes];
  alignas(64) float high[most_leaf_faces + most_float_lanes];
};

/// Between which projections all of them are, in every lane.
struct Slab {
  Floats low, high;
};

/// Projects the near faces of a leaf.
/// @param own    the slab lies across this
/// @param other  intervals of faces are along this
HWY_INLINE Slab project(const Leaf_input& leaf, const Face_list& near, const Slab_normal& own, const Slab_normal& other,
                        Face_intervals& intervals) {
  const Float_lanes d;
  const Rounded_vector across = own.in_all_lanes(), along = other.in_all_lanes();
  const auto infinite = hn::Set(d, std::numeric_limits<float>::infinity());
  Slab slab{infinite, hn::Neg(infinite)};
  // Bytes have been written, which could be those of this number.
  const std::size_t count = near.count;
  for (std::size_t first = 0; first < count; first += hn::Lanes(d)) {
    const auto [p, q, r] = load_corners(leaf, near.places + first).of;
    const auto real = hn::FirstN(d, count - first);
    const auto p_across = dot(across, p), q_across = dot(across, q), r_across = dot(across, r);
    slab.low = hn::Min(slab.low, hn::IfThenElse(real, hn::Min(hn::Min(p_across, q_across), r_across), infinite));
    slab.high =
        hn::Max(slab.high, hn::IfThenElse(real, hn::Max(hn::Max(p_across, q_across), r_across), hn::Neg(infinite)));
    const auto p_along = dot(along, p), q_along = dot(along, q), r_along = dot(along, r);
    hn::Store(hn::Min(hn::Min(p_along, q_along), r_along), d, intervals.low + first);
    hn::Store(hn::Max(hn::Max(p_along, q_along), r_along), d, intervals.high + first);
  }
  return {hn::MinOfLanes(d, slab.low), hn::MaxOfLanes(d, slab.high)};
}

/// Leaves out the near faces that are beyond a slab.
/// @return whether there are any left
HWY_INLINE bool keep_within(const Slab& slab, float allowed, const Face_intervals& intervals, Face_list& near) {
  const Float_lanes d;
  const auto low = hn::Sub(slab.low, hn::Set(d, allowed)), high = hn::Add(slab.high, hn::Set(d, allowed));
  const std::size_t count = near.count;
  std::size_t kept = 0;
  for (std::size_t first = 0; first < count; first += hn::Lanes(d)) {
    const auto below = hn::Lt(hn::Load(d, intervals.high + first), low);
    const auto above = hn::Gt(hn::Load(d, intervals.low + first), high);
    const auto within = hn::AndNot(hn::Or(below, above), hn::FirstN(d, count - first));
    kept += list_places_of_floats(mask_bits(d, within), near.places + first, near.places + kept);
  }
  near.count = kept;
  return kept > 0;
}

/// Leaves out the near faces of either leaf that are beyond the slab of the other's.
/// @return whether there are any left of both
HWY_INLINE bool keep_within_slabs(const Leaf_input& a, const Leaf_input& b, const Rounding& rounding,
                                  Filter_scratch& scratch) {
  fill_up(scratch.near_a);
  fill_up(scratch.near_b);
  const Slab_normal normal_a(a, scratch.near_a), normal_b(b, scratch.near_b);
  Face_intervals intervals_a, intervals_b;
  const Slab slab_a = project(a, scratch.near_a, normal_a, normal_b, intervals_a);
  const Slab slab_b = project(b, scratch.near_b, normal_b, normal_a, intervals_b);
  return keep_within(slab_b, slab_allowance(normal_b, rounding), intervals_a, scratch.near_a) &&
         keep_within(slab_a, slab_allowance(normal_a, rounding), intervals_b, scratch.near_b);
}

/// Whether leaving out faces takes less time than comparing the boxes of all: some hundred cycles.
HWY_INLINE bool slabs_pay(const Filter_scratch& scratch) { return scratch.near_a.count * scratch.near_b.count > 256; }

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
