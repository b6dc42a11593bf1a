// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever is read of a bounded surface is compared with the boxes in use, also where no leaf is posed.
#include <CGAL/boost/graph/copy_face_graph.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lodestone/bounds/lipschitz_bound.h"
#include "lodestone/bounds/stretch_bound.h"
#include "lodestone/queries/containment.h"
#include "support/arm.h"

namespace lodestone {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Moves the box of one node along x by half its length.
struct Beside {
  const Skin_bound& truth;
  std::uint32_t wrong;

  std::size_t node_count() const { return truth.node_count(); }
  Aabb box(std::uint32_t node) const {
    Aabb box = truth.box(node);
    const double half = (box.high[0] - box.low[0]) / 2;
    if (node == wrong) box.low[0] += half, box.high[0] += half;
    return box;
  }
};

/// Gives no limit, and has read a position.
struct Reads {
  std::size_t nodes;
  Eigen::Vector3d position;

  std::size_t node_count() const { return nodes; }
  Aabb box(std::uint32_t) const {
    return {.low = {-infinity, -infinity, -infinity, 0}, .high = {infinity, infinity, infinity, 0}};
  }
  Aabb box(std::uint32_t node, std::vector<Eigen::Vector3d>& read) const {
    read.push_back(position);
    return box(node);
  }
};

TEST(Compared_reads, of_a_leaf_are_compared_with_the_boxes_of_all_nodes_above_it) {
  Arm a(long_potato(30, 1), false);
  a.pose(0.4, {0, 0, 0});
  std::size_t noticed = 0, not_noticed = 0;
  const std::uint32_t wrong = 1;
  for (std::uint32_t leaf = 0; leaf < a.layout.leaf_count(); leaf += 7) {
    const Beside lie{a.bound, wrong};
    Tree_surface tree = a.tree;
    Bounded_surface surface(tree, a.points, lie);
    for (std::uint32_t node = 0; !a.layout.is_leaf(node);) {  // as a query goes down
      surface.box(node);
      const std::uint32_t second = a.layout.node(node).second_child;
      node = leaf < a.layout.node(second).leaf ? node + 1 : second;
    }
    const Aabb fitted = surface.pose(leaf);
    ASSERT_FALSE(surface.all_posed());
    const bool sticks_out = leaf < a.layout.node(wrong).end_leaf && !contains(lie.box(wrong), fitted);
    EXPECT_EQ(surface.is_broken(), sticks_out) << leaf;
    (sticks_out ? noticed : not_noticed) += 1;
  }
  EXPECT_GT(noticed, 5U);
  EXPECT_GT(not_noticed, 5U);
}

TEST(Compared_reads, of_one_vertex_are_compared_with_the_box_of_its_leaf) {
  Arm a(long_potato(20, 1), false);
  a.pose(0.4, {0, 0, 0});
  const auto components = a.surface.component_vertices();
  ASSERT_EQ(components.size(), 1U);
  const auto listed = a.layout.vertices(components[0].leaf);
  EXPECT_TRUE(std::ranges::find(listed, components[0].vertex) != listed.end());
  EXPECT_EQ(a.surface.position(components[0]), a.points(components[0].vertex));
  EXPECT_EQ(a.surface.vertices_posed(), 1U);
  EXPECT_FALSE(a.surface.is_broken());
  a.surface.pose(components[0].leaf);
  EXPECT_EQ(a.surface.position(components[0]), a.points(components[0].vertex));
  EXPECT_EQ(a.surface.vertices_posed(), 1 + listed.size());

  const Shrunk_bound nowhere{a.bound, 1};
  Tree_surface tree = a.tree;
  Bounded_surface surface(tree, a.points, nowhere);
  EXPECT_EQ(surface.position(surface.component_vertices()[0]), a.points(components[0].vertex));
  EXPECT_FALSE(surface.is_broken());  // no box was in use
  surface.box(a.layout.leaf_node(components[0].leaf));
  surface.position(surface.component_vertices()[0]);
  EXPECT_TRUE(surface.is_broken());
}

TEST(Compared_reads, are_compared_with_boxes_above_that_were_made_later_than_those_below) {
  Arm a(long_potato(20, 1), false);
  a.pose(0.4, {0, 0, 0});
  const auto at = a.surface.component_vertices()[0];
  for (const bool by_leaf : {false, true}) {
    struct Lie_about {
      const Skin_bound& truth;
      std::uint32_t node;
      std::size_t node_count() const { return truth.node_count(); }
      Aabb box(std::uint32_t n) const {
        return n == node ? Aabb{.low = {900, 900, 900, 0}, .high = {901, 901, 901, 0}} : truth.box(n);
      }
    };
    const Lie_about lie{a.bound, by_leaf ? a.surface.parent(a.layout.leaf_node(at.leaf)) : 0};
    Tree_surface tree = a.tree;
    Bounded_surface surface(tree, a.points, lie);
    surface.box(a.layout.leaf_node(at.leaf));
    surface.box(lie.node);
    EXPECT_FALSE(surface.is_broken());
    by_leaf ? void(surface.pose(at.leaf)) : void(surface.position(at));
    ASSERT_FALSE(surface.all_posed());
    EXPECT_TRUE(surface.is_broken());
  }
}

TEST(Compared_reads, that_are_not_finite_have_all_vertices_posed) {
  Arm a(long_potato(5, 1), false);
  a.pose(0.4, {0, 0, 0});
  const Reads reads{a.bound.node_count(), {std::numeric_limits<double>::quiet_NaN(), 0, 0}};
  Tree_surface tree = a.tree;
  Bounded_surface surface(tree, a.points, a.bound, reads);
  surface.box(0);
  EXPECT_TRUE(surface.all_posed());  // and would refuse a vertex that is not finite
  EXPECT_FALSE(surface.is_broken());
}

TEST(Compared_reads, of_bounds_are_compared_with_the_boxes_of_other_bounds) {
  Arm a(long_potato(10, 1), false);
  a.pose(0.4, {0, 0, 0});
  for (const bool inside : {false, true})
    for (const bool first : {false, true}) {
      const Aabb whole = a.bound.box(0);
      const double x = inside ? whole.high[0] : std::nextafter(whole.high[0], infinity);
      const Reads reads{a.bound.node_count(), {x, whole.low[1], whole.low[2]}};
      static_assert(Reading_bound<Reads> && !Reading_bound<Skin_bound>);
      Tree_surface tree = a.tree;
      auto surface =
          first ? Bounded_surface(tree, a.points, reads, a.bound) : Bounded_surface(tree, a.points, a.bound, reads);
      surface.box(0);
      EXPECT_EQ(surface.is_broken(), !inside);
    }
}

/// Separate pieces: a node of more than three of them has the landmarks of its parent.
Surface_mesh pieces(int count) {
  Surface_mesh all;
  for (int i = 0; i < count; ++i) {
    auto piece = tetrahedron();
    shift(piece, 2 * i);
    CGAL::copy_face_graph(piece, all);
  }
  return all;
}

/// @return how many nodes have no landmarks of their own
std::size_t expect_reads_of_the_node(const Surface_mesh& mesh) {
  Arm a(mesh, false);
  const std::vector<double> rest(a.points.shape().rest().begin(), a.points.shape().rest().end());
  const Computed_source<Skinned_points> positions(a.points);
  const Bounded_object object{.layout = a.layout, .labels = {}, .rest = rest, .positions = positions};
  const Lipschitz_promise lipschitz(2);
  const Stretch_promise stretch(2);
  const auto by_distance = lipschitz.bound(object);
  const auto by_edges = stretch.bound(object);
  a.pose(0.4, {0, 0, 0});
  std::size_t without_own = 0;
  for (std::uint32_t node = 0; node < a.layout.node_count(); ++node) {
    std::vector<Eigen::Vector3d> read;
    EXPECT_EQ(by_distance.box(node, read), by_distance.box(node));
    EXPECT_EQ(read.size(), 1U);
    EXPECT_EQ(by_edges.box(node, read), by_edges.box(node));
    without_own += read.size() == 1 ? 1 : 0;
    for (const auto& position : read) {
      bool is_of_node = false;
      for (auto leaf = a.layout.node(node).leaf; leaf < a.layout.node(node).end_leaf; ++leaf)
        for (const auto vertex : a.layout.vertices(leaf)) is_of_node |= a.points(vertex) == position;
      EXPECT_TRUE(is_of_node) << node;
    }
  }
  return without_own;
}

TEST(Compared_reads, of_lipschitz_and_stretch_bounds_are_those_of_vertices_of_the_node) {
  EXPECT_EQ(expect_reads_of_the_node(long_potato(20, 1)), 0U);
  EXPECT_GT(expect_reads_of_the_node(pieces(40)), 0U);
}

TEST(Compared_reads, a_component_that_is_elsewhere_is_noticed_where_only_it_is_asked_whether_it_is_inside) {
  Arm inner(sphere(30), false);
  Arm outer(sphere(30), false);
  for (auto* arm : {&inner, &outer}) arm->pose(0, {0, 0, 0});
  struct Far_inside {  // tiny, at the centre
    std::size_t nodes;
    std::size_t node_count() const { return nodes; }
    Aabb box(std::uint32_t) const { return {.low = {-0.01, -0.01, -0.01, 0}, .high = {0.01, 0.01, 0.01, 0}}; }
  };
  const Far_inside lie{inner.bound.node_count()};
  inner.pose(0, {0.9, 0, 0});
  Bounded_surface surface(inner.tree, inner.points, lie);
  EXPECT_FALSE(encloses(outer.surface, surface));
  EXPECT_GT(surface.violations(), 0U);
  EXPECT_TRUE(surface.all_posed());
}

}  // namespace
}  // namespace lodestone
