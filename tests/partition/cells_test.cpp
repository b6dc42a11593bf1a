// SPDX-License-Identifier: GPL-3.0-or-later
// What follows an assignment: sums, sizes and labels of the cells stay those of the vectors that are in them.
#include "partition/cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace lodestone {
namespace {

/// Every vector in the cell of its nearest code vector.
Assignment assigned(const Feature_vectors& vectors, const Feature_vectors& codes) {
  Assignment assignment;
  Workers workers(1);
  assign_plain(vectors, codes, assignment, workers);
  return assignment;
}

/// Compares sizes, sums and distances with those computed from the labels.
void expect_those_of_the_labels(const Assignment& assignment, const Feature_vectors& vectors,
                                const Feature_vectors& codes) {
  Feature_vectors sums = Feature_vectors::Zero(codes.rows(), codes.cols());
  std::vector<std::size_t> sizes(static_cast<std::size_t>(codes.rows()));
  for (std::size_t v = 0; v < assignment.labels.size(); ++v) {
    const auto vector = vectors.row(static_cast<Eigen::Index>(v));
    const Region_index cell = assignment.labels[v];
    sums.row(cell) += vector;
    ++sizes[cell];
    EXPECT_NEAR(assignment.squared_distances[v], (vector - codes.row(cell)).squaredNorm(), 1e-12);
  }
  EXPECT_LT((assignment.cell_sums - sums).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_TRUE(std::ranges::equal(assignment.cell_sizes, sizes));
}

TEST(Cells, that_are_empty_take_the_farthest_vectors_of_the_widest) {
  const Feature_vectors vectors = (Feature_vectors(5, 1) << 0, 1, 10, 14, 18).finished();
  Feature_vectors codes = (Feature_vectors(4, 1) << 0.5, 13, 100, 200).finished();
  Assignment assignment = assigned(vectors, codes);
  EXPECT_TRUE(refill_empty_cells(vectors, codes, assignment));
  expect_those_of_the_labels(assignment, vectors, codes);
  EXPECT_EQ(assignment.labels, (std::vector<Region_index>{0, 0, 3, 1, 2}));
  EXPECT_EQ(codes(2, 0), 18);
  EXPECT_EQ(codes(3, 0), 10);
  move_codes_to_means(assignment, codes);
  EXPECT_EQ(codes, (Feature_vectors(4, 1) << 0.5, 14, 18, 10).finished());
}

TEST(Cells, that_are_empty_are_filled_where_there_are_enough_different_vectors) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int round = 0; round < 50; ++round) {
    Feature_vectors vectors(30, 3), codes(12, 3);
    for (auto& x : vectors.reshaped()) x = number(random);
    for (auto& x : codes.reshaped()) x = 20 * number(random);  // few of them are near a vector
    Assignment assignment = assigned(vectors, codes);
    const bool had_empty = std::ranges::find(assignment.cell_sizes, 0U) != assignment.cell_sizes.end();
    EXPECT_EQ(refill_empty_cells(vectors, codes, assignment), had_empty);
    expect_those_of_the_labels(assignment, vectors, codes);
    EXPECT_EQ(std::ranges::count(assignment.cell_sizes, 0U), 0);
  }
}

TEST(Cells, stay_empty_where_vectors_are_the_same) {
  const Feature_vectors vectors = (Feature_vectors(3, 1) << 2, 2, 2).finished();
  Feature_vectors codes = (Feature_vectors(2, 1) << 2, 9).finished();
  Assignment assignment = assigned(vectors, codes);
  EXPECT_TRUE(refill_empty_cells(vectors, codes, assignment));
  expect_those_of_the_labels(assignment, vectors, codes);
  EXPECT_EQ(drop_empty_cells(assignment, codes)[0], 0U);
  EXPECT_EQ(codes, (Feature_vectors(1, 1) << 2).finished());
}

TEST(Cells, that_are_dropped_leave_the_code_vectors_of_the_others) {
  Feature_vectors codes = (Feature_vectors(4, 1) << 1, 2, 3, 4).finished();
  Assignment assignment;
  assignment.cell_sizes = {5, 0, 0, 7};
  EXPECT_EQ(drop_empty_cells(assignment, codes), (std::vector<Region_index>{0, 1, 1, 1}));
  EXPECT_EQ(codes, (Feature_vectors(2, 1) << 1, 4).finished());
}

TEST(Cells, that_are_empty_take_from_the_widest_that_is_left) {
  const Feature_vectors vectors = (Feature_vectors(5, 1) << 5, 5.5, 13, 18, 26).finished();
  Feature_vectors codes = (Feature_vectors(4, 1) << 5, 22, 100, 200).finished();
  Assignment assignment;
  Workers workers(1);
  assign_plain(vectors, codes, assignment, workers);
  ASSERT_EQ(assignment.labels, (std::vector<Region_index>{0, 0, 0, 1, 1}));
  EXPECT_TRUE(refill_empty_cells(vectors, codes, assignment));
  EXPECT_EQ(assignment.labels, (std::vector<Region_index>{0, 0, 2, 3, 1}));
}

}  // namespace
}  // namespace lodestone
