// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <cstddef>
#include <vector>

#include "lodestone/filter/face_filter.h"
#include "lodestone/mesh/pairs.h"
#include "lodestone/queries/leaf_triangle.h"
#include "lodestone/tree/tree_view.h"
#include "lodestone/tree/tree_walk.h"
#include "lodestone/triangles/triangle_distance.h"
#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

/// A function that is called once with each contact, in no particular order, and answers whether the walk goes on.
/// 'Yes or no', 'the first', 'all' and 'how many' are four visitors of one walk.
template <class Visitor>
concept Contact_visitor = requires(Visitor& visitor, Face_pair pair) {
  { visitor(pair) } -> std::same_as<Visit>;
};

/// Visits the contacts of two trees, or of one tree with itself: a Tree_walk lists candidate leaf pairs, a Face_filter
/// the candidate face pairs of each, and exact predicates decide. The contacts are those that testing every face
/// against every other would find.
///
/// O(candidate leaf pairs x their faces). Two surfaces that meet along a curve have about as many candidate leaf pairs
/// as the square root of their faces.
///
/// It is reused: it keeps its memory from one walk to the next. Each thread needs one of its own.
template <Bounding_volume Volume>
class Contact_walk {
 public:
  using View = Basic_tree_view<Volume>;  ///< a tree with its coordinates

  /// A walk over two trees, from their roots. Neither trees nor coordinates may change before the last `run`.
  /// @param distance  0: contacts are the face pairs that intersect; > 0: those nearer than this, in units of the
  ///                  coordinates
  void begin(const View& a, const View& b, double distance) {
    a_ = a, b_ = b;
    distance_ = distance;
    rest_ = {};
    filter_begun_ = false;
    walk_.begin(*a.tree, *b.tree, distance);
    exact_tests_ = 0;
  }
  /// Self-walk: contacts are the face pairs a < b that share no vertex, and that intersect, or are nearer than
  /// `distance` without having been near at rest: see `near_at_rest`.
  /// @param rest  where the vertices are at rest; empty: no pair has been near
  void begin_within(const View& view, double distance = 0, Coordinates rest = {}) {
    begin(view, view, distance);
    walk_.begin_within(*view.tree, distance);
    if (distance > 0) rest_ = rest;
  }
  /// Starts anew in the same trees: only the contacts below one node pair will be visited. Resets the counts.
  void start(Node_pair from = root_pair) {
    walk_.start(from);
    exact_tests_ = 0;
  }

  /// Visits contacts until the visitor stops the walk, the budget is used up, or none is left. After a pause the next
  /// `run` goes on with the next leaf pair: if the visitor stopped the walk, the remaining contacts of its leaf pair
  /// are not visited.
  /// @param budget  most leaf pairs to test
  /// @return stop if the visitor or the budget ended this run, even after the last leaf pair; else go_on
  template <Contact_visitor Visitor>
  Visit run(Visitor&& visitor, std::size_t budget = no_budget) {
    if (!filter_begun_) begin_filter();
    return walk_.run(
        [&](std::uint32_t leaf_a, std::uint32_t leaf_b) { return visit_leaf_contacts(leaf_a, leaf_b, visitor); },
        budget);
  }

  /// Whether no leaf pair is left.
  bool done() const { return walk_.done(); }
  /// Leaf pairs tested since `start`.
  std::size_t leaf_tests() const { return walk_.leaf_tests(); }
  /// Face pairs given to exact predicates since `start`.
  std::size_t exact_tests() const { return exact_tests_; }

  /// Cuts the rest of the walk into parts and ends it: see `Tree_walk::split`.
  void split(std::size_t more, std::vector<Node_pair>& starts) { walk_.split(more, starts); }

 private:
  /// Not part of `begin`: of several walks that share a search, only those that run pay for it.
  void begin_filter() {
    if (walk_.self_walk())
      filter_.begin_within(a_, distance_);
    else
      filter_.begin(a_, b_, distance_);
    filter_begun_ = true;
  }

