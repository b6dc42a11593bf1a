// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lodestone/bounds/morph_shifts.h"
#include "lodestone/mesh/morphed_points.h"
#include "lodestone/tree/tree_layout.h"
#include "lodestone/volumes/aabb.h"

namespace lodestone {

/// Boxes around linearly deformed vertices x_i + sum_j q_j U_ij, as \cite james2004 bounds reduced models: morph
/// targets, modes. A model of Motion_bound.
///
/// With the box [r, s] around the vertices of a node at rest, and a_j and b_j the least and the greatest U_ij among
/// them, each axis lies in
///
///     [r + sum_j min(q_j a_j, q_j b_j),  s + sum_j max(q_j a_j, q_j b_j)].
///
/// Targets that are zero at the node, or have weight 0, are left out. The ends are moved outwards by a margin for
/// rounding: see Morph_shifts.
class Linear_bound {
 public:
  /// O(V + T log N) for T offsets and N nodes.
  /// @param points         must outlive this
  /// @param layout         of the same vertices
  /// @throws Bad_argument  it has vertices that `points` does not have
  Linear_bound(const Morphed_points& points, const Tree_layout& layout);

  /// Number of nodes of the tree.
  std::size_t node_count() const { return rest_.size(); }
  /// The box of a node in the current pose. O(targets that move vertices of the node).
  Aabb box(std::uint32_t node) const;

 private:
  Morph_shifts shifts_;
  std::vector<Aabb> rest_;  ///< per node: the box at rest, which is not rounded
};

}  // namespace lodestone
