// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/contact/region_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/refit_kernel.h"
#include "contact/tree_builder.h"
#include "lodestone/errors.h"

namespace lodestone {

namespace {

/// Leaves of a part: few enough that their boxes are still in the cache when the nodes above them are fitted.
constexpr std::uint32_t part_leaves = 128;

/// Vertices whose coordinates, 12 MB, share a processor's last cache with little else.
constexpr std::size_t cached_vertices = 500'000;

}  // namespace

Region_tree::Region_tree(std::span<const Corners> corners, std::span<const Region_index> labels,
                         Coordinates coordinates, const Region_tree_options& options) {
  if (options.leaf_faces < 2 || options.leaf_faces > 128) throw Bad_argument("a leaf must hold at most 2 to 128 faces");
  if (corners.size() > std::numeric_limits<std::uint32_t>::max() / 3)
    throw Bad_mesh("the mesh has more than 1431655765 faces, which is what a tree can number");
  Tree_builder(*this, corners, labels, coordinates, options).build();
  vertices_.resize(vertices_.size() + kernel::vertices_ahead + 4, vertices_.back());
  boxes_.resize(nodes_.size());
  find_parts();
  for (std::size_t leaf = 0; leaf < leaf_count(); ++leaf) {
    most_leaf_faces_ = std::max(most_leaf_faces_, faces(leaf).size());
    most_leaf_vertices_ = std::max(most_leaf_vertices_, vertices(leaf).size());
  }
  refit(coordinates);
}

/// Cuts the tree below its top into subtrees of at most `part_leaves` leaves.
void Region_tree::find_parts() {
  struct Subtree {
    std::uint32_t node, end_node, end_leaf;
  };
  std::vector<Subtree> ahead{
      {0, static_cast<std::uint32_t>(nodes_.size()), static_cast<std::uint32_t>(leaf_nodes_.size())}};
  while (!ahead.empty()) {
    const auto [n, end_node, end_leaf] = ahead.back();
    ahead.pop_back();
    if (end_leaf - nodes_[n].leaf <= part_leaves) {
      parts_.push_back({.first_node = n, .end_node = end_node, .first_leaf = nodes_[n].leaf, .end_leaf = end_leaf});
      continue;
    }
    top_nodes_.push_back(n);
    const std::uint32_t second = nodes_[n].second_child;
    ahead.push_back({second, end_node, end_leaf});
    ahead.push_back({n + 1, second, nodes_[second].leaf});
  }
}

bool Region_tree::refit(Coordinates coordinates) {
  for (std::size_t part = 0; part < part_count(); ++part) refit_part(part, coordinates);
  return finish_refit(coordinates);
}

void Region_tree::refit_part(std::size_t index, Coordinates coordinates) {
  Part& part = parts_[index];
  const kernel::Refit refit{.coordinates = coordinates.data(),
                            .vertices = vertices_.data(),
                            .vertex_begin = vertex_begin_.data(),
                            .leaf_nodes = leaf_nodes_.data(),
                            .boxes = boxes_.data(),
                            .beyond_cache = coordinates.size() / 3 > cached_vertices};
  const auto [coordinate_sum, extents] = kernel::refit_leaves(refit, part.first_leaf, part.end_leaf);
  part.coordinate_sum = coordinate_sum;
  part.leaf_extents = extents;
  for (std::uint32_t n = part.end_node; n-- > part.first_node;)
    if (!is_leaf(n)) enclose_children(n);
}

bool Region_tree::finish_refit(Coordinates coordinates) {
  for (std::size_t i = top_nodes_.size(); i-- > 0;) enclose_children(top_nodes_[i]);

  double coordinate_sum = 0, leaf_extents = 0;
  for (const Part& part : parts_) {
    coordinate_sum += part.coordinate_sum;
    leaf_extents += part.leaf_extents;
  }
  const double whole = extent(boxes_.front());
  looseness_ = whole > 0 ? leaf_extents / static_cast<double>(leaf_count()) / whole : 0;
  if (!std::isfinite(looseness_)) looseness_ = 0;  // beyond 1e306 the sum overflows: such trees are not judged

  if (std::isfinite(coordinate_sum)) return true;
  // The sum may have overflowed, or the coordinates themselves are to blame.
  return std::ranges::all_of(vertices_, [&](std::uint32_t vertex) {
    const auto position = coordinates.subspan(3 * std::size_t{vertex}, 3);
    return std::isfinite(position[0]) && std::isfinite(position[1]) && std::isfinite(position[2]);
  });
}

void Region_tree::enclose_children(std::uint32_t n) {
  const Tree_box& first = boxes_[n + 1];
  const Tree_box& second = boxes_[nodes_[n].second_child];
  Tree_box& box = boxes_[n];
  for (int lane = 0; lane < 4; ++lane) {
    box.low[lane] = first.low[lane] < second.low[lane] ? first.low[lane] : second.low[lane];
    box.high[lane] = first.high[lane] > second.high[lane] ? first.high[lane] : second.high[lane];
  }
}

}  // namespace lodestone
