// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_NEAR_BOX_PAIRS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_NEAR_BOX_PAIRS_INL_H
#undef LODESTONE_NEAR_BOX_PAIRS_INL_H
#else
#define LODESTONE_NEAR_BOX_PAIRS_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "filter/filter_scratch.h"
#include "filter/near_boxes-inl.h"
#include "simd/lane_lookup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Bits of those faces of b, from the `start`th on, that have a vertex of a's face.
HWY_INLINE std::uint32_t share_a_vertex(const Box_columns& a, std::size_t face, const Box_columns& b,
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
HWY_INLINE std::uint32_t leave_out_neighbours(std::uint32_t bits, const Box_columns& a, std::size_t face,
                                              const Box_columns& b, std::size_t start) {
  constexpr std::size_t step = hn::MaxLanes(Vertex_lanes());
  constexpr std::uint32_t block = (1U << step) - 1;
  for (std::size_t first = 0; first < hn::MaxLanes(Box_lanes()); first += step)
    if ((bits >> first & block) != 0) bits &= ~(share_a_vertex(a, face, b, start + first) << first);
  return bits;
}

/// Puts the boxes of listed faces next to each other.
/// @tparam one_mesh  and their vertices
#if HWY_TARGET <= HWY_AVX3
template <bool one_mesh>
HWY_INLINE void gather(const Box_columns& faces, const Face_list& list, Box_columns& to) {
  const Box_lanes d;
  const Box_places box_places;
  const Vertex_lanes vertices;
  for (std::size_t start = 0; start < list.count; start += hn::Lanes(d)) {
    const auto places =
        hn::PromoteTo(box_places, hn::LoadU(hn::Rebind<std::uint8_t, Box_lanes>(), list.places + start));
    const auto low = look_up(box_places, faces.low, faces.count, places);
    const auto high = look_up(box_places, faces.high, faces.count, places);
    store_boxes(low.of, high.of, list.count - start, to, start);
    if constexpr (!one_mesh) continue;
    for (std::size_t first = start; first < start + hn::Lanes(d); first += hn::Lanes(vertices)) {
      const auto near =
          hn::PromoteTo(vertices, hn::LoadU(hn::Rebind<std::uint8_t, Vertex_lanes>(), list.places + first));
      const auto corners = look_up(vertices, faces.vertices, faces.count, near);
      for (std::size_t corner = 0; corner < 3; ++corner)
        hn::Store(corners.of[corner], vertices, to.vertices[corner] + first);
    }
  }
  to.count = list.count;
}
#else
template <bool one_mesh>
HWY_INLINE void gather(const Box_columns& faces, const Face_list& list, Box_columns& to) {
  for (std::size_t i = 0; i < list.count; ++i) {
    const std::size_t face = list.places[i];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      to.low[axis][i] = faces.low[axis][face];
      to.high[axis][i] = faces.high[axis][face];
      if constexpr (one_mesh) to.vertices[axis][i] = faces.vertices[axis][face];
    }
  }
  end_columns(to, list.count);
  to.count = list.count;
}
#endif

/// Adds the row of boxes, a vector of them from the `start`th on, that a face's is near, if there are any.
/// @tparam one_mesh  leave out faces that share a vertex
/// @param rows       listed so far
/// @return their number with this one
template <bool one_mesh>
HWY_INLINE std::size_t add_row(const Limits& box, const Box_columns& faces, std::size_t face, const Box_columns& boxes,
                               std::size_t start, std::size_t rows, Candidate_row* list) {
  std::uint32_t bits = mask_bits(Box_lanes(), near_boxes(box, boxes, start));
  if constexpr (one_mesh) bits = leave_out_neighbours(bits, faces, face, boxes, start);
  // It is written over unless it counts: no branch could foretell which do.
  list[rows] = {bits, static_cast<std::uint32_t>(face + 256 * start)};
  return rows + (bits != 0 ? 1 : 0);
}

/// Lists the pairs of which rows consist.
/// @param places             of the boxes that rows count
/// @param of_rows, of_boxes  are set to the places of both
/// @return their number
HWY_INLINE std::size_t list_pairs_of_rows(const Candidate_row* list, std::size_t rows, const std::uint8_t* places,
                                          std::uint8_t* of_rows, std::uint8_t* of_boxes) {
  std::size_t count = 0;
  for (std::size_t r = 0; r < rows; ++r) {
    const Candidate_row row = list[r];
    repeat_byte(row.places % 256, hn::MaxLanes(Box_lanes()), of_rows + count);
    count += list_places(row.bits, places + row.places / 256, of_boxes + count);
  }
  return count;
}

/// Lists the pairs of different faces of a leaf whose boxes are near, and that share no vertex.
/// @return their number
HWY_INLINE std::size_t list_pairs_within(const Box_columns& faces, Filter_scratch& scratch) {
  std::size_t rows = 0;
  for (std::size_t f = 0; f < faces.count; ++f)
    for (std::size_t start = f + 1; start < faces.count; start += hn::MaxLanes(Box_lanes()))
      rows = add_row<true>(limits(faces, f), faces, f, faces, start, rows, scratch.rows);
  return list_pairs_of_rows(scratch.rows, rows, every_place.data(), scratch.pairs_a, scratch.pairs_b);
}

/// Some faces of a leaf, and where to list those of pairs.
struct Side_of_pairs {
  const Box_columns& faces;
  const Face_list& near;
  std::uint8_t* listed;

  /// Vectors of the widest that hold them: the order of pairs must not depend on the instruction set.
  std::size_t blocks() const { return (near.count + most_box_lanes - 1) / most_box_lanes; }
};

/// Compares the near faces of one leaf, one after the other, with those of the other leaf, a vector at a time.
template <bool one_mesh>
HWY_INLINE std::size_t list_pairs(const Side_of_pairs& by_row, const Side_of_pairs& by_lane, Filter_scratch& scratch) {
  gather<one_mesh>(by_lane.faces, by_lane.near, scratch.boxes);
  // Bytes are written, which could be those of this number.
  const std::size_t faces = by_row.near.count;
  std::size_t row_count = 0;
  for (std::size_t i = 0; i < faces; ++i) {
    const std::size_t face = by_row.near.places[i];
    const Limits box = limits(by_row.faces, face);
    for (std::size_t start = 0; start < scratch.boxes.count; start += hn::MaxLanes(Box_lanes()))
      row_count = add_row<one_mesh>(box, by_row.faces, face, scratch.boxes, start, row_count, scratch.rows);
  }
  return list_pairs_of_rows(scratch.rows, row_count, by_lane.near.places, by_row.listed, by_lane.listed);
}

/// Lists the pairs of one of a's near faces and one of b's whose boxes are near.
/// @return their number
template <bool one_mesh>
HWY_INLINE std::size_t list_pairs(const Box_columns& a, const Box_columns& b, Filter_scratch& scratch) {
  const Side_of_pairs side_a{a, scratch.near_a, scratch.pairs_a}, side_b{b, scratch.near_b, scratch.pairs_b};
  const bool b_in_lanes = side_a.near.count * side_b.blocks() <= side_b.near.count * side_a.blocks();
  return b_in_lanes ? list_pairs<one_mesh>(side_a, side_b, scratch) : list_pairs<one_mesh>(side_b, side_a, scratch);
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
