// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_BOX_AXES_CULL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_BOX_AXES_CULL_INL_H
#undef LODESTONE_BOX_AXES_CULL_INL_H
#else
#define LODESTONE_BOX_AXES_CULL_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <limits>

#include "filter/box_lanes-inl.h"
#include "filter/face_filter_kernel.h"
#include "filter/filter_scratch.h"
#include "filter/rounded_corners-inl.h"
#include "filter/rounding-inl.h"
#include "filter/separation-inl.h"
#include "filter/slab_cull-inl.h"
#include "simd/compress-inl.h"
#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// The box of a long oblique face overlaps those of faces that it passes by. So such a face is compared with the box
// around the other leaf's faces, along the directions that can part a triangle and a box: the normal of the face, and
// the cross products of its edges and the coordinate axes. (The axes themselves are those of the boxes.)

/// Whether the boxes of so many pairs seem to overlap that it pays to look at the faces, judging by one of a's.
HWY_INLINE bool box_axes_cull_pays(const Leaf_input& a, const Leaf_input& b, const Filter_scratch& scratch) {
  const std::size_t count_a = scratch.faces_a.count, count_b = scratch.faces_b.count;
  if (count_a * count_b <= 8 * (count_a + count_b)) return false;
  const Lane_box box = lane_box(*a.faces, scratch.faces_a.indices[count_a / 2]);
  std::size_t met = 0;
  for (std::size_t start = 0; start < b.faces->count; start += side_lanes)
    met += hn::CountTrue(Side_lanes(), overlapping(box, *b.faces, start));
  return met * count_a > 8 * (count_a + count_b);
}

/// The same box in every lane.
struct Box_of_corners {
  Rounded_vector low, high;
};

/// Around the rounded corners of the listed faces.
/// @param list  padded, not empty
HWY_INLINE Box_of_corners box_of_corners(const Leaf_input& leaf, const Face_list& list) {
  const Float_lanes d;
  const auto infinite = hn::Set(d, std::numeric_limits<float>::infinity()), minus = hn::Neg(infinite);
  Box_of_corners box{{infinite, infinite, infinite}, {minus, minus, minus}};
  for (std::size_t first = 0; first < list.count; first += float_lanes)
    for (const auto& [x, y, z] : load_rounded_corners(leaf, list.indices + first).of) {
      box.low = {hn::Min(box.low.x, x), hn::Min(box.low.y, y), hn::Min(box.low.z, z)};
      box.high = {hn::Max(box.high.x, x), hn::Max(box.high.y, y), hn::Max(box.high.z, z)};
    }
  const auto least = [d](Floats of) HWY_ATTR { return hn::MinOfLanes(d, of); };
  const auto most = [d](Floats of) HWY_ATTR { return hn::MaxOfLanes(d, of); };
  return {{least(box.low.x), least(box.low.y), least(box.low.z)},
          {most(box.high.x), most(box.high.y), most(box.high.z)}};
}

/// What an axis must leave free, per component: the allowance of `slab_allowance`, and the margin. The sum of an axis's
/// components is at least its length.
HWY_INLINE Rounded_vector axis_allowance(const Rounding& rounding) {
  float allowed[3];
  for (std::size_t axis = 0; axis < 3; ++axis)
    allowed[axis] = 0x1p-19F * rounding.largest[axis] + Safe_range<float>::least + rounding.margin;
  return in_all_lanes(Float_lanes(), allowed);
}

/// Whether the projections onto an axis, which may be any, prove a face and a box farther apart than the margin. The
/// corners of the box are rounded corners, so what `slab_allowance` says holds for it too. Products that overflow are
/// more than what the axis must leave free may be.
HWY_INLINE hn::Mask<Float_lanes> apart_along(const Rounded_corners& face, const Box_of_corners& box,
                                             const Rounded_vector& allowance, const Rounded_vector& axis) {
  const Float_lanes d;
  const auto p = dot(axis, face.of[0]), q = dot(axis, face.of[1]), r = dot(axis, face.of[2]);
  const Rounded_vector low{hn::Mul(axis.x, box.low.x), hn::Mul(axis.y, box.low.y), hn::Mul(axis.z, box.low.z)};
  const Rounded_vector high{hn::Mul(axis.x, box.high.x), hn::Mul(axis.y, box.high.y), hn::Mul(axis.z, box.high.z)};
  const auto least = hn::Add(hn::Add(hn::Min(low.x, high.x), hn::Min(low.y, high.y)), hn::Min(low.z, high.z));
  const auto most = hn::Add(hn::Add(hn::Max(low.x, high.x), hn::Max(low.y, high.y)), hn::Max(low.z, high.z));
  const auto needed = hn::Add(dot(absolute(axis), allowance), hn::Set(d, Safe_range<float>::least));
  const auto gap = hn::Max(hn::Sub(hn::Min(hn::Min(p, q), r), most), hn::Sub(least, hn::Max(hn::Max(p, q), r)));
  return hn::And(hn::Gt(gap, needed), hn::Lt(needed, hn::Set(d, Safe_range<float>::most)));
}

/// Whether any of the directions proves a face and a box farther apart than the margin.
HWY_INLINE hn::Mask<Float_lanes> apart(const Rounded_corners& face, const Box_of_corners& box,
                                       const Rounded_vector& allowance) {
  const auto zero = hn::Zero(Float_lanes());
  const auto& [p, q, r] = face.of;
  const Rounded_vector edges[]{q - p, r - q, p - r};
  auto found = apart_along(face, box, allowance, cross(edges[0], edges[1]));
  for (const auto& [x, y, z] : edges) {
    found = hn::Or(found, apart_along(face, box, allowance, {zero, z, hn::Neg(y)}));
    found = hn::Or(found, apart_along(face, box, allowance, {hn::Neg(z), zero, x}));
    found = hn::Or(found, apart_along(face, box, allowance, {y, hn::Neg(x), zero}));
  }
  return found;
}

/// Removes from a list, which is padded, the faces that are apart from a box.
/// @return whether any are left
HWY_INLINE bool keep_faces_at(const Box_of_corners& box, const Rounded_vector& allowance, const Leaf_input& leaf,
                              Face_list& list) {
  const Float_lanes d;
  const std::size_t count = list.count;
  std::size_t kept = 0;
  for (std::size_t first = 0; first < count; first += float_lanes) {
    const auto away = apart(load_rounded_corners(leaf, list.indices + first), box, allowance);
    const auto near = hn::AndNot(away, hn::FirstN(d, count - first));
    kept += compress_float_lanes(mask_bits(d, near), list.indices + first, list.indices + kept);
  }
  list.count = kept;
  return kept > 0;
}

/// Removes the listed faces of either leaf that are apart from the box around the other leaf's.
/// @return whether both have any left
HWY_INLINE bool cull_by_box_axes(const Leaf_input& a, const Leaf_input& b, const Rounding& rounding,
                                 Filter_scratch& scratch) {
  const Rounded_vector allowance = axis_allowance(rounding);
  pad_list(scratch.faces_a);
  pad_list(scratch.faces_b);
  if (!keep_faces_at(box_of_corners(b, scratch.faces_b), allowance, a, scratch.faces_a)) return false;
  pad_list(scratch.faces_a);
  return keep_faces_at(box_of_corners(a, scratch.faces_a), allowance, b, scratch.faces_b);
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
