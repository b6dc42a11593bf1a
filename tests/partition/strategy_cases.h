// SPDX-License-Identifier: GPL-3.0-or-later
// Awkward but legal surfaces, which every partition strategy must handle.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "lodestone/partition/partition.h"
#include "lodestone/partition/strategies.h"
#include "support/test_meshes.h"

namespace lodestone {

/// The labels that a strategy gives a mesh before repair.
template <class Strategy>
std::vector<Region_index> labels_of(const Strategy& strategy, const Surface_mesh& mesh, std::size_t regions) {
  const Numbered_mesh numbered(mesh);
  return strategy.label({numbered.graph, numbered.positions, numbered.faces}, regions).labels;
}

std::size_t different(const std::vector<Region_index>& labels);

std::vector<std::size_t> sizes_of(const std::vector<Region_index>& labels);

/// A mesh in four components of different sizes, with isolated vertices and every vertex of one component twice.
Surface_mesh scattered_mesh();

/// Legal meshes, with the number of distinct positions of their vertices that have edges.
std::vector<std::pair<Surface_mesh, std::size_t>> awkward_meshes();

/// Labels are below V, without gaps, at most as many as requested, and give a partition without empty regions.
template <class Strategy>
void expect_sound_labels(const Strategy& strategy, const Surface_mesh& mesh, std::size_t wanted) {
  const auto labels = labels_of(strategy, mesh, wanted);
  ASSERT_EQ(labels.size(), mesh.number_of_vertices());
  const std::size_t regions = 1 + *std::ranges::max_element(labels);
  EXPECT_LE(regions, wanted);
  EXPECT_EQ(different(labels), regions);
  EXPECT_EQ(labels, labels_of(strategy, mesh, wanted)) << "a second run differs";

  Surface_mesh copy = mesh;
  auto map = copy.add_property_map<Surface_mesh::Vertex_index, Region_index>("v:label").first;
  const auto divided = partition(copy, wanted, map, strategy);
  std::vector<Region_index> repaired;
  for (const auto v : copy.vertices()) repaired.push_back(map[v]);
  const Numbered_mesh numbered(mesh);
  for (const auto& pieces : pieces_of(numbered.graph, repaired, divided.regions)) EXPECT_EQ(pieces.size(), 1U);
}

/// The same on all awkward meshes, for one region up to one per vertex.
/// @param regions_expected  of (wanted, vertices, different positions): how many regions there must be
template <class Strategy, class Expected>
void expect_sound_on_awkward_meshes(const Strategy& strategy, Expected regions_expected) {
  std::size_t number = 0;
  for (const auto& [mesh, positions] : awkward_meshes()) {
    const std::size_t vertices = mesh.number_of_vertices();
    const Numbered_mesh numbered(mesh);
    std::size_t used = 0;
    for (std::uint32_t v = 0; v < vertices; ++v) used += out_degree(v, numbered.graph) > 0 ? 1 : 0;
    for (const std::size_t wanted : std::set<std::size_t>{1, 2, 3, vertices / 2, vertices - 1, vertices}) {
      SCOPED_TRACE("awkward mesh " + std::to_string(number) + ", " + std::to_string(wanted) + " regions");
      expect_sound_labels(strategy, mesh, wanted);
      EXPECT_GE(different(labels_of(strategy, mesh, wanted)),
                regions_expected(std::min(wanted, used), used, positions));
    }
    ++number;
  }
}

/// As many regions as requested, even if vertices coincide.
inline constexpr auto always_as_wanted = [](std::size_t wanted, std::size_t, std::size_t) { return wanted; };

/// Coinciding vertices cannot be separated.
inline constexpr auto as_wanted_by_position = [](std::size_t wanted, std::size_t, std::size_t positions) {
  return std::min(wanted, positions);
};

/// The registry, asked for its name, gives the strategy that these settings describe.
template <class Strategy>
void expect_in_registry(const Strategy& strategy, const Strategy_settings& settings) {
  const auto mesh = potato(6);
  const Mesh_numbering<Surface_mesh> numbering(mesh);
  const Numbered_mesh numbered(mesh);
  const auto registered = make_strategy(Strategy::name, settings);
  const auto labelling =
      registered(Partition_input<Surface_mesh>{mesh, numbering, numbered.graph, numbered.positions}, 9);
  EXPECT_EQ(labelling.labels, labels_of(strategy, mesh, 9));
}

/// A translation and a scale that are exact in floating point change no label.
template <class Strategy>
void expect_invariant_under_translation_and_scale(const Strategy& strategy) {
  const auto lattice = [](Surface_mesh mesh) {
    deform(mesh, [](const Point& p) {
      const auto rounded = [](double x) { return std::round(1024 * x) / 1024; };
      return Point(rounded(p.x()), rounded(p.y()), rounded(p.z()));
    });
    return mesh;
  };
  const auto mesh = lattice(potato(6));
  for (const std::size_t regions : {2, 7, 20}) {
    const auto expected = labels_of(strategy, mesh, regions);
    auto moved = mesh;
    shift(moved, 8, -4, 32);
    EXPECT_EQ(labels_of(strategy, moved, regions), expected);
    auto scaled = mesh;
    scale(scaled, 0x1p-40);
    EXPECT_EQ(labels_of(strategy, scaled, regions), expected);
    scale(scaled, 0x1p+500);
    EXPECT_EQ(labels_of(strategy, scaled, regions), expected);
  }
}

}  // namespace lodestone
