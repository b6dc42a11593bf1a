// SPDX-License-Identifier: GPL-3.0-or-later
#include "queries/clearance_search.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>

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
  for (Side* side : {&a_, &b_}) side->leaves.resize(side->view->layout->leaf_count());
  in_line_.resize(most_leaf_faces * most_leaf_faces);
  // A length is at most two extents. The caller rounds a direction times a length, and adds it to coordinates, which
  // rounds again; each rounding errs by 2^-53 of the number, or by half the least double.
  const double extent = (scale_ * whole.max() - origin_).maxCoeff();
  const double least = std::ldexp(std::numeric_limits<double>::denorm_min(), -exponent_);
  slack_ = 0x1p-47 * extent + 0x1p-52 * (scale_ * largest) + 2 * least;
}

/// Spans bound the clearance of two faces as the normals of `clearance` do, which says how much rounding the slack
/// covers: the axes across are orthogonal to the direction up to a few roundings more, and the bound along it, which
/// drops faces, must not be smaller than that of `clearance`, so it has twice the slack.
Clearance_search::Seen_along Clearance_search::seen_along(const Way& way) {
  const Eigen::Vector3d u = way.direction.unitOrthogonal(), v = way.direction.cross(u);
  Seen_along seen;
  for (int axis = 0; axis < 3; ++axis) {
    seen.axes[0][axis] = u[axis];
    seen.axes[1][axis] = v[axis];
    seen.axes[2][axis] = way.direction[axis];
  }
  seen.slack[0] = way.slack * u.lpNorm<1>();
  seen.slack[1] = way.slack * v.lpNorm<1>();
  seen.slack[2] = 2 * way.slack * way.direction.lpNorm<1>();
  return seen;
}

std::optional<Clearance> Clearance_search::operator()(const Eigen::Vector3d& direction, double limit) {
  way_ = Way(direction, slack_);
  seen_ = seen_along(way_);
  limit_ = limit;
  best_ = {};
  queue_ = {};
  if (witnesses_reach()) return std::nullopt;
  push(root_pair);
  // Equal bounds are tried too: of several face pairs with the largest clearance the lowest gives the normal.
  while (!queue_.empty() && queue_.top().bound >= best_.length && best_.length < limit_) {
    const Node_pair pair = queue_.top().pair;
    queue_.pop();
    const Tree_layout &tree_a = *a_.view->layout, &tree_b = *b_.view->layout;
    if (tree_a.is_leaf(pair.a) && tree_b.is_leaf(pair.b)) {
      try_leaves(tree_a.node(pair.a).leaf, tree_b.node(pair.b).leaf);
      continue;
    }
    below_.clear();
    open_pair(tree_a, tree_b, pair, a_.view->boxes[pair.a].extent() >= b_.view->boxes[pair.b].extent(), below_);
    for (const Node_pair next : below_) push(next);
  }
  if (std::isfinite(best_.length)) witnesses_.push_back(best_triangles_);
  if (best_.length >= limit_) return std::nullopt;
  return best_;
}

bool Clearance_search::witnesses_reach() const {
  return std::any_of(witnesses_.rbegin(), witnesses_.rend(), [&](const auto& triangles) {
    const auto& [a, b] = triangles;
    return overlap_across(a, b) && clearance(a, b, way_, limit_).length >= limit_;
  });
}

/// The test of `kernel::In_line` across the direction: `clearance` alone can let pass what is dropped there, and a
/// witness must not count where a search would not come to it.
bool Clearance_search::overlap_across(const Boxed_triangle& a, const Boxed_triangle& b) const {
  for (int axis = 0; axis < 2; ++axis) {
    const double* const n = seen_.axes[axis];
    const auto at = [n](const Eigen::Vector3d& p) { return n[0] * p[0] + n[1] * p[1] + n[2] * p[2]; };
    const auto span = [&](const Boxed_triangle& t) {
      return std::minmax({at(t.corners[0]), at(t.corners[1]), at(t.corners[2])});
    };
    const auto [low_a, high_a] = span(a);
    const auto [low_b, high_b] = span(b);
    if (low_b - high_a > seen_.slack[axis] || low_a - high_b > seen_.slack[axis]) return false;
  }
  return true;
}

