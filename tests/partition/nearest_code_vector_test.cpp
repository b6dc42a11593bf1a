// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/nearest_code_vector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "partition/quantise_cases.h"

namespace lodestone {
namespace {

Feature_vectors drawn(const Feature_vectors& vectors, Eigen::Index count, std::mt19937_64& random) {
  Feature_vectors codes(count, vectors.cols());
  for (Eigen::Index i = 0; i < count; ++i)
    codes.row(i) = vectors.row(static_cast<Eigen::Index>(random() % static_cast<std::uint64_t>(vectors.rows())));
  return codes;
}

void expect_equal(const Assignment& bounded, const Assignment& plain) {
  EXPECT_EQ(bounded.labels, plain.labels);
  EXPECT_EQ(bounded.squared_distances, plain.squared_distances);
}

/// Runs both searches side by side as Lloyd iterations do: code vectors drift, and sometimes become more.
void compare_over_iterations(const Feature_vectors& vectors, Eigen::Index codes_wanted, std::mt19937_64& random) {
  Bounded_assignment search(vectors);
  Assignment bounded, plain;
  std::normal_distribution<double> drift(0, 0.05 * vectors.cwiseAbs().maxCoeff());
  for (const Eigen::Index count : {(codes_wanted + 1) / 2, codes_wanted}) {
    Feature_vectors codes = drawn(vectors, count, random);
    for (int iteration = 0; iteration < 4; ++iteration) {
      search.assign(codes, bounded);
      assign_plain(vectors, codes, plain);
      expect_equal(bounded, plain);
      // Some code vectors stay, as they do towards the end of a run.
      for (Eigen::Index c = 0; c < count; c += 1 + static_cast<Eigen::Index>(random() % 3))
        for (Eigen::Index j = 0; j < codes.cols(); ++j) codes(c, j) += iteration == 2 ? 0 : drift(random);
    }
  }
}

TEST(Assign_plain, takes_the_nearest_code_vector_and_the_lowest_index_of_equally_near_ones) {
  const Feature_vectors vectors = (Feature_vectors(4, 2) << 0, 0, 1, 0, 2, 0, 5, 3).finished();
  const Feature_vectors codes = (Feature_vectors(3, 2) << 2, 0, 0, 0, 2, 0).finished();
  Assignment assignment;
  assign_plain(vectors, codes, assignment);
  EXPECT_EQ(assignment.labels, (std::vector<Region_index>{1, 0, 0, 0}));
  EXPECT_EQ(assignment.squared_distances, (std::vector<double>{0, 1, 0, 18}));
  EXPECT_EQ(assignment.distance_evaluations, 12U);
}

TEST(Bounded_assignment, counts_each_vector_with_each_code_vector_where_no_bound_spares_a_distance) {
  // All vectors are as far from all six code vectors: 19 of them are two whole blocks and a part of one.
  const Feature_vectors vectors = Feature_vectors::Zero(19, 3);
  Feature_vectors codes(6, 3);
  codes << Eigen::Matrix3d::Identity(), -Eigen::Matrix3d::Identity();
  for (const Region_index labels : {1, 2}) {  // a block whose vectors share a label is searched in another way
    Assignment assignment;
    for (Region_index v = 0; v < 19; ++v) assignment.labels.push_back(v % labels);
    Bounded_assignment(vectors).assign(codes, assignment);
    EXPECT_EQ(assignment.distance_evaluations, 19U * 6) << labels;
  }
}

TEST(Bounded_assignment, equals_the_plain_loop_on_random_vectors) {
  std::mt19937_64 random(1);
  for (const Eigen::Index components : {3, 6, 7, 10})
    for (const Eigen::Index codes : {1, 2, 3, 7, 16, 61, 128, 300})
      compare_over_iterations(random_vectors(400, components, random), codes, random);
}

TEST(Bounded_assignment, equals_the_plain_loop_where_vectors_and_distances_are_equal) {
  std::mt19937_64 random(2);
  for (const Eigen::Index components : {3, 6, 7, 10})
    for (const Eigen::Index codes : {1, 2, 5, 32, 150}) {
      const auto vectors = lattice_vectors(300, components, 3, random);
      compare_over_iterations(vectors, codes, random);
      // Code vectors on the lattice itself: ties everywhere.
      Bounded_assignment search(vectors);
      Assignment bounded, plain;
      for (int iteration = 0; iteration < 3; ++iteration) {
        const auto lattice_codes = drawn(vectors, codes, random);
        search.assign(lattice_codes, bounded);
        assign_plain(vectors, lattice_codes, plain);
        expect_equal(bounded, plain);
      }
    }
}

TEST(Bounded_assignment, equals_the_plain_loop_far_from_the_origin_and_at_any_scale) {
  std::mt19937_64 random(3);
  for (const double scale : {1e-170, 1e-9, 1e9, 1e155}) {
    compare_over_iterations(scale * random_vectors(200, 6, random), 20, random);
    Feature_vectors far = random_vectors(200, 3, random);
    far.rowwise() += Eigen::RowVector3d(1e7, -1e7, 0);
    compare_over_iterations(scale * far, 20, random);
  }
}

TEST(Bounded_assignment, equals_the_plain_loop_in_tight_clusters) {
  std::mt19937_64 random(4);
  Feature_vectors vectors = lattice_vectors(300, 3, 3, random);
  vectors += 1e-9 * random_vectors(300, 3, random);
  for (const Eigen::Index codes : {4, 27, 90}) compare_over_iterations(vectors, codes, random);
}

TEST(Bounded_assignment, starts_from_any_label) {
  std::mt19937_64 random(5);
  const auto vectors = random_vectors(300, 6, random);
  const auto codes = drawn(vectors, 40, random);
  Assignment plain;
  assign_plain(vectors, codes, plain);
  for (int trial = 0; trial < 5; ++trial) {
    Bounded_assignment search(vectors);
    Assignment bounded;
    bounded.labels.resize(300);
    for (auto& label : bounded.labels) label = static_cast<Region_index>(random() % 40);
    search.assign(codes, bounded);
    expect_equal(bounded, plain);
  }
}

TEST(Bounded_assignment, follows_labels_that_its_caller_has_changed) {
  std::mt19937_64 random(6);
  const auto vectors = random_vectors(300, 3, random);
  auto codes = drawn(vectors, 25, random);
  Bounded_assignment search(vectors);
  Assignment bounded, plain;
  for (int iteration = 0; iteration < 8; ++iteration) {
    search.assign(codes, bounded);
    assign_plain(vectors, codes, plain);
    expect_equal(bounded, plain);
    // As in the repair of an empty cell, a vector replaces a code vector.
    const auto vector = static_cast<Eigen::Index>(random() % 300);
    const auto code = static_cast<Region_index>(random() % 25);
    codes.row(code) = vectors.row(vector);
    bounded.labels[vector] = code;
    bounded.squared_distances[vector] = 0;
  }
}

TEST(Bounded_assignment, equals_the_plain_loop_beyond_its_limit_of_code_vectors) {
  std::mt19937_64 random(7);
  const auto vectors = random_vectors(50, 3, random);
  for (const Eigen::Index codes : {Bounded_assignment::max_codes - 1, Bounded_assignment::max_codes + 1})
    compare_over_iterations(vectors, codes, random);
}

TEST(Bounded_assignment, skips_most_distances_after_convergence) {
  std::mt19937_64 random(8);
  const auto vectors = random_vectors(3000, 3, random);
  const auto codes = drawn(vectors, 64, random);
  Bounded_assignment search(vectors);
  Assignment bounded;
  search.assign(codes, bounded);
  const auto before = bounded.distance_evaluations;
  search.assign(codes, bounded);
  EXPECT_LT(bounded.distance_evaluations - before, 3000U * 64 / 4);
}

}  // namespace
}  // namespace lodestone
