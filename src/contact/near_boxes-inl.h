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
HWY_INLINE void end_columns(Face_columns& faces, std::size_t count) {
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

HWY_INLINE Limits limits(const Face_columns& faces, std::size_t face) {
  const Box_lanes d;
  const auto side = [&](const Face_columns::Sides& column) HWY_ATTR { return hn::Set(d, column[face]); };
  return {{side(faces.low[0]), side(faces.low[1]), side(faces.low[2])},
          {side(faces.high[0]), side(faces.high[1]), side(faces.high[2])}};
}

/// The lanes in which a face, from the `start`th on, has a box within the margin of another box.
HWY_INLINE hn::Mask<Box_lanes> near_boxes(const Limits& box, const Face_columns& faces, std::size_t start) {
  const Box_lanes d;
  const auto gap_along = [&](std::size_t axis) HWY_ATTR {
    return hn::Max(hn::SaturatedSub(box.low[axis], hn::LoadU(d, faces.high[axis] + start)),
                   hn::SaturatedSub(hn::LoadU(d, faces.low[axis] + start), box.high[axis]));
  };
  return hn::Lt(hn::Max(hn::Max(gap_along(0), gap_along(1)), gap_along(2)), hn::Set(d, 1));
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

  HWY_INLINE void add(const Face_columns& faces, std::size_t start, hn::Mask<Box_lanes> chosen) {
    const Box_lanes d;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto low = hn::Load(d, faces.low[axis] + start), high = hn::Load(d, faces.high[axis] + start);
      around_.low[axis] = hn::Min(around_.low[axis], hn::IfThenElse(chosen, low, highest()));
      around_.high[axis] = hn::Max(around_.high[axis], hn::IfThenElse(chosen, high, lowest()));
    }
  }
  /// Around all lanes; means nothing if there was no box.
  HWY_INLINE Limits all() const {
    const Box_lanes d;
    Limits limits;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      limits.low[axis] = hn::MinOfLanes(d, around_.low[axis]);
      limits.high[axis] = hn::MaxOfLanes(d, around_.high[axis]);
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
/// @param blocks  lists the first faces of the vectors in which there are any
HWY_INLINE bool any_near(const Face_columns& faces, const Limits& box, Limits& around, Face_list& blocks) {
  const Box_lanes d;
  Growing_box growing;
  std::size_t count = 0;
  for (std::size_t start = 0; start < faces.count; start += hn::Lanes(d)) {
    const auto near = near_boxes(box, faces, start);
    growing.add(faces, start, near);
    blocks.places[count] = static_cast<std::uint8_t>(start);
    count += hn::AllFalse(d, near) ? 0 : 1;
  }
  blocks.count = count;
  if (count == 0) return false;
  around = growing.all();
  return true;
}

/// Lists the faces whose boxes are within the margin of a box.
/// @return whether there are any
HWY_INLINE bool list_near(const Face_columns& faces, const Limits& box, Face_list& list) {
  const Box_lanes d;
  std::size_t count = 0;
  for (std::size_t start = 0; start < faces.count; start += hn::Lanes(d))
    count += list_lanes(mask_bits(d, near_boxes(box, faces, start)), start, list.places + count);
  list.count = count;
  return count > 0;
}

/// Bits of those faces of b, from the `start`th on, that have a vertex of a's face.
HWY_INLINE std::uint32_t share_a_vertex(const Face_columns& a, std::size_t face, const Face_columns& b,
                                        std::size_t start) {
  const Vertex_lanes d;
  const auto p = hn::Set(d, a.vertices[0][face]), q = hn::Set(d, a.vertices[1][face]);
  const auto r = hn::Set(d, a.vertices[2][face]);
  const auto shares = [&](std::size_t corner) HWY_ATTR {
    const auto vertex = hn::LoadU(d, b.vertices[corner] + start);
    return hn::Or(hn::Or(hn::Eq(p, vertex), hn::Eq(q, vertex)), hn::Eq(r, vertex));
  };
  return mask_bits(d, hn::Or(hn::Or(shares(0), shares(1)), shares(2)));
}

/// Leaves out those of some faces of b, given as bits from the `start`th on, that have a vertex of a's face.
HWY_INLINE std::uint32_t leave_out_neighbours(std::uint32_t bits, const Face_columns& a, std::size_t face,
                                              const Face_columns& b, std::size_t start) {
  constexpr std::size_t step = hn::MaxLanes(Vertex_lanes());
  constexpr std::uint32_t block = (1U << step) - 1;
  for (std::size_t first = 0; first < hn::MaxLanes(Box_lanes()); first += step)
    if ((bits >> first & block) != 0) bits &= ~(share_a_vertex(a, face, b, start + first) << first);
  return bits;
}

/// Adds the row of b's boxes, a vector of them from the `start`th on, that one of a's is near, if there are any.
/// @tparam one_mesh  leave out faces that share a vertex
/// @param rows       listed so far
/// @return their number with this one
template <bool one_mesh>
HWY_INLINE std::size_t add_row(const Limits& box, const Face_columns& a, std::size_t face, const Face_columns& b,
                               std::size_t start, std::size_t rows, Near_row* list) {
  std::uint32_t bits = mask_bits(Box_lanes(), near_boxes(box, b, start));
  if constexpr (one_mesh) bits = leave_out_neighbours(bits, a, face, b, start);
  // It is written over unless it counts: no branch could foretell which do.
  list[rows] = {bits, static_cast<std::uint32_t>(face + 256 * start)};
  return rows + (bits != 0 ? 1 : 0);
}

/// Lists the pairs of which rows consist.
/// @return their number
HWY_INLINE std::size_t list_pairs_of_rows(std::size_t rows, Leaf_scratch& scratch) {
  std::size_t count = 0;
  for (std::size_t r = 0; r < rows; ++r) {
    const Near_row row = scratch.rows[r];
    repeat_byte(row.places % 256, hn::MaxLanes(Box_lanes()), scratch.pairs_a + count);
    count += list_lanes(row.bits, row.places / 256, scratch.pairs_b + count);
  }
  return count;
}

/// Lists the pairs of different faces of a leaf whose boxes are near, and that share no vertex.
/// @return their number
HWY_INLINE std::size_t list_pairs_within(const Face_columns& faces, Leaf_scratch& scratch) {
  std::size_t rows = 0;
  for (std::size_t f = 0; f < faces.count; ++f)
    for (std::size_t start = f + 1; start < faces.count; start += hn::MaxLanes(Box_lanes()))
      rows = add_row<true>(limits(faces, f), faces, f, faces, start, rows, scratch.rows);
  return list_pairs_of_rows(rows, scratch);
}

/// Lists the pairs of one of a's listed faces and one of b's whose boxes are near.
/// @return their number
template <bool one_mesh>
HWY_INLINE std::size_t list_pairs(const Face_columns& a, const Face_columns& b, Leaf_scratch& scratch) {
  // Bytes are written, which could be those of this number.
  const std::size_t blocks = scratch.blocks_b.count;
  std::size_t rows = 0;
  for (std::size_t i = 0; i < scratch.near_a.count; ++i) {
    const std::size_t face = scratch.near_a.places[i];
    const Limits box = limits(a, face);
    for (std::size_t block = 0; block < blocks; ++block)
      rows = add_row<one_mesh>(box, a, face, b, scratch.blocks_b.places[block], rows, scratch.rows);
  }
  return list_pairs_of_rows(rows, scratch);
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
