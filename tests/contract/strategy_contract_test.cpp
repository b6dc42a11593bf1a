// SPDX-License-Identifier: GPL-3.0-or-later
// Every strategy of the registry, on every mesh type. A new strategy in the registry is tested automatically.
#include <algorithm>
#include <cmath>
#include <set>

#include "contract/divided.h"
#include "contract/mesh_types.h"
#include "lodestone/io/shapes/shapes.h"
#include "lodestone/partition/strategies.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

class Strategy_contract : public ::testing::TestWithParam<Strategy_entry> {
 protected:
  static Any_strategy strategy(std::uint64_t seed = 1) { return GetParam().make({.seed = seed}); }

  /// Every vertex has a region; every region is a connected set of vertices and has one particle.
  static void expect_sound(const Surface_mesh& mesh, const Divided& divided) {
    const auto vertices = mesh.number_of_vertices();
    ASSERT_EQ(divided.labels.size(), vertices);
    ASSERT_EQ(divided.particles.size(), divided.regions);
    for (const auto label : divided.labels) ASSERT_LT(label, divided.regions);
    for (Region_index region = 0; region < divided.regions; ++region) {
      ASSERT_LT(divided.particles[region], vertices);
      EXPECT_EQ(divided.labels[divided.particles[region]], region);
    }
    for (const auto& pieces : pieces_of(Numbered_mesh(mesh).graph, divided.labels, divided.regions))
      EXPECT_EQ(pieces.size(), 1U);
  }

  /// Checks that the result is the same on every mesh type and in a second run.
  static Divided divided_alike(const Surface_mesh& mesh, std::size_t regions) {
    const auto divided = divide(mesh, regions, strategy());
    EXPECT_EQ(divide(mesh, regions, strategy()), divided);
    EXPECT_EQ(divide(converted<Polyhedron>(mesh), regions, strategy()), divided);
    EXPECT_EQ(divide(converted<Open_mesh>(mesh), regions, strategy()), divided);
    EXPECT_EQ(divide(converted<Cell_complex>(mesh), regions, strategy()), divided);
    expect_sound(mesh, divided);
    return divided;
  }
};

TEST_P(Strategy_contract, a_closed_surface_gets_about_the_requested_number_of_regions_the_same_on_every_mesh_type) {
  const auto mesh = as_float(potato(9));
  for (const std::size_t regions : {1, 2, 7, 24}) {
    SCOPED_TRACE(regions);
    const auto divided = divided_alike(mesh, regions);
    EXPECT_LE(divided.regions, regions);
    EXPECT_GE(4 * divided.regions, 3 * regions);
  }
}

/// Programs refuse settings that the registry does not list.
TEST_P(Strategy_contract, a_setting_that_changes_the_regions_is_one_that_the_registry_lists) {
  const auto mesh = as_float(potato(14));
  const auto divided = [&](const auto& change) {
    Strategy_settings settings;
    change(settings.lbg);
    return divide(mesh, 12, GetParam().make(settings));
  };
  const auto usual = divided([](Lbg_options&) {});
  const auto expect_listed = [&](Lbg_setting setting, bool shows, const auto& change) {
    const bool differs = divided(change) != usual, listed = strategy_reads(GetParam().name, setting);
    if (differs) {
      EXPECT_TRUE(listed) << static_cast<int>(setting);
    } else if (listed) {
      EXPECT_FALSE(shows) << static_cast<int>(setting);
    }
  };
  expect_listed(Lbg_setting::normal_weight, true, [](Lbg_options& lbg) { lbg.features.normal_weight = 5; });
  expect_listed(Lbg_setting::split_rule, true, [](Lbg_options& lbg) { lbg.split_rule = Split::multiplicative; });
  expect_listed(Lbg_setting::split, false, [](Lbg_options& lbg) { lbg.split = 0.3; });
  expect_listed(Lbg_setting::tolerance, true, [](Lbg_options& lbg) { lbg.tolerance = 0.9; });
  expect_listed(Lbg_setting::sample, false, [](Lbg_options& lbg) { lbg.sample = 128; });
}

TEST_P(Strategy_contract, an_open_surface_is_divided) {
  const auto divided = divided_alike(as_float(grid(17, 12)), 10);
  EXPECT_GE(divided.regions, 7U);
  EXPECT_LE(divided.regions, 10U);
}

