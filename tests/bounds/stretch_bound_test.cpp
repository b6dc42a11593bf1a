// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes from a promise about the lengths of edges.
#include "lodestone/bounds/stretch_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "bounds/given_object.h"
#include "lodestone/mesh/errors.h"
#include "lodestone/queries/bounded_search.h"
#include "lodestone/tree/region_tree.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

static_assert(Watching_bound<Stretch_bound> && Motion_promise<Stretch_promise>);

/// How many times longer than at rest the longest edge is.
double greatest_stretch(const Given_object& object) {
  double most = 0;
  for (const auto& face : object.rest.faces)
    for (int i = 0; i < 3; ++i) {
      const auto a = face[static_cast<std::size_t>(i)], b = face[static_cast<std::size_t>((i + 1) % 3)];
      most = std::max(most, (object.at(object.now, a) - object.at(object.now, b)).norm() /
                                (object.at_rest(a) - object.at_rest(b)).norm());
    }
  return most;
}

/// Folds space along random planes, which brings no points farther apart, then turns it.
struct Folding {
  std::vector<std::pair<Eigen::Vector3d, double>> planes;
  Eigen::Isometry3d pose;

  explicit Folding(std::mt19937_64& random, double far) : planes(random() % 4), pose(random_frame(random, far)) {
    for (auto& [normal, offset] : planes) {
      normal = random_direction(random);
      offset = random_number(random);
    }
  }
  Eigen::Vector3d operator()(Eigen::Vector3d p) const {
    for (const auto& [normal, offset] : planes) p -= 2 * std::max(0.0, normal.dot(p) - offset) * normal;
    return pose * p;
  }
};

/// A strip along an arc of almost a full turn: its ends are near each other.
Face_soup rolled_strip(std::uint32_t columns) {
  Face_soup soup(grid(columns, 5));
  deform(soup, [&](const Point& p) {
    const double angle = 6 * p.x() / (columns - 1);
    return Point(10 * std::cos(angle), 10 * std::sin(angle), p.y());
  });
  return soup;
}

TEST(Stretch_bound, every_vertex_lies_in_the_boxes_of_its_nodes) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 150; ++round) {
    Given_object object(potato(2 + random() % 5, 1 + random() % 9), 2 + random() % 20);
    Stretch_promise promise;
    const Stretch_bound bound = promise.bound(object.bounded());
    ASSERT_EQ(bound.node_count(), object.layout.node_count());
    const double stretch = random_number(random, 0, 3), far = round % 2 == 0 ? 1 : 1e7;
    const Folding fold(random, far);
    object.pose([&](const Eigen::Vector3d& p) { return fold(stretch * p); });
    promise.set_stretch(stretch, 1e-15 * (far + 10));
    EXPECT_EQ(nodes_outside(bound, object), 0U) << round;
    for (std::uint32_t leaf = 0; leaf < object.layout.leaf_count(); ++leaf)
      EXPECT_TRUE(bound.note_read(leaf, object.fitted(leaf), object.now));
  }
}

/// The ends of a rolled strip move far apart while its edges keep their lengths.
TEST(Stretch_bound, every_vertex_lies_in_its_boxes_if_a_rolled_strip_is_unrolled) {
  for (const std::size_t leaf_faces : {8, 60, 128}) {
    Given_object object(rolled_strip(15), leaf_faces);
    const Face_soup flat(grid(15, 5));
    for (std::uint32_t v = 0; v < object.vertex_count(); ++v) {
      const Point p = flat.point(v);
      object.put(v, {60.0 / 14 * p.x(), 0, p.y()});
    }
    const Stretch_promise promise(greatest_stretch(object));
    const Stretch_bound bound = promise.bound(object.bounded());
    EXPECT_LT(promise.stretch(), 1.01);
    EXPECT_EQ(nodes_outside(bound, object), 0U);
  }
}

TEST(Stretch_bound, is_as_large_as_the_longest_of_the_shortest_paths) {
  Given_object object(grid(9, 3), 128);  // one node, with its landmark at (4, 1)
  Stretch_promise promise(2);
  const Stretch_bound bound = promise.bound(object.bounded());
  ASSERT_EQ(bound.landmarks(0).size(), 1U);
  EXPECT_EQ(bound.landmarks(0)[0].vertex, 13U);
  EXPECT_NEAR(bound.landmarks(0)[0].radius, 5, 1e-7);  // to (0, 2) and (8, 0), where no diagonal helps
  EXPECT_NEAR(bound.box(0).high[0], 4 + 2 * 5, 1e-6);
  EXPECT_NEAR(bound.box(0).low[2], -2 * 5, 1e-6);
}

