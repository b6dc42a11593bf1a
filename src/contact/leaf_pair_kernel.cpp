// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/leaf_pair_kernel.h"

#include <limits>

#include "contact/leaf_scratch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contact/leaf_pair_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "contact/separation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// A position fills one vector of four lanes or two of two; the fourth lane means nothing.
constexpr std::size_t lanes = HWY_MAX_BYTES >= 32 ? 4 : 2;
constexpr std::size_t vectors = 4 / lanes;
using D = hn::CappedTag<double, lanes>;

HWY_INLINE unsigned bits(hn::Mask<D> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(D(), mask, bytes);
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
    return (bits(below) | bits(above) << 4) << (i * lanes);
  };
  constexpr unsigned used = 0x77;  // the fourth lane is not
  const std::size_t last = leaf.vertex_count - 1;
  for (std::size_t place = 0; place < last; ++place) {
    const double* vertex = leaf.coordinates + 3 * std::size_t{leaf.vertices[place]};
    unsigned code = 0;
    for (std::size_t i = 0; i < vectors; ++i) code |= copy(place, i, hn::LoadU(d, vertex + i * lanes));
    side.outcodes[place] = static_cast<std::uint8_t>(code & used);
  }
  // The last one may be the last of the mesh: nothing past its z is read.
  const double* vertex = leaf.coordinates + 3 * std::size_t{leaf.vertices[last]};
  unsigned code = 0;
  for (std::size_t i = 0; i < vectors; ++i)
    code |=
        copy(last, i, hn::MaskedLoad(hn::FirstN(d, i + 1 < vectors ? lanes : 3 - i * lanes), d, vertex + i * lanes));
  side.outcodes[last] = static_cast<std::uint8_t>(code & used);
}

/// Lists the faces whose vertices do not all lie beyond one side, and fits their boxes.
/// @return their number
HWY_INLINE std::size_t near_side(const Leaf_view& leaf, Leaf_scratch::Side& side, Tree_box& whole) {
  std::size_t count = 0;
  for (std::size_t face = 0; face < leaf.face_count; ++face) {
    const auto& corners = leaf.corners[face];
    side.places[count] = static_cast<std::uint16_t>(face);
    count += (side.outcodes[corners[0]] & side.outcodes[corners[1]] & side.outcodes[corners[2]]) == 0 ? 1 : 0;
  }
  const D d;
  for (std::size_t i = 0; i < vectors; ++i) {
    auto whole_low = hn::Set(d, std::numeric_limits<double>::infinity());
    auto whole_high = hn::Set(d, -std::numeric_limits<double>::infinity());
    for (std::size_t f = 0; f < count; ++f) {
      const auto& corners = leaf.corners[side.places[f]];
      const auto first = hn::Load(d, side.positions[corners[0]] + i * lanes);
      const auto second = hn::Load(d, side.positions[corners[1]] + i * lanes);
      const auto third = hn::Load(d, side.positions[corners[2]] + i * lanes);
      const auto low = hn::Min(hn::Min(first, second), third);
      const auto high = hn::Max(hn::Max(first, second), third);
      hn::Store(low, d, side.low[f] + i * lanes);
      hn::Store(high, d, side.high[f] + i * lanes);
      whole_low = hn::Min(whole_low, low);
      whole_high = hn::Max(whole_high, high);
    }
    hn::Store(whole_low, d, whole.low + i * lanes);
    hn::Store(whole_high, d, whole.high + i * lanes);
  }
  return count;
}

/// Boxes of b's faces by coordinate. Their high sides are moved out by the margin.
HWY_INLINE void transpose_boxes(Leaf_scratch& scratch, std::size_t count, double margin) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t f = 0; f < count; ++f) {
      scratch.low[axis][f] = scratch.b.low[f][axis];
      scratch.high[axis][f] = scratch.b.high[f][axis] + margin;
    }
    for (std::size_t f = count; f < count + widest; ++f) {
      scratch.low[axis][f] = std::numeric_limits<double>::infinity();
      scratch.high[axis][f] = -std::numeric_limits<double>::infinity();
    }
  }
}

/// Bit f is set if the box of b's face `start + f` comes within the margin of the box of a's face.
HWY_INLINE unsigned near_boxes(const Leaf_scratch& scratch, const double* low, const double* high, double margin,
                               std::size_t start) {
  const hn::CappedTag<double, widest> d;
  unsigned result = 0;
  for (std::size_t first = 0; first < widest; first += hn::Lanes(d)) {
    auto near = hn::Eq(hn::Zero(d), hn::Zero(d));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto b_low = hn::LoadU(d, scratch.low[axis] + start + first);
      const auto b_high = hn::LoadU(d, scratch.high[axis] + start + first);
      near =
          hn::And(near, hn::And(hn::Le(hn::Set(d, low[axis]), b_high), hn::Le(b_low, hn::Set(d, high[axis] + margin))));
    }
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, near, bytes);
    result |= static_cast<unsigned>(bytes[0]) << first;
  }
  return result;
}

HWY_INLINE bool share_a_vertex(const Leaf_view& a, const Leaf_corners& face_a, const Leaf_view& b,
                               const Leaf_corners& face_b) {
  bool shared = false;
  for (const auto corner_a : face_a)
    for (const auto corner_b : face_b) shared |= a.vertices[corner_a] == b.vertices[corner_b];
  return shared;
}

std::size_t near_faces_kernel(const Leaf_view& a, const Leaf_view& b, double margin, bool same, bool skip_neighbours,
                              Leaf_scratch& scratch, Face_places* near) {
  Tree_box box_a, box_b;
  copy_vertices(a, *b.box, margin, scratch.a);
  const std::size_t count_a = near_side(a, scratch.a, box_a);
  if (count_a == 0) return 0;
  copy_vertices(b, box_a, margin, scratch.b);
  const std::size_t count_b = near_side(b, scratch.b, box_b);
  if (count_b == 0) return 0;
  transpose_boxes(scratch, count_b, margin);

  std::size_t count = 0;
  for (std::size_t i = 0; i < count_a; ++i) {
    const std::uint16_t place_a = scratch.a.places[i];
    const Leaf_corners& face_a = a.corners[place_a];
    // Both sides of one leaf list the same faces in the same order.
    for (std::size_t start = same ? i + 1 : 0; start < count_b; start += widest) {
      for (unsigned left = near_boxes(scratch, scratch.a.low[i], scratch.a.high[i], margin, start); left != 0;
           left &= left - 1) {
        const std::uint16_t place_b = scratch.b.places[start + hwy::Num0BitsBelowLS1Bit_Nonzero32(left)];
        const Leaf_corners& face_b = b.corners[place_b];
        if (skip_neighbours && share_a_vertex(a, face_a, b, face_b)) continue;
        const auto& at_a = scratch.a.positions;
        const auto& at_b = scratch.b.positions;
        if (proven_apart(at_a[face_a[0]], at_a[face_a[1]], at_a[face_a[2]], at_b[face_b[0]], at_b[face_b[1]],
                         at_b[face_b[2]], margin))
          continue;
        near[count++] = {place_a, place_b};
      }
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
