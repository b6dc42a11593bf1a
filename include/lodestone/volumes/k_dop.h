// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <limits>
#include <string_view>

#include "lodestone/volumes/aabb.h"
#include "lodestone/volumes/leaf_faces.h"

namespace lodestone {

/// Directions of a `K_dop`, in this order: the three axes; unless K is 14, the directions to the edges of a cube;
/// unless K is 18, those to its corners. Of two opposite directions only one is listed.
template <int K>
constexpr std::array<std::array<int, 3>, K / 2> dop_directions() {
  constexpr int axes[3][3]{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  constexpr int edges[6][3]{{1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1}, {0, 1, 1}, {0, 1, -1}};
  constexpr int corners[4][3]{{1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, -1, -1}};
  std::array<std::array<int, 3>, K / 2> directions{};
  std::size_t count = 0;
  const auto append = [&](const auto& some) {
    for (const auto& d : some) directions[count++] = {d[0], d[1], d[2]};
  };
  append(axes);
  if (K != 14) append(edges);
  if (K != 18) append(corners);
  return directions;
}

/// Discrete orientation polytope with K faces, \cite klosowski1998 and \cite zachmann1998: the points p with
///
///     low[i] <= d_i . p <= high[i]   for i = 0 ... K / 2 - 1,   d_i = directions[i],
///
/// in exact arithmetic. The d_i are not unit vectors, so that a projection is a plain sum of coordinates. Model of
/// Bounding_volume.
///
/// The slabs along the axes are as narrow as possible. The others allow for the rounding of sums: on either side they
/// are wider by at most 2^-50 of the sum of the largest |x|, |y| and |z|. Where these sums could overflow, slabs are
/// unbounded.
///
/// @tparam K  14: axes and corners of a cube; 18: axes and edges; 26: all three
template <int K>
struct K_dop {
  static_assert(K == 14 || K == 18 || K == 26);
  /// In tables and messages.
  static constexpr std::string_view name = K == 14 ? "k_dop_14" : K == 18 ? "k_dop_18" : "k_dop_26";
  static constexpr int slabs = K / 2;  ///< how many pairs of planes
  static constexpr std::array<std::array<int, 3>, K / 2> directions = dop_directions<K>();  ///< normals of the planes

  double low[slabs];   ///< per direction: the least projection
  double high[slabs];  ///< per direction: the greatest projection

  /// Cost: K / 2 projections per vertex.
  void enclose(const Leaf_faces& faces);
  /// Exact: the smallest polytope around both.
  void enclose(const K_dop& a, const K_dop& b) {
    for (int i = 0; i < slabs; ++i) {
      low[i] = a.low[i] < b.low[i] ? a.low[i] : b.low[i];
      high[i] = a.high[i] > b.high[i] ? a.high[i] : b.high[i];
    }
  }
  /// Sum of the three side lengths of `bounds()`, whose limits are exact.
  double extent() const { return (high[0] - low[0]) + (high[1] - low[1]) + (high[2] - low[2]); }
  /// Of the polytope, up to rounding. O(K^3), for experiments.
  double volume() const;
  /// Its first three slabs.
  Aabb bounds() const { return {{low[0], low[1], low[2], 0}, {high[0], high[1], high[2], 0}}; }

  /// Whether all slabs are the same.
  friend bool operator==(const K_dop& a, const K_dop& b) {
    bool equal = true;
    for (int i = 0; i < slabs; ++i) equal &= (a.low[i] == b.low[i]) & (a.high[i] == b.high[i]);
    return equal;
  }
};

/// Whether two come within `margin` >= 0 of each other along every direction; with 0: whether the two slabs of every
/// direction have a point in common.
///
/// `false` proves them farther apart. Points within the margin have projections within the margin times |d_i|. The
/// computed product is never below that: its factors exceed the square roots of 2 and 3 by more than 2^-52, and the
/// added constant covers subnormal products. The comparison is safe since rounding to nearest is monotonic: where the
/// exact sum is at least a double, so is the rounded sum.
template <int K>
bool near(const K_dop<K>& a, const K_dop<K>& b, double margin) {
  bool apart = false;
  for (int i = 0; i < 3; ++i) apart |= (a.low[i] > b.high[i] + margin) | (b.low[i] > a.high[i] + margin);
  if (apart) return false;
  constexpr double least = std::numeric_limits<double>::min();
  const double along_edge = margin > 0 ? 1.414213562373096 * margin + least : 0;
  const double along_corner = margin > 0 ? 1.732050807568879 * margin + least : 0;
  for (int i = 3; i < K / 2; ++i) {
    const double gap = K == 14 || i >= 9 ? along_corner : along_edge;
    apart |= (a.low[i] > b.high[i] + gap) | (b.low[i] > a.high[i] + gap);
  }
  return !apart;
}

extern template struct K_dop<14>;
extern template struct K_dop<18>;
extern template struct K_dop<26>;

}  // namespace lodestone
