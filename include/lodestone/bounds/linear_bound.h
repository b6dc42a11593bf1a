// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

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
/// Targets that are zero at the node, or have weight 0, are left out.
///
/// *Rounding.* With k targets, each term of a computed position is rounded at most k + 1 times: once as a product, then
/// with each sum. So is each term of the two ends. Let m = max(|r|, |s|) + sum_j |q_j| max(|a_j|, |b_j|). By the usual
/// bound, \cite higham2002 (section 3.1), both differ from the exact values by at most (k + 1) u / (1 - (k + 1) u) m,
/// where u = 2^-53, and by 2^-1075 for each product that underflows. The ends are moved outwards by (4 k + 16) u m and
/// k 2^-1020, which is more than both together with the rounding of m and of the ends themselves.
class Linear_bound {
 public:
  /// What a node's vertices can be away from rest, along each axis.
  struct Shift {
    std::array<double, 3> low = {};     ///< at most the exact sums, but for `margin`
    std::array<double, 3> high = {};    ///< at least the exact sums, but for `margin`
    std::array<double, 3> margin = {};  ///< for the rounding of both, and of the computed positions
  };

  /// O(V + T log N) for T offsets and N nodes.
  /// @param points         must outlive this
  /// @param layout         of the same vertices
  /// @throws Bad_argument  it has vertices that `points` does not have
  Linear_bound(const Morphed_points& points, const Tree_layout& layout);

  /// Number of nodes of the tree.
  std::size_t node_count() const { return rest_.size(); }
  /// The box of a node in the current pose. O(targets that move vertices of the node).
  Aabb box(std::uint32_t node) const;

  /// How far morphing moves the vertices of a node. O(targets that move some of them).
  Shift shift(std::uint32_t node) const;

 private:
  /// The offsets by which one target moves the vertices of a node.
  struct Range {
    std::uint32_t target;
    std::array<double, 3> low, high;
  };
  std::vector<Range> of_leaf(std::span<const std::uint32_t> vertices) const;
  static std::vector<Range> merged(std::span<const Range> a, std::span<const Range> b);

  const Morphed_points* points_;
  std::vector<Aabb> rest_;                  ///< per node: the box at rest, which is not rounded
  std::vector<Range> ranges_;               ///< by node, then by target
  std::vector<std::uint64_t> range_begin_;  ///< per node and past the last
};

}  // namespace lodestone
