// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/tree/tree_layout.h"

#include <algorithm>
#include <limits>

#include "lodestone/mesh/errors.h"
#include "tree/refit_kernel.h"
#include "tree/tree_builder.h"
#include "tree/tree_mender.h"

namespace lodestone {

namespace {

/// Most leaves of a part: few enough that their volumes are still in the cache when the nodes above are fitted.
constexpr std::uint32_t part_leaves = 128;

}  // namespace

void check(const Region_tree_options& options) {
  if (options.leaf_faces < 2 || options.leaf_faces > most_leaf_faces)
    throw Bad_argument("leaf_faces must be 2 to " + std::to_string(most_leaf_faces) + ", but is " +
                       std::to_string(options.leaf_faces));
}

void Tree_layout::check(std::span<const Corners> corners, const Region_tree_options& options) {
  lodestone::check(options);
  if (corners.size() > std::numeric_limits<std::uint32_t>::max() / 3)
    throw Bad_mesh("the mesh has more than 1431655765 faces, the most that a tree can index");
}

Tree_layout::Tree_layout(std::span<const Corners> corners, std::span<const Region_index> labels,
                         Coordinates coordinates, const Region_tree_options& options, Workers& workers) {
  check(corners, options);
  Tree_builder(*this, corners, labels, coordinates, options, workers).build();
  finish();
}

std::optional<Tree_layout> Tree_layout::mended(std::span<const Corners> corners, std::span<const std::uint32_t> changed,
                                               Coordinates coordinates, const Region_tree_options& options,
                                               Workers& workers) const {
  check(corners, options);
  std::optional<Tree_layout> tree(std::in_place);
  if (!Tree_mender(*this, *tree, corners, changed, coordinates, options, workers).mend()) return std::nullopt;
  tree->finish();
  return tree;
}

/// What follows from nodes and leaves.
void Tree_layout::finish() {
  vertices_.resize(vertices_.size() + kernel::vertices_ahead + 4, vertices_.back());
  static_assert(kernel::vertices_ahead >= most_float_lanes, "a leaf's vertices are read in vectors");
  find_parts();
}

Tree_layout::Branches Tree_layout::branches() const {
  constexpr int levels = 3;
  Branches found;
  const auto descend = [&](const auto& self, std::uint32_t n, int left) -> void {
    if (left == 0 || is_leaf(n)) {
      found.push_back(n);
      return;
    }
    self(self, n + 1, left - 1);
    self(self, nodes_[n].second_child, left - 1);
  };
  descend(descend, 0, levels);
  return found;
}

/// Cuts the tree below its top into subtrees of at most `part_leaves` leaves.
void Tree_layout::find_parts() {
  struct Subtree {
    std::uint32_t node, end_node, end_leaf;
  };
  std::vector<Subtree> stack{
      {0, static_cast<std::uint32_t>(nodes_.size()), static_cast<std::uint32_t>(leaf_nodes_.size())}};
  while (!stack.empty()) {
    const auto [n, end_node, end_leaf] = stack.back();
    stack.pop_back();
    if (end_leaf - nodes_[n].leaf <= part_leaves) {
      parts_.push_back({.first_node = n, .end_node = end_node, .first_leaf = nodes_[n].leaf, .end_leaf = end_leaf});
      continue;
    }
    top_nodes_.push_back(n);
    const std::uint32_t second = nodes_[n].second_child;
    stack.push_back({second, end_node, end_leaf});
    stack.push_back({n + 1, second, nodes_[second].leaf});
  }
}

std::vector<std::uint32_t> Tree_layout::parents() const {
  std::vector<std::uint32_t> parents(node_count(), 0);
  for (std::uint32_t node = 0; node < node_count(); ++node)
    if (!is_leaf(node)) parents[node + 1] = parents[nodes_[node].second_child] = node;
  return parents;
}

bool Tree_layout::finite(Coordinates coordinates) const {
  return std::ranges::all_of(vertices_, [&](std::uint32_t vertex) {
    const auto position = coordinates.subspan(3 * std::size_t{vertex}, 3);
    return std::isfinite(position[0]) && std::isfinite(position[1]) && std::isfinite(position[2]);
  });
}

}  // namespace lodestone
