// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/bounded_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "lodestone/mesh/errors.h"
#include "lodestone/queries/leaf_triangle.h"
#include "lodestone/triangles/triangle_distance.h"
#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

namespace {

/// The filter needs a finite box around everything.
void bound_whole(Bounded_surface& surface) {
  if (!std::isfinite(surface.box(0).extent())) surface.pose_all();
}

/// How many leaves the node above a node has; no node has more than what is said of the root.
std::uint32_t leaves_above(const Bounded_surface& surface, std::uint32_t node) {
  if (node == 0) return std::numeric_limits<std::uint32_t>::max();
  const Tree_layout::Node& above = surface.layout().node(surface.parent(node));
  return above.end_leaf - above.leaf;
}

/// The other child of the node above a node, which is not the root.
std::uint32_t sibling(const Bounded_surface& surface, std::uint32_t node) {
  const std::uint32_t first = surface.parent(node) + 1;
  return node == first ? surface.layout().node(surface.parent(node)).second_child : first;
}

}  // namespace

Contact_summary Bounded_search::run(Bounded_surface& a, Bounded_surface& b, const Contact_request& request,
                                    std::vector<Face_pair>& found, std::optional<Leaf_pair>* place) {
  const std::size_t limit = contact_limit(request);
  const bool from_place = place != nullptr && request.query == Contact_query::yes_no;
  begin(a, b, request.tolerance, limit < std::numeric_limits<std::size_t>::max());
  End end;
  do {
    settle_broken();
    contacts_.found.clear();
    start_at(from_place ? *place : std::nullopt);
    end = walk(true, [&](Face_pair contact) {
      contacts_.found.push_back(contact);
      return contacts_.found.size() < limit ? Visit::go_on : Visit::stop;
    });
  } while (end == End::broken);
  contacts_.leaf_tests = leaf_tests_;
  contacts_.exact_tests = exact_tests_;
  if (end != End::all_posed) {
    if (from_place) *place = contacts_.found.empty() ? std::nullopt : std::optional(tested_);
    return join_tasks(std::span(&contacts_, 1), request, found);
  }
  Contact_summary summary = whole_.between(a.tree(), b.tree(), request, found);
  if (from_place && !summary.found) place->reset();
  summary.leaf_tests += leaf_tests_;
  summary.exact_tests += exact_tests_;
  return summary;
}

Visit Bounded_search::visit(Bounded_surface& a, Bounded_surface& b, double tolerance,
                            const std::function<Visit(Face_pair)>& visitor) {
  begin(a, b, tolerance, true);
  std::vector<Face_pair> shown;  // each once; those of earlier walks sorted
  std::size_t of_earlier_walks = 0;
  const auto show = [&](Face_pair contact) {
    if (std::binary_search(shown.begin(), shown.begin() + static_cast<std::ptrdiff_t>(of_earlier_walks), contact))
      return Visit::go_on;
    shown.push_back(contact);
    return visitor(contact);
  };
  End end;
  do {
    settle_broken();
    std::ranges::sort(shown);
    of_earlier_walks = shown.size();
    start_at({});
    end = walk(false, show);
  } while (end == End::broken);
  return end == End::stopped ? Visit::stop : Visit::go_on;
}

void Bounded_search::begin(Bounded_surface& a, Bounded_surface& b, double tolerance, bool is_ordered) {
  if (!(tolerance >= 0) || !std::isfinite(tolerance)) throw Bad_argument("the tolerance must be finite and >= 0");
  a_ = &a, b_ = &b;
  tolerance_ = tolerance;
  is_ordered_ = is_ordered;
  leaf_tests_ = exact_tests_ = 0;
  a.start_frame();
  b.start_frame();
  bound_whole(a);
  bound_whole(b);
}

void Bounded_search::settle_broken() {
  if (a_->is_broken()) a_->settle();
  if (b_->is_broken()) b_->settle();
}

/// Has the walk begin with two leaves, go on with what lies beside them in the trees, and end with what lies beside the
/// largest nodes above them; without leaves, or if the roots are not near, begin with the roots.
void Bounded_search::start_at(const std::optional<Leaf_pair>& place) {
  const Tree_layout &layout_a = a_->layout(), &layout_b = b_->layout();
  waiting_.assign(1, root_pair);
  if (!place || place->a >= layout_a.leaf_count() || place->b >= layout_b.leaf_count() || !are_near(root_pair)) return;
  Node_pair listed{layout_a.leaf_node(place->a), layout_b.leaf_node(place->b)};
  waiting_.assign(1, listed);
  while (listed.a != 0 || listed.b != 0) {
    // All that lies below `listed` is in the list. Of the two nodes above it, the smaller takes its place.
    if (leaves_above(*a_, listed.a) <= leaves_above(*b_, listed.b)) {
      waiting_.push_back({sibling(*a_, listed.a), listed.b});
      listed.a = a_->parent(listed.a);
    } else {
      waiting_.push_back({listed.a, sibling(*b_, listed.b)});
      listed.b = b_->parent(listed.b);
    }
  }
  std::ranges::reverse(waiting_);
}