/// A path from one side to the other goes around the border of the plate.
TEST(Stretch_bound, of_a_thin_plate_has_a_landmark_on_each_side) {
  Surface_mesh mesh = cube(24);
  for (const auto v : mesh.vertices())
    mesh.point(v) = Point(mesh.point(v).x(), mesh.point(v).y(), 1e-3 * mesh.point(v).z());
  Given_object object(mesh, 32);
  const Stretch_promise promise(1);
  const Stretch_bound bound = promise.bound(object.bounded());
  EXPECT_EQ(nodes_outside(bound, object), 0U);
  std::size_t with_two = 0, inside = 0;
  for (std::uint32_t leaf = 0; leaf < object.layout.leaf_count(); ++leaf) {
    const Aabb fitted = object.fitted(leaf);
    // No faces of the rim, which connects the two sides.
    if (fitted.low[0] == 0 || fitted.low[1] == 0 || fitted.high[0] == 1 || fitted.high[1] == 1) continue;
    const std::uint32_t node = object.layout.leaf_node(leaf);
    EXPECT_LT(bound.box(node).extent(), 8 * fitted.extent());
    ++inside;
    with_two += bound.landmarks(node).size() == 2 ? 1 : 0;
  }
  EXPECT_EQ(with_two, inside);
  EXPECT_GT(inside, 20U);
}

TEST(Stretch_bound, of_few_components_is_finite_and_of_many_is_open_above_the_nodes_that_hold_few) {
  for (const int components : {2, 3, 5}) {
    Surface_mesh mesh = potato(4);
    for (int i = 1; i < components; ++i) {
      Surface_mesh other = potato(4, 1 + static_cast<std::uint64_t>(i));
      shift(other, 5 * i);
      append(mesh, other);
    }
    Given_object object(mesh, 16);
    Stretch_promise promise(1);
    Stretch_bound bound = promise.bound(object.bounded());
    EXPECT_EQ(std::isfinite(bound.box(0).extent()), components <= 3);
    EXPECT_EQ(nodes_outside(bound, object), 0U);
    std::size_t finite = 0;
    for (std::uint32_t node = 0; node < bound.node_count(); ++node)
      finite += std::isfinite(bound.box(node).extent()) ? 1 : 0;
    EXPECT_GT(finite, object.layout.leaf_count());
    // Components fly apart.
    for (std::uint32_t v = 0; v < object.vertex_count(); ++v)
      object.put(v, object.at_rest(v) + 3 * std::round(object.at_rest(v).x() / 5) * Eigen::Vector3d(1, 2, -3));
    promise.set_stretch(1, 1e-13);
    EXPECT_EQ(nodes_outside(bound, object), 0U);
  }
}

/// A crumpled sheet in a small box: its leaves are of many pieces, which only long paths connect.
TEST(Stretch_bound, every_vertex_lies_in_its_boxes_if_nodes_are_of_many_pieces) {
  const Face_soup flat(grid(60, 60));
  Face_soup sheet = flat;
  const double width = 7;
  deform(sheet, [&](const Point& p) {  // folded like a map, with layers that lie close together
    const double layer = std::floor(p.x() / width), along = p.x() - layer * width;
    const bool back = static_cast<int>(layer) % 2 == 1;
    return Point(back ? width - along : along, p.y(), 0.01 * p.x());
  });
  Given_object object(sheet, 40);
  Stretch_promise promise;
  const Stretch_bound bound = promise.bound(object.bounded());
  EXPECT_EQ(nodes_outside(bound, object), 0U);
  std::size_t inherited = 0;
  for (std::uint32_t node = 0; node < bound.node_count(); ++node) {
    ASSERT_LE(bound.landmarks(node).size(), 3U);
    if (object.layout.is_leaf(node)) continue;
    for (const auto child : {node + 1, object.layout.node(node).second_child})
      inherited += bound.landmarks(child).data() == bound.landmarks(node).data() ? 1 : 0;
  }
  EXPECT_GT(inherited, 0U);
  object.now = flat.coordinates;
  promise.set_stretch(greatest_stretch(object) * (1 + 1e-15));
  EXPECT_EQ(nodes_outside(bound, object), 0U);
}

