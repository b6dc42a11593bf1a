// SPDX-License-Identifier: GPL-3.0-or-later
#include "queries/lowest_contact.h"

#include <utility>
#include <vector>

#include "lodestone/filter/face_filter.h"
#include "lodestone/queries/leaf_pair_list.h"
#include "lodestone/queries/leaf_triangle.h"
#include "lodestone/tree/node_pair.h"
#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

namespace {

class Lowest_contact_search {
 public:
  Lowest_contact_search(const Layout_view& a, const Layout_view& b, bool is_within)
      : a_(a), b_(b), is_within_(is_within) {
    is_within ? filter_.begin_within(a, 0) : filter_.begin(a, b, 0);
  }

  std::optional<Lowest_contact> run() {
    push(root_pair);
    while (!waiting_.empty()) {
      const Node_pair pair = waiting_.back();
      waiting_.pop_back();
      if (a_.layout->is_leaf(pair.a) && b_.layout->is_leaf(pair.b))
        test({a_.layout->node(pair.a).leaf, b_.layout->node(pair.b).leaf});
      else
        open(pair);
    }
    return lowest_;
  }

 private:
  void push(Node_pair pair) {
    if (near(a_.boxes[pair.a], b_.boxes[pair.b], 0)) waiting_.push_back(pair);
  }

  void open(Node_pair pair) {
    below_.clear();
    if (is_within_ && pair.a == pair.b)
      open_with_itself(*a_.layout, pair.a, below_);
    else
      open_pair(*a_.layout, *b_.layout, pair, a_.boxes[pair.a].extent() >= b_.boxes[pair.b].extent(), below_);
    for (const Node_pair next : below_) push(next);
  }

  void test(Leaf_pair leaves) {
    const Leaf_faces faces_a = a_.leaf(leaves.a), faces_b = b_.leaf(leaves.b);
    for (const Face_candidate& candidate : filter_.face_candidates(leaves.a, leaves.b)) {
      Lowest_contact next{{a_.layout->faces(leaves.a)[candidate.a], b_.layout->faces(leaves.b)[candidate.b]},
                          {leaves.a, candidate.a},
                          {leaves.b, candidate.b}};
      if (is_within_ && next.faces.b < next.faces.a) {
        std::swap(next.faces.a, next.faces.b);
        std::swap(next.a, next.b);
      }
      if (lowest_ && !(next.faces < lowest_->faces)) continue;
      if (triangles_intersect_given(leaf_triangle(faces_a, candidate.a), leaf_triangle(faces_b, candidate.b),
                                    candidate.crossing))
        lowest_ = next;
    }
  }

  const Layout_view& a_;
  const Layout_view& b_;
  bool is_within_;
  Face_filter filter_;
  std::vector<Node_pair> waiting_, below_;
  std::optional<Lowest_contact> lowest_;
};

}  // namespace

std::optional<Lowest_contact> lowest_contact(const Layout_view& a, const Layout_view& b) {
  return Lowest_contact_search(a, b, false).run();
}

std::optional<Lowest_contact> lowest_contact_within(const Layout_view& surface) {
  return Lowest_contact_search(surface, surface, true).run();
}

}  // namespace lodestone
