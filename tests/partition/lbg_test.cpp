// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/lbg.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>

#include "partition/quantise_cases.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

/// `per_cluster` vectors within 0.01 of each centre.
Feature_vectors clusters(const Feature_vectors& centres, Eigen::Index per_cluster) {
  Feature_vectors vectors = 0.005 * seeded_vectors(centres.rows() * per_cluster, centres.cols(), 3);
  for (Eigen::Index v = 0; v < vectors.rows(); ++v) vectors.row(v) += centres.row(v / per_cluster);
  return vectors;
}

std::vector<Region_index> labels_on(const Surface_mesh& mesh, std::size_t regions, const Lbg_options& options = {}) {
  Surface_mesh copy = mesh;
  auto map = copy.add_property_map<Surface_mesh::Vertex_index, Region_index>("v:label").first;
  lbg(copy, regions, map, options);
  std::vector<Region_index> labels;
  for (const auto v : copy.vertices()) labels.push_back(map[v]);
  return labels;
}

TEST(Quantise, one_cell_is_the_mean) {
  const auto vectors = seeded_vectors(100, 6, 1);
  const auto result = quantise(vectors, 1);
  ASSERT_EQ(result.code_vectors.rows(), 1);
  EXPECT_TRUE(result.code_vectors.row(0).isApprox(vectors.colwise().mean(), 1e-13));
  EXPECT_EQ(result.labels, std::vector<Region_index>(100, 0));
}

TEST(Quantise, two_vectors_become_two_cells) {
  const Feature_vectors vectors = (Feature_vectors(2, 3) << 1, 2, 3, 4, 2, 3).finished();
  for (const auto split : splits) {
    const auto result = quantise(vectors, 2, {.split_rule = split});
    ASSERT_EQ(result.code_vectors.rows(), 2);
    EXPECT_NE(result.labels[0], result.labels[1]);
    for (Eigen::Index v = 0; v < 2; ++v) EXPECT_EQ(result.code_vectors.row(result.labels[v]), vectors.row(v));
    EXPECT_EQ(result.runs.back().distortion.back(), 0);
  }
}

TEST(Quantise, well_separated_clusters_are_the_cells) {
  const Feature_vectors centres = (Feature_vectors(4, 3) << 9, 1, 0, -7, 2, 0, 1, 8, 1, 2, -6, 3).finished();
  const auto vectors = clusters(centres, 25);
  for (const auto split : splits) {
    const auto result = quantise(vectors, 4, {.split_rule = split});
    ASSERT_EQ(result.code_vectors.rows(), 4);
    std::set<Region_index> used;
    for (std::size_t v = 0; v < 100; ++v) {
      EXPECT_EQ(result.labels[v], result.labels[v / 25 * 25]);
      used.insert(result.labels[v]);
    }
    EXPECT_EQ(used.size(), 4U);
    expect_means_of_full_cells(vectors, result);
  }
}

TEST(Quantise, two_code_vectors_cut_a_line_of_vectors_in_the_middle) {
  Feature_vectors vectors = Feature_vectors::Zero(40, 3);
  for (Eigen::Index v = 0; v < 40; ++v) vectors(v, 1) = static_cast<double>(v);
  for (const auto split : splits) {
    const auto result = quantise(vectors, 2, {.tolerance = 1e-9, .split_rule = split});
    for (std::size_t v = 0; v < 40; ++v) EXPECT_EQ(result.labels[v] == result.labels[0], v < 20) << v;
    // The variance of 20 equal steps is (20^2 - 1) / 12, here over 3 components.
    EXPECT_NEAR(result.runs.back().distortion.back(), 399.0 / 36, 1e-9);
  }
}

TEST(Quantise, any_number_of_cells_is_reached_and_each_is_the_mean_of_its_vectors) {
  const auto vectors = seeded_vectors(300, 6, 4);
  for (const std::size_t cells : {2, 3, 5, 6, 7, 12, 33, 100, 300})
    for (const auto split : splits) {
      const auto result = quantise(vectors, cells, {.split_rule = split});
      EXPECT_EQ(static_cast<std::size_t>(result.code_vectors.rows()), cells);
      expect_means_of_full_cells(vectors, result);
    }
}

