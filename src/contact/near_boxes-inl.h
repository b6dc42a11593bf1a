// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_NEAR_BOXES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_NEAR_BOXES_INL_H
#undef LODESTONE_NEAR_BOXES_INL_H
#else
#define LODESTONE_NEAR_BOXES_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include "contact/lane_lists.h"
#include "contact/leaf_scratch.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// One side of as many boxes as a vector holds, in steps.
using Box_lanes = hn::CappedTag<std::int16_t, most_box_lanes>;
using Sides = hn::Vec<Box_lanes>;
/// As many vertices as a vector has floats.
using Vertex_lanes = hn::CappedTag<std::uint32_t, most_float_lanes>;

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

/// Lists which of eight bits are set, counted from `first`. Eight bytes are written, whatever their number: no branch
/// could foretell it.
/// @return number of bits
HWY_INLINE std::size_t list_eight(std::uint32_t bits, std::size_t first, std::uint8_t* list) {
  std::uint64_t numbers;
  std::memcpy(&numbers, lane_lists[bits].data(), 8);
  numbers += first * 0x0101010101010101;
  std::memcpy(list, &numbers, 8);
  return hwy::PopCount(bits);
}

/// The same for as many bits as a vector has boxes.
HWY_INLINE std::size_t list_lanes(std::uint32_t bits, std::size_t first, std::uint8_t* list) {
  std::size_t count = 0;
  for (std::size_t eight = 0; eight < hn::MaxLanes(Box_lanes()); eight += 8)
    count += list_eight(bits >> eight & 0xff, first + eight, list + count);
  return count;
}

HWY_INLINE void repeat_byte(std::size_t byte, std::size_t count, std::uint8_t* list) {
  const std::uint64_t bytes = byte * 0x0101010101010101;
  for (std::size_t eight = 0; eight < count; eight += 8) std::memcpy(list + eight, &bytes, 8);
}

/// Fills up the last vector of the listed pairs with the last pair.
HWY_INLINE void fill_up(std::size_t count, Leaf_scratch& scratch) {
  repeat_byte(scratch.pairs_a[count - 1], most_float_lanes, scratch.pairs_a + count);
  repeat_byte(scratch.pairs_b[count - 1], most_float_lanes, scratch.pairs_b + count);
}

/// Gives the lanes past the last face boxes that meet nothing.
HWY_INLINE void end_columns(Box_columns& faces, std::size_t count) {
  const Box_lanes d;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    hn::StoreU(hn::Set(d, std::numeric_limits<std::int16_t>::max()), d, faces.low[axis] + count);
    hn::StoreU(hn::Set(d, std::numeric_limits<std::int16_t>::min()), d, faces.high[axis] + count);
  }
  faces.count = count;
}

/// A box in every lane, its high side moved out by the margin.
struct Limits {
  Sides low[3], high[3];
};

HWY_INLINE Limits limits(const Box_columns& faces, std::size_t face) {
  const Box_lanes d;
  const auto side = [&](const Box_columns::Sides& column) HWY_ATTR { return hn::Set(d, column[face]); };
  return {{side(faces.low[0]), side(faces.low[1]), side(faces.low[2])},
          {side(faces.high[0]), side(faces.high[1]), side(faces.high[2])}};
}

/// The lanes in which a face, from the `start`th on, has a box within the margin of another box.
HWY_INLINE hn::Mask<Box_lanes> near_boxes(const Limits& box, const Box_columns& faces, std::size_t start) {
  const Box_lanes d;
  const auto gap_along = [&](std::size_t axis) HWY_ATTR {
    return hn::Max(hn::SaturatedSub(box.low[axis], hn::LoadU(d, faces.high[axis] + start)),
                   hn::SaturatedSub(hn::LoadU(d, faces.low[axis] + start), box.high[axis]));
  };
  return hn::Lt(hn::Max(hn::Max(gap_along(0), gap_along(1)), gap_along(2)), hn::Set(d, 1));
}

/// The least or greatest number of the lanes, in every lane. Highway's own function for it takes twice the
/// instructions.
template <bool least>
HWY_INLINE Sides extreme_of_lanes(Sides sides) {
#if HWY_TARGET == HWY_SCALAR
  return sides;
#else
  // Halves are folded onto each other; of eight numbers without a sign one instruction finds the least.
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
  const Box_lanes d;
  return hn::Set(d, of_lanes(of_lanes, d, sides));
#endif
}

/// A box that grows around others, lane by lane.
class Growing_box {
 public:
  Growing_box() {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      around_.low[axis] = highest();
      around_.high[axis] = lowest();
    }
  }

  HWY_INLINE void add(const Box_columns& faces, std::size_t start, hn::Mask<Box_lanes> chosen) {
    const Box_lanes d;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto low = hn::Load(d, faces.low[axis] + start), high = hn::Load(d, faces.high[axis] + start);
      around_.low[axis] = hn::Min(around_.low[axis], hn::IfThenElse(chosen, low, highest()));
      around_.high[axis] = hn::Max(around_.high[axis], hn::IfThenElse(chosen, high, lowest()));
    }
  }
  /// Around all lanes; means nothing if there was no box.
  HWY_INLINE Limits all() const {
    Limits limits;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      limits.low[axis] = extreme_of_lanes<true>(around_.low[axis]);
      limits.high[axis] = extreme_of_lanes<false>(around_.high[axis]);
    }
    return limits;
  }

 private:
  static HWY_INLINE Sides highest() { return hn::Set(Box_lanes(), std::numeric_limits<std::int16_t>::max()); }
  static HWY_INLINE Sides lowest() { return hn::Set(Box_lanes(), std::numeric_limits<std::int16_t>::min()); }

  Limits around_;
};

/// Whether boxes of faces are within the margin of a box.
/// @param around  is set to a box around these, if there are any
HWY_INLINE bool any_near(const Box_columns& faces, const Limits& box, Limits& around) {
  const Box_lanes d;
  Growing_box growing;
  auto any = hn::FirstN(d, 0);
  for (std::size_t start = 0; start < faces.count; start += hn::Lanes(d)) {
    const auto near = near_boxes(box, faces, start);
    growing.add(faces, start, near);
    any = hn::Or(any, near);
  }
  if (hn::AllFalse(d, any)) return false;
  around = growing.all();
  return true;
}

/// Lists the faces whose boxes are within the margin of a box.
/// @return whether there are any
HWY_INLINE bool list_near(const Box_columns& faces, const Limits& box, Face_list& list) {
  const Box_lanes d;
  std::size_t count = 0;
  for (std::size_t start = 0; start < faces.count; start += hn::Lanes(d))
    count += list_lanes(mask_bits(d, near_boxes(box, faces, start)), start, list.places + count);
  list.count = count;
  return count > 0;
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
