// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lodestone/bounds/joint_range.h"
#include "lodestone/bounds/morph_shifts.h"
#include "lodestone/mesh/skinned_points.h"
#include "lodestone/tree/tree_layout.h"
#include "lodestone/volumes/aabb.h"

namespace lodestone {

/// Boxes around skinned vertices (sum_j w_ij T_j) x_i from the motions of their joints. A model of Motion_bound.
///
/// For a node let l_j and g_j be the least and the greatest weight of joint j among its vertices, and B_j the box at
/// rest around those that joint j moves; where vertices are morphed, it is widened by the Morph_shift of the node, with
/// the margin for this box. For an axis, let M_j be the greatest coordinate of T_j B_j. The greatest coordinate of the
/// node is at most
///
///     max { sum_j w_j M_j :  l_j <= w_j <= g_j,  sum_j w_j = 1 }.
///
/// The maximum is reached by starting with w = l and handing out the rest of the sum to the joints of greatest M_j
/// first. The hull of all T_j B_j, for which all l_j are 0 and all g_j 1, is much larger where joints bend.
///
/// *Rounding.* Let J be the number of joints of the node, n the most of one vertex, u = 2^-53, and R the greatest
/// |T_j| (|x|, |y|, |z|, 1) of any joint and any point of its box, so that |M_j| <= R.
///
/// - A computed position: each term w_ij T_j x_i is rounded at most n + 3 times, which is (n + 3) u R.
/// - Weights as they are stored add up to 1 up to (n + 1) u; where a joint is listed twice, the sum of its weights is
///   rounded again. Moving that much weight between joints changes the sum by at most (2 n + 1) u R.
/// - M_j: seven products and sums, of numbers that were rounded twice: 11 u R.
/// - The maximum: J products, 3 J sums and differences of numbers up to R, and 2 J roundings of weights up to 1:
///   6 J u R.
///
/// Together these are less than (6 J + 3 n + 16) u R, up to terms in u^2. The ends are moved outwards by
/// (16 (J + n) + 64) u R, which also covers the rounding of R and of the ends themselves. Products that underflow add
/// at most 2^-1075 (8 n + 16 J + 32) (|x| + |y| + |z| + 1), for which (J + n + 4) 2^-1020 (|x| + |y| + |z| + 1) is
/// added. Boxes at rest are halved to find their centres, which rounds the smallest numbers: the halves are 2^-960
/// longer. Both are more than needed, because many processors are slow at products below 2^-1022.
class Skin_bound {
 public:
  /// O(influences log N) for N nodes.
  /// @param points         must outlive this
  /// @param layout         of the same vertices
  /// @throws Bad_argument  it has vertices that `points` does not have
  Skin_bound(const Skinned_points& points, const Tree_layout& layout);

  /// Number of nodes of the tree.
  std::size_t node_count() const { return range_begin_.size() - 1; }
  /// The box of a node in the current pose. O(J) for each joint that weight is handed out to: one to three as a rule,
  /// at most J.
  Aabb box(std::uint32_t node) const;

 private:
  /// One joint and one vertex that it moves.
  struct Influence {
    std::uint32_t joint, vertex;
    double weight;
  };
  static std::vector<Influence> influences_on(const Skinned_points& points, std::span<const std::uint32_t> vertices);
  std::vector<Joint_range> of_leaf(std::span<const std::uint32_t> vertices) const;
  Joint_range of_vertex(const Influence& influence) const;
  static void enclose(Joint_range& range, const Joint_range& other);
  static std::vector<Joint_range> merged(std::span<const Joint_range> a, std::span<const Joint_range> b);

  const Skinned_points* points_;
  std::optional<Morph_shifts> shifts_;          ///< none: vertices are not morphed
  std::vector<Joint_range> ranges_;             ///< by node, then by joint
  std::vector<std::uint64_t> range_begin_;      ///< per node and past the last
  std::vector<std::uint32_t> most_influences_;  ///< per node: of one vertex
};

}  // namespace lodestone