TEST(Quantise, code_vectors_double_until_the_last_split) {
  const auto result = quantise(seeded_vectors(300, 3, 5), 11);
  std::vector<std::size_t> counts;
  for (const auto& run : result.runs) counts.push_back(run.code_vectors);
  EXPECT_EQ(counts, (std::vector<std::size_t>{1, 2, 4, 8, 11}));
}

TEST(Quantise, the_last_split_takes_the_cell_with_the_largest_distortion) {
  // One cluster has two halves 2 apart, the other is tight: the third code vector must go to the first.
  const Feature_vectors centres = (Feature_vectors(4, 2) << 21, 5, 23, 5, -20, 5, -20, 5).finished();
  const auto vectors = clusters(centres, 20);
  for (const auto split : splits) {
    const auto result = quantise(vectors, 3, {.split_rule = split});
    EXPECT_NE(result.labels[0], result.labels[20]);
    EXPECT_EQ(result.labels[40], result.labels[60]);
  }
}

TEST(Quantise, distortion_never_rises_within_a_run_and_a_run_ends_at_the_first_small_drop) {
  const double tolerance = 0.003;
  for (const auto split : splits) {
    const auto result = quantise(seeded_vectors(2000, 6, 6), 24, {.tolerance = tolerance, .split_rule = split});
    for (const auto& run : result.runs) {
      const auto& d = run.distortion;
      ASSERT_GE(d.size(), 2U);
      for (std::size_t i = 1; i < d.size(); ++i) {
        EXPECT_LE(d[i], d[i - 1] * (1 + 1e-12));
        EXPECT_EQ((d[i - 1] - d[i]) / d[i - 1] <= tolerance, i + 1 == d.size());
      }
    }
  }
}

TEST(Quantise, distortion_is_the_mean_squared_error_per_component) {
  const auto vectors = seeded_vectors(500, 6, 7);
  const auto result = quantise(vectors, 1);
  const double spread = (vectors.rowwise() - vectors.colwise().mean().eval()).squaredNorm();
  EXPECT_NEAR(result.runs[0].distortion[0], spread / (6 * 500), 1e-12);
}

TEST(Quantise, more_cells_than_different_vectors_give_one_for_each) {
  Feature_vectors vectors(30, 2);
  for (Eigen::Index v = 0; v < 30; ++v) vectors.row(v) << static_cast<double>(v % 5), static_cast<double>(v % 2);
  for (const auto split : splits)
    for (const std::size_t cells : {10, 11, 16, 30, 1000}) {
      const auto result = quantise(vectors, cells, {.split_rule = split});
      EXPECT_EQ(result.code_vectors.rows(), 10);
      for (std::size_t v = 0; v < 30; ++v)
        EXPECT_EQ(result.code_vectors.row(result.labels[v]), vectors.row(static_cast<Eigen::Index>(v)));
      expect_means_of_full_cells(vectors, result);
    }
}

TEST(Quantise, a_cell_that_becomes_empty_is_re_seeded) {
  // At the origin the published split gives two equal code vectors, one of which gets no vectors.
  const Feature_vectors vectors = (Feature_vectors(4, 1) << -3, -2, 2, 3).finished();
  for (const std::size_t cells : {2, 3, 4}) {
    const auto result = quantise(vectors, cells, {.split_rule = Split::multiplicative});
    EXPECT_EQ(static_cast<std::size_t>(result.code_vectors.rows()), cells);
    expect_means_of_full_cells(vectors, result);
  }
  const auto halves = quantise(vectors, 2, {.split_rule = Split::multiplicative});
  EXPECT_EQ(halves.labels[0], halves.labels[1]);
  EXPECT_EQ(halves.labels[2], halves.labels[3]);
  EXPECT_NE(halves.labels[0], halves.labels[2]);
}

TEST(Quantise, a_cell_that_is_re_seeded_in_the_last_iteration_stays) {
  const Feature_vectors vectors = (Feature_vectors(4, 1) << -3, -2, 2, 3).finished();
  for (const std::size_t cells : {2, 3, 4}) {
    const auto result = quantise(vectors, cells, {.split_rule = Split::multiplicative, .max_iterations = 1});
    EXPECT_EQ(static_cast<std::size_t>(result.code_vectors.rows()), cells);
    expect_means_of_full_cells(vectors, result);
  }
}

