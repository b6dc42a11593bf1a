// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_BOX_PAIRS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_BOX_PAIRS_INL_H
#undef LODESTONE_BOX_PAIRS_INL_H
#else
#define LODESTONE_BOX_PAIRS_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "filter/box_lanes-inl.h"
#include "filter/face_columns.h"
#include "filter/filter_scratch.h"
#include "simd/compress-inl.h"
#include "simd/lane_lists.h"
#include "simd/lane_lookup-inl.h"
#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// What happens to pairs of faces that share a vertex.
enum class Neighbours { kept, discarded };

/// Of a vector of b's faces, from the `start`th on, the bits of those that share a vertex with a face of a.
HWY_INLINE std::uint32_t neighbour_bits(const Box_columns& a, std::size_t face, const Box_columns& b,
                                        std::size_t start) {
  const Index_lanes d;
  const auto p = hn::Set(d, a.vertices[0][face]), q = hn::Set(d, a.vertices[1][face]);
  const auto r = hn::Set(d, a.vertices[2][face]);
  const auto shares = [&](std::size_t corner) HWY_ATTR {
    const auto vertex = hn::LoadU(d, b.vertices[corner] + start);
    return hn::Or(hn::Or(hn::Eq(p, vertex), hn::Eq(q, vertex)), hn::Eq(r, vertex));
  };
  return mask_bits(d, hn::Or(hn::Or(shares(0), shares(1)), shares(2)));
}

/// Clears the bits of neighbours.
/// @param bits  of b's faces, from the `start`th on
HWY_INLINE std::uint32_t discard_neighbours(std::uint32_t bits, const Box_columns& a, std::size_t face,
                                            const Box_columns& b, std::size_t start) {
  constexpr std::uint32_t block = (1U << float_lanes) - 1;
  for (std::size_t first = 0; first < side_lanes; first += float_lanes)
    if ((bits >> first & block) != 0) bits &= ~(neighbour_bits(a, face, b, start + first) << first);
  return bits;
}

/// Copies the boxes of the listed faces next to each other; where neighbours are discarded, also their vertices.
#if HWY_TARGET <= HWY_AVX3
template <Neighbours neighbours>
HWY_INLINE void gather_boxes(const Box_columns& faces, const Face_list& list, Box_columns& to) {
  const Side_index_lanes d;
  const Index_lanes wide;
  for (std::size_t start = 0; start < list.count; start += side_lanes) {
    const auto indices =
        hn::PromoteTo(d, hn::LoadU(hn::Rebind<std::uint8_t, Side_index_lanes>(), list.indices + start));
    const auto low = look_up(d, faces.low, faces.count, indices);
    const auto high = look_up(d, faces.high, faces.count, indices);
    store_boxes(low.of, high.of, list.count - start, to, start);
    if constexpr (neighbours == Neighbours::kept) continue;
    for (std::size_t first = start; first < start + side_lanes; first += float_lanes) {
      const auto half = hn::PromoteTo(wide, hn::LoadU(hn::Rebind<std::uint8_t, Index_lanes>(), list.indices + first));
      const auto vertices = look_up(wide, faces.vertices, faces.count, half);
      for (std::size_t corner = 0; corner < 3; ++corner)
        hn::Store(vertices.of[corner], wide, to.vertices[corner] + first);
    }
  }
  to.count = list.count;
}
#else
template <Neighbours neighbours>
HWY_INLINE void gather_boxes(const Box_columns& faces, const Face_list& list, Box_columns& to) {
  for (std::size_t i = 0; i < list.count; ++i) {
    const std::size_t face = list.indices[i];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      to.low[axis][i] = faces.low[axis][face];
      to.high[axis][i] = faces.high[axis][face];
      if constexpr (neighbours == Neighbours::discarded) to.vertices[axis][i] = faces.vertices[axis][face];
    }
  }
  pad_columns(to, list.count);
  to.count = list.count;
}
#endif

