// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

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

inline std::vector<std::size_t> cell_sizes(const Quantisation& result) {
  std::vector<std::size_t> sizes(static_cast<std::size_t>(result.code_vectors.rows()), 0);
  for (const auto label : result.labels) ++sizes.at(label);
  return sizes;
}

/// Checks that no cell is empty, and that each code vector is the mean of its cell.
inline void expect_means_of_full_cells(const Feature_vectors& vectors, const Quantisation& result) {
  const auto sizes = cell_sizes(result);
  EXPECT_EQ(std::ranges::count(sizes, 0U), 0);
  Feature_vectors means = Feature_vectors::Zero(result.code_vectors.rows(), vectors.cols());
  for (std::size_t v = 0; v < result.labels.size(); ++v)
    means.row(result.labels[v]) += vectors.row(static_cast<Eigen::Index>(v)) / double(sizes[result.labels[v]]);
  EXPECT_LT((means - result.code_vectors).cwiseAbs().maxCoeff(), 1e-12 * (1 + vectors.cwiseAbs().maxCoeff()));
}

inline bool same_bits(const Feature_vectors& a, const Feature_vectors& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() &&
         (a.size() == 0 || std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(double)) == 0);
}

inline void expect_same(const Quantisation& a, const Quantisation& b) {
  EXPECT_EQ(a.labels, b.labels);
  EXPECT_TRUE(same_bits(a.code_vectors, b.code_vectors));
  ASSERT_EQ(a.runs.size(), b.runs.size());
  for (std::size_t r = 0; r < a.runs.size(); ++r) {
    EXPECT_EQ(a.runs[r].code_vectors, b.runs[r].code_vectors);
    EXPECT_EQ(a.runs[r].distortion, b.runs[r].distortion);
  }
}

}  // namespace lodestone
