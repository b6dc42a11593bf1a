// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_SLAB_CULL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_SLAB_CULL_INL_H
#undef LODESTONE_SLAB_CULL_INL_H
#else
#define LODESTONE_SLAB_CULL_INL_H
#endif

#include <hwy/highway.h>

#include <cmath>
#include <cstddef>
#include <limits>

#include "filter/face_filter_kernel.h"
#include "filter/filter_scratch.h"
#include "filter/rounded_corners-inl.h"
#include "filter/rounding-inl.h"
#include "filter/separation-inl.h"
#include "simd/compress-inl.h"
#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// The faces of a leaf that may meet another leaf are mostly a patch that is nearly flat: it lies in a thin slab across
// its normal. Where two surfaces pass through each other, few of the other leaf's faces meet that slab.

/// The normal of one of a leaf's listed faces, at its rounded corners. How far it is rounded does not matter: a slab
/// may lie across any direction.
struct Slab_normal {
  float of[3];

  HWY_INLINE Slab_normal(const Leaf_input& leaf, const Face_list& list) {
    const auto [p, q, r] = leaf.corners[list.indices[list.count / 2]];
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
};

/// At least the length of the normal.
HWY_INLINE float length_bound(const Slab_normal& normal) {
  const auto [x, y, z] = normal.of;
  const double length = std::sqrt(double{x} * x + double{y} * y + double{z} * z);
  return static_cast<float>(length) * (1 + 0x1p-20F) + Safe_range<float>::least;
}

/// How far apart projections onto a normal must be to prove the corners farther apart than the margin.
///
/// Let u = 2^-24. A rounded corner is off by 1.01 u of the largest coordinate, and its projection by less than 4 u of
/// the sum of the sizes of its terms: two projections together by less than 11 u |normal| . largest. The allowance is
/// nearly three times that, plus what is lost below the normal floats, plus the margin times the length of the normal.
/// It is infinite where a projection could be beyond all floats.
HWY_INLINE float slab_allowance(const Slab_normal& normal, const Rounding& rounding) {
  using Range = Safe_range<float>;
  float allowed = Range::least;
  bool safe = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float largest = rounding.largest[axis];
    safe &= largest < Range::most;
    allowed += std::abs(normal.of[axis]) * (0x1p-19F * largest + Range::least);
  }
  if (rounding.margin > 0) allowed += rounding.margin * length_bound(normal);
  return safe && allowed < Range::most ? allowed : std::numeric_limits<float>::infinity();
}

/// For each listed face, the interval of its corners' projections.
struct Face_intervals {
  alignas(64) float low[most_leaf_faces + most_float_lanes];
  alignas(64) float high[most_leaf_faces + most_float_lanes];
};

/// The interval of all faces' projections, in every lane.
struct Slab {
  Floats low, high;
};

/// Projects the listed faces of a leaf.
/// @param own        the direction across which the returned slab lies
/// @param other      the direction of `intervals`
/// @param intervals  set
HWY_INLINE Slab project(const Leaf_input& leaf, const Face_list& list, const Slab_normal& own, const Slab_normal& other,
                        Face_intervals& intervals) {
  const Float_lanes d;
  const Rounded_vector across = in_all_lanes(d, own.of), along = in_all_lanes(d, other.of);
  const auto infinite = hn::Set(d, std::numeric_limits<float>::infinity());
  Slab slab{infinite, hn::Neg(infinite)};
  const std::size_t count = list.count;  // hoisted: byte stores may alias it
  for (std::size_t first = 0; first < count; first += float_lanes) {
    const auto [p, q, r] = load_rounded_corners(leaf, list.indices + first).of;
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

/// Removes from a list the faces that are beyond a slab.
/// @return whether any are left
HWY_INLINE bool keep_within(const Slab& slab, float allowed, const Face_intervals& intervals, Face_list& list) {
  const Float_lanes d;
  const auto low = hn::Sub(slab.low, hn::Set(d, allowed)), high = hn::Add(slab.high, hn::Set(d, allowed));
  const std::size_t count = list.count;
  std::size_t kept = 0;
  for (std::size_t first = 0; first < count; first += float_lanes) {
    const auto below = hn::Lt(hn::Load(d, intervals.high + first), low);
    const auto above = hn::Gt(hn::Load(d, intervals.low + first), high);
    const auto within = hn::AndNot(hn::Or(below, above), hn::FirstN(d, count - first));
    kept += compress_float_lanes(mask_bits(d, within), list.indices + first, list.indices + kept);
  }
  list.count = kept;
  return kept > 0;
}

/// Repeats the last face of a list, which is not empty, to the end of the last vector.
HWY_INLINE void pad_list(Face_list& list) {
  repeat_byte(list.indices[list.count - 1], most_float_lanes, list.indices + list.count);
}

/// Whether the slabs take less time, a few hundred cycles, than comparing the boxes of all pairs.
HWY_INLINE bool slab_cull_pays(const Filter_scratch& scratch) {
  return scratch.faces_a.count * scratch.faces_b.count > 256;
}

/// Removes the listed faces of either leaf that are beyond the slab of the other leaf's.
/// @return whether both have any left
HWY_INLINE bool cull_by_slab(const Leaf_input& a, const Leaf_input& b, const Rounding& rounding,
                             Filter_scratch& scratch) {
  pad_list(scratch.faces_a);
  pad_list(scratch.faces_b);
  const Slab_normal normal_a(a, scratch.faces_a), normal_b(b, scratch.faces_b);
  Face_intervals intervals_a, intervals_b;
  const Slab slab_a = project(a, scratch.faces_a, normal_a, normal_b, intervals_a);
  const Slab slab_b = project(b, scratch.faces_b, normal_b, normal_a, intervals_b);
  return keep_within(slab_b, slab_allowance(normal_b, rounding), intervals_a, scratch.faces_a) &&
         keep_within(slab_a, slab_allowance(normal_a, rounding), intervals_b, scratch.faces_b);
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
