// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_LEAF_BOX_CULL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_LEAF_BOX_CULL_INL_H
#undef LODESTONE_LEAF_BOX_CULL_INL_H
#else
#define LODESTONE_LEAF_BOX_CULL_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "filter/box_lanes-inl.h"
#include "filter/face_columns-inl.h"
#include "filter/face_filter_kernel.h"
#include "filter/filter_scratch.h"
#include "simd/compress-inl.h"
#include "simd/lane_lists.h"
#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The least or the greatest side of all lanes, in every lane. Highway's `MinOfLanes` takes twice the instructions.
template <bool least>
HWY_INLINE Sides extreme_of_lanes(Sides sides) {
#if HWY_TARGET == HWY_SCALAR
  return sides;
#else
  // Folds halves onto each other; one instruction finds the least of eight unsigned numbers.
  const auto of_lanes = [](const auto& again, auto d, auto numbers) HWY_ATTR {
    if constexpr (hn::MaxLanes(d) <= 8) {
      const hn::RebindToUnsigned<decltype(d)> ordered;
      constexpr std::uint16_t flip = least ? 0x8000 : 0x7fff;
      const auto flipped = hn::Xor(hn::BitCast(ordered, numbers), hn::Set(ordered, flip));
      return static_cast<std::int16_t>(hn::GetLane(hn::MinOfLanes(ordered, flipped)) ^ flip);
    } else {
      const hn::Half<decltype(d)> half;
      const auto low = hn::LowerHalf(half, numbers), high = hn::UpperHalf(half, numbers);
      return again(again, half, least ? hn::Min(low, high) : hn::Max(low, high));
    }
  };
  const Side_lanes d;
  return hn::Set(d, of_lanes(of_lanes, d, sides));
#endif
}

/// A box that grows around others, lane by lane.
class Growing_box {
 public:
  HWY_INLINE Growing_box()
      : low_x_(padding_low()),
        low_y_(padding_low()),
        low_z_(padding_low()),
        high_x_(padding_high()),
        high_y_(padding_high()),
        high_z_(padding_high()) {}

  HWY_INLINE void add(const Box_columns& columns, std::size_t start, hn::Mask<Side_lanes> chosen) {
    add_low(low_x_, columns.low[0] + start, chosen);
    add_low(low_y_, columns.low[1] + start, chosen);
    add_low(low_z_, columns.low[2] + start, chosen);
    add_high(high_x_, columns.high[0] + start, chosen);
    add_high(high_y_, columns.high[1] + start, chosen);
    add_high(high_z_, columns.high[2] + start, chosen);
  }
  /// Around the boxes of all lanes; undefined if none was added.
  HWY_INLINE Lane_box all() const {
    return {{extreme_of_lanes<true>(low_x_), extreme_of_lanes<true>(low_y_), extreme_of_lanes<true>(low_z_)},
            {extreme_of_lanes<false>(high_x_), extreme_of_lanes<false>(high_y_), extreme_of_lanes<false>(high_z_)}};
  }

 private:
  static HWY_INLINE void add_low(Sides& low, const std::int16_t* sides, hn::Mask<Side_lanes> chosen) {
    low = hn::Min(low, hn::IfThenElse(chosen, hn::Load(Side_lanes(), sides), padding_low()));
  }
  static HWY_INLINE void add_high(Sides& high, const std::int16_t* sides, hn::Mask<Side_lanes> chosen) {
    high = hn::Max(high, hn::IfThenElse(chosen, hn::Load(Side_lanes(), sides), padding_high()));
  }

  Sides low_x_, low_y_, low_z_;
  Sides high_x_, high_y_, high_z_;
};

/// Bounds the faces whose boxes overlap a box.
/// @param around  set to a box around them, if there are any
/// @return whether there are any
HWY_INLINE bool bound_overlapping(const Box_columns& faces, const Lane_box& box, Lane_box& around) {
  const Side_lanes d;
  Growing_box growing;
  auto any = hn::FirstN(d, 0);
  for (std::size_t start = 0; start < faces.count; start += side_lanes) {
    const auto found = overlapping(box, faces, start);
    growing.add(faces, start, found);
    any = hn::Or(any, found);
  }
  if (hn::AllFalse(d, any)) return false;
  around = growing.all();
  return true;
}

/// Lists the faces whose boxes overlap a box.
/// @param visit  is called with the start and the mask of each vector of them
/// @return whether there are any
template <class Visit>
HWY_INLINE bool list_overlapping(const Box_columns& faces, const Lane_box& box, Face_list& list, Visit visit) {
  const Side_lanes d;
  std::size_t count = 0;
  for (std::size_t start = 0; start < faces.count; start += side_lanes) {
    const auto found = overlapping(box, faces, start);
    visit(start, found);
    count += compress_side_lanes(mask_bits(d, found), every_index.data() + start, list.indices + count);
  }
  list.count = count;
  return count > 0;
}
HWY_INLINE bool list_overlapping(const Box_columns& faces, const Lane_box& box, Face_list& list) {
  return list_overlapping(faces, box, list, [](std::size_t, hn::Mask<Side_lanes>) HWY_ATTR {});
}
/// @param around  set to a box around them, if there are any
HWY_INLINE bool list_overlapping(const Box_columns& faces, const Lane_box& box, Face_list& list, Lane_box& around) {
  Growing_box growing;
  const auto grow = [&](std::size_t start, hn::Mask<Side_lanes> found) HWY_ATTR { growing.add(faces, start, found); };
  if (!list_overlapping(faces, box, list, grow)) return false;
  around = growing.all();
  return true;
}

/// Lists the faces of either leaf that may meet the other leaf: a's faces at b's box are bounded, b's faces at that
/// bound are listed and bounded, and a's faces at that second bound are listed.
/// @return whether there are any
HWY_INLINE bool cull_by_leaf_box(const Leaf_input& a, const Leaf_input& b, const Filter_request& request,
                                 Filter_scratch& scratch) {
  Lane_box around_a, around_b;
  if (!bound_overlapping(*a.faces, leaf_box(b, request), around_a)) return false;
  round_corners(b, request);
  return list_overlapping(*b.faces, around_a, scratch.faces_b, around_b) &&
         list_overlapping(*a.faces, around_b, scratch.faces_a);
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
