// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/bounded_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

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
  starts_.assign(1, root_pair);
  if (!place || place->a >= layout_a.leaf_count() || place->b >= layout_b.leaf_count() || !are_near(root_pair)) return;
  Node_pair listed{layout_a.leaf_node(place->a), layout_b.leaf_node(place->b)};
  starts_.assign(1, listed);
  while (listed.a != 0 || listed.b != 0) {
    // All that lies below `listed` is in the list. Of the two nodes above it, the smaller takes its place.
    if (leaves_above(*a_, listed.a) <= leaves_above(*b_, listed.b)) {
      starts_.push_back({sibling(*a_, listed.a), listed.b});
      listed.a = a_->parent(listed.a);
    } else {
      starts_.push_back({listed.a, sibling(*b_, listed.b)});
      listed.b = b_->parent(listed.b);
    }
  }
}

/// @param until_all_posed  end as soon as both surfaces are posed as a whole
/// @return all_posed: pairs are still waiting; broken: what was visited is not all
/// @pre `start_at` has said where
template <class Visitor>
Bounded_search::End Bounded_search::walk(bool until_all_posed, Visitor&& visitor) {
  filter_of_a_ = {};
  for (const Node_pair start : starts_) {
    waiting_.assign(1, start);
    // How many pairs at the bottom of the list are to be compared: the start, or those listed before the last leaf was
    // posed, which makes boxes smaller.
    std::size_t unsure = 1;
    while (!waiting_.empty()) {
      if (is_broken()) return End::broken;
      if (until_all_posed && all_posed()) return End::all_posed;
      const Node_pair pair = waiting_.back();
      waiting_.pop_back();
      if (waiting_.size() < unsure) {
        unsure = waiting_.size();
        if (!are_near(pair)) continue;
      }
      if (!a_->layout().is_leaf(pair.a) || !b_->layout().is_leaf(pair.b)) {
        open(pair);
        continue;
      }
      // A contact is one even if a bound is broken.
      if (test_leaves(pair, visitor) == End::stopped) return End::stopped;
      unsure = waiting_.size();
    }
  }
  return is_broken() ? End::broken : End::complete;
}

/// Lists the two pairs one level below a pair, if they are near. If both are and not all contacts are wanted, the pair
/// whose boxes overlap more deeply is visited first: a contact is likelier there.
void Bounded_search::open(Node_pair pair) {
  const bool a_is_larger = a_->box(pair.a).extent() >= b_->box(pair.b).extent();
  const auto [first, second] = pairs_below(a_->layout(), b_->layout(), pair, a_is_larger);
  const bool first_is_near = are_near(first), second_is_near = are_near(second);
  if (first_is_near && second_is_near) {
    const bool swap = is_ordered_ && overlap_depth(second) > overlap_depth(first);
    waiting_.push_back(swap ? first : second);
    waiting_.push_back(swap ? second : first);
  } else if (first_is_near || second_is_near) {
    waiting_.push_back(first_is_near ? first : second);
  }
}

/// How far two boxes overlap, along the axis on which they do least.
double Bounded_search::overlap_depth(Node_pair pair) {
  const Aabb &a = a_->box(pair.a), &b = b_->box(pair.b);
  double least = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double end = a.high[axis] < b.high[axis] ? a.high[axis] : b.high[axis];
    const double begin = a.low[axis] > b.low[axis] ? a.low[axis] : b.low[axis];
    const double common = end - begin;
    least = common < least ? common : least;
  }
  return least;
}

/// @return stopped, or complete
template <class Visitor>
Bounded_search::End Bounded_search::test_leaves(Node_pair pair, Visitor& visitor) {
  const std::uint32_t leaf_a = a_->layout().node(pair.a).leaf, leaf_b = b_->layout().node(pair.b).leaf;
  // The fitted box of one leaf can spare posing the other.
  const bool a_first = a_->is_posed(leaf_a) || !b_->is_posed(leaf_b);
  const bool apart = a_first ? !near(a_->pose(leaf_a), b_->box(pair.b), tolerance_)
                             : !near(a_->box(pair.a), b_->pose(leaf_b), tolerance_);
  if (apart || !near(a_->pose(leaf_a), b_->pose(leaf_b), tolerance_) || is_broken()) return End::complete;
  ++leaf_tests_;
  tested_ = {leaf_a, leaf_b};
  begin_filter();
  const Leaf_faces faces_a = a_->view().leaf(leaf_a), faces_b = b_->view().leaf(leaf_b);
  const auto indices_a = a_->layout().faces(leaf_a), indices_b = b_->layout().faces(leaf_b);
  for (const Face_candidate& candidate : filter_.face_candidates(leaf_a, leaf_b)) {
    ++exact_tests_;
    if (!are_in_contact(leaf_triangle(faces_a, candidate.a), leaf_triangle(faces_b, candidate.b), tolerance_,
                        candidate.crossing))
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

}  // namespace lodestone
