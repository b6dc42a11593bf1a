// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes with very many connected components, and strategies that violate their concept.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <set>
#include <vector>

#include "lodestone/partition/islands.h"
#include "lodestone/partition/lbg.h"
#include "lodestone/partition/partition.h"
#include "lodestone/partition/strategies.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

using Labels = std::vector<Region_index>;

/// The same triangles, each with three separate vertices.
Surface_mesh unwelded(const Surface_mesh& mesh) {
  std::vector<Point> points;
  std::vector<Corners> faces;
  for (const auto f : mesh.faces()) {
    const auto first = static_cast<std::uint32_t>(points.size());
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) points.push_back(mesh.point(v));
    faces.push_back({first, first + 1, first + 2});
  }
  return mesh_of(points, faces);
}

/// Copies of `part` in a row, far apart.
Surface_mesh copies(const Surface_mesh& part, int count) {
  Surface_mesh all;
  for (int i = 0; i < count; ++i) {
    auto copy = part;
    shift(copy, 3 * i);
    append(all, copy);
  }
  return all;
}

Numbered_partition partitioned(const Surface_mesh& mesh, std::size_t regions, const Partition_options& options = {}) {
  const Numbered_mesh numbered(mesh);
  const Partition_input<Surface_mesh> input{mesh, numbered.numbering, numbered.graph, numbered.positions};
  return partition_numbered(input, regions, Lbg{}, options);
}

Labels random_labels(std::size_t vertices, std::size_t regions, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Labels labels(vertices);
  for (auto& label : labels) label = static_cast<Region_index>(random() % regions);
  for (Region_index region = 0; region < regions; ++region) labels[region] = region;
  return labels;
}

void expect_every_region_used(const Labels& labels, std::size_t regions) {
  const std::set<Region_index> used(labels.begin(), labels.end());
  EXPECT_EQ(used.size(), regions);
  EXPECT_LT(*used.rbegin(), regions);
}

std::size_t bound(std::size_t wanted) { return wanted + std::max<std::size_t>(wanted, 64); }

template <class Run>
double seconds_of(Run run) {
  const auto start = std::chrono::steady_clock::now();
  run();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TEST(Repair_islands, regions_stay_bounded_however_many_components_there_are) {
  const Numbered_mesh mesh(unwelded(sphere(25)));
  ASSERT_EQ(mesh.faces.size(), 5000U);
  for (const std::size_t regions : {1, 12, 100, 1000}) {
    auto labels = random_labels(mesh.numbering.vertex_count(), regions, regions);
    Island_repair repair;
    EXPECT_LT(seconds_of([&] { repair = repair_islands(mesh.graph, labels, regions); }), 10);
    EXPECT_LE(repair.regions, bound(regions));
    EXPECT_EQ(repair.regions, regions + repair.regions_added);
    expect_every_region_used(labels, repair.regions);
  }
}

TEST(Repair_islands, components_within_the_bound_each_get_a_separate_region) {
  // One region takes the first triangle, 64 more are added.
  const Numbered_mesh mesh(copies(single_triangle(), 65));
  Labels labels(mesh.numbering.vertex_count(), 0);
  const auto repair = repair_islands(mesh.graph, labels, 1);
  EXPECT_EQ(repair.regions, 65U);
  for (const auto& pieces : pieces_of(mesh.graph, labels, repair.regions)) EXPECT_EQ(pieces.size(), 1U);
}

TEST(Repair_islands, components_beyond_the_bound_keep_the_label_they_had) {
  const Numbered_mesh mesh(copies(single_triangle(), 1000));
  Labels labels(mesh.numbering.vertex_count());
  for (std::size_t v = 0; v < labels.size(); ++v) labels[v] = static_cast<Region_index>(v / 3 % 7);
  const Labels before = labels;
  const auto repair = repair_islands(mesh.graph, labels, 7);
  EXPECT_LE(repair.regions, bound(7));
  expect_every_region_used(labels, repair.regions);
  for (std::size_t v = 0; v < labels.size(); ++v) {
    EXPECT_TRUE(labels[v] == before[v] || labels[v] >= 7) << v;
  }
}

TEST(Partition, an_unwelded_sphere_is_divided_at_once_into_a_bounded_number_of_regions) {
  const auto mesh = unwelded(sphere(25));
  Numbered_partition result;
  EXPECT_LT(seconds_of([&] { result = partitioned(mesh, 12); }), 10);
  EXPECT_GE(result.regions, 12U);
  EXPECT_LE(result.regions, bound(12));
  EXPECT_EQ(result.particles.size(), result.regions);
  ASSERT_EQ(result.labels.size(), 15000U);
  expect_every_region_used(result.labels, result.regions);
  for (Region_index region = 0; region < result.regions; ++region)
    EXPECT_EQ(result.labels[result.particles[region]], region);
}

TEST(Partition, of_loose_triangles_has_as_many_regions_whatever_the_strategy) {
  const Numbered_mesh mesh(unwelded(sphere(10)));
  const Numbered_surface surface{mesh.graph, mesh.positions, mesh.faces};
  for (const auto& entry : strategies()) {
    const auto strategy = entry.make({});
    EXPECT_EQ(partition_numbered(surface, 8, strategy).regions, bound(8)) << entry.name;
    EXPECT_EQ(partition_numbered(surface, 100, strategy).regions, bound(100)) << entry.name;
  }
}

/// A strategy that gives the labels it has, whatever the wanted number.
struct Own_number {
  static constexpr std::string_view name = "own_number";
  Labels labels = {};
  Labelling label(const Numbered_surface&, std::size_t) const { return {.labels = labels}; }
};

TEST(Partition, of_a_strategy_that_ignores_the_wanted_number_is_limited_by_its_labels) {
  // 200 labels on as many triangles, then a component that no region reaches.
  const Numbered_mesh mesh(copies(single_triangle(), 201));
  Own_number strategy;
  for (std::uint32_t v = 0; v < 603; ++v) strategy.labels.push_back(std::min<Region_index>(v / 3, 199));
  EXPECT_EQ(partition_numbered({mesh.graph, mesh.positions, mesh.faces}, 1, strategy).regions, 201U);
}

TEST(Partition, every_region_of_a_mesh_of_few_components_is_connected) {
  const auto mesh = copies(tetrahedron(), 10);
  const auto result = partitioned(mesh, 3);
  EXPECT_GE(result.regions, 10U);
  EXPECT_LE(result.regions, 13U);
  expect_every_region_used(result.labels, result.regions);
  const Numbered_mesh numbered(mesh);
  for (const auto& pieces : pieces_of(numbered.graph, result.labels, result.regions)) EXPECT_EQ(pieces.size(), 1U);
}

TEST(Partition, islands_that_are_kept_add_no_region) {
  EXPECT_EQ(partitioned(unwelded(sphere(25)), 12, {.keep_islands = true}).regions, 12U);
  EXPECT_EQ(partitioned(copies(tetrahedron(), 10), 3, {.keep_islands = true}).regions, 3U);
}

/// A strategy that returns a stored labelling.
struct Fixed_labelling {
  static constexpr std::string_view name = "fixed";
  Labelling labelling = {};
  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& /*input*/, std::size_t /*regions*/) const {
    return labelling;
  }
};

