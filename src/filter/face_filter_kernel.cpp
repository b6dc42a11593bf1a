// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter/face_filter_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/face_filter_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "filter/box_axes_cull-inl.h"
#include "filter/box_pairs-inl.h"
#include "filter/face_columns-inl.h"
#include "filter/leaf_box_cull-inl.h"
#include "filter/plane_cull-inl.h"
#include "filter/rounded_cull-inl.h"
#include "filter/rounding-inl.h"
#include "filter/slab_cull-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

/// Lists the pairs whose boxes overlap; if there seem to be many, only of the faces that pass through the box around
/// the other leaf's.
template <Neighbours neighbours>
HWY_INLINE std::size_t list_pairs_at(const Leaf_input& a, const Leaf_input& b, const Rounding& rounding,
                                     Filter_scratch& scratch) {
  if (box_axes_cull_pays(a, b, scratch) && !cull_by_box_axes(a, b, rounding, scratch)) return 0;
  return list_box_pairs<neighbours>(*a.faces, *b.faces, scratch);
}

/// Leaves of two meshes.
HWY_INLINE std::size_t candidates_of_two_meshes(const Leaf_input& a, const Leaf_input& b, const Filter_request& request,
                                                Filter_scratch& scratch, Face_candidate* candidates) {
  round_corners(a, request);
  if (!cull_by_leaf_box(a, b, request, scratch)) return 0;
  const Rounding rounding(request, *a.box, *b.box);
  if (slab_cull_pays(scratch) && !cull_by_slab(a, b, rounding, scratch)) return 0;
  const std::size_t pairs = list_pairs_at<Neighbours::kept>(a, b, rounding, scratch);
  if (request.margin > 0) {
    const std::size_t left = cull_by_rounded_planes(a, b, rounding, pairs, scratch);
    return cull_by_plane(a, b, request, left, scratch, candidates);
  }
  const auto [crossing, unclear] = sort_by_rounded_corners(a, b, rounding, pairs, scratch, candidates);
  return crossing + cull_by_plane(a, b, request, unclear, scratch, candidates + crossing);
}

/// Two leaves of one mesh. No slabs: neighbouring leaves lie within the slab of each other.
HWY_INLINE std::size_t candidates_of_one_mesh(const Leaf_input& a, const Leaf_input& b, const Filter_request& request,
                                              Filter_scratch& scratch, Face_candidate* candidates) {
  round_corners(a, request);
  if (!cull_by_leaf_box(a, b, request, scratch)) return 0;
  const Rounding rounding(request, *a.box, *b.box);
  const std::size_t pairs = list_pairs_at<Neighbours::discarded>(a, b, rounding, scratch);
  const std::size_t left = cull_by_rounded_planes(a, b, rounding, pairs, scratch);
  return cull_by_plane(a, b, request, left, scratch, candidates);
}

/// A leaf against itself.
HWY_INLINE std::size_t candidates_of_one_leaf(const Leaf_input& leaf, const Filter_request& request,
                                              Filter_scratch& scratch, Face_candidate* candidates) {
  round_corners(leaf, request);
  const Rounding rounding(request, *leaf.box, *leaf.box);
  const std::size_t pairs = list_box_pairs_within(*leaf.faces, scratch);
  const std::size_t left = cull_by_rounded_planes(leaf, leaf, rounding, pairs, scratch);
  return cull_by_plane(leaf, leaf, request, left, scratch, candidates);
}

std::size_t face_candidates_kernel(const Leaf_input& a, const Leaf_input& b, const Filter_request& request,
                                   Filter_scratch& scratch, Face_candidate* candidates) {
  if (request.one_leaf) return candidates_of_one_leaf(a, request, scratch, candidates);
  return request.one_mesh ? candidates_of_one_mesh(a, b, request, scratch, candidates)
                          : candidates_of_two_meshes(a, b, request, scratch, candidates);
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(face_candidates_kernel);

std::size_t face_candidates(const Leaf_input& a, const Leaf_input& b, const Filter_request& request,
                            Filter_scratch& scratch, Face_candidate* candidates) {
  return HWY_DYNAMIC_DISPATCH(face_candidates_kernel)(a, b, request, scratch, candidates);
}

}  // namespace lodestone::kernel
#endif
