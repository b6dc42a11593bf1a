// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/leaf_pair_kernel.h"

#include <cstring>
#include <limits>

#include "contact/lane_lists.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contact/leaf_pair_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "contact/corner_columns-inl.h"
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

/// Lists the numbers of the lanes whose bits are set, counted from `first`. Eight bytes are written, whatever their
/// number: no branch could foretell it.
/// @return number of bits
HWY_INLINE std::size_t list_lanes(unsigned bits, std::size_t first, std::uint8_t* list) {
  std::uint64_t numbers;
  std::memcpy(&numbers, lane_lists[bits].data(), 8);
  numbers += first * 0x0101010101010101;
  std::memcpy(list, &numbers, 8);
  return hwy::PopCount(bits);
}

HWY_INLINE void repeat_byte(std::size_t byte, std::uint8_t* list) {
  const std::uint64_t bytes = byte * 0x0101010101010101;
  std::memcpy(list, &bytes, 8);
}

/// Copies the vertices of a leaf next to each other.
HWY_INLINE void copy_positions(const Leaf_view& leaf, double (*positions)[4]) {
  const D d;
  const std::size_t last = leaf.vertex_count - 1;
  for (std::size_t place = 0; place < last; ++place) {
    const double* vertex = leaf.coordinates + 3 * std::size_t{leaf.vertices[place]};
    for (std::size_t i = 0; i < vectors; ++i)
      hn::Store(hn::LoadU(d, vertex + i * lanes), d, positions[place] + i * lanes);
  }
  const double* vertex = leaf.coordinates + 3 * std::size_t{leaf.vertices[last]};
  for (std::size_t i = 0; i < vectors; ++i) hn::Store(load_last(vertex, i), d, positions[last] + i * lanes);
}

HWY_INLINE Aabb box_of(const Leaf_corners& corners, const double (*positions)[4]) {
  const D d;
  Aabb box;
  for (std::size_t i = 0; i < vectors; ++i) {
    const auto p = hn::Load(d, positions[corners[0]] + i * lanes);
    const auto q = hn::Load(d, positions[corners[1]] + i * lanes);
    const auto r = hn::Load(d, positions[corners[2]] + i * lanes);
    hn::Store(hn::Min(hn::Min(p, q), r), d, box.low + i * lanes);
    hn::Store(hn::Max(hn::Max(p, q), r), d, box.high + i * lanes);
  }
  return box;
}

/// Gives the lanes past the last face boxes that meet nothing.
HWY_INLINE void end_columns(Face_columns& faces, std::size_t count) {
  const Lanes d;
  const auto infinity = all(std::numeric_limits<double>::infinity());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    hn::StoreU(infinity, d, faces.low[axis] + count);
    hn::StoreU(hn::Neg(infinity), d, faces.high[axis] + count);
  }
  faces.count = count;
}

/// Fills in where the faces of a leaf are.
HWY_INLINE void pose(const Leaf_view& leaf, const Leaf_request& request) {
  Face_columns& faces = *leaf.faces;
  copy_positions(leaf, faces.positions);
  for (std::size_t f = 0; f < leaf.face_count; ++f) {
    const Aabb box = box_of(leaf.corners[f], faces.positions);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      faces.low[axis][f] = box.low[axis];
      faces.high[axis][f] = box.high[axis] + request.margin;
    }
  }
  if (request.one_mesh)
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (std::size_t f = 0; f < leaf.face_count; ++f)
        faces.vertices[corner][f] = leaf.vertices[leaf.corners[f][corner]];
  end_columns(faces, leaf.face_count);
}

/// A box in every lane, its high side moved out by the margin.
struct Limits {
  Numbers low[3], high[3];
};

HWY_INLINE Limits limits(const Aabb& box, double margin) {
  return {{all(box.low[0]), all(box.low[1]), all(box.low[2])},
          {all(box.high[0] + margin), all(box.high[1] + margin), all(box.high[2] + margin)}};
}
HWY_INLINE Limits limits(const Face_columns& faces, std::size_t face) {
  return {{all(faces.low[0][face]), all(faces.low[1][face]), all(faces.low[2][face])},
          {all(faces.high[0][face]), all(faces.high[1][face]), all(faces.high[2][face])}};
}