TEST(Quantise, equal_vectors_are_one_cell) {
  const Feature_vectors vectors = Feature_vectors::Constant(50, 6, 2.5);
  for (const auto split : splits) EXPECT_EQ(quantise(vectors, 8, {.split_rule = split}).code_vectors.rows(), 1);
}

TEST(Quantise, bounded_and_plain_search_give_equal_results) {
  for (const auto split : splits)
    for (const Eigen::Index components : {3, 6, 7, 10})
      for (const std::size_t cells : {5, 64, 200}) {
        const auto vectors = seeded_vectors(600, components, cells);
        const auto bounded = quantise(vectors, cells, {.split_rule = split, .search = Nearest_search::bounded});
        const auto plain = quantise(vectors, cells, {.split_rule = split, .search = Nearest_search::plain});
        EXPECT_EQ(bounded.labels, plain.labels);
        EXPECT_EQ(bounded.code_vectors, plain.code_vectors);
        ASSERT_EQ(bounded.runs.size(), plain.runs.size());
        for (std::size_t r = 0; r < plain.runs.size(); ++r)
          EXPECT_EQ(bounded.runs[r].distortion, plain.runs[r].distortion);
      }
}

TEST(Quantise, counts_the_distances_of_every_iteration_and_of_the_assignment_after_training_on_a_sample) {
  const std::size_t count = 2000, cells = 6;
  const auto vectors = seeded_vectors(count, 3, 8);
  for (const std::size_t sample : {0, 900}) {
    const auto result = quantise(vectors, cells, {.search = Nearest_search::plain, .sample = sample});
    std::size_t expected = sample > 0 ? count * cells : 0;
    for (const auto& run : result.runs)
      expected += run.distortion.size() * (sample > 0 ? sample : count) * run.code_vectors;
    EXPECT_EQ(result.distance_evaluations, expected) << sample;
  }
}

TEST(Quantise, nothing_to_quantise_and_options_out_of_range_are_refused) {
  const auto vectors = seeded_vectors(10, 3, 1);
  EXPECT_THROW(quantise(Feature_vectors(0, 3), 2), Bad_argument);
  EXPECT_THROW(quantise(vectors, 0), Bad_argument);
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(quantise(vectors, 2, {.split = bad}), Bad_argument);
    EXPECT_THROW(quantise(vectors, 2, {.tolerance = bad}), Bad_argument);
  }
}

TEST(Lbg, regions_do_not_change_under_translation_and_uniform_scale) {
  const auto mesh = potato(12);
  const auto expected = labels_on(mesh, 20);
  for (const double factor : {0x1p-40, 0x1p60, 3.7, 1e-5}) {
    auto moved = mesh;
    scale(moved, factor);
    EXPECT_EQ(labels_on(moved, 20), expected) << factor;
    shift(moved, 5 * factor, -3 * factor, 0.1 * factor);
    EXPECT_EQ(labels_on(moved, 20), expected) << factor;
  }
  for (const double offset : {1024.0, -77.3}) {
    auto moved = mesh;
    shift(moved, offset, 0, offset);
    EXPECT_EQ(labels_on(moved, 20), expected) << offset;
  }
}

TEST(Lbg, both_splits_divide_a_mesh_centred_at_the_origin) {
  for (const auto split : splits) {
    const auto labels = labels_on(sphere(10), 16, {.split_rule = split});
    EXPECT_EQ(std::set(labels.begin(), labels.end()).size(), 16U);
  }
}

TEST(Lbg, both_searches_give_the_same_regions) {
  const auto mesh = sphere(14);  // symmetric: many equal distances
  for (const std::size_t regions : {12, 50, 200})
    EXPECT_EQ(labels_on(mesh, regions, {.search = Nearest_search::bounded}),
              labels_on(mesh, regions, {.search = Nearest_search::plain}));
}

TEST(Lbg, options_out_of_range_are_refused) {
  EXPECT_THROW(labels_on(sphere(2), 4, {.split = 0}), Bad_argument);
  EXPECT_THROW(labels_on(sphere(2), 4, {.features = {.normal_weight = -1}}), Bad_argument);
  EXPECT_THROW(labels_on(sphere(2), 0), Bad_argument);
}

}  // namespace
}  // namespace lodestone
