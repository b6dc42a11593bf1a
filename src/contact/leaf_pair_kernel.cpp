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

/// The box of a face, in vectors of a position.
struct Face_box {
  hn::Vec<D> low[vectors], high[vectors];
};

HWY_INLINE Face_box box_of(const Leaf_corners& corners, const Leaf_scratch::Side& side) {
  const D d;
  Face_box box;
  for (std::size_t i = 0; i < vectors; ++i) {
    const auto p = hn::Load(d, side.positions[corners[0]] + i * lanes);
    const auto q = hn::Load(d, side.positions[corners[1]] + i * lanes);
    const auto r = hn::Load(d, side.positions[corners[2]] + i * lanes);
    box.low[i] = hn::Min(hn::Min(p, q), r);
    box.high[i] = hn::Max(hn::Max(p, q), r);
  }
  return box;
}

HWY_INLINE Tree_box store(const Face_box& box) {
  Tree_box stored;
  for (std::size_t i = 0; i < vectors; ++i) {
    hn::Store(box.low[i], D(), stored.low + i * lanes);
    hn::Store(box.high[i], D(), stored.high + i * lanes);
  }
  return stored;
}

/// Boxes of the listed faces go to `take(number in the list, box)`.
/// @return the box around them all
template <class Take>
HWY_INLINE Tree_box box_around(const Leaf_view& leaf, const Leaf_scratch::Side& side, std::size_t count, Take take) {
  Face_box whole;
  for (std::size_t i = 0; i < vectors; ++i) {
    whole.low[i] = hn::Set(D(), std::numeric_limits<double>::infinity());
    whole.high[i] = hn::Set(D(), -std::numeric_limits<double>::infinity());
  }
  for (std::size_t f = 0; f < count; ++f) {
    const Face_box box = box_of(leaf.corners[side.places[f]], side);
    for (std::size_t i = 0; i < vectors; ++i) {
      whole.low[i] = hn::Min(whole.low[i], box.low[i]);
      whole.high[i] = hn::Max(whole.high[i], box.high[i]);
    }
    take(f, box);
  }
  return store(whole);
}

/// Writes the boxes of b's listed faces by coordinate. The lanes past the last one get boxes that meet nothing.
/// @return the box around them all
HWY_INLINE Tree_box fill_columns(const Leaf_view& leaf, std::size_t count, double margin, bool with_vertices,
                                 Leaf_scratch& scratch) {
  auto& columns = scratch.columns;
  const Tree_box whole = box_around(leaf, scratch.b, count, [&](std::size_t f, const Face_box& face) HWY_ATTR {
    const Tree_box box = store(face);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      columns.low[axis][f] = box.low[axis];
      columns.high[axis][f] = box.high[axis] + margin;
    }
  });
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t f = count; f < count + widest; ++f) {
      columns.low[axis][f] = std::numeric_limits<double>::infinity();
      columns.high[axis][f] = -std::numeric_limits<double>::infinity();
    }
  if (with_vertices)
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (std::size_t f = 0; f < count; ++f)
        columns.vertices[corner][f] = leaf.vertices[leaf.corners[scratch.b.places[f]][corner]];
  return whole;
}

HWY_INLINE Truths near_along(double low, double high, const double* b_low, const double* b_high) {
  const Lanes d;
  return hn::And(hn::Le(all(low), hn::LoadU(d, b_high)), hn::Le(hn::LoadU(d, b_low), all(high)));
}

/// The lanes in which a face of b, from the `start`th on, has a box within the margin of a's.
HWY_INLINE Truths near_boxes(const Tree_box& a, double margin, const Leaf_scratch::Columns& b, std::size_t start) {
  return hn::And(hn::And(near_along(a.low[0], a.high[0] + margin, b.low[0] + start, b.high[0] + start),
                         near_along(a.low[1], a.high[1] + margin, b.low[1] + start, b.high[1] + start)),
                 near_along(a.low[2], a.high[2] + margin, b.low[2] + start, b.high[2] + start));
}

/// The lanes in which a face of b, from the `start`th on, has a vertex of a's face.
HWY_INLINE Truths share_a_vertex(const Leaf_view& leaf, const Leaf_corners& a, const Leaf_scratch::Columns& b,
                                 std::size_t start) {
  const auto shares = [&](std::size_t corner) HWY_ATTR {
    const auto vertex = hn::LoadU(Lanes(), b.vertices[corner] + start);
    return hn::Or(hn::Or(hn::Eq(all(leaf.vertices[a[0]]), vertex), hn::Eq(all(leaf.vertices[a[1]]), vertex)),
                  hn::Eq(all(leaf.vertices[a[2]]), vertex));
  };
  return hn::Or(hn::Or(shares(0), shares(1)), shares(2));
}

