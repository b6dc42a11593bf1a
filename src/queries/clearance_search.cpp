// SPDX-License-Identifier: GPL-3.0-or-later
#include "queries/clearance_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lodestone/volumes/to_box.h"

namespace lodestone {

namespace {

double largest_coordinate(const Box& box) {
  return std::max(box.min().lpNorm<Eigen::Infinity>(), box.max().lpNorm<Eigen::Infinity>());
}

}  // namespace

Clearance_search::Clearance_search(const Layout_view& a, const Layout_view& b) : a_{&a}, b_{&b} {
  const Box whole = to_box(a.boxes[0]).merged(to_box(b.boxes[0]));
  const double largest = largest_coordinate(whole);
  exponent_ = (largest > 0 ? std::max(std::ilogb(largest), -1022) : -1022) + 1;
  scale_ = std::ldexp(1.0, -exponent_);
  origin_ = scale_ * whole.min();
  for (Side* side : {&a_, &b_}) {
    for (const Aabb& box : side->view->boxes) side->boxes.push_back(scaled(box));
    side->leaves.resize(side->view->layout->leaf_count());
  }
  // A length is at most two extents. The caller rounds a direction times a length, and adds it to coordinates, which
  // rounds again; each rounding errs by 2^-53 of the number, or by half the least double.
  const double extent = (scale_ * whole.max() - origin_).maxCoeff();
  const double least = std::ldexp(std::numeric_limits<double>::denorm_min(), -exponent_);
  way_.slack = 0x1p-47 * extent + 0x1p-52 * (scale_ * largest) + 2 * least;
}

std::optional<Clearance> Clearance_search::operator()(const Eigen::Vector3d& direction, double limit) {
  way_.direction = direction;
  best_ = {};
  best_a_ = best_b_ = nullptr;
  queue_ = {};
  if (witnesses_reach(limit)) return std::nullopt;
  push(root_pair);
  // Equal bounds are tried too: of several face pairs with the largest clearance the lowest gives the normal.
  while (!queue_.empty() && queue_.top().bound >= best_.length) {
    const Node_pair pair = queue_.top().pair;
    queue_.pop();
    if (a_.view->layout->is_leaf(pair.a) && b_.view->layout->is_leaf(pair.b)) {
      try_leaves(pair);
      if (best_.length >= limit) break;
      continue;
    }
    below_.clear();
    open_pair(*a_.view->layout, *b_.view->layout, pair,
              a_.view->boxes[pair.a].extent() >= b_.view->boxes[pair.b].extent(), below_);
    for (const Node_pair next : below_) push(next);
  }
  if (best_a_ != nullptr) witnesses_.emplace_back(best_a_, best_b_);
  if (best_.length >= limit) return std::nullopt;
  return best_;
}

bool Clearance_search::witnesses_reach(double limit) const {
  return std::any_of(witnesses_.rbegin(), witnesses_.rend(), [&](const auto& faces) {
    return clearance(faces.first->triangle, faces.second->triangle, way_, limit).length >= limit;
  });
}

void Clearance_search::push(Node_pair pair) {
  const double bound = clearance(a_.boxes[pair.a], b_.boxes[pair.b], way_);
  if (std::isfinite(bound) && bound >= best_.length) queue_.push({bound, pair});
}

const std::vector<Clearance_search::Face>& Clearance_search::faces_of(Side& side, std::uint32_t leaf) const {
  auto& faces = side.leaves[leaf];
  if (!faces.empty()) return faces;
  const Leaf_faces corners = side.view->leaf(leaf);
  const auto indices = side.view->layout->faces(leaf);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    Face face{.index = indices[i], .triangle = {}};
    for (std::size_t k = 0; k < 3; ++k) {
      face.triangle.corners[k] = scaled(corners.position(corners.corners[i][k]));
      face.triangle.box.extend(face.triangle.corners[k]);
    }
    faces.push_back(face);
  }
  return faces;
}

void Clearance_search::try_leaves(Node_pair pair) {
  const auto& faces_a = faces_of(a_, a_.view->layout->node(pair.a).leaf);
  const auto& faces_b = faces_of(b_, b_.view->layout->node(pair.b).leaf);
  keep_facing(faces_a, b_.boxes[pair.b], true, facing_a_);
  keep_facing(faces_b, a_.boxes[pair.a], false, facing_b_);
  for (const Face* a : facing_a_)
    for (const Face* b : facing_b_)
      if (const double bound = clearance(a->triangle.box, b->triangle.box, way_);
          std::isfinite(bound) && bound >= best_.length)
        try_faces(*a, *b);
}

/// The faces of a leaf whose clearance from the other leaf may be the largest.
void Clearance_search::keep_facing(const std::vector<Face>& faces, const Box& other, bool of_a,
                                   std::vector<const Face*>& kept) const {
  kept.clear();
  for (const Face& face : faces) {
    const Box& box = face.triangle.box;
    const double bound = of_a ? clearance(box, other, way_) : clearance(other, box, way_);
    if (std::isfinite(bound) && bound >= best_.length) kept.push_back(&face);
  }
}

void Clearance_search::try_faces(const Face& a, const Face& b) {
  const Clearance found = clearance(a.triangle, b.triangle, way_, best_.length);
  if (found.length < best_.length || !std::isfinite(found.length)) return;
  if (found.length == best_.length && std::pair(best_a_->index, best_b_->index) < std::pair(a.index, b.index)) return;
  best_ = found;
  best_a_ = &a, best_b_ = &b;
}

}  // namespace lodestone