/// The lanes in which a face, from the `start`th on, has a box within the margin of another box.
HWY_INLINE Truths near_boxes(const Limits& box, const Face_columns& faces, std::size_t start) {
  const Lanes d;
  const auto near_along = [&](std::size_t axis) HWY_ATTR {
    return hn::And(hn::Le(box.low[axis], hn::LoadU(d, faces.high[axis] + start)),
                   hn::Le(hn::LoadU(d, faces.low[axis] + start), box.high[axis]));
  };
  return hn::And(hn::And(near_along(0), near_along(1)), near_along(2));
}

/// Lists the faces whose boxes are within the margin of a box.
/// @return the limits of these
HWY_INLINE Limits list_near(const Face_columns& faces, const Limits& box, Face_list& list) {
  const Lanes d;
  const auto infinity = all(std::numeric_limits<double>::infinity());
  Limits around;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    around.low[axis] = infinity;
    around.high[axis] = hn::Neg(infinity);
  }
  std::size_t count = 0;
  for (std::size_t start = 0; start < faces.count; start += hn::Lanes(d)) {
    const auto near = near_boxes(box, faces, start);
    count += list_lanes(mask_bits(d, near), start, list.places + count);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto low = hn::IfThenElse(near, hn::Load(d, faces.low[axis] + start), infinity);
      const auto high = hn::IfThenElse(near, hn::Load(d, faces.high[axis] + start), hn::Neg(infinity));
      around.low[axis] = hn::Min(around.low[axis], low);
      around.high[axis] = hn::Max(around.high[axis], high);
    }
  }
  list.count = count;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    around.low[axis] = hn::MinOfLanes(d, around.low[axis]);
    around.high[axis] = hn::MaxOfLanes(d, around.high[axis]);
  }
  return around;
}

HWY_INLINE void copy_listed(const Face_columns& faces, const Face_list& list, bool with_vertices, Face_columns& copy) {
  for (std::size_t f = 0; f < list.count; ++f) {
    const std::size_t place = list.places[f];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      copy.low[axis][f] = faces.low[axis][place];
      copy.high[axis][f] = faces.high[axis][place];
      if (with_vertices) copy.vertices[axis][f] = faces.vertices[axis][place];
    }
  }
  end_columns(copy, list.count);
}

/// The lanes in which a face of b, from the `start`th on, has a vertex of a's face.
HWY_INLINE Truths share_a_vertex(const Face_columns& a, std::size_t face, const Face_columns& b, std::size_t start) {
  const auto p = all(a.vertices[0][face]), q = all(a.vertices[1][face]), r = all(a.vertices[2][face]);
  const auto shares = [&](std::size_t corner) HWY_ATTR {
    const auto vertex = hn::LoadU(Lanes(), b.vertices[corner] + start);
    return hn::Or(hn::Or(hn::Eq(p, vertex), hn::Eq(q, vertex)), hn::Eq(r, vertex));
  };
  return hn::Or(hn::Or(shares(0), shares(1)), shares(2));
}

/// Adds the pairs of a face of a and one of b, from the `first`th on, whose boxes are within the margin.
/// @param count  of the pairs listed so far
/// @return the same with these
HWY_INLINE std::size_t list_near_pairs(const Face_columns& a, std::size_t face, const Face_columns& b,
                                       std::size_t first, bool skip_neighbours, std::size_t count,
                                       Leaf_scratch& scratch) {
  const Lanes d;
  const Limits box = limits(a, face);
  for (std::size_t start = first; start < b.count; start += hn::Lanes(d)) {
    auto near = near_boxes(box, b, start);
    if (skip_neighbours && !hn::AllFalse(d, near)) near = hn::AndNot(share_a_vertex(a, face, b, start), near);
    repeat_byte(face, scratch.pairs_a + count);
    count += list_lanes(mask_bits(d, near), start, scratch.pairs_b + count);
  }
  return count;
}