TEST_P(Strategy_contract, several_components_are_divided) {
  auto mesh = grid(9, 9);
  append(mesh, sphere(4, 1, {20, 0, 0}));
  append(mesh, sphere(3, 2, {0, 20, 0}));
  mesh = as_float(mesh);
  const auto divided = divided_alike(mesh, 12);
  EXPECT_GE(divided.regions, 8U);
  // No region spans two components, and each component has at least one region.
  const auto component = [&](std::size_t v) {
    return mesh.point(Surface_mesh::Vertex_index(v)).x() > 15   ? 1
           : mesh.point(Surface_mesh::Vertex_index(v)).y() > 15 ? 2
                                                                : 0;
  };
  std::map<Region_index, std::set<int>> components;
  for (std::size_t v = 0; v < divided.labels.size(); ++v) components[divided.labels[v]].insert(component(v));
  for (const auto& [region, of] : components) EXPECT_EQ(of.size(), 1U);
}

TEST_P(Strategy_contract, a_single_triangle_is_divided) {
  for (const std::size_t regions : {1, 2, 3}) {
    SCOPED_TRACE(regions);
    divided_alike(single_triangle(), regions);
  }
}

TEST_P(Strategy_contract, more_regions_than_vertices_are_reduced) {
  const auto divided = divided_alike(tetrahedron(), 50);
  EXPECT_LE(divided.regions, 4U);
  EXPECT_GE(divided_alike(as_float(sphere(2)), 1000).regions, 9U);  // of 18 vertices
}

TEST_P(Strategy_contract, zero_area_faces_are_divided) {
  // A grid with one half folded into a line and one column of vertices into a point.
  auto mesh = grid(12, 8);
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    if (p.x() >= 6) mesh.point(v) = Point(p.x(), 3, 0);
    if (p.x() == 11) mesh.point(v) = Point(11, 3, 0);
  }
  const auto divided = divided_alike(mesh, 8);
  EXPECT_GE(divided.regions, 5U);
  // All vertices coincide: no direction, no length.
  for (const auto v : mesh.vertices()) mesh.point(v) = Point(1, 2, 3);
  divided_alike(mesh, 8);
}

TEST_P(Strategy_contract, coordinates_of_any_magnitude_give_the_same_regions) {
  const auto mesh = as_float(potato(7));
  const auto expected = divide(mesh, 12, strategy());
  for (const int exponent : {-400, 400}) {
    auto scaled = mesh;
    for (const auto v : scaled.vertices()) {
      const auto& p = mesh.point(v);
      scaled.point(v) = Point(std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent), std::ldexp(p.z(), exponent));
    }
    EXPECT_EQ(divide(scaled, 12, strategy()), expected) << "2^" << exponent;
  }
}

TEST_P(Strategy_contract, every_seed_gives_a_valid_partition) {
  const auto mesh = as_float(potato(8));
  for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{2}, ~std::uint64_t{0} >> 1})
    expect_sound(mesh, divide(mesh, 16, strategy(seed)));
}

TEST_P(Strategy_contract, a_hundred_thousand_vertices_are_divided_or_refused) {
  Surface_mesh mesh = icosphere(100);  // 100 002 vertices
  if (mesh.number_of_vertices() > GetParam().most_vertices) {
    EXPECT_THROW(divide(mesh, 64, strategy()), Bad_argument);
    mesh = icosphere(static_cast<std::size_t>(std::sqrt(static_cast<double>(GetParam().most_vertices - 2) / 10)));
  }
  const auto divided = divide(mesh, 64, strategy());
  EXPECT_GE(divided.regions, 48U);
  EXPECT_LE(divided.regions, 64U);
  expect_sound(mesh, divided);
}

TEST_P(Strategy_contract, every_strategy_is_found_by_its_name) {
  EXPECT_EQ(make_strategy(GetParam().name).name, GetParam().name);
  EXPECT_FALSE(GetParam().summary.empty());
}

INSTANTIATE_TEST_SUITE_P(All, Strategy_contract, ::testing::ValuesIn(strategies().begin(), strategies().end()),
                         [](const auto& test) {
                           std::string name(test.param.name);
                           std::ranges::replace(name, '+', 'p');
                           return name;
                         });

TEST(Strategies, lbg_comes_first_and_names_are_unique) {
  ASSERT_FALSE(strategies().empty());
  EXPECT_EQ(strategies().front().name, "lbg");
  std::set<std::string_view> names;
  for (const auto& entry : strategies()) EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
}

TEST(Strategies, an_unknown_name_is_refused) { EXPECT_THROW(make_strategy("guess"), Bad_argument); }

}  // namespace
}  // namespace lodestone
