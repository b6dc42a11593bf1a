// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/leaf_pair_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contact/leaf_pair_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "contact/corner_columns-inl.h"
#include "contact/near_boxes-inl.h"
#include "contact/position_vectors-inl.h"
#include "contact/separation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

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

/// A box as faces are compared by: its high side moved out by the margin, in the request's unit, seen from its origin,
/// and rounded.
///
/// All boxes are rounded alike, and neither of these steps can reverse the order of two numbers: boxes that are within
/// the margin of each other stay so, whatever is lost.
struct Rounded_box {
  float low[4], high[4];
};

HWY_INLINE Rounded_box rounded(const Leaf_request& request, const hn::Vec<D> (&low)[vectors],
                               const hn::Vec<D> (&high)[vectors]) {
  const D d;
  const hn::Rebind<float, D> to;
  Rounded_box box;
  for (std::size_t i = 0; i < vectors; ++i) {
    const auto round = [&](hn::Vec<D> side) HWY_ATTR {
      const auto from_origin = hn::Sub(side, hn::LoadU(d, request.origin + i * lanes));
      return hn::DemoteTo(to, hn::Mul(from_origin, hn::Set(d, request.scale)));
    };
    hn::StoreU(round(low[i]), to, box.low + i * lanes);
    hn::StoreU(round(hn::Add(high[i], hn::Set(d, request.margin))), to, box.high + i * lanes);
  }
  return box;
}

HWY_INLINE Rounded_box box_of(const Leaf_request& request, const Leaf_corners& corners, const double (*positions)[4]) {
  const D d;
  hn::Vec<D> low[vectors], high[vectors];
  for (std::size_t i = 0; i < vectors; ++i) {
    const auto p = hn::Load(d, positions[corners[0]] + i * lanes);
    const auto q = hn::Load(d, positions[corners[1]] + i * lanes);
    const auto r = hn::Load(d, positions[corners[2]] + i * lanes);
    low[i] = hn::Min(hn::Min(p, q), r);
    high[i] = hn::Max(hn::Max(p, q), r);
  }
  return rounded(request, low, high);
}

HWY_INLINE Limits limits(const Leaf_request& request, const Aabb& box) {
  const D d;
  hn::Vec<D> low[vectors], high[vectors];
  for (std::size_t i = 0; i < vectors; ++i) {
    low[i] = hn::Load(d, box.low + i * lanes);
    high[i] = hn::Load(d, box.high + i * lanes);
  }
  const Rounded_box box_rounded = rounded(request, low, high);
  return limits(box_rounded.low, box_rounded.high);
}

/// Fills in where the faces of a leaf are.
HWY_INLINE void pose(const Leaf_view& leaf, const Leaf_request& request) {
  Face_columns& faces = *leaf.faces;
  copy_positions(leaf, faces.positions);
  for (std::size_t f = 0; f < leaf.face_count; ++f) {
    const Rounded_box box = box_of(request, leaf.corners[f], faces.positions);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      faces.low[axis][f] = box.low[axis];
      faces.high[axis][f] = box.high[axis];
    }
  }
  if (request.one_mesh)
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (std::size_t f = 0; f < leaf.face_count; ++f)
        faces.vertices[corner][f] = leaf.vertices[leaf.corners[f][corner]];
  end_columns(faces, leaf.face_count);
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
    // All places of the list are written, whatever their number: no branch could foretell it.
    std::uint8_t left_lanes[widest];
    const std::size_t left_count = list_eight(mask_bits(d, left), 0, left_lanes);
    for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
      near[kept + i] = places[left_lanes[i]];
      near[kept + i].crossing = static_cast<std::uint8_t>(crossings[left_lanes[i]]);
    }
    kept += left_count;
  }
  return kept;
}

/// Lists the pairs of different faces of a leaf whose boxes are near, and that share no vertex.
/// @return their number
HWY_INLINE std::size_t list_pairs_within(const Face_columns& faces, Leaf_scratch& scratch) {
  std::size_t count = 0;
  for (std::size_t f = 0; f < faces.count; ++f) count = list_near_pairs(faces, f, faces, f + 1, true, count, scratch);
  return count;
}

/// Lists the pairs of one of a's listed faces and one of b's whose boxes are near.
/// @return their number
template <bool one_mesh>
HWY_INLINE std::size_t list_pairs(const Face_columns& a, const Face_list& near_a, const Face_columns& b,
                                  Leaf_scratch& scratch) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < near_a.count; ++i)
    count = list_near_pairs(a, near_a.places[i], b, 0, one_mesh, count, scratch);
  return count;
}

HWY_INLINE std::size_t near_faces_of_one_leaf(const Leaf_view& leaf, const Leaf_request& request, Leaf_scratch& scratch,
                                              Face_places* near) {
  const std::size_t count = list_pairs_within(*leaf.faces, scratch);
  return keep_not_apart(leaf, leaf, nullptr, request, count, scratch, near);
}

HWY_INLINE std::size_t near_faces_of_two_leaves(const Leaf_view& a, const Leaf_view& b, const Leaf_request& request,
                                                Leaf_scratch& scratch, Face_places* near) {
  const Limits limits_a = list_near(*a.faces, limits(request, *b.box), scratch.near_a);
  if (scratch.near_a.count == 0) return 0;
  if (b.faces->count == 0) pose(b, request);
  const Limits limits_b = request.one_mesh ? list_near<true>(*b.faces, limits_a, scratch.near_b, &scratch.b)
                                           : list_near<false>(*b.faces, limits_a, scratch.near_b, &scratch.b);
  if (scratch.near_b.count == 0) return 0;
  list_near(*a.faces, limits_b, scratch.near_a);
  const std::size_t count = request.one_mesh ? list_pairs<true>(*a.faces, scratch.near_a, scratch.b, scratch)
                                             : list_pairs<false>(*a.faces, scratch.near_a, scratch.b, scratch);
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
