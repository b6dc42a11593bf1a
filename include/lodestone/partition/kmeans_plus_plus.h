// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "lodestone/partition/feature_vectors.h"
#include "lodestone/partition/partition.h"

namespace lodestone {

/// The start of k-means++ \cite arthur2007: the first vector is drawn at random, each further one with a probability
/// proportional to its squared distance from the nearest vector drawn before. The draw is the same on every machine.
/// O(M N) distances, each of O(k) for k components.
///
/// @param vectors  M x k, components below 1e100
/// @param count    N; fewer are returned only if the vectors hold fewer than N different values; those that differ by
///                 less than 1e-150 may count as one
/// @return row indices of different vectors, in the order of the draw
std::vector<std::size_t> kmeans_plus_plus_start(const Feature_vectors& vectors, std::size_t count, std::uint64_t seed);

/// Options of Kmeans_plus_plus.
struct Kmeans_plus_plus_options {
  std::uint64_t seed = 1;  ///< of the draw of the first code vectors
  double tolerance = 0;    ///< iterations stop at this relative drop of the distortion, >= 0; 0: when no label changes
  std::size_t max_iterations = 1000;  ///< >= 1
  Feature_options features = {};      ///< what is compared
};

/// @throws Bad_argument  an option out of range
void check(const Kmeans_plus_plus_options& options);

/// Partition strategy: the cells of Lloyd iterations from a k-means++ start, over the feature vectors of `Lbg`.
///
/// With the default tolerance no mean is nearer to a vector than that of its own cell. A cell that becomes empty is
/// re-seeded with the vector that is farthest from its code vector. Each iteration computes M N distances at worst,
/// each of O(k) for k components; `Bounded_assignment` avoids most of them.
struct Kmeans_plus_plus {
  static constexpr std::string_view name = "kmeans++";  ///< for `make_strategy`, tables and messages
  static constexpr bool is_concurrent = true;           ///< see Partition_strategy

  Kmeans_plus_plus_options options = {};  ///< seed, features, and when iterations stop

  /// See Partition_strategy.
  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  /// The same for a surface by index.
  /// @throws Bad_argument  an option out of range
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

}  // namespace lodestone
