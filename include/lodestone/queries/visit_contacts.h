// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <cstddef>
#include <limits>
#include <vector>

#include "lodestone/filter/face_filter.h"
#include "lodestone/mesh/pairs.h"
#include "lodestone/tree/tree_walk.h"
#include "lodestone/triangles/triangle_distance.h"
#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

/// What is called with each face pair that is found, once, in no particular order; it says whether to go on. "Yes or
/// no", "the first", "all" and "how many" are four visitors of one walk.
template <class Visitor>
concept Contact_visitor = requires(Visitor& visitor, Face_pair pair) {
  { visitor(pair) } -> std::same_as<Visit>;
};

/// Memory and counts of walks over trees; one per thread.
struct Tree_walk {
  std::vector<Node_pair> ahead;
  Face_filter face_filter;
  bool resumes = false;  ///< trees, positions and distance are those of the walk before: what was read of leaves holds
  /// The walk stops, with the rest in `ahead`, when `leaf_tests` reaches this.
  std::size_t last_leaf_test = std::numeric_limits<std::size_t>::max();
  std::size_t leaf_tests = 0;   ///< pairs of leaves looked at, since the start
  std::size_t exact_tests = 0;  ///< face pairs given to exact predicates, since the start
};

/// The corners of a face of a leaf.
inline Triangle_corners leaf_corners(const Leaf_faces& leaf, std::size_t place) {
  const auto [p, q, r] = leaf.corners[place];
  return {leaf.position(p), leaf.position(q), leaf.position(r)};
}

/// Visits all pairs of faces, one of a and one of b, that intersect (`distance` = 0) or are nearer than `distance`,
/// exactly: the pairs that checking every face against every other would find.
///
/// The walk starts from the node pairs that the caller has put into `walk.ahead`, {0, 0} being the two roots, and
/// removes those it has been through.
///
/// O(pairs of near leaves x their faces); for two surfaces that meet along a curve about the square root of their size.
template <Bounding_volume Volume, Contact_visitor Visitor>
Visit visit_contacts(const Basic_tree_view<Volume>& a, const Basic_tree_view<Volume>& b, double distance,
                     Tree_walk& walk, Visitor&& visitor) {
  const Layout_view layout_a = a, layout_b = b;
  const auto visit_leaves = [&](std::uint32_t leaf_a, std::uint32_t leaf_b) {
    ++walk.leaf_tests;
    const Leaf_faces faces_a = layout_a.leaf(leaf_a), faces_b = layout_b.leaf(leaf_b);
    const auto numbers_a = a.tree->faces(leaf_a), numbers_b = b.tree->faces(leaf_b);
    for (const auto& places : walk.face_filter.face_candidates(leaf_a, leaf_b)) {
      const Triangle_corners corners_a = leaf_corners(faces_a, places.a);
      const Triangle_corners corners_b = leaf_corners(faces_b, places.b);
      ++walk.exact_tests;
      if (distance > 0 ? !triangles_nearer_than(triangle_of(corners_a), triangle_of(corners_b), distance)
                       : !triangles_intersect_given(corners_a, corners_b, places.crossing))
        continue;
      if (visitor(Face_pair{numbers_a[places.a], numbers_b[places.b]}) == Visit::stop) return Visit::stop;
    }
    return walk.leaf_tests < walk.last_leaf_test ? Visit::go_on : Visit::stop;
  };
  if (!walk.resumes) walk.face_filter.begin(layout_a, layout_b, distance);
  return walk_leaf_pairs(*a.tree, *b.tree, distance, walk.ahead, visit_leaves);
}

/// The whole walk, from the two roots.
template <Bounding_volume Volume, Contact_visitor Visitor>
Visit visit_contacts(const Basic_tree_view<Volume>& a, const Basic_tree_view<Volume>& b, double distance,
                     Visitor&& visitor) {
  Tree_walk walk;
  walk.ahead = {{0, 0}};
  return visit_contacts(a, b, distance, walk, visitor);
}

/// Visits all intersecting pairs of faces of one mesh that share no vertex; pairs have a < b.
template <Bounding_volume Volume, Contact_visitor Visitor>
Visit visit_contacts_within(const Basic_tree_view<Volume>& posed, Tree_walk& walk, Visitor&& visitor) {
  const Layout_view layout = posed;
  const auto visit_leaves = [&](std::uint32_t leaf_a, std::uint32_t leaf_b) {
    ++walk.leaf_tests;
    const Leaf_faces faces_a = layout.leaf(leaf_a), faces_b = layout.leaf(leaf_b);
    const auto numbers_a = posed.tree->faces(leaf_a), numbers_b = posed.tree->faces(leaf_b);
    for (const auto& places : walk.face_filter.face_candidates(leaf_a, leaf_b)) {
      ++walk.exact_tests;
      const Triangle_corners a = leaf_corners(faces_a, places.a), b = leaf_corners(faces_b, places.b);
      if (!triangles_intersect_given(a, b, places.crossing)) continue;
      const auto [first, second] = std::minmax(numbers_a[places.a], numbers_b[places.b]);
      if (visitor(Face_pair{first, second}) == Visit::stop) return Visit::stop;
    }
    return walk.leaf_tests < walk.last_leaf_test ? Visit::go_on : Visit::stop;
  };
  if (!walk.resumes) walk.face_filter.begin_within(layout);
  return walk_leaf_pairs_within(*posed.tree, walk.ahead, visit_leaves);
}

}  // namespace lodestone
