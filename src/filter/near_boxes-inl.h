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

#include "filter/filter_scratch.h"
#include "simd/lane_lists.h"
#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Lists which of eight bits are set. Eight bytes are written, whatever their number: no branch could foretell it.
/// @return number of bits
HWY_INLINE std::size_t list_eight(std::uint32_t bits, std::uint8_t* list) {
  std::memcpy(list, lane_lists[bits].data(), 8);
  return hwy::PopCount(bits);
}

/// Lists the places whose bits are set, of as many as a vector has floats. So many bytes are written: the list may
/// begin where the places do, or before.
/// @return number of bits
#if HWY_TARGET <= HWY_AVX3
HWY_INLINE std::size_t list_places_of_floats(std::uint32_t bits, const std::uint8_t* places, std::uint8_t* list) {
  const Vertex_lanes d;
  const hn::Rebind<std::uint8_t, Vertex_lanes> bytes;
  const std::uint8_t bits_as_bytes[8] = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8)};
  const auto numbers = hn::PromoteTo(d, hn::LoadU(bytes, places));
  const auto listed = hn::Compress(numbers, hn::LoadMaskBits(d, bits_as_bytes));
  // Not `TruncateTo`: that of Highway 1.0.3 is wrong for HWY_AVX3_DL.
  hn::StoreU(hn::Vec<decltype(bytes)>{_mm512_cvtepi32_epi8(listed.raw)}, bytes, list);
  return hwy::PopCount(bits);
}
#else
HWY_INLINE std::size_t list_places_of_floats(std::uint32_t bits, const std::uint8_t* places, std::uint8_t* list) {
  constexpr std::size_t step = hn::MaxLanes(Vertex_lanes());
  static_assert(step <= 8, "what is listed at a time");
  std::uint8_t some[step], chosen[8];
  std::memcpy(some, places, step);
  const std::size_t count = list_eight(bits, chosen);
  for (std::size_t i = 0; i < step; ++i) list[i] = some[chosen[i]];
  return count;
}
#endif

/// The same for as many places as a vector has boxes.
HWY_INLINE std::size_t list_places(std::uint32_t bits, const std::uint8_t* places, std::uint8_t* list) {
  constexpr std::size_t step = hn::MaxLanes(Vertex_lanes());
  constexpr std::uint32_t block = (1U << step) - 1;
  std::size_t count = 0;
  for (std::size_t first = 0; first < hn::MaxLanes(Box_lanes()); first += step)
    count += list_places_of_floats(bits >> first & block, places + first, list + count);
  return count;
}

HWY_INLINE void repeat_byte(std::size_t byte, std::size_t count, std::uint8_t* list) {
  const std::uint64_t bytes = byte * 0x0101010101010101;
  for (std::size_t eight = 0; eight < count; eight += 8) std::memcpy(list + eight, &bytes, 8);
}

/// Fills up the last vector of the listed pairs with the last pair.
HWY_INLINE void fill_up(std::size_t count, Filter_scratch& scratch) {
  repeat_byte(scratch.pairs_a[count - 1], most_float_lanes, scratch.pairs_a + count);
  repeat_byte(scratch.pairs_b[count - 1], most_float_lanes, scratch.pairs_b + count);
}

/// The same for a list of faces, which is not empty.
HWY_INLINE void fill_up(Face_list& list) {
  repeat_byte(list.places[list.count - 1], most_float_lanes, list.places + list.count);
}

/// Sides of boxes that meet nothing.
HWY_INLINE Sides highest() { return hn::Set(Box_lanes(), std::numeric_limits<std::int16_t>::max()); }
HWY_INLINE Sides lowest() { return hn::Set(Box_lanes(), std::numeric_limits<std::int16_t>::min()); }

/// Gives the lanes past the last face boxes that meet nothing.
HWY_INLINE void end_columns(Box_columns& faces, std::size_t count) {
  const Box_lanes d;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    hn::StoreU(highest(), d, faces.low[axis] + count);
    hn::StoreU(lowest(), d, faces.high[axis] + count);
  }
}

/// Stores the boxes of some faces, as many as a vector holds; there may be less than that.
HWY_INLINE void store_boxes(const Sides (&low)[3], const Sides (&high)[3], std::size_t count, Box_columns& faces,
                            std::size_t start) {
  const Box_lanes d;
  const auto real = hn::FirstN(d, count);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    hn::Store(hn::IfThenElse(real, low[axis], highest()), d, faces.low[axis] + start);
    hn::Store(hn::IfThenElse(real, high[axis], lowest()), d, faces.high[axis] + start);
  }
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
  HWY_INLINE Growing_box()
      : low_x_(highest()),
        low_y_(highest()),
        low_z_(highest()),
        high_x_(lowest()),
        high_y_(lowest()),
        high_z_(lowest()) {}

  HWY_INLINE void add(const Box_columns& faces, std::size_t start, hn::Mask<Box_lanes> chosen) {
    add_low(low_x_, faces.low[0] + start, chosen);
    add_low(low_y_, faces.low[1] + start, chosen);
    add_low(low_z_, faces.low[2] + start, chosen);
    add_high(high_x_, faces.high[0] + start, chosen);
    add_high(high_y_, faces.high[1] + start, chosen);
    add_high(high_z_, faces.high[2] + start, chosen);
  }
  /// Around all lanes; means nothing if there was no box.
  HWY_INLINE Limits all() const {
    return {{extreme_of_lanes<true>(low_x_), extreme_of_lanes<true>(low_y_), extreme_of_lanes<true>(low_z_)},
            {extreme_of_lanes<false>(high_x_), extreme_of_lanes<false>(high_y_), extreme_of_lanes<false>(high_z_)}};
  }

 private:
  static HWY_INLINE void add_low(Sides& low, const std::int16_t* sides, hn::Mask<Box_lanes> chosen) {
    low = hn::Min(low, hn::IfThenElse(chosen, hn::Load(Box_lanes(), sides), highest()));
  }
  static HWY_INLINE void add_high(Sides& high, const std::int16_t* sides, hn::Mask<Box_lanes> chosen) {
    high = hn::Max(high, hn::IfThenElse(chosen, hn::Load(Box_lanes(), sides), lowest()));
  }

  Sides low_x_, low_y_, low_z_;
  Sides high_x_, high_y_, high_z_;
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
/// @param visit  is called with the mask of each vector of them, and where it starts
/// @return whether there are any
template <class Visit>
HWY_INLINE bool list_near(const Box_columns& faces, const Limits& box, Face_list& list, Visit visit) {
  const Box_lanes d;
  std::size_t count = 0;
  for (std::size_t start = 0; start < faces.count; start += hn::Lanes(d)) {
    const auto near = near_boxes(box, faces, start);
    visit(start, near);
    count += list_places(mask_bits(d, near), every_place.data() + start, list.places + count);
  }
  list.count = count;
  return count > 0;
}
HWY_INLINE bool list_near(const Box_columns& faces, const Limits& box, Face_list& list) {
  return list_near(faces, box, list, [](std::size_t, hn::Mask<Box_lanes>) HWY_ATTR {});
}
/// @param around  is set to a box around these, if there are any
HWY_INLINE bool list_near(const Box_columns& faces, const Limits& box, Face_list& list, Limits& around) {
  Growing_box growing;
  const auto grow = [&](std::size_t start, hn::Mask<Box_lanes> near) HWY_ATTR { growing.add(faces, start, near); };
  if (!list_near(faces, box, list, grow)) return false;
  around = growing.all();
  return true;
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
