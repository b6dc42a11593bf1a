// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_PLANE_CULL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_PLANE_CULL_INL_H
#undef LODESTONE_PLANE_CULL_INL_H
#else
#define LODESTONE_PLANE_CULL_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "filter/face_filter_kernel.h"
#include "filter/filter_scratch.h"
#include "filter/pair_list-inl.h"
#include "filter/separation-inl.h"
#include "lodestone/filter/face_candidate.h"
#include "lodestone/triangles/crossing.h"
#include "simd/compress-inl.h"
#include "simd/positions-inl.h"
#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The corners of one face per lane.
struct Lane_corners {
  Vector3<Double_lanes> of[3];
};

/// @param faces  indices in the leaf, one per lane
HWY_INLINE Lane_corners load_corners(const Leaf_input& leaf, const std::uint8_t* faces) {
  const Leaf_corners* corners[double_lanes];
  for (std::size_t lane = 0; lane < double_lanes; ++lane) corners[lane] = leaf.corners + faces[lane];
  const auto load = [&](std::size_t corner) HWY_ATTR {
    return load_positions([&](std::size_t lane) HWY_ATTR {
      return leaf.coordinates + 3 * std::size_t{leaf.vertices[(*corners[lane])[corner]]};
    });
  };
  return {{load(0), load(1), load(2)}};
}

/// Which of the lanes in `asked` floating point does not prove farther apart than the margin (0: without a common
/// point).
/// @param one_mesh  a and b are faces of one mesh
/// @param crossing  set to a `Crossing` per lane
HWY_INLINE Double_mask not_proven_apart(const Lane_corners& a, const Lane_corners& b, double margin, bool one_mesh,
                                        Double_mask asked, Doubles& crossing) {
  const Double_lanes d;
  const auto none = hn::Set(d, double{no_crossing});
  const Two_triangles<Double_lanes> two(a.of, b.of);
  crossing = none;
  auto left = asked;
  // On one surface, or within a margin, planes separate most pairs.
  if (one_mesh || margin > 0) left = not_apart_by_planes(two, two.reach, margin, left);
  if (margin > 0 || hn::AllFalse(d, left)) return left;
  const auto of = determinants(two);
  const auto gap = greatest_gap(of);
  left = hn::AndNot(hn::Gt(gap, telling_gap(two, 1e90)), left);
  crossing = find_crossing(of, gap);
  const auto unclear = hn::And(left, hn::Eq(crossing, none));
  if (one_mesh || hn::AllFalse(d, unclear)) return left;
  // The answer of one lane must not depend on the others: instruction sets have different numbers of lanes.
  return hn::Or(hn::AndNot(unclear, left), not_apart_by_planes(two, two.reach, margin, unclear));
}

/// Makes candidates of the listed pairs that planes do not prove apart, at the corners as they are, in doubles.
/// @return number of candidates
HWY_NOINLINE inline std::size_t cull_by_plane(const Leaf_input& a, const Leaf_input& b, const Filter_request& request,
                                              std::size_t count, Filter_scratch& scratch, Face_candidate* candidates) {
  static_assert(double_lanes <= 8, "lists of eight bits");
  const Double_lanes d;
  if (count == 0) return 0;
  pad_pairs(count, scratch);
  std::size_t kept = 0;
  for (std::size_t first = 0; first < count; first += double_lanes) {
    const std::uint8_t* const pairs_a = scratch.pairs_a + first;
    const std::uint8_t* const pairs_b = scratch.pairs_b + first;
    Doubles crossing;
    const auto left = not_proven_apart(load_corners(a, pairs_a), load_corners(b, pairs_b), request.margin,
                                       request.one_mesh, hn::FirstN(d, count - first), crossing);
    alignas(64) double crossings[most_double_lanes];
    hn::Store(crossing, d, crossings);
    Face_candidate pairs[most_double_lanes];
    for (std::size_t lane = 0; lane < double_lanes; ++lane)
      pairs[lane] = {pairs_a[lane], pairs_b[lane], static_cast<Crossing>(crossings[lane])};
    // How many are left is unpredictable, so branchless: a whole vector of candidates is written.
    std::uint8_t left_lanes[8];
    const std::size_t left_count = list_set_bits(mask_bits(d, left), left_lanes);
    for (std::size_t i = 0; i < double_lanes; ++i) candidates[kept + i] = pairs[left_lanes[i]];
    kept += left_count;
  }
  return kept;
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