/// The vertex moves by too little to leave any box.
TEST(Stretch_bound, that_is_broken_is_noticed_where_an_edge_is_read) {
  Given_object object(grid(20, 20), 40);
  Stretch_promise promise(1);
  Stretch_bound bound = promise.bound(object.bounded());
  const auto surface = object.surface(bound);
  const std::uint32_t leaf = 2, vertex = object.layout.vertices(leaf)[9];
  for (const double by : {0.9e-9, 3e-9, 0.01}) {
    object.now = object.rest.coordinates;
    object.put(vertex, object.at_rest(vertex) + Eigen::Vector3d(by, 0, 0));
    surface->start_frame();
    surface->pose(leaf);
    EXPECT_EQ(surface->violations(), by > 1e-9 ? 1U : 0U) << by;
  }
  promise.set_stretch(1.02);
  surface->start_frame();
  surface->pose(leaf);
  EXPECT_EQ(surface->violations(), 0U);
  promise.set_stretch(1, 0.005);
  surface->start_frame();
  surface->pose(leaf);
  EXPECT_EQ(surface->violations(), 0U);
}

TEST(Stretch_bound, that_is_broken_anywhere_is_noticed_in_64_frames_that_read_all_and_at_once_on_request) {
  Given_object object(grid(60, 60), 40);
  const Stretch_promise promise(1);
  Stretch_bound bound = promise.bound(object.bounded());
  ASSERT_GT(object.layout.leaf_count(), 128U);
  const std::vector<Aabb> fitted = fitted_boxes(object.layout, object.now);
  for (int frame = 0; frame < 64; ++frame) EXPECT_TRUE(bound.note_all(fitted, object.now, false));
  EXPECT_TRUE(bound.note_all(fitted, object.now, true));
  for (const std::uint32_t vertex : {130U, 1000U, 1234U, 2500U}) {
    ASSERT_LT(vertex, object.vertex_count());
    object.now = object.rest.coordinates;
    object.put(vertex, object.at_rest(vertex) + Eigen::Vector3d(0.1, 0.1, 0));
    EXPECT_FALSE(bound.note_all(fitted, object.now, true)) << vertex;
    int noticed = 0;
    for (int frame = 0; frame < 64; ++frame) noticed += bound.note_all(fitted, object.now, false) ? 0 : 1;
    const auto leaf_of_vertex = [&](std::uint32_t leaf) {
      return std::ranges::binary_search(object.layout.vertices(leaf), vertex);
    };
    int leaves = 0;
    for (std::uint32_t leaf = 0; leaf < object.layout.leaf_count(); ++leaf) leaves += leaf_of_vertex(leaf) ? 1 : 0;
    EXPECT_GE(noticed, 1) << vertex;
    EXPECT_LE(noticed, leaves) << vertex;
  }
}

/// Shortens the face, and makes one edge after the other longer than it was.
TEST(Stretch_bound, that_is_broken_by_any_edge_of_a_face_is_noticed) {
  Given_object object(mesh_of({Point(0, 0, 0), Point(1, 0, 0), Point(0.5, 1, 0)}, {{0, 1, 2}}));
  const Stretch_promise promise(1);
  const Stretch_bound bound = promise.bound(object.bounded());
  EXPECT_TRUE(bound.note_read(0, object.fitted(0), object.now));
  for (std::uint32_t v = 0; v < 3; ++v) {
    const std::uint32_t from = (v + 1) % 3, to = (v + 2) % 3;
    const Eigen::Vector3d along = object.at_rest(to) - object.at_rest(from);
    object.now = object.rest.coordinates;
    object.put(v, (object.at_rest(from) + object.at_rest(to)) / 2);
    EXPECT_TRUE(bound.note_read(0, object.fitted(0), object.now));
    object.put(to, object.at_rest(from) + 1.01 * along);
    EXPECT_FALSE(bound.note_read(0, object.fitted(0), object.now)) << v;
  }
}

/// A small shape far away is turned and brought to the origin, where it is as rough as its coordinates were there.
TEST(Stretch_bound, every_vertex_lies_in_its_boxes_if_the_error_of_positions_is_promised) {
  std::mt19937_64 random(4);
  std::size_t outside_without = 0;
  for (int round = 0; round < 50; ++round) {
    const double far = std::ldexp(1.0, static_cast<int>(random() % 30));
    Given_object object(placed(potato(4, 1 + random() % 9), std::ldexp(1.0, -20), far), 2 + random() % 4);
    const Eigen::Isometry3d frame = random_frame(random, 0) * Eigen::Translation3d(Eigen::Vector3d::Constant(-far));
    object.pose([&](const Eigen::Vector3d& p) { return frame * p; });
    // Errors of a shape that is almost a point are far larger than it.
    for (double& x : object.now) x += random_number(random) * 8 * 0x1p-53 * far;
    Stretch_promise promise(1);
    const Stretch_bound bound = promise.bound(object.bounded());
    outside_without += nodes_outside(bound, object);
    promise.set_stretch(1, 64 * 0x1p-53 * far);
    EXPECT_EQ(nodes_outside(bound, object), 0U) << round;
    for (std::uint32_t leaf = 0; leaf < object.layout.leaf_count(); ++leaf)
      EXPECT_TRUE(bound.note_read(leaf, object.fitted(leaf), object.now));
  }
  EXPECT_GT(outside_without, 0U);
}