class Partition_by_ones_own_strategy : public testing::Test {
 protected:
  Partition<Surface_mesh> divide(Labelling labelling, bool keep_islands = false) {
    return partition(mesh, 4, map, Fixed_labelling{std::move(labelling)}, {.keep_islands = keep_islands});
  }

  Surface_mesh mesh = sphere(3);
  std::size_t vertices = num_vertices(mesh);
  Surface_mesh::Property_map<Surface_mesh::Vertex_index, Region_index> map =
      mesh.add_property_map<Surface_mesh::Vertex_index, Region_index>("v:label").first;
};

TEST_F(Partition_by_ones_own_strategy, a_label_for_each_vertex_is_accepted) {
  EXPECT_EQ(divide({.labels = Labels(vertices, 0)}).regions, 1U);
  Labels own(vertices);
  for (std::size_t v = 0; v < vertices; ++v) own[v] = static_cast<Region_index>(v);
  EXPECT_EQ(divide({.labels = own}).regions, vertices);
  EXPECT_EQ(divide({.labels = own, .vectors = Feature_vectors::Random(vertices, 2)}).regions, vertices);
}

TEST_F(Partition_by_ones_own_strategy, a_wrong_number_of_labels_is_refused) {
  for (const bool keep_islands : {false, true})
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, vertices - 1, vertices + 1})
      EXPECT_THROW(divide({.labels = Labels(count, 0)}, keep_islands), Bad_argument) << count;
}

TEST_F(Partition_by_ones_own_strategy, a_label_beyond_the_number_of_vertices_is_refused) {
  for (const bool keep_islands : {false, true})
    for (const auto label : {static_cast<Region_index>(vertices), static_cast<Region_index>(-1)}) {
      Labels labels(vertices, 0);
      labels.back() = label;
      EXPECT_THROW(divide({.labels = labels}, keep_islands), Bad_argument) << label;
    }
}

TEST_F(Partition_by_ones_own_strategy, vectors_for_a_wrong_number_of_vertices_are_refused) {
  for (const bool keep_islands : {false, true})
    for (const std::size_t rows : {std::size_t{1}, vertices - 1, vertices + 1})
      EXPECT_THROW(divide({.labels = Labels(vertices, 0), .vectors = Feature_vectors::Zero(rows, 3)}, keep_islands),
                   Bad_argument)
          << rows;
}

}  // namespace
}  // namespace lodestone
