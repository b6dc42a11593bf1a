// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "lodestone/tree/tree_layout.h"

namespace lodestone {

std::string Tree_layout::validate_layout(std::span<const Corners> mesh_corners, std::size_t vertex_count) const {
  auto wrong = validate_leaves(mesh_corners, vertex_count);
  return wrong.empty() ? validate_nodes() : wrong;
}

/// Every face is in exactly one leaf, with its own corners. Leaves list no other vertices.
std::string Tree_layout::validate_leaves(std::span<const Corners> mesh_corners, std::size_t vertex_count) const {
  std::vector<std::uint8_t> seen(mesh_corners.size(), 0);  // not bool: faces come in no order
  std::vector<std::uint8_t> used;
  for (std::size_t leaf = 0; leaf < leaf_count(); ++leaf) {
    const auto list = vertices(leaf);
    used.assign(list.size(), 0);
    if (list.empty() || std::ranges::adjacent_find(list, std::greater_equal()) != list.end())
      return fmt::format("leaf {}: its vertices are not listed once each in ascending order", leaf);
    if (list.back() >= vertex_count) return fmt::format("leaf {}: there is no vertex {}", leaf, list.back());
    for (std::size_t i = 0; i < faces(leaf).size(); ++i) {
      const std::uint32_t face = faces(leaf)[i];
      if (face >= mesh_corners.size()) return fmt::format("leaf {}: there is no face {}", leaf, face);
      if (std::exchange(seen[face], 1) != 0) return fmt::format("face {} is in two leaves", face);
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::size_t index = corners(leaf)[i][corner];
        if (index >= list.size() || list[index] != mesh_corners[face][corner])
          return fmt::format("leaf {}: face {} has other corners than in the mesh", leaf, face);
        used[index] = 1;
      }
    }
    if (const auto unused = std::ranges::find(used, 0); unused != used.end())
      return fmt::format("leaf {}: none of its faces has vertex {}", leaf, list[unused - used.begin()]);
    if (leaf_nodes_[leaf] >= nodes_.size() || !is_leaf(leaf_nodes_[leaf]))
      return fmt::format("leaf {}: its node is not a leaf", leaf);
  }
  if (const auto face = std::ranges::find(seen, 0); face != seen.end())
    return fmt::format("face {} is in no leaf", face - seen.begin());
  return {};
}

/// A depth-first walk from the root meets all nodes and all leaves in ascending order.
std::string Tree_layout::validate_nodes() const {
  std::uint32_t next = 0, leaf = 0;
  std::vector<std::uint32_t> stack{0};
  while (!stack.empty()) {
    const std::uint32_t n = stack.back();
    stack.pop_back();
    if (n != next++ || n >= nodes_.size()) return fmt::format("node {} is out of order", n);
    if (nodes_[n].leaf != leaf) return fmt::format("node {}: its first leaf should be {}", n, leaf);
    if (is_leaf(n)) {
      if (nodes_[n].end_leaf != leaf + 1) return fmt::format("node {}: its end leaf should be {}", n, leaf + 1);
      if (leaf_nodes_[leaf++] != n) return fmt::format("node {} is not the node of its leaf", n);
      continue;
    }
    const std::uint32_t second = nodes_[n].second_child;
    if (second <= n + 1 || second >= nodes_.size()) return fmt::format("node {}: there is no node {}", n, second);
    if (nodes_[n + 1].end_leaf != nodes_[second].leaf || nodes_[second].end_leaf != nodes_[n].end_leaf)
      return fmt::format("node {}: its leaves are not those of its children", n);
    stack.push_back(second);
    stack.push_back(n + 1);
  }
  if (next != nodes_.size() || leaf != leaf_count()) return "the tree has nodes that no walk from its root meets";
  return {};
}

}  // namespace lodestone
