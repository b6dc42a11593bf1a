// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/region_extents.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <boost/graph/filtered_graph.hpp>
#include <boost/property_map/function_property_map.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include "support/test_meshes.h"

namespace lodestone {
namespace {

const Eigen::Vector3d up(0, 0, 1);

/// A mesh with the inputs of `region_extents`.
struct Measured : Numbered_mesh {
  std::vector<Region_index> labels;
  std::vector<bool> border;
  Live_positions position;

  explicit Measured(const Surface_mesh& mesh)
      : Numbered_mesh(mesh),
        labels(numbering.vertex_count(), 0),
        border(open_border(numbering.vertex_count(), faces)),
        position(positions.data()) {}
  Measured(const Measured&) = delete;
  Measured& operator=(const Measured&) = delete;

  Region_extent extent(std::uint32_t home, const Eigen::Vector3d& normal = up) const {
    return region_extents({graph, labels, border, position}, std::vector{Extent_start{home, normal}}).front();
  }
};

std::array<double, 4> lengths(const Region_extent& extent) {
  std::array<double, 4> result{};
  for (std::size_t i = 0; i < 4; ++i) result[i] = extent.paths[i].length;
  return result;
}

TEST(Region_extent, of_a_flat_grid_reaches_its_open_border_along_the_axes) {
  const Measured square(grid(9, 9));
  EXPECT_EQ(lengths(square.extent(4 * 9 + 4)), (std::array{4.0, 4.0, 4.0, 4.0}));
  EXPECT_EQ(square.extent(4 * 9 + 4).area(), 64);
  const Measured oblong(grid(11, 5));
  EXPECT_EQ(oblong.extent(2 * 11 + 3).area(), 10 * 4);  // whatever the home, both directions add up to the sides
}

TEST(Region_extent, ends_where_another_region_begins) {
  Measured mesh(grid(9, 9));
  for (std::uint32_t v = 0; v < 81; ++v) mesh.labels[v] = v % 9 < 6 ? 0 : 1;
  auto found = lengths(mesh.extent(4 * 9 + 3));
  std::ranges::sort(found);
  EXPECT_EQ(found, (std::array{2.0, 3.0, 4.0, 4.0}));
  EXPECT_EQ(mesh.extent(4 * 9 + 3).area(), 5 * 8);
}

TEST(Region_extent, reaches_to_the_nearest_border_in_a_direction) {
  // A vertex of another region two steps to the left, to the right, above or below the home: the border is beside it.
  for (const std::uint32_t hole : {4 * 9 + 2, 4 * 9 + 6, 2 * 9 + 4, 6 * 9 + 4}) {
    Measured mesh(grid(9, 9));
    mesh.labels[hole] = 1;
    auto found = lengths(mesh.extent(4 * 9 + 4));
    std::ranges::sort(found);
    EXPECT_EQ(found, (std::array{1.0, 4.0, 4.0, 4.0})) << hole;
  }
}

TEST(Region_extent, is_zero_towards_a_border_on_which_the_home_lies) {
  const Measured mesh(grid(9, 9));
  const auto extent = mesh.extent(4 * 9);
  const auto found = lengths(extent);
  EXPECT_EQ(std::ranges::count(found, 0.0), 1);
  EXPECT_EQ(std::ranges::count(found, 8.0), 1);
  EXPECT_EQ(found[0] + found[1], 8);
  EXPECT_EQ(found[2], found[3]);  // the square is the same above and below
  for (const auto& path : extent.paths) EXPECT_EQ(path.samples.empty(), path.length == 0);
}

TEST(Region_extent, measures_along_edges) {
  // From the centre of a 3 x 3 grid whose middle row is folded up, the border above and below is a hop of sqrt 2 away.
  auto folded = grid(3, 3);
  deform(folded, [](const Point& p) { return Point(p.x(), p.y(), p.y() == 1 ? 1 : 0); });
  const Measured mesh(folded);
  auto found = lengths(mesh.extent(4));
  std::ranges::sort(found);
  EXPECT_EQ(found, (std::array{1.0, 1.0, std::sqrt(2.0), std::sqrt(2.0)}));
}

TEST(Region_extent, lies_in_the_tangent_plane) {
  auto standing = grid(9, 5);
  deform(standing, [](const Point& p) { return Point(0, p.x(), p.y()); });
  const Measured mesh(standing);
  EXPECT_NEAR(mesh.extent(2 * 9 + 4, {3, 0, 0}).area(), 8 * 4, 1e-12);
  EXPECT_NEAR(Measured(grid(9, 5)).extent(2 * 9 + 4, {0, 0, 0}).area(), 8 * 4, 1e-12);
}

TEST(Region_extent, of_a_closed_component_is_taken_to_its_farthest_vertices) {
  // On the octahedron each of the four neighbours of a corner lies in a direction of its own, the opposite one in none.
  const Measured mesh(sphere(1));
  std::uint32_t home = 0;
  for (std::uint32_t v = 0; v < 6; ++v)
    if (mesh.positions(v, 2) == 1) home = v;
  for (const double length : lengths(mesh.extent(home))) EXPECT_NEAR(length, std::sqrt(2), 1e-14);
  EXPECT_NEAR(mesh.extent(home).area(), 8, 1e-13);
}

TEST(Region_extent, of_a_region_round_a_tube_is_its_girth_in_the_direction_without_a_border) {
  auto bar = cube(8);
  deform(bar, [](const Point& p) { return Point(p.x(), p.y(), 4 * p.z()); });
  Measured mesh(bar);
  std::uint32_t home = 0;
  for (std::uint32_t v = 0; v < mesh.labels.size(); ++v) {
    const auto p = mesh.position(v);
    mesh.labels[v] = p.z() < 1 ? 1 : p.z() > 3 ? 2 : 0;
    if (p == Eigen::Vector3d(1, 0.5, 2)) home = v;
  }
  const auto extent = mesh.extent(home, {1, 0, 0});
  auto found = lengths(extent);
  std::ranges::sort(found);
  EXPECT_EQ(found[0], 1);
  EXPECT_EQ(found[1], 1);
  EXPECT_NEAR(found[2], 2, 0.2);
  EXPECT_NEAR(found[3], 2, 0.2);
  // A limb that grows longer, or thicker, is seen to grow.
  const auto grown = [&](double thickness, double length) {
    const auto now = [&, thickness, length](std::uint32_t v) {
      const auto p = mesh.position(v);
      return Eigen::Vector3d(thickness * p.x(), thickness * p.y(), length * p.z());
    };
    return stretched_area(extent, now) / extent.area();
  };
  EXPECT_NEAR(grown(1, 3), 3, 0.1);
  EXPECT_NEAR(grown(2, 1), 2, 0.1);
}

TEST(Region_extent, of_a_region_round_a_tube_grows_with_the_tube_beyond_the_region_s_length) {
  // 64 corners round a tube of length 3, whose middle third is the region.
  const auto measured = [](double radius) {
    constexpr std::uint32_t around = 64, along = 48;
    Surface_mesh tube;
    for (std::uint32_t i = 0; i <= along; ++i)
      for (std::uint32_t j = 0; j < around; ++j) {
        const double angle = 2 * std::numbers::pi * j / around;
        tube.add_vertex(Point(radius * std::cos(angle), radius * std::sin(angle), 3.0 * i / along));
      }
    const auto at = [](std::uint32_t i, std::uint32_t j) {
      return Surface_mesh::Vertex_index(i * around + j % around);
    };
    for (std::uint32_t i = 0; i < along; ++i)
      for (std::uint32_t j = 0; j < around; ++j) {
        tube.add_face(at(i, j), at(i, j + 1), at(i + 1, j));
        tube.add_face(at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
      }
    Measured mesh(tube);
    for (std::uint32_t v = 0; v < mesh.labels.size(); ++v) mesh.labels[v] = v / around / (along / 3);
    return mesh.extent(at(along / 2, 0), {1, 0, 0}).area();
  };
  double before = measured(0.1);
  EXPECT_NEAR(before, 2 * std::numbers::pi * 0.1, 0.15);
  for (double radius = 0.12; radius < 1.5; radius *= 1.2) {
    const double area = measured(radius);
    EXPECT_GT(area, 1.1 * before) << radius;
    before = area;
  }
}

TEST(Region_extent, goes_on_where_the_farthest_vertex_is_more_than_half_as_far_again_as_the_border_beside) {
  // Straight along X lies a vertex that is not on the border; the border is one unit away, 37 degrees beside X.
  for (const double farthest : {1.49, 1.51}) {
    Measured mesh(mesh_of({{0, 0, 0}, {farthest, 0, 0}, {0.8, 0.6, 0}}, {{0, 1, 2}}));
    mesh.border = {false, false, true};
    EXPECT_NEAR(lengths(mesh.extent(0))[0], farthest > 1.5 ? farthest : 1, 1e-15);
  }
}

TEST(Region_extent, grows_with_the_square_of_a_uniform_scale) {
  const auto surface = potato(8);
  const Measured mesh(surface);
  for (const double factor : {0.25, 3.0}) {
    auto scaled = surface;
    scale(scaled, factor);
    const Measured larger(scaled);
    for (const std::uint32_t home : {0, 17, 100}) {
      const Eigen::Vector3d normal = mesh.positions.row(home);
      const double area = mesh.extent(home, normal).area();
      EXPECT_GT(area, 0);
      EXPECT_NEAR(larger.extent(home, normal).area(), factor * factor * area, 1e-9 * area);
      EXPECT_NEAR(stretched_area(mesh.extent(home, normal), larger.position), factor * factor * area, 1e-9 * area);
    }
  }
}

/// Lengths of the shortest paths within the region of `home`, by Boost's search.
std::vector<double> boosts_lengths(const Measured& mesh, std::uint32_t home) {
  std::vector<double> lengths(mesh.labels.size());
  const boost::filtered_graph region(mesh.graph, boost::keep_all(), std::function([&](std::uint32_t v) {
                                       return mesh.labels[v] == mesh.labels[home];
                                     }));
  const auto edge_length =
      boost::make_function_property_map<Vertex_graph::edge_descriptor>([&](const Vertex_graph::edge_descriptor& edge) {
        return (mesh.position(source(edge, mesh.graph)) - mesh.position(target(edge, mesh.graph))).norm();
      });
  boost::dijkstra_shortest_paths(
      region, home,
      boost::weight_map(edge_length)
          .distance_map(boost::make_iterator_property_map(lengths.begin(), get(boost::vertex_index, mesh.graph)))
          .distance_inf(std::numeric_limits<double>::infinity()));
  return lengths;
}

TEST(Region_extent, paths_are_as_long_as_the_shortest_that_boosts_search_finds) {
  std::mt19937_64 random(1);
  Surface_mesh rough = grid(40, 30);  // where the first path to a vertex is seldom the shortest
  deform(rough, [&](const Point& p) { return Point(p.x(), p.y(), static_cast<double>(random() % 64)); });
  for (const auto& surface : {potato(9), grid(12, 9), sphere(7), rough}) {
    Measured mesh(surface);
    for (const Region_index regions : {1, 3, 8}) {
      // Halfspaces cut regions of several pieces, too.
      for (std::uint32_t v = 0; v < mesh.labels.size(); ++v)
        mesh.labels[v] = static_cast<Region_index>(std::abs(mesh.positions.row(v).sum()) * 2) % regions;
      for (int trial = 0; trial < 20; ++trial) {
        const auto home = static_cast<std::uint32_t>(random() % mesh.labels.size());
        const auto expected = boosts_lengths(mesh, home);
        for (const auto& path : mesh.extent(home, Eigen::Vector3d::Random()).paths) {
          if (path.samples.empty()) continue;
          EXPECT_EQ(path.length, expected[path.samples.back()]);
        }
      }
    }
  }
}

TEST(Region_extents, measured_together_are_those_measured_alone) {
  Measured mesh(potato(9));
  std::vector<Extent_start> starts;
  for (std::uint32_t v = 0; v < mesh.labels.size(); ++v) mesh.labels[v] = v % 10 < 7 ? 0 : 1;
  for (std::uint32_t home = 0; home < 60; ++home) starts.push_back({home, mesh.positions.row(home)});
  const auto together = region_extents({mesh.graph, mesh.labels, mesh.border, mesh.position}, starts);
  ASSERT_EQ(together.size(), starts.size());
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const auto alone = mesh.extent(starts[i].home, starts[i].normal);
    for (std::size_t direction = 0; direction < 4; ++direction) {
      EXPECT_EQ(together[i].paths[direction].length, alone.paths[direction].length);
      EXPECT_EQ(together[i].paths[direction].samples, alone.paths[direction].samples);
    }
  }
}

TEST(Stretched_area, of_a_mesh_at_rest_is_its_area) {
  const Measured mesh(potato(8));
  for (const std::uint32_t home : {3, 50, 90}) {
    const auto extent = mesh.extent(home, mesh.positions.row(home));
    EXPECT_NEAR(stretched_area(extent, mesh.position), extent.area(), 1e-12 * extent.area());
  }
}

TEST(Stretched_area, follows_an_affine_stretch) {
  const Measured mesh(grid(13, 9));
  const auto extent = mesh.extent(4 * 13 + 6);
  const auto stretched = [&](double x, double y) {
    return stretched_area(extent, [&, x, y](std::uint32_t v) {
      const auto p = mesh.position(v);
      return Eigen::Vector3d(x * p.x(), y * p.y(), 7);
    });
  };
  EXPECT_NEAR(stretched(3, 1), 3 * 96, 1e-9);
  EXPECT_NEAR(stretched(1, 0.5), 0.5 * 96, 1e-9);
  EXPECT_NEAR(stretched(2, 5), 10 * 96, 1e-9);
}

TEST(Stretched_area, reads_no_more_than_sixteen_vertices_besides_the_home) {
  const Measured mesh(grid(101, 101));
  const auto extent = mesh.extent(50 * 101 + 50);
  std::size_t reads = 0;
  stretched_area(extent, [&](std::uint32_t v) {
    ++reads;
    return mesh.position(v);
  });
  EXPECT_LE(reads, 20U);
  for (const auto& path : extent.paths) {
    EXPECT_LE(path.samples.size(), 5U);
    EXPECT_EQ(path.samples.front(), 50U * 101 + 50);
    EXPECT_TRUE(mesh.border[path.samples.back()]);
  }
}

TEST(Region_extent, has_its_first_direction_along_the_given_axis) {
  const Numbered_mesh mesh(grid(11, 5));
  const std::vector<Region_index> labels(55, 0);
  const auto border = open_border(55, mesh.faces);
  const Live_positions position(mesh.positions.data());
  const auto lengths = [&](const Eigen::Vector3d& axis) {
    const auto extent =
        region_extents({mesh.graph, labels, border, position}, std::vector{Extent_start{2 * 11 + 3, up, axis}}).front();
    std::vector<double> result;
    for (const auto& path : extent.paths) result.push_back(path.length);
    return result;
  };
  EXPECT_EQ(lengths({5, 0, 1}), (std::vector<double>{7, 3, 2, 2}));  // only its projection counts
  EXPECT_EQ(lengths({-1, 0, 0}), (std::vector<double>{3, 7, 2, 2}));
  EXPECT_EQ(lengths({0, 1, 0}), (std::vector<double>{2, 2, 3, 7}));  // Y is up x X
  EXPECT_EQ(lengths({0, -1, 0}), (std::vector<double>{2, 2, 7, 3}));
}

TEST(Angle_to_axis, turns_a_vector_around_the_normal_to_where_x_is) {
  const Eigen::Vector3d needle(1, 2, 0.5);
  const Eigen::Vector3d turned = Eigen::AngleAxisd(angle_to_axis(up, needle), up) * needle;
  EXPECT_NEAR(turned.x(), std::sqrt(5), 1e-12);
  EXPECT_NEAR(turned.y(), 0, 1e-12);
}

}  // namespace
}  // namespace lodestone
