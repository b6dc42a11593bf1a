// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_NEAR_BOXES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_NEAR_BOXES_INL_H
#undef LODESTONE_NEAR_BOXES_INL_H
#else
#define LODESTONE_NEAR_BOXES_INL_H
#endif

#include <hwy/highway.h>

#include <cstring>
#include <limits>

#include "contact/lane_lists.h"
#include "contact/leaf_scratch.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// One side of as many boxes as a vector holds.
using Box_lanes = hn::CappedTag<float, most_box_lanes>;
using Sides = hn::Vec<Box_lanes>;
using Near = hn::Mask<Box_lanes>;

template <class Tag>
HWY_INLINE unsigned mask_bits(Tag d, hn::Mask<Tag> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  std::uint32_t bits;
  std::memcpy(&bits, bytes, 4);
  return bits;
}

/// Lists which of eight bits are set, counted from `first`. Eight bytes are written, whatever their number: no branch
/// could foretell it.
/// @return number of bits
HWY_INLINE std::size_t list_eight(unsigned bits, std::size_t first, std::uint8_t* list) {
  std::uint64_t numbers;
  std::memcpy(&numbers, lane_lists[bits].data(), 8);
  numbers += first * 0x0101010101010101;
  std::memcpy(list, &numbers, 8);
  return hwy::PopCount(bits);
}

/// The same for as many bits as a vector has boxes.
HWY_INLINE std::size_t list_lanes(unsigned bits, std::size_t first, std::uint8_t* list) {
  std::size_t count = list_eight(bits & 0xff, first, list);
  if constexpr (hn::MaxLanes(Box_lanes()) > 8) count += list_eight(bits >> 8U, first + 8, list + count);
  return count;
}

HWY_INLINE void repeat_byte(std::size_t byte, std::uint8_t* list) {
  const std::uint64_t bytes = byte * 0x0101010101010101;
  std::memcpy(list, &bytes, 8);
}

/// Gives the lanes past the last face boxes that meet nothing, not even a box without an end: their sides are not
/// numbers.
HWY_INLINE void end_columns(Face_columns& faces, std::size_t count) {
  const Box_lanes d;
  const auto no_number = hn::Set(d, std::numeric_limits<float>::quiet_NaN());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    hn::StoreU(no_number, d, faces.low[axis] + count);
    hn::StoreU(no_number, d, faces.high[axis] + count);
  }
  faces.count = count;
}

/// A box in every lane, its high side moved out by the margin.
struct Limits {
  Sides low[3], high[3];
};

HWY_INLINE Limits limits(const float (&low)[4], const float (&high)[4]) {
  const Box_lanes d;
  return {{hn::Set(d, low[0]), hn::Set(d, low[1]), hn::Set(d, low[2])},
          {hn::Set(d, high[0]), hn::Set(d, high[1]), hn::Set(d, high[2])}};
}
HWY_INLINE Limits limits(const Face_columns& faces, std::size_t face) {
  const Box_lanes d;
  const auto side = [&](const Face_columns::Column& column) HWY_ATTR { return hn::Set(d, column[face]); };
  return {{side(faces.low[0]), side(faces.low[1]), side(faces.low[2])},
          {side(faces.high[0]), side(faces.high[1]), side(faces.high[2])}};
}

/// The lanes in which a face, from the `start`th on, has a box within the margin of another box.
HWY_INLINE Near near_boxes(const Limits& box, const Face_columns& faces, std::size_t start) {
  const Box_lanes d;
  const auto near_along = [&](std::size_t axis) HWY_ATTR {
    return hn::And(hn::Le(box.low[axis], hn::LoadU(d, faces.high[axis] + start)),
                   hn::Le(hn::LoadU(d, faces.low[axis] + start), box.high[axis]));
  };
  return hn::And(hn::And(near_along(0), near_along(1)), near_along(2));
}

/// As many vertex numbers as there are boxes in a vector.
using Vertex_lanes = hn::Rebind<std::uint32_t, Box_lanes>;

/// Writes those lanes that are asked for next to each other, and anything after them.
#if HWY_TARGET <= HWY_AVX3
class Packing {
 public:
  Packing(Near chosen, unsigned /*bits*/) : chosen_(chosen) {}

  HWY_INLINE void store(Sides sides, float* to) const { hn::StoreU(hn::Compress(sides, chosen_), Box_lanes(), to); }
  HWY_INLINE void store(hn::Vec<Vertex_lanes> vertices, std::uint32_t* to) const {
    const Vertex_lanes d;
    hn::StoreU(hn::Compress(vertices, hn::RebindMask(d, chosen_)), d, to);
  }