/// Compares a face's box with a vector of boxes, from the `start`th on, and lists the row if any overlap.
/// @param rows  number of rows listed so far
/// @return number of rows with this one
template <Neighbours neighbours>
HWY_INLINE std::size_t add_row(const Lane_box& box, const Box_columns& faces, std::size_t face,
                               const Box_columns& boxes, std::size_t start, std::size_t rows, Box_row* list) {
  std::uint32_t bits = mask_bits(Side_lanes(), overlapping(box, boxes, start));
  if constexpr (neighbours == Neighbours::discarded) bits = discard_neighbours(bits, faces, face, boxes, start);
  // Unpredictable, so branchless: the next row overwrites one that does not count.
  list[rows] = {bits, static_cast<std::uint32_t>(face + 256 * start)};
  return rows + (bits != 0 ? 1 : 0);
}

/// Lists the pairs of all rows.
/// @param indices            of the faces whose boxes the rows refer to
/// @param of_rows, of_boxes  set to the indices of both faces
/// @return number of pairs
HWY_INLINE std::size_t list_pairs_of_rows(const Box_row* list, std::size_t rows, const std::uint8_t* indices,
                                          std::uint8_t* of_rows, std::uint8_t* of_boxes) {
  std::size_t count = 0;
  for (std::size_t r = 0; r < rows; ++r) {
    const Box_row row = list[r];
    repeat_byte(row.packed % 256, side_lanes, of_rows + count);
    count += compress_side_lanes(row.bits, indices + row.packed / 256, of_boxes + count);
  }
  return count;
}

/// The listed faces of one leaf, and where to list their part of the pairs.
struct Side_of_pairs {
  const Box_columns& faces;
  const Face_list& list;
  std::uint8_t* pairs;

  /// Vectors of `most_side_lanes` that hold them: the order of pairs must not depend on the instruction set.
  std::size_t blocks() const { return (list.count + most_side_lanes - 1) / most_side_lanes; }
};

/// Compares the boxes of one leaf, one after the other, with those of the other leaf, a vector at a time.
template <Neighbours neighbours>
HWY_INLINE std::size_t list_box_pairs(const Side_of_pairs& by_row, const Side_of_pairs& by_lane,
                                      Filter_scratch& scratch) {
  gather_boxes<neighbours>(by_lane.faces, by_lane.list, scratch.boxes);
  const std::size_t faces = by_row.list.count;  // hoisted: byte stores may alias it
  std::size_t rows = 0;
  for (std::size_t i = 0; i < faces; ++i) {
    const std::size_t face = by_row.list.indices[i];
    const Lane_box box = lane_box(by_row.faces, face);
    for (std::size_t start = 0; start < scratch.boxes.count; start += side_lanes)
      rows = add_row<neighbours>(box, by_row.faces, face, scratch.boxes, start, rows, scratch.rows);
  }
  return list_pairs_of_rows(scratch.rows, rows, by_lane.list.indices, by_row.pairs, by_lane.pairs);
}

/// Lists the pairs of listed faces, one of a and one of b, whose boxes overlap.
/// @return number of pairs
template <Neighbours neighbours>
HWY_INLINE std::size_t list_box_pairs(const Box_columns& a, const Box_columns& b, Filter_scratch& scratch) {
  const Side_of_pairs side_a{a, scratch.faces_a, scratch.pairs_a}, side_b{b, scratch.faces_b, scratch.pairs_b};
  const bool b_in_lanes = side_a.list.count * side_b.blocks() <= side_b.list.count * side_a.blocks();
  return b_in_lanes ? list_box_pairs<neighbours>(side_a, side_b, scratch)
                    : list_box_pairs<neighbours>(side_b, side_a, scratch);
}

/// Lists the pairs of faces of one leaf whose boxes overlap and that share no vertex, each once.
/// @return number of pairs
HWY_INLINE std::size_t list_box_pairs_within(const Box_columns& faces, Filter_scratch& scratch) {
  std::size_t rows = 0;
  for (std::size_t f = 0; f < faces.count; ++f)
    for (std::size_t start = f + 1; start < faces.count; start += side_lanes)
      rows = add_row<Neighbours::discarded>(lane_box(faces, f), faces, f, faces, start, rows, scratch.rows);
  return list_pairs_of_rows(scratch.rows, rows, every_index.data(), scratch.pairs_a, scratch.pairs_b);
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