/// Takes the listed pairs that floating point does not prove apart, as many at a time as a vector has lanes.
/// @param places_b  of b's faces by their numbers in the list; null: the same
/// @return their number
HWY_INLINE std::size_t keep_not_apart(const Leaf_view& a, const Leaf_view& b, const std::uint8_t* places_b,
                                      const Leaf_request& request, std::size_t count, Leaf_scratch& scratch,
                                      Face_places* near) {
  if (count == 0) return 0;
  const Lanes d;
  // The last vector is filled up with the last pair.
  repeat_byte(scratch.pairs_a[count - 1], scratch.pairs_a + count);
  repeat_byte(scratch.pairs_b[count - 1], scratch.pairs_b + count);
  std::size_t kept = 0;
  for (std::size_t first = 0; first < count; first += hn::Lanes(d)) {
    Face_places places[widest];
    Lane_faces faces_a{a.faces->positions, {}}, faces_b{b.faces->positions, {}};
    for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
      const std::uint8_t place_b = scratch.pairs_b[first + lane];
      places[lane] = {scratch.pairs_a[first + lane], places_b == nullptr ? place_b : places_b[place_b]};
      faces_a.corners[lane] = a.corners + places[lane].a;
      faces_b.corners[lane] = b.corners + places[lane].b;
    }
    const Vector3 corners_a[]{load_corner(faces_a, 0), load_corner(faces_a, 1), load_corner(faces_a, 2)};
    const Vector3 corners_b[]{load_corner(faces_b, 0), load_corner(faces_b, 1), load_corner(faces_b, 2)};
    Numbers crossing;
    const auto left = not_proven_apart(corners_a, corners_b, request.margin, request.one_mesh,
                                       hn::FirstN(d, count - first), crossing);
    alignas(64) double crossings[widest];
    hn::Store(crossing, d, crossings);
    for (unsigned bits = mask_bits(d, left); bits != 0; bits &= bits - 1) {
      const std::size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(bits);
      near[kept] = places[lane];
      near[kept++].crossing = static_cast<std::uint8_t>(crossings[lane]);
    }
  }
  return kept;
}

HWY_INLINE std::size_t near_faces_of_one_leaf(const Leaf_view& leaf, const Leaf_request& request, Leaf_scratch& scratch,
                                              Face_places* near) {
  const Face_columns& faces = *leaf.faces;
  std::size_t count = 0;
  for (std::size_t f = 0; f < faces.count; ++f) count = list_near_pairs(faces, f, faces, f + 1, true, count, scratch);
  return keep_not_apart(leaf, leaf, nullptr, request, count, scratch, near);
}

HWY_INLINE std::size_t near_faces_of_two_leaves(const Leaf_view& a, const Leaf_view& b, const Leaf_request& request,
                                                Leaf_scratch& scratch, Face_places* near) {
  const Limits limits_a = list_near(*a.faces, limits(*b.box, request.margin), scratch.near_a);
  if (scratch.near_a.count == 0) return 0;
  if (b.faces->count == 0) pose(b, request);
  const Limits limits_b = list_near(*b.faces, limits_a, scratch.near_b);
  if (scratch.near_b.count == 0) return 0;
  copy_listed(*b.faces, scratch.near_b, request.one_mesh, scratch.b);
  list_near(*a.faces, limits_b, scratch.near_a);
  std::size_t count = 0;
  for (std::size_t i = 0; i < scratch.near_a.count; ++i)
    count = list_near_pairs(*a.faces, scratch.near_a.places[i], scratch.b, 0, request.one_mesh, count, scratch);
  return keep_not_apart(a, b, scratch.near_b.places, request, count, scratch, near);
}

std::size_t near_faces_kernel(const Leaf_view& a, const Leaf_view& b, const Leaf_request& request,
                              Leaf_scratch& scratch, Face_places* near) {
  if (a.faces->count == 0) pose(a, request);
  return request.one_leaf ? near_faces_of_one_leaf(a, request, scratch, near)
                          : near_faces_of_two_leaves(a, b, request, scratch, near);
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(near_faces_kernel);

std::size_t near_faces(const Leaf_view& a, const Leaf_view& b, const Leaf_request& request, Leaf_scratch& scratch,
                       Face_places* near) {
  return HWY_DYNAMIC_DISPATCH(near_faces_kernel)(a, b, request, scratch, near);
}

}  // namespace lodestone::kernel
#endif
