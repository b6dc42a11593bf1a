// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/partition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "lodestone/partition/lbg.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

/// The result of a partition, with its labels by vertex index.
struct Divided {
  std::vector<Region_index> labels;
  Partition<Surface_mesh> partition;
};

template <class Strategy = Lbg>
Divided divide(const Surface_mesh& mesh, std::size_t regions, const Strategy& strategy = {},
               const Partition_options& options = {}) {
  Surface_mesh copy = mesh;
  auto map = copy.add_property_map<Surface_mesh::Vertex_index, Region_index>("v:label", 12345).first;
  Divided result{.labels = {}, .partition = partition(copy, regions, map, strategy, options)};
  for (const auto v : copy.vertices()) result.labels.push_back(map[v]);
  return result;
}

/// Every vertex with edges has one region; every region is connected and has its particle.
void expect_sound(const Surface_mesh& mesh, const Divided& divided) {
  const Numbered_mesh numbered(mesh);
  const std::size_t regions = divided.partition.regions;
  ASSERT_GE(regions, 1U);
  for (const auto label : divided.labels) ASSERT_LT(label, regions);
  for (const auto& pieces : pieces_of(numbered.graph, divided.labels, regions)) EXPECT_EQ(pieces.size(), 1U);
  ASSERT_EQ(divided.partition.particles.size(), regions);
  for (Region_index region = 0; region < regions; ++region) {
    const auto at = divided.partition.particles[region];
    EXPECT_EQ(divided.labels[at], region);
    EXPECT_FALSE(neighbours(numbered.graph, at).empty());
  }
}

/// Columns of equal width along x, assigned to regions in turn: many islands unless there are as many columns as
/// regions.
struct Stripes {
  static constexpr std::string_view name = "stripes";
  std::size_t columns = 4;

  template <class Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    Labelling labelling;
    const double low = input.positions.col(0).minCoeff();
    const double width = (input.positions.col(0).maxCoeff() - low) / static_cast<double>(columns);
    for (Eigen::Index v = 0; v < input.positions.rows(); ++v) {
      const auto column = static_cast<std::size_t>((input.positions(v, 0) - low) / width * (1 - 1e-9));
      labelling.labels.push_back(static_cast<Region_index>(column % regions));
    }
    labelling.iterations = 7;
    return labelling;
  }
};

TEST(Partition, regions_are_connected_and_not_empty) {
  for (const std::size_t regions : {1, 2, 3, 12, 32, 100}) {
    const auto mesh = potato(12);
    const auto divided = divide(mesh, regions);
    EXPECT_EQ(divided.partition.regions, regions);
    expect_sound(mesh, divided);
  }
}

TEST(Partition, islands_are_kept_if_requested) {
  const auto mesh = grid(13, 4);
  const auto kept = divide(mesh, 2, Stripes{}, {.keep_islands = true});
  EXPECT_EQ(kept.partition.regions, 2U);
  const auto pieces = pieces_of(Numbered_mesh(mesh).graph, kept.labels, 2);
  EXPECT_EQ(pieces[0].size(), 2U);
  EXPECT_EQ(pieces[1].size(), 2U);

  const auto repaired = divide(mesh, 2, Stripes{});
  EXPECT_EQ(repaired.partition.statistics.repair.parts_before, 4U);
  EXPECT_EQ(repaired.partition.statistics.repair.islands_joined, 2U);
  expect_sound(mesh, repaired);
}

TEST(Partition, a_custom_strategy_determines_the_regions) {
  const auto mesh = grid(12, 5);
  const auto divided = divide(mesh, 4, Stripes{.columns = 4});
  EXPECT_EQ(divided.partition.regions, 4U);
  EXPECT_EQ(divided.partition.statistics.iterations, 7U);
  for (std::uint32_t v = 0; v < 60; ++v) EXPECT_EQ(divided.labels[v], v % 12 / 3);
  expect_sound(mesh, divided);
}

TEST(Partition, a_particle_starts_at_the_vertex_nearest_to_the_mean_of_its_region) {
  const auto mesh = potato(9);
  const Numbered_mesh numbered(mesh);
  const auto features = feature_vectors(numbered.positions, numbered.faces);
  const auto check = [&](const Divided& divided) {
    for (Region_index region = 0; region < divided.partition.regions; ++region) {
      Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(6);
      for (std::size_t v = 0; v < divided.labels.size(); ++v)
        if (divided.labels[v] == region) mean += features.row(static_cast<Eigen::Index>(v));
      mean /= static_cast<double>(std::ranges::count(divided.labels, region));
      const double reached = (features.row(divided.partition.particles[region]) - mean).norm();
      for (std::size_t v = 0; v < divided.labels.size(); ++v) {
        if (divided.labels[v] != region) continue;
        EXPECT_LE(reached, (features.row(static_cast<Eigen::Index>(v)) - mean).norm() + 1e-12);
      }
    }
  };
  check(divide(mesh, 15));
  check(divide(mesh, 6, Stripes{.columns = 6}));  // a strategy without its own feature space: position and normal
}

TEST(Partition, more_regions_than_vertices_are_reduced) {
  for (const std::size_t regions : {4, 5, 1000}) {
    const auto mesh = tetrahedron();
    const auto divided = divide(mesh, regions);
    EXPECT_EQ(divided.partition.regions, 4U);
    expect_sound(mesh, divided);
  }
}

TEST(Partition, a_single_triangle_has_one_to_three_regions) {
  for (const std::size_t regions : {1, 2, 3, 9}) {
    const auto mesh = single_triangle();
    const auto divided = divide(mesh, regions);
    EXPECT_EQ(divided.partition.regions, std::min<std::size_t>(regions, 3));
    expect_sound(mesh, divided);
  }
}

