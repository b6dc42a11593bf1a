// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/bounds/morph_shift.h"
#include "lodestone/bounds/offset_range.h"
#include "lodestone/mesh/morphed_points.h"
#include "lodestone/tree/tree_layout.h"

namespace lodestone {

/// How far morph targets move the vertices of each node of a tree. Vertex i is at x_i + sum_j q_j U_ij.
///
/// With a_j and b_j the least and the greatest U_ij among the vertices of a node, a coordinate changes by at least
/// sum_j min(q_j a_j, q_j b_j) and by at most sum_j max(q_j a_j, q_j b_j).
///
/// *Rounding.* Let k be the number of targets of the node whose weight is not 0. Each term of a computed position is
/// rounded at most k + 1 times: once as a product, then with each sum. So is each term of the two ends. Let the
/// vertices lie in [r, s] at rest, and M = max(|r|, |s|) + sum_j |q_j| max(|a_j|, |b_j|). By the usual bound,
/// \cite higham2002 (section 3.1), both differ from the exact values by at most (k + 1) u / (1 - (k + 1) u) M, where
/// u = 2^-53, and by 2^-1075 for each product that underflows. The margin of a Morph_shift is
/// (4 k + 16) u M + k 2^-1020. That is more than both errors, the rounding of M and the rounding of the moved ends
/// together. The box [r, s] may be that of any part of the vertices.
class Morph_shifts {
 public:
  /// O(V + T log N) for T offsets and N nodes.
  /// @param points         must outlive this
  /// @param layout         of the same vertices
  /// @throws Bad_argument  it has vertices that `points` does not have
  Morph_shifts(const Morphed_points& points, const Tree_layout& layout);

  /// The shift of a node in the current pose. Targets that are zero at the node, or have weight 0, are left out.
  /// O(targets that move some of its vertices).
  Morph_shift operator[](std::uint32_t node) const;

 private:
  std::vector<Offset_range> of_leaf(std::span<const std::uint32_t> vertices) const;
  static std::vector<Offset_range> merged(std::span<const Offset_range> a, std::span<const Offset_range> b);

  const Morphed_points* points_;
  std::vector<Offset_range> ranges_;        ///< by node, then by target
  std::vector<std::uint64_t> range_begin_;  ///< per node and past the last
};

}  // namespace lodestone
