// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/leaf_pair_kernel.h"

#include <limits>

#include "contact/leaf_scratch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contact/leaf_pair_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "contact/position_vectors-inl.h"
#include "contact/separation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class Tag>
HWY_INLINE unsigned mask_bits(Tag d, hn::Mask<Tag> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  return bytes[0];
}

/// Copies the vertices of a leaf, with one bit for each side of the box, widened by the margin, that they lie beyond.
HWY_INLINE void copy_vertices(const Leaf_view& leaf, const Tree_box& box, double margin, Leaf_scratch::Side& side) {
  const D d;
  const auto widening = hn::Set(d, margin);
  const auto copy = [&](std::size_t place, std::size_t i, auto x) HWY_ATTR {
    hn::Store(x, d, side.positions[place] + i * lanes);
    const auto below = hn::Lt(hn::Add(x, widening), hn::Load(d, box.low + i * lanes));
    const auto above = hn::Gt(x, hn::Add(hn::Load(d, box.high + i * lanes), widening));
    return (mask_bits(d, below) | mask_bits(d, above) << 4) << (i * lanes);
  };
  constexpr unsigned used = 0x77;  // the fourth lane is not
  const std::size_t last = leaf.vertex_count - 1;
  for (std::size_t place = 0; place < last; ++place) {
    const double* vertex = leaf.coordinates + 3 * std::size_t{leaf.vertices[place]};
    unsigned code = 0;
    for (std::size_t i = 0; i < vectors; ++i) code |= copy(place, i, hn::LoadU(d, vertex + i * lanes));
    side.outcodes[place] = static_cast<std::uint8_t>(code & used);
  }
  const double* vertex = leaf.coordinates + 3 * std::size_t{leaf.vertices[last]};
  unsigned code = 0;
  for (std::size_t i = 0; i < vectors; ++i) code |= copy(last, i, load_last(vertex, i));
  side.outcodes[last] = static_cast<std::uint8_t>(code & used);
}

/// Lists the faces whose vertices do not all lie beyond one side.
/// @return their number
HWY_INLINE std::size_t list_near_faces(const Leaf_view& leaf, Leaf_scratch::Side& side) {
  std::size_t count = 0;
  for (std::size_t face = 0; face < leaf.face_count; ++face) {
    const auto& corners = leaf.corners[face];
    side.places[count] = static_cast<std::uint16_t>(face);
    count += (side.outcodes[corners[0]] & side.outcodes[corners[1]] & side.outcodes[corners[2]]) == 0 ? 1 : 0;
  }
  return count;
}

/// The box around the listed faces.
HWY_INLINE Tree_box box_of_near_faces(const Leaf_view& leaf, const Leaf_scratch::Side& side, std::size_t count) {
  const D d;
  Tree_box box;
  for (std::size_t i = 0; i < vectors; ++i) {
    auto low = hn::Set(d, std::numeric_limits<double>::infinity());
    auto high = hn::Set(d, -std::numeric_limits<double>::infinity());
    for (std::size_t f = 0; f < count; ++f)
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const auto x = hn::Load(d, side.positions[leaf.corners[side.places[f]][corner]] + i * lanes);
        low = hn::Min(low, x);
        high = hn::Max(high, x);
      }
    hn::Store(low, d, box.low + i * lanes);
    hn::Store(high, d, box.high + i * lanes);
  }
  return box;
}

/// Writes b's listed faces by coordinate. The lanes past the last one get boxes that meet nothing.
HWY_INLINE void fill_columns(const Leaf_view& leaf, std::size_t count, double margin, bool with_vertices,
                             Leaf_scratch& scratch) {
  auto& columns = scratch.columns;
  for (std::size_t corner = 0; corner < 3; ++corner)
    for (std::size_t f = 0; f < count; ++f) {
      const std::uint16_t place = leaf.corners[scratch.b.places[f]][corner];
      const double* position = scratch.b.positions[place];
      for (std::size_t axis = 0; axis < 3; ++axis) columns.corners[corner][axis][f] = position[axis];
      if (with_vertices) columns.vertices[corner][f] = leaf.vertices[place];
    }
  const Lanes d;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t f = 0; f < count; f += hn::Lanes(d)) {
      const auto first = hn::Load(d, columns.corners[0][axis] + f);
      const auto second = hn::Load(d, columns.corners[1][axis] + f);
      const auto third = hn::Load(d, columns.corners[2][axis] + f);
      hn::Store(hn::Min(hn::Min(first, second), third), d, columns.low[axis] + f);
      hn::Store(hn::Add(hn::Max(hn::Max(first, second), third), all(margin)), d, columns.high[axis] + f);
    }
    for (std::size_t f = count; f < count + widest; ++f) {
      columns.low[axis][f] = std::numeric_limits<double>::infinity();
      columns.high[axis][f] = -std::numeric_limits<double>::infinity();
    }
  }
}

