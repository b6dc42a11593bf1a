// SPDX-License-Identifier: GPL-3.0-or-later
#include "nested_codebook/hierarchy_search.h"

#include <algorithm>
#include <map>
#include <queue>
#include <tuple>
#include <utility>

namespace lodestone {

namespace {

/// Two nodes by index. `order`: squared distance of their anchors, relative to the sum of their radii.
struct Waiting_nodes {
  double order = 0;
  std::uint32_t a = 0, b = 0;
  bool operator<(const Waiting_nodes& other) const {  // the nearest is the largest
    return std::tie(order, a, b) > std::tie(other.order, other.a, other.b);
  }
};

}  // namespace

Hierarchy_in_frame::Hierarchy_in_frame(Face_hierarchy hierarchy)
    : hierarchy_(std::move(hierarchy)),
      leaf_of_(hierarchy_.faces.size()),
      anchor_read_(hierarchy_.nodes.size()),
      leaf_read_(hierarchy_.nodes.size()),
      boxes_(hierarchy_.nodes.size()) {
  for (std::uint32_t n = 0; n < hierarchy_.nodes.size(); ++n)
    for (std::uint32_t place = node(n).first_face; is_leaf(n) && place < node(n).end_face; ++place)
      leaf_of_[hierarchy_.faces[place]] = n;
}

void Hierarchy_in_frame::start_frame(const Positions& positions) {
  positions_ = &positions;
  ++frame_;
  anchors_ = leaves_ = leaf_vertices_ = 0;
}

std::size_t Hierarchy_in_frame::leaf_count() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(hierarchy_.nodes, [](const auto& node) { return node.second_child == 0; }));
}

Eigen::Vector3d Hierarchy_in_frame::anchor(std::uint32_t n) {
  if (std::exchange(anchor_read_[n], frame_) != frame_) ++anchors_;
  return positions_->row(node(n).anchor);
}

const Box& Hierarchy_in_frame::box(std::uint32_t leaf) {
  if (std::exchange(leaf_read_[leaf], frame_) == frame_) return boxes_[leaf];
  ++leaves_;
  leaf_vertices_ += node(leaf).vertices.size();
  boxes_[leaf].setEmpty();
  for (const auto vertex : node(leaf).vertices) boxes_[leaf].extend(positions_->row(vertex).transpose());
  return boxes_[leaf];
}

void Hierarchy_in_frame::add_reads(Search_counts& counts) const {
  counts.anchors += anchors_;
  counts.leaves += leaves_;
  counts.vertices += vertices_read();
}

void search(Hierarchy_in_frame& a, Hierarchy_in_frame& b, double reach, std::span<const Face_pair> contacts,
            Search_counts& counts) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> contacts_in;  // by leaf pair
  for (const auto& contact : contacts) ++contacts_in[{a.leaf_of(contact.a), b.leaf_of(contact.b)}];
  const std::size_t read_before = a.vertices_read() + b.vertices_read();
  bool reached = false;

  std::priority_queue<Waiting_nodes> waiting;
  const auto consider = [&](std::uint32_t node_a, std::uint32_t node_b) {
    const double squared = (a.anchor(node_a) - b.anchor(node_b)).squaredNorm();
    const double radii = reach * (a.node(node_a).radius + b.node(node_b).radius);
    if (squared <= radii * radii) waiting.push({radii > 0 ? squared / (radii * radii) : 0, node_a, node_b});
  };
  const auto compare = [&](std::uint32_t leaf_a, std::uint32_t leaf_b) {
    if (!a.box(leaf_a).intersects(b.box(leaf_b))) return;
    ++counts.leaf_pairs;
    const auto here = contacts_in.find({leaf_a, leaf_b});
    if (here == contacts_in.end()) return;
    counts.contacts_reached += here->second;
    if (!std::exchange(reached, true)) counts.read_to_first += a.vertices_read() + b.vertices_read() - read_before;
  };
  for (const auto root_a : a.roots())
    for (const auto root_b : b.roots()) consider(root_a, root_b);
  while (!waiting.empty()) {
    const auto [order, node_a, node_b] = waiting.top();
    waiting.pop();
    if (a.is_leaf(node_a) && b.is_leaf(node_b)) {
      compare(node_a, node_b);
      continue;
    }
    ++counts.opened;
    if (b.is_leaf(node_b) || (!a.is_leaf(node_a) && a.node(node_a).radius >= b.node(node_b).radius)) {
      consider(node_a + 1, node_b);
      consider(a.node(node_a).second_child, node_b);
    } else {
      consider(node_a, node_b + 1);
      consider(node_a, b.node(node_b).second_child);
    }
  }
  counts.colliding += contacts.empty() ? 0 : 1;
  counts.reached += reached ? 1 : 0;
  counts.contacts += contacts.size();
}

}  // namespace lodestone