/// Face pairs whose boxes are within the margin.
HWY_INLINE std::size_t list_near_boxes(const Leaf_view& a, std::size_t count_a, std::size_t count_b,
                                       const Tree_box& box_b, double margin, bool same, bool skip_neighbours,
                                       const Leaf_scratch& scratch, Face_places* near_pairs) {
  const Lanes d;
  std::size_t count = 0;
  for (std::size_t i = 0; i < count_a; ++i) {
    const std::uint16_t place_a = scratch.a.places[i];
    const Leaf_corners& corners = a.corners[place_a];
    const Tree_box box = store(box_of(corners, scratch.a));
    if (!near(box, box_b, margin)) continue;
    // Both sides of one leaf list the same faces in the same order.
    for (std::size_t start = same ? i + 1 : 0; start < count_b; start += hn::Lanes(d)) {
      auto found = near_boxes(box, margin, scratch.columns, start);
      if (hn::AllFalse(d, found)) continue;
      if (skip_neighbours) found = hn::AndNot(share_a_vertex(a, corners, scratch.columns, start), found);
      for (unsigned bits = mask_bits(d, found); bits != 0; bits &= bits - 1)
        near_pairs[count++] = {place_a, scratch.b.places[start + hwy::Num0BitsBelowLS1Bit_Nonzero32(bits)]};
    }
  }
  return count;
}

HWY_INLINE void copy_corners(const Leaf_corners& corners, const Leaf_scratch::Side& side, std::size_t lane,
                             double (*columns)[3][widest]) {
  for (std::size_t corner = 0; corner < 3; ++corner)
    for (std::size_t axis = 0; axis < 3; ++axis) columns[corner][axis][lane] = side.positions[corners[corner]][axis];
}

HWY_INLINE Vector3 load_corner(const double (*columns)[widest]) {
  const Lanes d;
  return {hn::Load(d, columns[0]), hn::Load(d, columns[1]), hn::Load(d, columns[2])};
}

/// Removes the pairs that planes prove apart, as many at a time as a vector has lanes.
/// @return the number of those left, in their order
HWY_INLINE std::size_t keep_not_apart(const Leaf_view& a, const Leaf_view& b, double margin, Leaf_scratch& scratch,
                                      Face_places* pairs, std::size_t count) {
  const Lanes d;
  auto& batch = scratch.batch;
  std::size_t kept = 0;
  for (std::size_t first = 0; first < count; first += hn::Lanes(d)) {
    const std::size_t used = count - first < hn::Lanes(d) ? count - first : hn::Lanes(d);
    for (std::size_t lane = 0; lane < used; ++lane) {
      copy_corners(a.corners[pairs[first + lane].a], scratch.a, lane, batch.a);
      copy_corners(b.corners[pairs[first + lane].b], scratch.b, lane, batch.b);
    }
    const auto left = not_proven_apart(load_corner(batch.a[0]), load_corner(batch.a[1]), load_corner(batch.a[2]),
                                       load_corner(batch.b[0]), load_corner(batch.b[1]), load_corner(batch.b[2]),
                                       margin, hn::FirstN(d, used));
    for (unsigned bits = mask_bits(d, left); bits != 0; bits &= bits - 1)
      pairs[kept++] = pairs[first + hwy::Num0BitsBelowLS1Bit_Nonzero32(bits)];
  }
  return kept;
}

std::size_t near_faces_kernel(const Leaf_view& a, const Leaf_view& b, double margin, bool same, bool skip_neighbours,
                              Leaf_scratch& scratch, Face_places* near_pairs) {
  copy_vertices(a, *b.box, margin, scratch.a);
  const std::size_t count_a = list_near_faces(a, scratch.a);
  if (count_a == 0) return 0;
  const Tree_box box_a = box_around(a, scratch.a, count_a, [](std::size_t, const Face_box&) HWY_ATTR {});
  copy_vertices(b, box_a, margin, scratch.b);
  const std::size_t count_b = list_near_faces(b, scratch.b);
  if (count_b == 0) return 0;
  const Tree_box box_b = fill_columns(b, count_b, margin, skip_neighbours, scratch);
  const std::size_t count =
      list_near_boxes(a, count_a, count_b, box_b, margin, same, skip_neighbours, scratch, near_pairs);
  return keep_not_apart(a, b, margin, scratch, near_pairs, count);
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
