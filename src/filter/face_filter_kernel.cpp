// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter/face_filter_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/face_filter_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "filter/corner_columns-inl.h"
#include "filter/leaf_pose-inl.h"
#include "filter/near_box_pairs-inl.h"
#include "filter/near_boxes-inl.h"
#include "filter/near_slabs-inl.h"
#include "filter/rounded_separation-inl.h"
#include "filter/separation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Takes the listed pairs that floating point does not prove apart, as many at a time as a vector has lanes.
/// @return their number
HWY_INLINE std::size_t keep_not_apart(const Leaf_input& a, const Leaf_input& b, const Filter_request& request,
                                      std::size_t count, Filter_scratch& scratch, Face_candidate* near) {
  if (count == 0) return 0;
  const Lanes d;
  fill_up(count, scratch);
  std::size_t kept = 0;
  for (std::size_t first = 0; first < count; first += hn::Lanes(d)) {
    Face_candidate places[widest];
    Lane_faces faces_a{a.coordinates, a.vertices, {}}, faces_b{b.coordinates, b.vertices, {}};
    for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
      places[lane] = {scratch.pairs_a[first + lane], scratch.pairs_b[first + lane]};
      faces_a.corners[lane] = a.corners + places[lane].a;
      faces_b.corners[lane] = b.corners + places[lane].b;
    }
    const Vector3<Lanes> corners_a[]{load_corner(faces_a, 0), load_corner(faces_a, 1), load_corner(faces_a, 2)};
    const Vector3<Lanes> corners_b[]{load_corner(faces_b, 0), load_corner(faces_b, 1), load_corner(faces_b, 2)};
    Numbers crossing;
    const auto left = not_proven_apart(corners_a, corners_b, request.margin, request.one_mesh,
                                       hn::FirstN(d, count - first), crossing);
    alignas(64) double crossings[widest];
    hn::Store(crossing, d, crossings);
    // All places of the list are written, whatever their number: no branch could foretell it.
    std::uint8_t left_lanes[widest];
    const std::size_t left_count = list_eight(mask_bits(d, left), left_lanes);
    for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
      near[kept + i] = places[left_lanes[i]];
      near[kept + i].crossing = static_cast<std::uint8_t>(crossings[left_lanes[i]]);
    }
    kept += left_count;
  }
  return kept;
}

/// The same for pairs of which planes separate most: faces of one mesh, or within a margin of each other.
HWY_INLINE std::size_t keep_not_apart_by_planes(const Leaf_input& a, const Leaf_input& b, const Filter_request& request,
                                                const Rounding& rounding, std::size_t count, Filter_scratch& scratch,
                                                Face_candidate* near) {
  const std::size_t left = drop_apart_by_rounded_planes(a, b, rounding, count, scratch);
  return keep_not_apart(a, b, request, left, scratch, near);
}

template <bool one_mesh>
HWY_INLINE std::size_t candidates_of_two_leaves(const Leaf_input& a, const Leaf_input& b, const Filter_request& request,
                                                Filter_scratch& scratch, Face_candidate* near) {
  Limits near_a, near_b;
  if (!any_near(*a.faces, limits_of_leaf(b, request), near_a)) return 0;
  if (b.faces->count == 0) pose(b, request);
  if (!list_near(*b.faces, near_a, scratch.near_b, near_b)) return 0;
  if (!list_near(*a.faces, near_b, scratch.near_a)) return 0;
  const Rounding rounding(request, *a.box, *b.box);
  // Neighbouring leaves of one mesh lie within the slab of each other.
  if (!one_mesh && slabs_pay(scratch) && !keep_within_slabs(a, b, rounding, scratch)) return 0;
  const std::size_t count = list_pairs<one_mesh>(*a.faces, *b.faces, scratch);
  if (one_mesh || request.margin > 0) return keep_not_apart_by_planes(a, b, request, rounding, count, scratch, near);
  const auto [crossing, unclear] = sort_by_rounded_corners(a, b, rounding, count, scratch, near);
  return crossing + keep_not_apart(a, b, request, unclear, scratch, near + crossing);
}

std::size_t face_candidates_kernel(const Leaf_input& a, const Leaf_input& b, const Filter_request& request,
                                   Filter_scratch& scratch, Face_candidate* near) {
  if (a.faces->count == 0) pose(a, request);
  if (request.one_leaf) {
    const std::size_t count = list_pairs_within(*a.faces, scratch);
    return keep_not_apart_by_planes(a, a, request, Rounding(request, *a.box, *a.box), count, scratch, near);
  }
  return request.one_mesh ? candidates_of_two_leaves<true>(a, b, request, scratch, near)
                          : candidates_of_two_leaves<false>(a, b, request, scratch, near);
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(face_candidates_kernel);

std::size_t face_candidates(const Leaf_input& a, const Leaf_input& b, const Filter_request& request,
                            Filter_scratch& scratch, Face_candidate* near) {
  return HWY_DYNAMIC_DISPATCH(face_candidates_kernel)(a, b, request, scratch, near);
}

}  // namespace lodestone::kernel
#endif
