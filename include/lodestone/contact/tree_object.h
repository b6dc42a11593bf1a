// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lodestone/contact/leaf_pairs.h"
#include "lodestone/contact/region_tree.h"
#include "lodestone/contact/vertex_fans.h"
#include "lodestone/workers.h"

namespace lodestone {

/// One object as the exact mode keeps it from frame to frame: its faces, its tree, where its vertices are now, and what
/// single queries need to know of its connectivity, found when first asked for.
class Tree_object {
 public:
  Tree_object() = default;
  /// @param corners  F >= 1 faces; kept by the caller
  explicit Tree_object(std::span<const Corners> corners) : corners_(corners) {}

  /// Builds the tree, anew if there is one. O(F log F).
  /// @param labels       V: region of each vertex
  /// @param coordinates  3 V, all finite, not changed before the next refit
  void build(std::span<const Region_index> labels, Coordinates coordinates, const Region_tree_options& options);

  const Region_tree& tree() const { return tree_; }
  std::span<const Corners> corners() const { return corners_; }
  std::size_t vertex_count() const { return coordinates_.size() / 3; }
  Coordinates coordinates() const { return coordinates_; }
  Posed_tree posed() const { return {&tree_, coordinates_}; }
  /// Whether all coordinates that faces use are finite. Nothing can be asked of an object where one is not.
  bool finite() const { return finite_; }
  /// Whether the leaves have become looser by more than `factor` since the tree was built.
  bool looser_than(double factor) const { return tree_.looseness() > factor * built_looseness_; }

  /// The faces around each vertex. O(V + F) the first time.
  const Vertex_fans& fans() const;
  /// Whether each edge has an even number of faces, so that the surface has an inside. O(F log F) the first time.
  bool closed() const;
  /// One vertex of each connected piece of the surface. O(V + F) the first time.
  std::span<const std::uint32_t> piece_vertices() const;

 private:
  friend void refit(std::span<Tree_object* const> objects, std::span<const Coordinates> coordinates, Workers& workers);

  std::span<const Corners> corners_;
  Region_tree tree_;
  Coordinates coordinates_;
  bool finite_ = true;
  double built_looseness_ = 0;
  mutable std::optional<Vertex_fans> fans_;
  mutable std::optional<bool> closed_;
  mutable std::vector<std::uint32_t> piece_vertices_;
};

/// Moves objects to where their vertices are now: all that depends on positions. O(V), shared among the workers.
/// @param coordinates  per object: 3 V, not changed before the next refit
void refit(std::span<Tree_object* const> objects, std::span<const Coordinates> coordinates, Workers& workers);

}  // namespace lodestone
