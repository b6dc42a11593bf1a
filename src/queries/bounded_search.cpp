// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/bounded_search.h"

#include <cmath>
#include <span>

#include "lodestone/mesh/errors.h"
#include "lodestone/queries/face_pair_order.h"
#include "lodestone/queries/leaf_triangle.h"
#include "lodestone/triangles/triangle_distance.h"
#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

namespace {

/// The filter needs a finite box around everything.
void bound_whole(Bounded_surface& surface) {
  if (!std::isfinite(surface.box(0).extent())) surface.pose_all();
}

}  // namespace

Contact_summary Bounded_search::run(Bounded_surface& a, Bounded_surface& b, Contact_query query,
                                    std::vector<Face_pair>& found, double tolerance) {
  if (!(tolerance >= 0) || !std::isfinite(tolerance)) throw Bad_argument("the tolerance must be finite and >= 0");
  a_ = &a, b_ = &b;
  tolerance_ = tolerance;
  one_is_enough_ = query != Contact_query::all;
  leaf_tests_ = exact_tests_ = 0;
  a.start_frame();
  b.start_frame();
  bound_whole(a);
  bound_whole(b);
  const std::size_t first = found.size();
  do {
    found.resize(first);
    if (a.is_broken()) a.settle();
    if (b.is_broken()) b.settle();
  } while (!search(found));
  const Contact_summary summary{.found = found.size() > first, .leaf_tests = leaf_tests_, .exact_tests = exact_tests_};
  if (query == Contact_query::yes_no) found.resize(first);
  sort_face_pairs(std::span(found).subspan(first));
  return summary;
}

/// @return false if a bound was broken: what was found is not all
bool Bounded_search::search(std::vector<Face_pair>& found) {
  filter_begun_ = false;
  waiting_.assign(1, root_pair);
  const Tree_layout &layout_a = a_->layout(), &layout_b = b_->layout();
  while (!waiting_.empty()) {
    const Node_pair pair = waiting_.back();
    waiting_.pop_back();
    const Aabb box_a = a_->box(pair.a), box_b = b_->box(pair.b);
    if (!near(box_a, box_b, tolerance_)) continue;
    if (!layout_a.is_leaf(pair.a) || !layout_b.is_leaf(pair.b)) {
      open_pair(layout_a, layout_b, pair, box_a.extent() >= box_b.extent(), waiting_);
      continue;
    }
    const bool met = test_leaves(layout_a.node(pair.a).leaf, layout_b.node(pair.b).leaf, found);
    if (met && one_is_enough_) return true;  // even if a bound is broken: the contact is there
    if (is_broken()) return false;
  }
  return true;
}

/// @return whether there was a contact
bool Bounded_search::test_leaves(std::uint32_t leaf_a, std::uint32_t leaf_b, std::vector<Face_pair>& found) {
  // The fitted box of one leaf can spare posing the other.
  const bool a_first = a_->is_posed(leaf_a) || !b_->is_posed(leaf_b);
  const bool apart = a_first ? !near(a_->pose(leaf_a), b_->box(b_->layout().leaf_node(leaf_b)), tolerance_)
                             : !near(a_->box(a_->layout().leaf_node(leaf_a)), b_->pose(leaf_b), tolerance_);
  if (apart || !near(a_->pose(leaf_a), b_->pose(leaf_b), tolerance_) || is_broken()) return false;
  ++leaf_tests_;
  if (!filter_begun_) filter_.begin(a_->view(), b_->view(), tolerance_);
  filter_begun_ = true;
  const Leaf_faces faces_a = a_->view().leaf(leaf_a), faces_b = b_->view().leaf(leaf_b);
  const auto indices_a = a_->layout().faces(leaf_a), indices_b = b_->layout().faces(leaf_b);
  const std::size_t before = found.size();
  for (const Face_candidate& candidate : filter_.face_candidates(leaf_a, leaf_b)) {
    ++exact_tests_;
    if (!are_in_contact(leaf_triangle(faces_a, candidate.a), leaf_triangle(faces_b, candidate.b), candidate.crossing))
      continue;
    found.push_back({indices_a[candidate.a], indices_b[candidate.b]});
    if (one_is_enough_) break;
  }
  return found.size() > before;
}

bool Bounded_search::are_in_contact(const Triangle_corners& a, const Triangle_corners& b, Crossing likely) const {
  return tolerance_ > 0 ? triangles_nearer_than(triangle_of(a), triangle_of(b), tolerance_)
                        : triangles_intersect_given(a, b, likely);
}

}  // namespace lodestone
