// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "lodestone/partition/feature_vectors.h"
#include "lodestone/partition/partition.h"

namespace lodestone {

/// The start of k-means++ \cite arthur2007: the first vector is drawn at random, each further one with a probability
/// proportional to its squared distance from the nearest drawn before. The same draw on every machine. O(k M N).
///
/// @param vectors  M x k, components below 1e100
/// @param count    N; fewer come back only when the vectors hold fewer than N different values
/// @return rows of different vectors, in the order of the draw
std::vector<std::size_t> kmeans_plus_plus_start(const Feature_vectors& vectors, std::size_t count, std::uint64_t seed);

struct Kmeans_plus_plus_options {
  std::uint64_t seed = 1;  ///< of the draw of the first code vectors
  double tolerance = 0;    ///< relative drop of the distortion at which iterations stop, >= 0; 0: no label changes
  std::size_t max_iterations = 1000;  ///< >= 1
  Feature_options features = {};
};

/// Partition strategy: the cells of Lloyd iterations from a k-means++ start, over the feature vectors of `Lbg`.
///
/// With the default tolerance every vector is nearest to the mean of its own cell, and no other. A cell that becomes
/// empty starts anew at the vector farthest from its code vector. O(k M N) per iteration at worst; most distances are
/// spared by `Bounded_assignment`.
struct Kmeans_plus_plus {
  static constexpr std::string_view name = "kmeans++";

  Kmeans_plus_plus_options options = {};

  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  /// @throws Bad_argument  an option out of range
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

}  // namespace lodestone