/// Faces without area along an axis, so that shortest paths are straight. All edges are longer by what is let pass.
TEST(Stretch_bound, that_is_not_seen_to_be_broken_holds_every_vertex) {
  Face_soup chain;
  for (std::uint32_t v = 0; v < 60; ++v) {
    chain.coordinates.insert(chain.coordinates.end(), {v + 0.1, 0, 0});
    if (v >= 2) chain.faces.push_back({v - 2, v - 1, v});
  }
  Given_object object(chain, 20);
  const Stretch_promise promise(1);
  const Stretch_bound bound = promise.bound(object.bounded());
  object.pose([](const Eigen::Vector3d& p) { return Eigen::Vector3d((1 + 0.9e-9) * p); });
  for (std::uint32_t leaf = 0; leaf < object.layout.leaf_count(); ++leaf)
    EXPECT_TRUE(bound.note_read(leaf, object.fitted(leaf), object.now));
  EXPECT_EQ(nodes_outside(bound, object), 0U);
}

TEST(Stretch_bound, contacts_are_those_of_exhaustive_checking) {
  std::mt19937_64 random(3);
  Given_object a(potato(12, 1), 32), b(potato(12, 2), 32);
  const Stretch_promise promise(1, 1e-14);
  Stretch_bound bound_a = promise.bound(a.bounded()), bound_b = promise.bound(b.bounded());
  Bounded_search search;
  std::size_t meetings = 0, partly = 0;
  for (int frame = 0; frame < 200; ++frame) {
    const auto surface_a = a.surface(bound_a),
               surface_b = b.surface(bound_b, frame % 2 == 0);  // with no memory of earlier frames
    a.pose(Folding(random, 1));
    b.pose(Folding(random, 2.5));
    std::vector<Face_pair> found;
    search.run(*surface_a, *surface_b, {}, found);
    Face_soup now_a = a.rest, now_b = b.rest;
    now_a.coordinates = a.now;
    now_b.coordinates = b.now;
    EXPECT_EQ(found, true_pairs(now_a, now_b));
    EXPECT_EQ(surface_a->violations() + surface_b->violations(), 0U);
    meetings += found.empty() ? 0 : 1;
    partly += surface_a->all_posed() ? 0 : 1;
  }
  EXPECT_GT(meetings, 5U);
  EXPECT_GT(partly, 5U);
}

TEST(Stretch_bound, that_overflows_is_open) {
  Given_object object(placed(potato(3), 1e300));
  const Stretch_promise promise(1);
  EXPECT_EQ(promise.bound(object.bounded()).box(0), open_box);
  Given_object small(potato(3));
  const Stretch_promise large(1e308);
  EXPECT_EQ(large.bound(small.bounded()).box(0), open_box);
}

TEST(Stretch_bound, contains_the_smallest_numbers) {
  Given_object object(potato(3), 4);
  object.pose([](const Eigen::Vector3d& p) { return Eigen::Vector3d(1e-320 * p); });
  const auto tiny = object.now;
  object.rest.coordinates = tiny;
  const Stretch_promise promise(1);
  const Stretch_bound bound = promise.bound(object.bounded());
  EXPECT_EQ(nodes_outside(bound, object), 0U);
  for (std::uint32_t leaf = 0; leaf < object.layout.leaf_count(); ++leaf)
    EXPECT_TRUE(bound.note_read(leaf, object.fitted(leaf), object.now));
}

TEST(Stretch_promise, refuses_what_is_no_stretch) {
  Stretch_promise promise(2, 1);
  for (const double bad : {-1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_THROW(promise.set_stretch(bad), Bad_argument);
    EXPECT_THROW(promise.set_stretch(1, bad), Bad_argument);
  }
  EXPECT_EQ(promise.stretch(), 2);
  EXPECT_EQ(promise.error(), 1);
}

TEST(Stretch_bound, contains_errors_both_ways) { expect_inside_off_both_ways(Stretch_promise(1, 10)); }

}  // namespace
}  // namespace lodestone