void Clearance_search::push(Node_pair pair) {
  const double bound = clearance(box(a_, pair.a), box(b_, pair.b), way_);
  if (std::isfinite(bound) && bound >= best_.length) queue_.push({bound, pair});
}

kernel::Corner_columns Clearance_search::corners_of(Side& side, std::uint32_t leaf) const {
  constexpr std::size_t step = kernel::faces_per_step;
  Leaf& numbers = side.leaves[leaf];
  const Leaf_faces faces = side.view->leaf(leaf);
  const std::size_t count = faces.corners.size(), stride = (count + step - 1) / step * step;
  if (numbers.empty()) {
    numbers.resize(9 * stride);
    for (std::size_t i = 0; i < stride; ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        const Eigen::Vector3d p = scaled(faces.position(faces.corners[std::min(i, count - 1)][c]));
        for (std::size_t axis = 0; axis < 3; ++axis)
          numbers[(3 * c + axis) * stride + i] = p[static_cast<Eigen::Index>(axis)];
      }
  }
  return {numbers.data(), count, stride};
}

Boxed_triangle Clearance_search::triangle(const Side& side, std::uint32_t leaf, std::uint8_t face) const {
  const std::vector<double>& numbers = side.leaves[leaf];
  const std::size_t stride = numbers.size() / 9;
  Boxed_triangle triangle;
  for (std::size_t c = 0; c < 3; ++c) {
    const double* const x = numbers.data() + 3 * c * stride + face;
    triangle.corners[c] = {x[0], x[stride], x[2 * stride]};
    triangle.box.extend(triangle.corners[c]);
  }
  return triangle;
}

/// Lists the face pairs of two leaves whose clearance may be the largest, as a heap by their bounds.
void Clearance_search::list_candidates(std::uint32_t leaf_a, std::uint32_t leaf_b) {
  const auto all_of_a = span_faces(corners_of(a_, leaf_a), seen_.axes, spans_a_);
  const auto all_of_b = span_faces(corners_of(b_, leaf_b), seen_.axes, spans_b_);
  const kernel::In_line rule{{seen_.slack[0], seen_.slack[1]}, best_.length - seen_.slack[2]};
  keep_in_line_with(spans_a_, all_of_b, rule);
  keep_in_line_with(all_of_a, spans_b_, rule);
  const std::size_t count = list_in_line(spans_a_, spans_b_, rule, in_line_.data());
  candidates_.clear();
  for (const kernel::Face_slots slots : std::span(in_line_).first(count))
    candidates_.push_back({spans_b_.high[2][slots.b] - spans_a_.low[2][slots.a] + seen_.slack[2], slots});
  std::ranges::make_heap(candidates_, std::less(), &Clearance_candidate::bound);
}

void Clearance_search::try_leaves(std::uint32_t leaf_a, std::uint32_t leaf_b) {
  list_candidates(leaf_a, leaf_b);
  const auto faces_a = a_.view->layout->faces(leaf_a), faces_b = b_.view->layout->faces(leaf_b);
  const auto go_on = [&] { return best_.length < limit_ && !candidates_.empty(); };
  for (; go_on() && candidates_.front().bound >= best_.length; candidates_.pop_back()) {
    std::ranges::pop_heap(candidates_, std::less(), &Clearance_candidate::bound);
    const kernel::Face_slots slots = candidates_.back().slots;
    const std::uint8_t a = spans_a_.faces[slots.a], b = spans_b_.faces[slots.b];
    try_faces({faces_a[a], faces_b[b]}, triangle(a_, leaf_a, a), triangle(b_, leaf_b, b));
  }
}

void Clearance_search::try_faces(Face_pair faces, const Boxed_triangle& a, const Boxed_triangle& b) {
  const Clearance found = clearance(a, b, way_, best_.length);
  if (found.length < best_.length || !std::isfinite(found.length)) return;
  if (found.length == best_.length && best_faces_ < faces) return;
  best_ = found;
  best_faces_ = faces;
  best_triangles_ = {a, b};
}

}  // namespace lodestone