TEST(Partition, every_component_gets_a_region) {
  Surface_mesh mesh;
  for (int i = 0; i < 5; ++i) append(mesh, sphere(2 + i, 0.3, {1.0 * i, 0, 0}));
  for (const std::size_t regions : {1, 2, 5, 20}) {
    const auto divided = divide(mesh, regions);
    EXPECT_GE(divided.partition.regions, std::max<std::size_t>(regions, 5));
    expect_sound(mesh, divided);
  }
}

template <class Value>
using Map_of = Surface_mesh::Property_map<Surface_mesh::Vertex_index, Value>;

TEST(Partition, a_region_map_is_wide_enough_for_any_region) {
  static_assert(Region_map<Map_of<Region_index>, Surface_mesh>);
  static_assert(Region_map<Map_of<std::size_t>, Surface_mesh>);
  static_assert(Region_map<Map_of<int>, Surface_mesh>);
  static_assert(!Region_map<Map_of<unsigned char>, Surface_mesh>);
  static_assert(!Region_map<Map_of<std::int16_t>, Surface_mesh>);
  static_assert(!Region_map<Map_of<bool>, Surface_mesh>);
  static_assert(!Region_map<Map_of<float>, Surface_mesh>);  // exact up to 2^24 only
}

TEST(Partition, isolated_vertices_do_not_form_regions) {
  auto mesh = sphere(4);
  for (int i = 0; i < 10; ++i) mesh.add_vertex({100.0 + 10 * i, 0, 0});
  for (const std::size_t regions : {1, 4, 12, 1000}) expect_sound(mesh, divide(mesh, regions));
}

TEST(Partition, zero_area_faces_and_a_mesh_without_extent_are_legal) {
  auto flat = sphere(4);
  deform(flat, [](const Point& p) { return Point(p.x(), 0, 0); });
  auto point = sphere(4);
  deform(point, [](const Point&) { return Point(3, 1, 2); });
  for (const std::size_t regions : {1, 5, 12}) {
    expect_sound(flat, divide(flat, regions));
    expect_sound(point, divide(point, regions));
  }
}

TEST(Partition, faces_with_a_common_edge_of_three_and_coinciding_vertices_are_legal) {
  auto mesh = grid(4, 4);
  append(mesh, grid(4, 4));  // every vertex twice
  const auto divided = divide(mesh, 6);
  expect_sound(mesh, divided);
}

TEST(Partition, a_further_factor_changes_the_regions) {
  auto mesh = grid(9, 9);
  auto height = mesh.add_property_map<Surface_mesh::Vertex_index, double>("v:height").first;
  for (const auto v : mesh.vertices()) height[v] = mesh.point(v).y() < 2.5 ? 0 : 100;
  const Lbg with_factor{.extra_factors = factors(mesh, height)};
  const auto divided = divide(mesh, 2, with_factor);
  // The factor dominates, so that it alone decides.
  for (std::uint32_t v = 0; v < 81; ++v) EXPECT_EQ(divided.labels[v] == divided.labels[0], v / 9 < 3) << v;
  EXPECT_NE(divide(mesh, 2).labels, divided.labels);
}

TEST(Partition, factors_of_another_mesh_are_refused) {
  const auto mesh = grid(3, 3);
  EXPECT_THROW(divide(mesh, 2, Lbg{.extra_factors = Feature_vectors::Zero(8, 1)}), Bad_argument);
}

TEST(Partition, positions_may_come_from_another_map) {
  auto mesh = grid(10, 3);
  const auto straight = divide(mesh, 5);
  auto turned = mesh.add_property_map<Surface_mesh::Vertex_index, Point>("v:turned").first;
  for (const auto v : mesh.vertices()) {
    turned[v] = mesh.point(v);
    mesh.point(v) = Point(0, 0, 0);
  }
  auto map = mesh.add_property_map<Surface_mesh::Vertex_index, Region_index>("v:label").first;
  partition(mesh, 5, map, Lbg{}, {}, CGAL::parameters::vertex_point_map(turned));
  for (const auto v : mesh.vertices()) EXPECT_EQ(map[v], straight.labels[v]);
}

TEST(Partition, bad_input_is_refused) {
  EXPECT_THROW(divide(sphere(2), 0), Bad_argument);
  EXPECT_THROW(divide(Surface_mesh(), 2), Bad_mesh);
  auto mesh = sphere(2);
  mesh.point(Surface_mesh::Vertex_index(5)) = Point(0, std::numeric_limits<double>::infinity(), 0);
  EXPECT_THROW(divide(mesh, 2), Bad_mesh);
}

/// The first vertex gets one label, all others another.
struct Two_labels {
  static constexpr std::string_view name = "two labels";
  Region_index others;
  template <class Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t) const {
    Labelling labelling{.labels = std::vector<Region_index>(static_cast<std::size_t>(input.positions.rows()), others)};
    labelling.labels.front() = 0;
    return labelling;
  }
};

TEST(Partition, labels_that_a_strategy_leaves_out_are_no_regions) {
  Surface_mesh mesh;
  for (int i = 0; i < 100; ++i) append(mesh, single_triangle());
  const auto expected = divide(mesh, 4, Two_labels{1});
  for (const Region_index others : {2U, 60U, 67U, 68U, 299U}) {
    const auto found = divide(mesh, 4, Two_labels{others});
    EXPECT_EQ(found.partition.regions, expected.partition.regions) << others;
    EXPECT_EQ(found.labels, expected.labels) << others;
  }
}

}  // namespace
}  // namespace lodestone
