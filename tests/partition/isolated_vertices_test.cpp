// SPDX-License-Identifier: GPL-3.0-or-later
// Vertices that no face uses, anywhere in space and in the list of vertices.
#include <gtest/gtest.h>

#include <vector>

#include "lodestone/partition/lbg_curvature.h"
#include "lodestone/partition/partition_measures.h"
#include "lodestone/partition/strategies.h"
#include "partition/surface_soup.h"

namespace lodestone {
namespace {

/// A surface, and the same with a vertex without faces before each third of its vertices and after the last.
class Isolated_vertices : public testing::TestWithParam<double> {
 protected:
  Isolated_vertices() {
    std::vector<Eigen::RowVector3d> points;
    for (Eigen::Index v = 0; v < alone.positions.rows(); ++v) {
      if (v % 3 == 0) points.emplace_back(GetParam() * static_cast<double>(v + 1), -GetParam(), 0.5);
      place.push_back(static_cast<std::uint32_t>(points.size()));
      points.emplace_back(alone.positions.row(v));
    }
    points.emplace_back(-GetParam(), 0, 0);
    among.positions.resize(static_cast<Eigen::Index>(points.size()), 3);
    for (std::size_t v = 0; v < points.size(); ++v) among.positions.row(static_cast<Eigen::Index>(v)) = points[v];
    for (const auto& [a, b, c] : alone.faces) among.faces.push_back({place[a], place[b], place[c]});
    among.graph = vertex_graph(static_cast<std::uint32_t>(points.size()), among.faces);
  }

  Surface_soup alone = surface_soup(potato(9));
  Surface_soup among;
  std::vector<std::uint32_t> place;  ///< per vertex of `alone`: the same in `among`
};

TEST_P(Isolated_vertices, change_no_partition_and_no_measure) {
  for (const auto& entry : strategies())
    for (const std::size_t regions : {1, 5, 12, 40}) {
      SCOPED_TRACE(std::string(entry.name) + ", " + std::to_string(regions) + " regions");
      const auto expected = partition_numbered(alone.surface(), regions, entry.make({}));
      const auto result = partition_numbered(among.surface(), regions, entry.make({}));
      std::vector<Region_index> labels;
      for (const auto v : place) labels.push_back(result.labels[v]);
      EXPECT_EQ(labels, expected.labels);
      std::vector<std::uint32_t> particles;
      for (const auto v : expected.particles) particles.push_back(place[v]);
      EXPECT_EQ(result.particles, particles);
      EXPECT_EQ(result.labels.front(), 0U);
      EXPECT_EQ(result.labels.back(), 0U);

      const auto m = measure_partition(among.surface(), result), n = measure_partition(alone.surface(), expected);
      EXPECT_EQ(m.distortion, n.distortion);
      EXPECT_EQ(m.size_balance, n.size_balance);
      EXPECT_EQ(m.border_length, n.border_length);
      EXPECT_EQ(m.normal_deviation, n.normal_deviation);
      EXPECT_EQ(m.geodesic_radius, n.geodesic_radius);
      EXPECT_EQ(m.box_volume, n.box_volume);
      EXPECT_EQ(m.ball_volume, n.ball_volume);
    }
}

TEST_P(Isolated_vertices, have_a_curvature_factor_of_0_and_change_no_other) {
  const auto expected = curvature_factor(alone.surface()), factor = curvature_factor(among.surface());
  ASSERT_EQ(factor.rows(), among.positions.rows());
  for (std::size_t v = 0; v < place.size(); ++v)
    EXPECT_EQ(factor(place[v], 0), expected(static_cast<Eigen::Index>(v), 0));
  EXPECT_EQ(factor(0, 0), 0);
}

TEST_P(Isolated_vertices, leave_further_factors_to_the_vertices_that_have_them) {
  const Eigen::VectorXd rows = Eigen::VectorXd::LinSpaced(alone.positions.rows(), -2, 2);
  Lbg expected, lbg;
  expected.extra_factors = rows;
  lbg.extra_factors = Feature_vectors::Constant(among.positions.rows(), 1, 1e5);
  for (std::size_t v = 0; v < place.size(); ++v) lbg.extra_factors(place[v], 0) = rows[static_cast<Eigen::Index>(v)];
  const auto labels = lbg.label(among.surface(), 7).labels, wanted = expected.label(alone.surface(), 7).labels;
  for (std::size_t v = 0; v < place.size(); ++v) EXPECT_EQ(labels[place[v]], wanted[v]);
}

INSTANTIATE_TEST_SUITE_P(At, Isolated_vertices, testing::Values(0.0, 1.5, 1e3, 1e18, 1e140));

TEST(Isolated_vertices_alone, are_one_region) {
  // A face whose corners are one vertex has no edge.
  const Surface_soup soup{Positions::Random(5, 3), {{2, 2, 2}}};
  for (const auto& entry : strategies()) {
    const auto result = partition_numbered(soup.surface(), 3, entry.make({}));
    EXPECT_EQ(result.regions, 1U) << entry.name;
    EXPECT_NO_THROW(measure_partition(soup.surface(), result)) << entry.name;
  }
}

}  // namespace
}  // namespace lodestone