/// A face of a, the same in every lane.
struct Spread_face {
  Vector3 corners[3];
  Vector3 low, high;  ///< its box, the high side moved out by the margin
  Numbers vertices[3];
};

HWY_INLINE Spread_face spread(const Leaf_view& leaf, const Leaf_corners& corners, const Leaf_scratch::Side& side,
                              double margin) {
  Spread_face face;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const double* position = side.positions[corners[corner]];
    face.corners[corner] = {all(position[0]), all(position[1]), all(position[2])};
    face.vertices[corner] = all(leaf.vertices[corners[corner]]);
  }
  const auto& [p, q, r] = face.corners;
  face.low = {hn::Min(hn::Min(p.x, q.x), r.x), hn::Min(hn::Min(p.y, q.y), r.y), hn::Min(hn::Min(p.z, q.z), r.z)};
  face.high = greater(greater(p, q), r) + Vector3{all(margin), all(margin), all(margin)};
  return face;
}

HWY_INLINE Truths near_along(Numbers low, Numbers high, const double* b_low, const double* b_high) {
  const Lanes d;
  return hn::And(hn::Le(low, hn::LoadU(d, b_high)), hn::Le(hn::LoadU(d, b_low), high));
}

/// The lanes in which a face of b, from the `start`th on, has a box within the margin of a's.
HWY_INLINE Truths near_boxes(const Spread_face& a, const Leaf_scratch::Columns& b, std::size_t start) {
  return hn::And(hn::And(near_along(a.low.x, a.high.x, b.low[0] + start, b.high[0] + start),
                         near_along(a.low.y, a.high.y, b.low[1] + start, b.high[1] + start)),
                 near_along(a.low.z, a.high.z, b.low[2] + start, b.high[2] + start));
}

/// The lanes in which a face of b, from the `start`th on, has a vertex of a's face.
HWY_INLINE Truths share_a_vertex(const Spread_face& a, const Leaf_scratch::Columns& b, std::size_t start) {
  const auto shares = [&](std::size_t corner) HWY_ATTR {
    const auto vertex = hn::LoadU(Lanes(), b.vertices[corner] + start);
    return hn::Or(hn::Or(hn::Eq(a.vertices[0], vertex), hn::Eq(a.vertices[1], vertex)), hn::Eq(a.vertices[2], vertex));
  };
  return hn::Or(hn::Or(shares(0), shares(1)), shares(2));
}

HWY_INLINE Vector3 corner_of(const Leaf_scratch::Columns& b, std::size_t corner, std::size_t start) {
  const Lanes d;
  return {hn::LoadU(d, b.corners[corner][0] + start), hn::LoadU(d, b.corners[corner][1] + start),
          hn::LoadU(d, b.corners[corner][2] + start)};
}

std::size_t near_faces_kernel(const Leaf_view& a, const Leaf_view& b, double margin, bool same, bool skip_neighbours,
                              Leaf_scratch& scratch, Face_places* near) {
  copy_vertices(a, *b.box, margin, scratch.a);
  const std::size_t count_a = list_near_faces(a, scratch.a);
  if (count_a == 0) return 0;
  copy_vertices(b, box_of_near_faces(a, scratch.a, count_a), margin, scratch.b);
  const std::size_t count_b = list_near_faces(b, scratch.b);
  if (count_b == 0) return 0;
  fill_columns(b, count_b, margin, skip_neighbours, scratch);

  const Lanes d;
  const Leaf_scratch::Columns& columns = scratch.columns;
  std::size_t count = 0;
  for (std::size_t i = 0; i < count_a; ++i) {
    const std::uint16_t place_a = scratch.a.places[i];
    const Spread_face face = spread(a, a.corners[place_a], scratch.a, margin);
    // Both sides of one leaf list the same faces in the same order.
    for (std::size_t start = same ? i + 1 : 0; start < count_b; start += hn::Lanes(d)) {
      auto asked = near_boxes(face, columns, start);
      if (hn::AllFalse(d, asked)) continue;
      if (skip_neighbours) {
        asked = hn::AndNot(share_a_vertex(face, columns, start), asked);
        if (hn::AllFalse(d, asked)) continue;
      }
      const auto left =
          not_proven_apart(face.corners[0], face.corners[1], face.corners[2], corner_of(columns, 0, start),
                           corner_of(columns, 1, start), corner_of(columns, 2, start), margin, asked);
      for (unsigned bit = mask_bits(d, left); bit != 0; bit &= bit - 1)
        near[count++] = {place_a, scratch.b.places[start + hwy::Num0BitsBelowLS1Bit_Nonzero32(bit)]};
    }
  }
  return count;
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(near_faces_kernel);

std::size_t near_faces(const Leaf_view& a, const Leaf_view& b, double margin, bool same, bool skip_neighbours,
                       Leaf_scratch& scratch, Face_places* near) {
  return HWY_DYNAMIC_DISPATCH(near_faces_kernel)(a, b, margin, same, skip_neighbours, scratch, near);
}

}  // namespace lodestone::kernel
#endif
