// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/bounds/stretch_bound.h"

#include <algorithm>
#include <cmath>

#include "bounds/grown_box.h"
#include "bounds/landmark_search.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

constexpr double slack = 1e-9;

Eigen::Vector3d edge_between(Coordinates coordinates, std::uint32_t from, std::uint32_t to) {
  const auto at = [&](std::uint32_t v) {
    return Eigen::Map<const Eigen::Vector3d>(coordinates.data() + 3 * std::size_t{v});
  };
  return at(to) - at(from);
}

}  // namespace

Stretch_bound::Stretch_bound(const Stretch_promise& promise, const Bounded_object& object)
    : promise_(&promise), layout_(&object.layout), positions_(&object.positions) {
  check_object(object);
  rest_.assign(object.rest.begin(), object.rest.end());
  list_edges();
  const auto nodes = static_cast<std::uint32_t>(layout_->node_count());
  const double longer = 1 + (2 * slack + 0x1p-51 * static_cast<double>(positions_->vertex_count()));
  begin_.resize(nodes);
  end_.resize(nodes);
  has_own_.resize(nodes);
  Landmark_search search(*layout_, rest_);
  for (std::uint32_t node = 0; node < nodes; ++node) {
    const auto found = search.find(node);
    has_own_[node] = !found.empty();
    if (!found.empty()) {
      begin_[node] = static_cast<std::uint32_t>(landmarks_.size());
      for (const auto& [vertex, radius] : found) landmarks_.push_back({.vertex = vertex, .radius = longer * radius});
      end_[node] = static_cast<std::uint32_t>(landmarks_.size());
    }
    if (layout_->is_leaf(node)) continue;
    // Those of this node, until the children find their own.
    for (const auto child : {node + 1, layout_->node(node).second_child}) {
      begin_[child] = begin_[node];
      end_[child] = end_[node];
    }
  }
}

Aabb Stretch_bound::box(std::uint32_t node) const {
  return box_around_landmarks(node, [](const Eigen::Vector3d&) {});
}

Aabb Stretch_bound::box(std::uint32_t node, std::vector<Eigen::Vector3d>& read) const {
  return box_around_landmarks(node, [&](const Eigen::Vector3d& position) {
    if (has_own_[node]) read.push_back(position);
  });
}

/// @param note  called with each position that is read
template <class Note>
Aabb Stretch_bound::box_around_landmarks(std::uint32_t node, Note note) const {
  const double error = 2 * (1 + slack) * promise_->error();
  const auto around = [&](const Landmark& landmark) {
    const Eigen::Vector3d position = (*positions_)(landmark.vertex);
    note(position);
    return box_around(position, promise_->stretch() * landmark.radius + error);
  };
  const auto all = landmarks(node);
  Aabb box = around(all.front());
  for (const auto& landmark : all.subspan(1)) box.enclose(box, around(landmark));
  return box;
}

/// Lists the edges of each leaf, and how long they are at rest.
void Stretch_bound::list_edges() {
  edge_begin_.push_back(0);
  for (std::size_t leaf = 0; leaf < layout_->leaf_count(); ++leaf) {
    for (const auto& [a, b, c] : layout_->corners(leaf))
      for (const auto& [from, to] : {Leaf_edge{a, b}, Leaf_edge{b, c}, Leaf_edge{c, a}})
        edges_.push_back({std::min(from, to), std::max(from, to)});
    const auto first = edges_.begin() + edge_begin_.back();
    std::sort(first, edges_.end());
    edges_.erase(std::unique(first, edges_.end()), edges_.end());
    edge_begin_.push_back(static_cast<std::uint32_t>(edges_.size()));
    const auto vertices = layout_->vertices(leaf);
    for (std::size_t i = squared_.size(); i < edges_.size(); ++i)
      squared_.push_back(edge_between(rest_, vertices[edges_[i].from], vertices[edges_[i].to]).squaredNorm());
  }
}

bool Stretch_bound::note_read(std::uint32_t leaf, const Aabb& /*fitted*/, Coordinates coordinates) const {
  // What squares that underflow or overflow do not tell, and the error allowed.
  constexpr double smallest_square = 1e-290, largest_square = 1e300, smallest = 1e-150;
  const double most = (1 + slack) * promise_->stretch(), error = 2 * (1 + slack) * promise_->error();
  const auto vertices = layout_->vertices(leaf);
  for (std::uint32_t i = edge_begin_[leaf]; i < edge_begin_[leaf + 1]; ++i) {
    const std::uint32_t from = vertices[edges_[i].from], to = vertices[edges_[i].to];
    const Eigen::Vector3d now = edge_between(coordinates, from, to);
    const double longest = most * most * squared_[i];
    if ((now.squaredNorm() <= longest) & (longest > smallest_square) & (longest < largest_square)) continue;
    const double then = edge_between(rest_, from, to).stableNorm();
    if (!(now.stableNorm() <= most * (then + smallest) + error)) return false;
  }
  return true;
}

bool Stretch_bound::note_all(std::span<const Aabb> fitted, Coordinates coordinates, bool all) {
  constexpr std::size_t one_in = 64;
  const std::size_t leaves = layout_->leaf_count(), step = all ? 1 : std::min(one_in, leaves);
  bool kept = true;
  for (std::size_t leaf = turn_++ % step; leaf < leaves; leaf += step)
    kept &= note_read(static_cast<std::uint32_t>(leaf), fitted[layout_->leaf_node(leaf)], coordinates);
  return kept;
}

void Stretch_promise::set_stretch(double stretch, double error) {
  if (!(stretch >= 0) || !std::isfinite(stretch)) throw Bad_argument("a stretch must be >= 0 and finite");
  if (!(error >= 0) || !std::isfinite(error)) throw Bad_argument("the error of positions must be >= 0 and finite");
  stretch_ = stretch;
  error_ = error;
}

}  // namespace lodestone
