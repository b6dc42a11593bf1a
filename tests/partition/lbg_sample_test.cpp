// SPDX-License-Identifier: GPL-3.0-or-later
// Training on a sample of the vectors, and one assignment of all.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "lodestone/io/shapes/shapes.h"
#include "lodestone/partition/lbg.h"
#include "partition/quantise_cases.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

/// Mean squared distance of the vectors from the means of their cells, per component.
double distortion(const Feature_vectors& vectors, const Quantisation& result) {
  double sum = 0;
  for (std::size_t v = 0; v < result.labels.size(); ++v)
    sum += (vectors.row(static_cast<Eigen::Index>(v)) - result.code_vectors.row(result.labels[v])).squaredNorm();
  return sum / static_cast<double>(vectors.size());
}

TEST(Sample, no_smaller_than_the_vectors_changes_nothing) {
  const auto vectors = seeded_vectors(5000, 6, 1);
  const auto all = quantise(vectors, 7, {.sample = 0});
  for (const std::size_t sample : {5000, 5001, 100000}) expect_same(quantise(vectors, 7, {.sample = sample}), all);
  EXPECT_NE(quantise(vectors, 7, {.sample = 4999}).runs.back().distortion, all.runs.back().distortion);
}

TEST(Sample, holds_at_least_128_vectors_for_each_code_vector) {
  const auto vectors = seeded_vectors(128 * 20, 3, 2);
  expect_same(quantise(vectors, 20, {.sample = 1}), quantise(vectors, 20, {.sample = 0}));
  expect_same(quantise(vectors, 10, {.sample = 1}), quantise(vectors, 10, {.sample = 1280}));
  EXPECT_NE(quantise(vectors, 10, {.sample = 1}).labels, quantise(vectors, 10, {.sample = 0}).labels);
}

TEST(Sample, leaves_meshes_up_to_32768_vertices_as_they_were) {
  const auto vectors = seeded_vectors(32768, 3, 3);
  expect_same(quantise(vectors, 12), quantise(vectors, 12, {.sample = 0}));
}

TEST(Sample, every_cell_holds_a_vector_and_its_code_vector_is_their_mean) {
  for (const std::size_t cells : {1, 2, 5, 12, 33})
    for (const auto split : splits) {
      const auto vectors = seeded_vectors(20001, 6, cells);
      const auto result = quantise(vectors, cells, {.split_rule = split, .sample = 1});
      EXPECT_EQ(static_cast<std::size_t>(result.code_vectors.rows()), cells);
      ASSERT_EQ(result.labels.size(), 20001U);
      expect_means_of_full_cells(vectors, result);
    }
}

TEST(Sample, costs_at_most_a_few_percent_of_distortion) {
  const std::vector<std::pair<std::string, Surface_mesh>> meshes{{"potato", potato(60)},
                                                                 {"teapot", teapot({.u = 24, .v = 24})},
                                                                 {"cube", cube(60)},
                                                                 {"knot", torus_knot({.segments = 600, .sides = 40})}};
  for (const auto& [name, mesh] : meshes) {
    const auto vectors = feature_vectors(mesh);
    for (const std::size_t cells : {32, 64}) {
      SCOPED_TRACE(testing::Message() << name << ", N = " << cells);
      const auto all = quantise(vectors, cells, {.sample = 0}), some = quantise(vectors, cells, {.sample = 1});
      ASSERT_NE(some.labels, all.labels);
      EXPECT_LT(distortion(vectors, some), 1.06 * distortion(vectors, all));
    }
  }
}

TEST(Sample, of_vectors_in_a_regular_order_holds_all_kinds_of_them) {
  // Four clusters take turns: every fourth vector would be of one cluster.
  Feature_vectors vectors = 0.01 * seeded_vectors(4 * 4096, 3, 5);
  for (Eigen::Index v = 0; v < vectors.rows(); ++v) vectors(v, 0) += static_cast<double>(v % 4);
  const auto result = quantise(vectors, 4, {.sample = 4096});
  for (std::size_t v = 4; v < result.labels.size(); ++v) ASSERT_EQ(result.labels[v], result.labels[v % 4]);
  expect_means_of_full_cells(vectors, result);
}

TEST(Sample, that_misses_rare_values_does_not_cost_regions) {
  Feature_vectors vectors = Feature_vectors::Zero(20000, 3);
  for (int i = 1; i < 6; ++i) vectors(3000 * i + 17 * i, 1) = i;
  const auto result = quantise(vectors, 6, {.sample = 1});
  EXPECT_EQ(result.code_vectors.rows(), 6);
  expect_means_of_full_cells(vectors, result);
  EXPECT_EQ(quantise(vectors, 9, {.sample = 1}).code_vectors.rows(), 6);
}

TEST(Sample, whose_code_vectors_are_partly_equal_leaves_no_cell_empty) {
  // The published split of the cell that holds nothing but tens gives 15 and 5. All tens go to 15, then one of them to
  // the empty cell of 5: after the only iteration two code vectors are 10, of which the second gets no vectors.
  Feature_vectors vectors(600, 1);
  vectors << Feature_vectors::Constant(150, 1, 10), Feature_vectors::Constant(225, 1, -1),
      Feature_vectors::Constant(225, 1, -2);
  for (const auto search : {Nearest_search::bounded, Nearest_search::plain}) {
    const auto result = quantise(
        vectors, 3,
        {.split = 0.5, .split_rule = Split::multiplicative, .search = search, .sample = 1, .max_iterations = 1});
    EXPECT_EQ(result.code_vectors.rows(), 3);
    expect_means_of_full_cells(vectors, result);
  }
}

TEST(Sample, gives_the_same_bits_on_any_number_of_threads_and_with_either_search) {
  for (const std::size_t cells : {2, 11, 64}) {
    const auto vectors = seeded_vectors(30003, 6, cells);
    const auto alone = quantise(vectors, cells, {.sample = 8192, .threads = 1});
    for (const std::size_t threads : {2, 3, 0})
      expect_same(quantise(vectors, cells, {.sample = 8192, .threads = threads}), alone);
    expect_same(quantise(vectors, cells, {.search = Nearest_search::plain, .sample = 8192}), alone);
  }
}

TEST(Sample, finds_nearest_code_vectors_whatever_the_order_of_the_vectors) {
  // Labels to begin with are wrong for nearly all vectors, since neighbours in the list are not neighbours in space.
  const auto vectors = seeded_vectors(20000, 3, 7);
  const auto result = quantise(vectors, 16, {.sample = 4096});
  expect_same(quantise(vectors, 16, {.search = Nearest_search::plain, .sample = 4096}), result);
}

TEST(Sample, keeps_large_partitions_connected_and_full) {
  const auto mesh = icosphere(70);
  ASSERT_GT(num_vertices(mesh), 32768U);
  const Numbered_mesh numbered(mesh);
  const auto partition =
      partition_numbered(Numbered_surface{numbered.graph, numbered.positions, numbered.faces}, 32, Lbg{});
  EXPECT_EQ(partition.regions, 32U);
  EXPECT_EQ(count_parts(numbered.graph, partition.labels), 32U);
}

}  // namespace
}  // namespace lodestone
