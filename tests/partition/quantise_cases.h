// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <random>

#include "lodestone/partition/feature_vectors.h"
#include "lodestone/partition/lbg.h"

namespace lodestone {

inline constexpr std::array splits{Split::principal_axis, Split::multiplicative};

/// Independent normal components.
inline Feature_vectors random_vectors(Eigen::Index count, Eigen::Index components, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Feature_vectors vectors(count, components);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < components; ++j) vectors(i, j) = normal(random);
  return vectors;
}

inline Feature_vectors seeded_vectors(Eigen::Index count, Eigen::Index components, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  return random_vectors(count, components, random);
}

/// Integers below `values`: many vectors are equal, many equally far from two code vectors.
inline Feature_vectors lattice_vectors(Eigen::Index count, Eigen::Index components, std::uint64_t values,
                                       std::mt19937_64& random) {
  Feature_vectors vectors(count, components);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < components; ++j) vectors(i, j) = static_cast<double>(random() % values);
  return vectors;
}

}  // namespace lodestone
