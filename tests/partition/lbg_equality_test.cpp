// SPDX-License-Identifier: GPL-3.0-or-later
// The bounded search and the plain one over many small problems, most of them full of ties and near ties.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "lodestone/partition/lbg.h"
#include "partition/quantise_cases.h"
#include "support/special_numbers.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

using Random = std::mt19937_64;

Eigen::Index between(Eigen::Index low, Eigen::Index high, Random& random) {
  return std::uniform_int_distribution<Eigen::Index>(low, high)(random);
}

/// Vectors within about `spread` of a few centres.
Feature_vectors clusters(Eigen::Index count, Eigen::Index components, double spread, Random& random) {
  const auto centres = random_vectors(between(1, 6, random), components, random);
  Feature_vectors vectors = spread * random_vectors(count, components, random);
  for (auto row : vectors.rowwise()) row += centres.row(between(0, centres.rows() - 1, random));
  return vectors;
}

/// Each vector several times, in random order.
Feature_vectors duplicates(Eigen::Index count, Eigen::Index components, Random& random) {
  const auto some = random_vectors(between(1, std::max<Eigen::Index>(1, count / 3), random), components, random);
  Feature_vectors vectors(count, components);
  for (auto row : vectors.rowwise()) row = some.row(between(0, some.rows() - 1, random));
  return vectors;
}

/// Whether both searches give the same labels, code vectors and runs, to the last bit, with both splits.
bool equal_results(const Feature_vectors& vectors, std::size_t cells) {
  for (const auto split : splits) {
    const auto bounded = quantise(vectors, cells, {.split_rule = split, .search = Nearest_search::bounded});
    const auto plain = quantise(vectors, cells, {.split_rule = split, .search = Nearest_search::plain});
    if (bounded.labels != plain.labels || bounded.code_vectors.rows() != plain.code_vectors.rows() ||
        bounded.code_vectors != plain.code_vectors || bounded.runs.size() != plain.runs.size())
      return false;
    for (std::size_t r = 0; r < plain.runs.size(); ++r)
      if (bounded.runs[r].code_vectors != plain.runs[r].code_vectors ||
          bounded.runs[r].distortion != plain.runs[r].distortion)
        return false;
  }
  return true;
}

/// Runs `problems` random problems that `make` creates for a number of vectors and of components; a failure reports its
/// seed.
template <class Make>
void compare_searches(std::uint64_t problems, Eigen::Index most_vectors, Eigen::Index most_cells, Make make) {
  for (std::uint64_t seed = 1; seed <= problems; ++seed) {
    Random random(seed);
    const Eigen::Index count = between(1, most_vectors, random), components = between(1, 8, random);
    const auto cells = static_cast<std::size_t>(between(1, most_cells, random));
    const Feature_vectors vectors = make(count, components, random);
    ASSERT_TRUE(equal_results(vectors, cells))
        << "seed " << seed << ": M = " << count << ", k = " << components << ", N = " << cells;
  }
}

TEST(Quantise, both_searches_agree_on_random_vectors) { compare_searches(300, 400, 60, random_vectors); }

TEST(Quantise, both_searches_agree_on_integer_lattices) {
  for (const Eigen::Index values : {2, 4})
    compare_searches(1000, 200, 40, [&](Eigen::Index count, Eigen::Index components, Random& random) {
      return lattice_vectors(count, components, values, random);
    });
}

TEST(Quantise, both_searches_agree_on_lattices_whose_steps_are_not_exact) {
  compare_searches(500, 200, 40, [](Eigen::Index count, Eigen::Index components, Random& random) {
    return Feature_vectors(0.1 * lattice_vectors(count, components, 4, random));
  });
}

TEST(Quantise, both_searches_agree_in_clusters_down_to_the_size_of_rounding) {
  for (const double spread : {1e-4, 1e-12, 1e-14, 1e-16})
    compare_searches(400, 400, 60, [&](Eigen::Index count, Eigen::Index components, Random& random) {
      return clusters(count, components, spread, random);
    });
}

TEST(Quantise, both_searches_agree_on_vectors_that_occur_several_times) { compare_searches(500, 400, 60, duplicates); }

TEST(Quantise, both_searches_agree_far_from_the_origin_and_at_any_scale) {
  for (const double size : {1e-100, 1e-12, 1e12, 1e90})
    compare_searches(100, 300, 60, [&](Eigen::Index count, Eigen::Index components, Random& random) {
      Feature_vectors vectors = random_vectors(count, components, random);
      vectors.rowwise() += Eigen::RowVectorXd::Constant(components, 1e6);
      return Feature_vectors(size * vectors);
    });
}

TEST(Quantise, non_finite_and_too_large_components_are_refused) {
  Random random(1);
  const auto vectors = random_vectors(20, 3, random);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity, 1.01e100, -1e101, 1e300})
    for (const Eigen::Index row : {0, 19})
      for (const auto search : {Nearest_search::bounded, Nearest_search::plain}) {
        Feature_vectors broken = vectors;
        broken(row, 2) = bad;
        EXPECT_THROW(quantise(broken, 4, {.search = search}), Bad_argument) << bad;
      }
  EXPECT_NO_THROW(quantise(1e98 * vectors, 4));
}

TEST(Feature_vectors, weights_out_of_range_are_refused) {
  const Numbered_mesh mesh(sphere(3));
  const auto made = [&](const Feature_options& options) {
    return feature_vectors(mesh.positions, mesh.faces, options);
  };
  for (const double bad : {1.01e6, 1e100, infinity, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(made({.position_weight = bad}), Bad_argument) << bad;
    EXPECT_THROW(made({.normal_weight = bad}), Bad_argument) << bad;
  }
  EXPECT_NO_THROW(made({.position_weight = 1e6, .normal_weight = 1e6}));
}

TEST(Lbg, weights_out_of_range_are_refused) {
  auto mesh = sphere(3);
  auto map = mesh.add_property_map<Surface_mesh::Vertex_index, Region_index>("v:label").first;
  EXPECT_THROW(lbg(mesh, 4, map, {.features = {.normal_weight = 1.01e6}}), Bad_argument);
  EXPECT_THROW(lbg(mesh, 4, map, {.features = {.position_weight = 1e9}}), Bad_argument);
  EXPECT_NO_THROW(lbg(mesh, 4, map, {.features = {.normal_weight = 1e6}}));
}

}  // namespace
}  // namespace lodestone