  template <class Visitor>
  Visit visit_leaf_contacts(std::uint32_t leaf_a, std::uint32_t leaf_b, Visitor& visitor);

  /// Of faces that were near at rest only those count that intersect.
  bool is_contact(std::uint32_t leaf_a, std::uint32_t leaf_b, const Face_candidate& candidate,
                  const Triangle_corners& a, const Triangle_corners& b) const {
    if (rest_.empty()) return are_in_contact(a, b, distance_, candidate.crossing);
    const Triangle_corners rest_a = leaf_triangle(a_.tree->leaf_faces(leaf_a, rest_), candidate.a);
    const Triangle_corners rest_b = leaf_triangle(a_.tree->leaf_faces(leaf_b, rest_), candidate.b);
    if (corners_nearer_than(rest_a, rest_b, 2 * distance_))
      return boxes_meet(a, b) && triangles_intersect_given(a, b, candidate.crossing);
    return are_in_contact(a, b, distance_, candidate.crossing) &&
           (!near_at_rest(rest_a, rest_b) || triangles_intersect(triangle_of(a), triangle_of(b)));
  }

  /// Whether two faces of one object were nearer than twice the distance at rest. With once the distance, faces that
  /// have always been near would become contacts wherever the surface shrinks a little. Twice hides no fold: beside a
  /// crease of less than 60 degrees there are points within the distance that were farther than twice that apart.
  bool near_at_rest(const Triangle_corners& rest_a, const Triangle_corners& rest_b) const {
    return triangles_nearer_than(triangle_of(rest_a), triangle_of(rest_b), 2 * distance_);
  }

  View a_, b_;
  double distance_ = 0;
  Coordinates rest_ = {};  ///< empty: all contacts count
  Tree_walk<Volume> walk_;
  Face_filter filter_;
  /// Whether the filter has been told of the current trees. What it has read of their leaves holds until `begin`.
  bool filter_begun_ = false;
  std::size_t exact_tests_ = 0;
};

template <Bounding_volume Volume>
template <class Visitor>
Visit Contact_walk<Volume>::visit_leaf_contacts(std::uint32_t leaf_a, std::uint32_t leaf_b, Visitor& visitor) {
  const Leaf_faces faces_a = a_.tree->leaf_faces(leaf_a, a_.coordinates);
  const Leaf_faces faces_b = b_.tree->leaf_faces(leaf_b, b_.coordinates);
  const auto indices_a = a_.tree->faces(leaf_a), indices_b = b_.tree->faces(leaf_b);
  for (const Face_candidate& candidate : filter_.face_candidates(leaf_a, leaf_b)) {
    ++exact_tests_;
    const Triangle_corners a = leaf_triangle(faces_a, candidate.a), b = leaf_triangle(faces_b, candidate.b);
    if (!is_contact(leaf_a, leaf_b, candidate, a, b)) continue;
    Face_pair contact{indices_a[candidate.a], indices_b[candidate.b]};
    if (walk_.self_walk() && contact.b < contact.a) std::swap(contact.a, contact.b);
    if (visitor(contact) == Visit::stop) return Visit::stop;
  }
  return Visit::go_on;
}

/// Visits all contacts of two trees: the face pairs, one face of a and one of b, that intersect (`distance` = 0) or are
/// nearer than `distance`. Exact; the cost is that of a Contact_walk.
/// @param distance  >= 0, in units of the coordinates
/// @return stop if the visitor stopped the walk, else go_on
template <Bounding_volume Volume, Contact_visitor Visitor>
Visit visit_contacts(const Basic_tree_view<Volume>& a, const Basic_tree_view<Volume>& b, double distance,
                     Visitor&& visitor) {
  Contact_walk<Volume> walk;
  walk.begin(a, b, distance);
  return walk.run(visitor);
}

}  // namespace lodestone