 private:
  Near chosen_;
};
#else
// Without an instruction for it, Highway's `Compress` has GCC 12 write a table of a kilobyte each time.
class Packing {
  static_assert(hn::MaxLanes(Box_lanes()) <= 8, "what the table has");

 public:
  Packing(Near /*chosen*/, unsigned bits)
      : lanes_(
            hn::PromoteTo(Vertex_lanes(), hn::LoadU(hn::Rebind<std::uint8_t, Box_lanes>(), lane_lists[bits].data()))) {}

  HWY_INLINE void store(Sides sides, float* to) const {
    const Box_lanes d;
    hn::StoreU(hn::TableLookupLanes(sides, hn::IndicesFromVec(d, lanes_)), d, to);
  }
  HWY_INLINE void store(hn::Vec<Vertex_lanes> vertices, std::uint32_t* to) const {
    const Vertex_lanes d;
    hn::StoreU(hn::TableLookupLanes(vertices, hn::IndicesFromVec(d, lanes_)), d, to);
  }

 private:
  hn::Vec<Vertex_lanes> lanes_;
};
#endif

/// Lists the faces whose boxes are within the margin of a box.
/// @param copy  null, or where these faces are put next to each other
/// @return the limits of these; they mean nothing if there is none
template <bool with_vertices = false>
HWY_INLINE Limits list_near(const Face_columns& faces, const Limits& box, Face_list& list,
                            Face_columns* copy = nullptr) {
  const Box_lanes d;
  const auto infinity = hn::Set(d, std::numeric_limits<float>::infinity());
  Limits around;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    around.low[axis] = infinity;
    around.high[axis] = hn::Neg(infinity);
  }
  std::size_t count = 0;
  for (std::size_t start = 0; start < faces.count; start += hn::Lanes(d)) {
    const auto near = near_boxes(box, faces, start);
    const unsigned bits = mask_bits(d, near);
    const Packing packing(near, bits);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto low = hn::Load(d, faces.low[axis] + start), high = hn::Load(d, faces.high[axis] + start);
      around.low[axis] = hn::Min(around.low[axis], hn::IfThenElse(near, low, infinity));
      around.high[axis] = hn::Max(around.high[axis], hn::IfThenElse(near, high, hn::Neg(infinity)));
      if (copy == nullptr) continue;
      packing.store(low, copy->low[axis] + count);
      packing.store(high, copy->high[axis] + count);
      if constexpr (with_vertices)
        packing.store(hn::Load(Vertex_lanes(), faces.vertices[axis] + start), copy->vertices[axis] + count);
    }
    count += list_lanes(bits, start, list.places + count);
  }
  list.count = count;
  if (copy != nullptr) end_columns(*copy, count);
  if (count == 0) return around;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    around.low[axis] = hn::MinOfLanes(d, around.low[axis]);
    around.high[axis] = hn::MaxOfLanes(d, around.high[axis]);
  }
  return around;
}

/// The lanes in which a face of b, from the `start`th on, has a vertex of a's face.
HWY_INLINE Near share_a_vertex(const Face_columns& a, std::size_t face, const Face_columns& b, std::size_t start) {
  const Vertex_lanes d;
  const auto p = hn::Set(d, a.vertices[0][face]), q = hn::Set(d, a.vertices[1][face]);
  const auto r = hn::Set(d, a.vertices[2][face]);
  const auto shares = [&](std::size_t corner) HWY_ATTR {
    const auto vertex = hn::LoadU(d, b.vertices[corner] + start);
    return hn::Or(hn::Or(hn::Eq(p, vertex), hn::Eq(q, vertex)), hn::Eq(r, vertex));
  };
  return hn::RebindMask(Box_lanes(), hn::Or(hn::Or(shares(0), shares(1)), shares(2)));
}

/// Adds the pairs of a face of a and one of b, from the `first`th on, whose boxes are within the margin.
/// @param count  of the pairs listed so far
/// @return the same with these
HWY_INLINE std::size_t list_near_pairs(const Face_columns& a, std::size_t face, const Face_columns& b,
                                       std::size_t first, bool skip_neighbours, std::size_t count,
                                       Leaf_scratch& scratch) {
  const Box_lanes d;
  const Limits box = limits(a, face);
  const std::size_t end = b.count;  // bytes are written, which could be those of b
  for (std::size_t start = first; start < end; start += hn::Lanes(d)) {
    auto near = near_boxes(box, b, start);
    if (skip_neighbours && !hn::AllFalse(d, near)) near = hn::AndNot(share_a_vertex(a, face, b, start), near);
    for (std::size_t eight = 0; eight < hn::Lanes(d); eight += 8) repeat_byte(face, scratch.pairs_a + count + eight);
    count += list_lanes(mask_bits(d, near), start, scratch.pairs_b + count);
  }
  return count;
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