/// @param until_all_posed  end as soon as both surfaces are posed as a whole
/// @return broken: what was visited is not all
/// @pre `start_at` has said where
template <class Visitor>
Bounded_search::End Bounded_search::walk(bool until_all_posed, Visitor&& visitor) {
  filter_of_a_ = {};
  const Tree_layout &layout_a = a_->layout(), &layout_b = b_->layout();
  while (!waiting_.empty()) {
    if (is_broken()) return End::broken;
    if (until_all_posed && all_posed()) return End::all_posed;
    const Node_pair pair = waiting_.back();
    waiting_.pop_back();
    if (!are_near(pair)) continue;  // some leaf may have been posed since, so boxes may be smaller
    if (!layout_a.is_leaf(pair.a) || !layout_b.is_leaf(pair.b)) {
      open_pair(layout_a, layout_b, pair, a_->box(pair.a).extent() >= b_->box(pair.b).extent(), waiting_);
      if (is_ordered_) deeper_first();
      continue;
    }
    const End end = test_leaves(layout_a.node(pair.a).leaf, layout_b.node(pair.b).leaf, visitor);
    if (end == End::stopped) return end;  // even if a bound is broken: the contacts are there
  }
  return is_broken() ? End::broken : End::complete;
}

/// Of the two pairs that were pushed last, visits that first whose boxes lie deeper in each other, along the axis on
/// which they do least: if not all contacts are wanted, one is likelier to be there.
void Bounded_search::deeper_first() {
  const auto depth = [&](Node_pair pair) {
    const Aabb &of_a = a_->box(pair.a), &of_b = b_->box(pair.b);
    double least = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis)
      least = std::min(least, std::min(of_a.high[axis], of_b.high[axis]) - std::max(of_a.low[axis], of_b.low[axis]));
    return least;
  };
  Node_pair *const first = &waiting_.back(), *const second = first - 1;
  if (depth(*second) > depth(*first)) std::swap(*first, *second);
}

/// @return stopped, or complete
template <class Visitor>
Bounded_search::End Bounded_search::test_leaves(std::uint32_t leaf_a, std::uint32_t leaf_b, Visitor& visitor) {
  // The fitted box of one leaf can spare posing the other.
  const bool a_first = a_->is_posed(leaf_a) || !b_->is_posed(leaf_b);
  const bool apart = a_first ? !near(a_->pose(leaf_a), b_->box(b_->layout().leaf_node(leaf_b)), tolerance_)
                             : !near(a_->box(a_->layout().leaf_node(leaf_a)), b_->pose(leaf_b), tolerance_);
  if (apart || !near(a_->pose(leaf_a), b_->pose(leaf_b), tolerance_) || is_broken()) return End::complete;
  ++leaf_tests_;
  tested_ = {leaf_a, leaf_b};
  begin_filter();
  const Leaf_faces faces_a = a_->view().leaf(leaf_a), faces_b = b_->view().leaf(leaf_b);
  const auto indices_a = a_->layout().faces(leaf_a), indices_b = b_->layout().faces(leaf_b);
  for (const Face_candidate& candidate : filter_.face_candidates(leaf_a, leaf_b)) {
    ++exact_tests_;
    if (!are_in_contact(leaf_triangle(faces_a, candidate.a), leaf_triangle(faces_b, candidate.b), candidate.crossing))
      continue;
    if (visitor({indices_a[candidate.a], indices_b[candidate.b]}) == Visit::stop) return End::stopped;
  }
  return End::complete;
}

/// Once for the positions in each memory: a surface that is posed as a whole can have them elsewhere.
void Bounded_search::begin_filter() {
  const Coordinates of_a = a_->tree().coordinates(), of_b = b_->tree().coordinates();
  if (of_a.data() == filter_of_a_.data() && of_b.data() == filter_of_b_.data()) return;
  filter_.begin(a_->view(), b_->view(), tolerance_);
  filter_of_a_ = of_a, filter_of_b_ = of_b;
}

bool Bounded_search::are_in_contact(const Triangle_corners& a, const Triangle_corners& b, Crossing likely) const {
  return tolerance_ > 0 ? triangles_nearer_than(triangle_of(a), triangle_of(b), tolerance_)
                        : triangles_intersect_given(a, b, likely);
}

}  // namespace lodestone
