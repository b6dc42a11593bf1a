// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/tree/tree_on_demand.h"

#include <gtest/gtest.h>

#include <numeric>

#include "lodestone/mesh/errors.h"
#include "support/face_soup.h"
#include "support/special_numbers.h"

namespace lodestone {
namespace {

/// Positions that do not lie in memory, and how often each was read.
struct Counted_soup {
  Face_soup soup;
  mutable std::vector<std::size_t> reads = std::vector<std::size_t>(soup.vertex_count());

  static Eigen::Vector3d read(const void* counted, std::uint32_t vertex) {
    const auto& self = *static_cast<const Counted_soup*>(counted);
    ++self.reads[vertex];
    return Eigen::Map<const Eigen::Vector3d>(self.soup.coordinates.data() + 3 * std::size_t{vertex});
  }
  Live_positions positions() const { return {this, read}; }
  std::size_t sum() const { return std::accumulate(reads.begin(), reads.end(), std::size_t{0}); }
};

Tree_on_demand tree_of(const Face_soup& soup, std::size_t leaf_faces = 8) {
  return {soup.faces, octants(soup), soup.coordinates, {.leaf_faces = leaf_faces}};
}

TEST(Tree_on_demand, a_leaf_is_read_once_a_frame_and_nothing_else_but_the_anchor_of_all) {
  for (const auto& [name, soup] : small_objects()) {
    const Counted_soup counted{soup};
    Tree_on_demand tree = tree_of(soup);
    for (std::uint32_t leaf = 0; leaf < tree.layout().leaf_count(); leaf += 3) {
      tree.start_frame(counted.positions());
      std::ranges::fill(counted.reads, 0);
      EXPECT_FALSE(tree.is_posed(leaf));
      tree.pose(leaf);
      EXPECT_TRUE(tree.is_posed(leaf));
      const auto vertices = tree.layout().vertices(leaf);
      for (const auto vertex : vertices) EXPECT_GE(counted.reads[vertex], 1U);
      EXPECT_LE(counted.sum(), vertices.size() + 1) << name;
      EXPECT_EQ(counted.sum(), tree.vertices_read());
      tree.pose(leaf);
      EXPECT_EQ(counted.sum(), tree.vertices_read());
      EXPECT_LE(tree.vertices_read(), vertices.size() + 1);
    }
  }
}

TEST(Tree_on_demand, an_anchor_is_a_vertex_that_is_read_once_a_frame) {
  const Counted_soup counted{icosphere(6)};
  Tree_on_demand tree = tree_of(counted.soup);
  for (int frame = 0; frame < 3; ++frame) {
    tree.start_frame(counted.positions());
    std::ranges::fill(counted.reads, 0);
    for (std::uint32_t n = 0; n < tree.layout().node_count(); ++n) {
      const Eigen::Vector3d first = tree.anchor(n);
      EXPECT_EQ(counted.sum(), n + 1);
      EXPECT_EQ(tree.anchor(n), first);
    }
    EXPECT_EQ(counted.sum(), tree.layout().node_count());
    EXPECT_EQ(tree.vertices_read(), tree.layout().node_count());
  }
}

TEST(Tree_on_demand, the_vertices_of_a_node_lie_within_its_radius_of_its_anchor_wherever_it_moves) {
  std::mt19937_64 random(3);
  for (const auto& [name, soup] : small_objects()) {
    Tree_on_demand tree = tree_of(soup);
    for (const double factor : {1.0, 0.5, 3.0}) {
      const auto now = placed(posed_at_random(soup, 2, random), factor);
      tree.start_frame(Live_positions(now.coordinates.data()));
      EXPECT_EQ(tree.stretch(), 1);
      tree.note_distance(factor, 1);
      EXPECT_EQ(tree.stretch(), std::max(1.0, factor));
      for (std::uint32_t n = 0; n < tree.layout().node_count(); ++n)
        for (std::uint32_t leaf = tree.layout().node(n).leaf; leaf < tree.layout().node(n).end_leaf; ++leaf)
          for (const auto vertex : tree.layout().vertices(leaf)) {
            const Eigen::Map<const Eigen::Vector3d> p(now.coordinates.data() + 3 * std::size_t{vertex});
            EXPECT_LE((p - tree.anchor(n)).norm(), tree.radius(n) * (1 + 1e-12) + 1e-14) << name;
          }
    }
  }
}

TEST(Tree_on_demand, a_distance_of_vertices_at_one_place_at_rest_does_not_stretch_the_surface) {
  Tree_on_demand tree = tree_of(icosphere(3));
  const Face_soup soup = icosphere(3);
  tree.start_frame(Live_positions(soup.coordinates.data()));
  tree.note_distance(1, 0);
  tree.note_distance(1, 2);
  EXPECT_EQ(tree.stretch(), 1);
}

TEST(Tree_on_demand, the_bounds_enclose_all_leaves_that_were_posed_far_away_too) {
  std::mt19937_64 random(4);
  for (const auto& [name, soup] : small_objects())
    for (const double factor : {1.0, 4.0, 0.01})
      for (const double offset : {0.0, 1e6, -1e12}) {
        Tree_on_demand tree = tree_of(soup);
        for (int frame = 0; frame < 3; ++frame) {
          const auto now = placed(posed_at_random(soup, 1, random), factor, frame == 1 ? -offset : offset);
          tree.start_frame(Live_positions(now.coordinates.data()));
          for (std::uint32_t leaf = frame; leaf < tree.layout().leaf_count(); leaf += 2) {
            const Aabb box = tree.pose(leaf);
            Aabb expected;
            expected.enclose(tree.layout().leaf_faces(leaf, now.coordinates));
            EXPECT_EQ(box, expected) << name;
          }
          for (std::uint32_t leaf = frame; leaf < tree.layout().leaf_count(); leaf += 2) {
            Aabb both;
            both.enclose(tree.bounds(), tree.pose(leaf));
            EXPECT_EQ(both, tree.bounds()) << name;
          }
        }
      }
}

TEST(Tree_on_demand, positions_read_by_a_function_or_placed_give_the_tree_of_those_in_memory) {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  motion.pretranslate(Eigen::Vector3d(5, -1, 2));
  const Rigid_motion placement(motion);
  for (const auto& [name, soup] : small_objects()) {
    const Counted_soup counted{soup};
    auto moved_soup = soup;
    deform(moved_soup, [&](const Point& p) {
      const Eigen::Vector3d q = placement(Eigen::Vector3d(p.x(), p.y(), p.z()));
      return Point(q.x(), q.y(), q.z());
    });
    const std::vector<std::pair<Live_positions, const Face_soup*>> cases{
        {counted.positions(), &soup},
        {Live_positions(soup.coordinates.data(), placement), &moved_soup},
        {Live_positions(&counted, Counted_soup::read, placement), &moved_soup}};
    for (const auto& [positions, expected_soup] : cases) {
      Tree_on_demand tree = tree_of(soup), expected = tree_of(soup);
      tree.start_frame(positions);
      expected.start_frame(Live_positions(expected_soup->coordinates.data()));
      for (std::uint32_t n = 0; n < tree.layout().node_count(); ++n) EXPECT_EQ(tree.anchor(n), expected.anchor(n));
      for (std::uint32_t leaf = 0; leaf < tree.layout().leaf_count(); ++leaf) {
        EXPECT_EQ(tree.pose(leaf), expected.pose(leaf));
        for (const auto vertex : tree.layout().vertices(leaf))
          for (std::size_t axis = 0; axis < 3; ++axis)
            EXPECT_EQ(tree.view().coordinates[3 * std::size_t{vertex} + axis],
                      expected.view().coordinates[3 * std::size_t{vertex} + axis]);
      }
      EXPECT_EQ(tree.bounds(), expected.bounds());
      EXPECT_EQ(tree.vertices_read(), expected.vertices_read());
    }
  }
}

TEST(Tree_on_demand, a_coordinate_that_is_not_finite_is_refused_where_it_is_read_until_it_is_finite_again) {
  for (const double bad : {not_a_number, infinity, -infinity})
    for (const bool in_memory : {false, true}) {
      Counted_soup counted{icosphere(6)};
      Tree_on_demand tree = tree_of(counted.soup);
      const auto vertex = tree.layout().vertices(5).back();
      double& coordinate = counted.soup.coordinates[3 * std::size_t{vertex} + 1];
      const double before = std::exchange(coordinate, bad);
      tree.start_frame(in_memory ? Live_positions(counted.soup.coordinates.data()) : counted.positions());
      EXPECT_THROW(tree.pose(5), Bad_mesh);
      EXPECT_THROW(tree.pose(5), Bad_mesh);
      for (std::uint32_t leaf = 0; leaf < tree.layout().leaf_count(); ++leaf)
        if (std::ranges::find(tree.layout().vertices(leaf), vertex) == tree.layout().vertices(leaf).end()) {
          EXPECT_NO_THROW(tree.pose(leaf));
        }
      coordinate = before;
      tree.start_frame(in_memory ? Live_positions(counted.soup.coordinates.data()) : counted.positions());
      EXPECT_NO_THROW(tree.pose(5));

      deform(counted.soup, [&](const Point&) { return Point(0, bad, 0); });
      tree.start_frame(in_memory ? Live_positions(counted.soup.coordinates.data()) : counted.positions());
      for (std::uint32_t n = 0; n < tree.layout().node_count(); ++n) EXPECT_THROW(tree.anchor(n), Bad_mesh);
    }
}

TEST(Tree_on_demand, coordinates_whose_sum_overflows_are_accepted) {
  const Face_soup at_rest = icosphere(6), large = placed(at_rest, 1, 1.7e308);
  Tree_on_demand tree = tree_of(at_rest);
  tree.start_frame(Live_positions(large.coordinates.data()));
  for (std::uint32_t leaf = 0; leaf < tree.layout().leaf_count(); ++leaf) EXPECT_NO_THROW(tree.pose(leaf));
}

}  // namespace
}  // namespace lodestone
