// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/opening_search.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "lodestone/queries/leaf_triangle.h"
#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

namespace {

/// Of two waiting pairs the one to be opened later: a heap has the others first.
constexpr auto later = [](const auto& p, const auto& q) {
  return std::tie(p.order, p.nodes.a, p.nodes.b) > std::tie(q.order, q.nodes.a, q.nodes.b);
};

}  // namespace

void Opening_search::begin(Tree_on_demand& a, Tree_on_demand& b, const Opening_request& request) {
  a_ = &a, b_ = &b;
  request_ = request;
  filter_begun_ = false;
  out_of_budget_ = false;
  leaf_tests_ = exact_tests_ = 0;
  waiting_.clear();
}

/// The filter keeps what it has read of leaves for as long as the bounds hold.
void Opening_search::begin_filter() {
  if (filter_begun_ && bounds_a_ == a_->bounds() && bounds_b_ == b_->bounds()) return;
  bounds_a_ = a_->bounds(), bounds_b_ = b_->bounds();
  filter_.begin(a_->view(), b_->view(), 0);
  filter_begun_ = true;
}

bool Opening_search::test_leaves(std::uint32_t leaf_a, std::uint32_t leaf_b, std::vector<Face_pair>& found) {
  if (!near(a_->pose(leaf_a), b_->pose(leaf_b), 0)) return false;
  ++leaf_tests_;
  begin_filter();
  const Layout_view a = a_->view(), b = b_->view();
  const Leaf_faces faces_a = a.leaf(leaf_a), faces_b = b.leaf(leaf_b);
  const std::size_t before = found.size();
  for (const Face_candidate& candidate : filter_.face_candidates(leaf_a, leaf_b)) {
    ++exact_tests_;
    if (!triangles_intersect_given(leaf_triangle(faces_a, candidate.a), leaf_triangle(faces_b, candidate.b),
                                   candidate.crossing))
      continue;
    found.push_back({a.layout->faces(leaf_a)[candidate.a], b.layout->faces(leaf_b)[candidate.b]});
    if (!request_.all) break;
  }
  return found.size() > before;
}

/// Puts a pair of nodes on the list unless they are taken to be apart.
void Opening_search::consider(Node_pair pair) {
  const double squared = (a_->anchor(pair.a) - b_->anchor(pair.b)).squaredNorm();
  const double radii = request_.reach * (a_->radius(pair.a) + b_->radius(pair.b));
  if (squared > radii * radii) return;
  waiting_.push_back({static_cast<float>(radii > 0 ? squared / (radii * radii) : 0), pair});
}

/// Opens the node with the larger radius, since that separates most.
void Opening_search::consider_children(Node_pair pair) {
  const Tree_layout &a = a_->layout(), &b = b_->layout();
  const bool open_a = b.is_leaf(pair.b) || (!a.is_leaf(pair.a) && a_->radius(pair.a) >= b_->radius(pair.b));
  if (open_a) {
    consider({pair.a + 1, pair.b});
    consider({a.node(pair.a).second_child, pair.b});
  } else {
    consider({pair.a, pair.b + 1});
    consider({pair.a, b.node(pair.b).second_child});
  }
}

bool Opening_search::open(std::vector<Face_pair>& found) {
  const std::size_t before = found.size();
  const bool covers_all = request_.budget >= a_->vertex_count() + b_->vertex_count();
  covers_all ? open_depth_first(found) : open_in_order(found);
  return found.size() > before;
}

bool Opening_search::is_leaf_pair(Node_pair pair) const {
  return a_->layout().is_leaf(pair.a) && b_->layout().is_leaf(pair.b);
}

bool Opening_search::test_leaf_pair(Node_pair pair, std::vector<Face_pair>& found) {
  const std::uint32_t leaf_a = a_->layout().node(pair.a).leaf, leaf_b = b_->layout().node(pair.b).leaf;
  // The box of a leaf that has been read can spare reading the other.
  const bool a_first = a_->is_posed(leaf_a) || !b_->is_posed(leaf_b);
  if (a_first ? is_apart(a_->pose(leaf_a), *b_, pair.b) : is_apart(b_->pose(leaf_b), *a_, pair.a)) return false;
  return test_leaves(leaf_a, leaf_b, found);
}

/// Whether a node is taken to be apart from a box.
bool Opening_search::is_apart(const Aabb& box, Tree_on_demand& tree, std::uint32_t node) const {
  const Eigen::Vector3d& anchor = tree.anchor(node);
  const double radius = request_.reach * tree.radius(node);
  double squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double beyond = std::max({box.low[axis] - anchor[axis], anchor[axis] - box.high[axis], 0.0});
    squared += beyond * beyond;
  }
  return squared > radius * radius;
}

void Opening_search::open_depth_first(std::vector<Face_pair>& found) {
  while (!waiting_.empty()) {
    const Node_pair pair = waiting_.back().nodes;
    waiting_.pop_back();
    if (!is_leaf_pair(pair))
      consider_children(pair);
    else if (test_leaf_pair(pair, found) && !request_.all)
      return;
  }
}

void Opening_search::open_in_order(std::vector<Face_pair>& found) {
  const std::size_t limit = vertices_read() + request_.budget;
  std::ranges::make_heap(waiting_, later);
  while (!waiting_.empty()) {
    if (vertices_read() >= limit) {
      out_of_budget_ = true;
      return;
    }
    std::ranges::pop_heap(waiting_, later);
    const Node_pair pair = waiting_.back().nodes;
    waiting_.pop_back();
    if (!is_leaf_pair(pair)) {
      const std::size_t old = waiting_.size();
      consider_children(pair);
      for (std::size_t end = old + 1; end <= waiting_.size(); ++end)
        std::push_heap(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(end), later);
    } else if (test_leaf_pair(pair, found) && !request_.all) {
      return;
    }
  }
}

}  // namespace lodestone
