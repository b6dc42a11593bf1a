// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts of surfaces that are bounded and posed only where they are near: those of exhaustive checking.
#include "lodestone/queries/bounded_search.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "lodestone/mesh/errors.h"
#include "support/arm.h"
#include "support/exact_truth.h"
#include "support/message_of.h"

namespace lodestone {
namespace {

/// Compares all three questions with the truth.
/// @return whether the two meet
bool expect_truth(Bounded_surface& a, Bounded_surface& b, const Surface_mesh& mesh_a, const Surface_mesh& mesh_b) {
  const auto truth = exhaustive_face_pairs(mesh_a, mesh_b);
  Bounded_search search;
  std::vector<Face_pair> found{{7, 7}};
  EXPECT_EQ(search.run(a, b, {.query = Contact_query::yes_no}, found).found, !truth.empty());
  EXPECT_EQ(found.size(), 1U);
  EXPECT_EQ(search.run(a, b, {.query = Contact_query::first}, found).found, !truth.empty());
  EXPECT_EQ(found.size(), truth.empty() ? 1U : 2U);
  if (!truth.empty()) {
    EXPECT_TRUE(std::ranges::find(truth, found.back()) != truth.end());
  }
  found.resize(1);
  EXPECT_EQ(search.run(a, b, {}, found).found, !truth.empty());
  EXPECT_EQ(std::vector(found.begin() + 1, found.end()), truth);
  EXPECT_EQ(found.front(), (Face_pair{7, 7}));
  return !truth.empty();
}

/// A smooth body along x, large enough that it is not posed as a whole where its tip is near.
Surface_mesh smooth_body() {
  Surface_mesh mesh = sphere(40);
  for (const auto v : mesh.vertices())
    mesh.point(v) = Point(3 * mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z());
  return mesh;
}

TEST(Bounded_search, finds_what_exhaustive_checking_finds) {
  std::mt19937_64 random(1);
  int meetings = 0, rounds = 0;
  for (const bool morphed : {false, true})
    for (const std::size_t leaf_faces : {4, 40}) {
      Arm a(long_potato(7, 1), morphed, leaf_faces), b(long_potato(6, 2), !morphed, leaf_faces);
      for (int round = 0; round < 12; ++round, ++rounds) {
        const auto number = [&] { return std::uniform_real_distribution<double>(-1, 1)(random); };
        a.pose(1.5 * number(), {0, 0, 0});
        b.pose(1.5 * number(), {4 * number(), 2 * number(), 2 * number()});
        meetings += expect_truth(a.surface, b.surface, a.mesh, b.mesh) ? 1 : 0;
        EXPECT_EQ(a.surface.violations() + b.surface.violations(), 0U);
      }
    }
  EXPECT_GT(meetings, rounds / 5);
  EXPECT_LT(meetings, rounds - rounds / 5);
}

TEST(Bounded_search, with_a_tolerance_finds_what_is_near) {
  std::mt19937_64 random(2);
  Arm a(long_potato(5, 1), true, 8), b(long_potato(5, 2), false, 8);
  Bounded_search search;
  std::size_t near_misses = 0;
  for (int round = 0; round < 40; ++round) {
    const auto number = [&] { return std::uniform_real_distribution<double>(-1, 1)(random); };
    a.pose(number(), {0, 0, 0});
    b.pose(number(), {number(), 2.0 + 0.4 * number(), number()});
    for (const double tolerance : {0.01, 0.3}) {
      const auto truth = near_face_pairs(a.mesh, b.mesh, tolerance);
      std::vector<Face_pair> found;
      const auto ask = [&](Contact_query query) {
        return search.run(a.surface, b.surface, {.query = query, .tolerance = tolerance}, found).found;
      };
      EXPECT_EQ(ask(Contact_query::yes_no), !truth.empty());
      ask(Contact_query::all);
      EXPECT_EQ(found, truth);
      near_misses += !truth.empty() && exhaustive_face_pairs(a.mesh, b.mesh).empty() ? 1 : 0;
    }
  }
  EXPECT_GT(near_misses, 2U);
}

/// Points that are written where they are asked for one by one, and lie elsewhere once all are asked for.
class Elsewhere final : public Position_source {
 public:
  explicit Elsewhere(const Skinned_points& points) : points_(&points), all_(3 * std::size_t{points.vertex_count()}) {}

  std::uint32_t vertex_count() const override { return points_->vertex_count(); }
  std::uint64_t pose_number() const override { return points_->pose_number(); }
  Eigen::Vector3d operator()(std::uint32_t vertex) const override { return (*points_)(vertex); }
  void pose(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const override {
    points_->pose(vertices, coordinates);
  }
  void pose_all(std::span<double> coordinates) const override { points_->pose_all(coordinates); }
  Coordinates all(std::span<double> /*memory*/) const override {
    points_->pose_all(all_);
    return all_;
  }

 private:
  const Skinned_points* points_;
  mutable std::vector<double> all_;
};

TEST(Bounded_search, shows_all_contacts_where_a_surface_is_posed_elsewhere_in_the_middle_of_a_visit) {
  Arm a(long_potato(16, 1), false), b(long_potato(16, 2), false);
  a.pose(0.3, {0, 0, 0});
  b.pose(0.3, {0.3, 0.2, 0});
  const auto truth = exhaustive_face_pairs(a.mesh, b.mesh);
  const auto surface_of = [](Arm& arm, bool elsewhere) {
    std::vector<std::unique_ptr<Node_bound>> bounds;
    bounds.push_back(std::make_unique<Node_bound_of<const Skin_bound&>>(arm.bound));
    std::unique_ptr<const Position_source> source;
    if (elsewhere)
      source = std::make_unique<Elsewhere>(arm.points);
    else
      source = std::make_unique<Computed_source<Skinned_points>>(arm.points);
    return std::make_unique<Bounded_surface>(arm.tree, std::move(source), std::move(bounds));
  };
  for (const bool of_a : {false, true}) {
    const auto surface_a = surface_of(a, of_a), surface_b = surface_of(b, !of_a);
    std::vector<Face_pair> shown;
    std::size_t before = 0;  // contacts that are shown before the surface is posed as a whole
    Bounded_search().visit(*surface_a, *surface_b, 0, [&](Face_pair contact) {
      shown.push_back(contact);
      before += (of_a ? surface_a : surface_b)->all_posed() ? 0 : 1;
      return Visit::go_on;
    });
    std::ranges::sort(shown);
    EXPECT_EQ(shown, truth) << of_a;
    EXPECT_GT(before, 0U) << of_a;
    EXPECT_LT(before, shown.size()) << of_a;
  }
}

TEST(Bounded_search, refuses_what_is_no_tolerance) {
  Arm a(long_potato(3, 1), false), b(long_potato(3, 2), false);
  std::vector<Face_pair> found;
  for (const double tolerance : {-1.0, std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_THROW(Bounded_search().run(a.surface, b.surface, {.tolerance = tolerance}, found), Bad_argument);
}

TEST(Bounded_search, poses_little_where_little_is_near) {
  Arm a(smooth_body(), false), b(smooth_body(), false);
  a.pose(0.5, {0, 0, 0});
  b.pose(-0.5, {0, 0, 30});
  Bounded_search search;
  std::vector<Face_pair> found;
  EXPECT_FALSE(search.run(a.surface, b.surface, {}, found).found);
  EXPECT_EQ(a.surface.vertices_posed() + b.surface.vertices_posed(), 0U);
  EXPECT_EQ(a.surface.nodes_bounded(), 1U);
  bool meet = false;
  for (double x = 6.2; !meet && x > 5; x -= 0.05) {  // tip to tip
    a.pose(0, {0, 0, 0});
    b.pose(0, {x, 0, 0});
    meet = expect_truth(a.surface, b.surface, a.mesh, b.mesh);
  }
  EXPECT_TRUE(meet);
  EXPECT_GT(a.surface.vertices_posed(), 0U);
  EXPECT_LT(a.surface.vertices_posed(), a.points.vertex_count() / 10);
}

/// `b` has one leaf, whose box is much too large. Once that leaf is posed, no further node of `a` is opened.
TEST(Bounded_search, opens_no_node_that_is_apart_from_a_posed_leaf) {
  Arm a(smooth_body(), false, 8), b(long_potato(2, 1), false, 100);
  ASSERT_EQ(b.layout.leaf_count(), 1U);
  a.pose(0, {0, 0, 0});
  b.pose(0, {0, 0, 30});
  struct Wide_bound {
    std::size_t node_count() const { return 1; }
    Aabb box(std::uint32_t) const { return {.low = {-50, -50, -50, 0}, .high = {50, 50, 50, 0}}; }
  };
  const Wide_bound wide;
  Bounded_surface surface(b.tree, b.points, wide);
  std::vector<Face_pair> found;
  EXPECT_FALSE(Bounded_search().run(a.surface, surface, {}, found).found);
  ASSERT_EQ(a.surface.leaves_posed(), 1U);
  std::uint32_t leaf = 0, levels = 0;
  while (!a.surface.is_posed(leaf)) ++leaf;
  for (std::uint32_t node = a.layout.leaf_node(leaf); node != 0; node = a.surface.parent(node)) ++levels;
  EXPECT_GT(levels, 5U);
  EXPECT_EQ(a.surface.nodes_bounded(), 1 + 2 * levels);
}

TEST(Bounded_search, that_begins_anywhere_says_the_same) {
  Arm a(smooth_body(), false, 8), b(smooth_body(), true, 11);
  std::mt19937_64 random(5);
  const auto any_leaf = [&](const Tree_layout& layout) {
    return static_cast<std::uint32_t>(random() % (layout.leaf_count() + 1));  // one past the last does not exist
  };
  const auto is_in = [&](const Leaf_pair& place, Face_pair contact) {
    return std::ranges::count(a.layout.faces(place.a), contact.a) == 1 &&
           std::ranges::count(b.layout.faces(place.b), contact.b) == 1;
  };
  Bounded_search search;
  int meetings = 0, poses = 0;
  for (double x = 5.9; x < 6.01; x += 0.01, ++poses) {  // tip to tip
    a.pose(0.1 * std::sin(80 * x), {0, 0, 0});
    b.pose(0.1 * std::sin(50 * x), {x, 0, 0});
    std::vector<Face_pair> truth;
    meetings += search.run(a.surface, b.surface, {}, truth).found ? 1 : 0;
    for (int i = 0; i < 200; ++i) {
      a.surface.forget_pose(), b.surface.forget_pose();
      std::optional<Leaf_pair> place = Leaf_pair{any_leaf(a.layout), any_leaf(b.layout)};
      std::vector<Face_pair> found;
      const auto summary = search.run(a.surface, b.surface, {.query = Contact_query::yes_no}, found, &place);
      ASSERT_EQ(summary.found, !truth.empty());
      ASSERT_FALSE(a.surface.all_posed() || b.surface.all_posed());
      ASSERT_EQ(place.has_value(), !truth.empty());
      if (place) {
        EXPECT_TRUE(std::ranges::any_of(truth, [&](Face_pair contact) { return is_in(*place, contact); }));
      }
    }
  }
  EXPECT_GT(meetings, poses / 5);
  EXPECT_LT(meetings, poses);
}

TEST(Bounded_search, that_begins_anywhere_visits_each_leaf_pair_once) {
  Arm a(smooth_body(), false, 8), b(smooth_body(), false, 11);
  Bounded_search search;
  std::vector<Face_pair> found;
  Contact_summary from_roots{.found = true};
  for (double apart = 1.8; from_roots.found; apart += 0.0005) {  // then just apart: some leaves are near
    a.pose(0.1, {0, 0, 0});
    b.pose(0.1, {0.4, 0.3, apart});
    from_roots = search.run(a.surface, b.surface, {.query = Contact_query::yes_no}, found);
  }
  ASSERT_GT(from_roots.leaf_tests, 1U);
  for (std::uint32_t leaf = 0; leaf < a.layout.leaf_count(); ++leaf) {
    a.surface.forget_pose(), b.surface.forget_pose();
    std::optional<Leaf_pair> place = Leaf_pair{leaf, 7 * leaf % static_cast<std::uint32_t>(b.layout.leaf_count())};
    const auto summary = search.run(a.surface, b.surface, {.query = Contact_query::yes_no}, found, &place);
    EXPECT_FALSE(summary.found || place);
    EXPECT_EQ(summary.leaf_tests, from_roots.leaf_tests);
    ASSERT_FALSE(a.surface.all_posed() || b.surface.all_posed());
  }
}

TEST(Bounded_search, that_begins_where_surfaces_touched_looks_at_little_else) {
  Arm a(smooth_body(), false), b(smooth_body(), false);
  Bounded_search search;
  std::optional<Leaf_pair> place;
  for (int frame = 0; frame < 10; ++frame) {
    a.pose(0, {0, 0, 0});
    b.pose(0, {5.9 - 0.001 * frame, 0, 0});  // tip to tip
    std::vector<Face_pair> found;
    const auto contacts = search.run(a.surface, b.surface, {.query = Contact_query::yes_no}, found, &place);
    EXPECT_TRUE(contacts.found && place);
    EXPECT_EQ(found.size(), 0U);
    if (frame == 0) continue;
    EXPECT_EQ(contacts.leaf_tests, 1U);
    EXPECT_EQ(a.surface.leaves_posed() + b.surface.leaves_posed(), 2U);
    EXPECT_EQ(a.surface.nodes_bounded() + b.surface.nodes_bounded(), 4U);  // these leaves, and the roots
  }
}

TEST(Bounded_search, that_finds_all_posed_keeps_the_place_of_a_contact_that_is_there) {
  Arm a(smooth_body(), false), b(smooth_body(), false);
  Bounded_search search;
  std::optional<Leaf_pair> place;
  const auto ask = [&](double x) {
    a.pose(0, {0, 0, 0});
    b.pose(0, {x, 0, 0});
    std::vector<Face_pair> found;
    a.surface.start_frame(), b.surface.start_frame();
    a.surface.pose_all(), b.surface.pose_all();
    return search.run(a.surface, b.surface, {.query = Contact_query::yes_no}, found, &place).found;
  };
  EXPECT_TRUE(ask(5.9));
  EXPECT_FALSE(place);  // nobody has looked at leaves one by one
  place = Leaf_pair{1, 2};
  EXPECT_TRUE(ask(5.9));
  EXPECT_EQ(place, (Leaf_pair{1, 2}));
  EXPECT_FALSE(ask(7));
  EXPECT_FALSE(place);
}

TEST(Bounded_surface, that_was_posed_as_a_whole_poses_leaf_by_leaf_again_when_little_is_near) {
  Arm a(long_potato(16, 1), false), b(long_potato(16, 1), false);
  Bounded_search search;
  const auto play = [&](double x, int frame) {
    a.pose(0.3 + 0.001 * frame, {0, 0, 0});
    b.pose(0.3, {x, 0.005, 0});
    std::vector<Face_pair> found;
    search.run(a.surface, b.surface, {}, found);
    EXPECT_EQ(found, exhaustive_face_pairs(a.mesh, b.mesh));
  };
  std::vector<int> tries;  // frames in which leaves were posed before it gave up
  for (int frame = 0; frame < 110; ++frame) {
    play(0.01, frame);
    EXPECT_TRUE(a.surface.all_posed());
    if (a.surface.nodes_bounded() > 20) tries.push_back(frame);
  }
  EXPECT_EQ(tries, (std::vector{0, 2, 5, 10, 19, 36, 69, 102}));
  play(30, 100);  // nothing is near
  EXPECT_EQ(a.surface.vertices_posed(), 0U);
  for (double x = 6.5; x > 4; x -= 0.02) {
    play(x, static_cast<int>(100 * x));
    if (a.surface.leaves_posed() > 0) break;
  }
  EXPECT_GT(a.surface.leaves_posed(), 0U);
  EXPECT_FALSE(a.surface.all_posed());
  tries.clear();
  for (int frame = 0; frame < 5; ++frame) {
    play(0.01, frame);
    if (a.surface.nodes_bounded() > 20) tries.push_back(frame);
  }
  EXPECT_EQ(tries, (std::vector{0, 2}));  // pauses are short again
}

TEST(Bounded_surface, goes_on_pausing_after_a_frame_in_which_something_else_posed_all) {
  Arm a(long_potato(16, 1), false), b(long_potato(16, 1), false);
  Bounded_search search;
  std::vector<int> tries;
  for (int frame = 0; frame < 12; ++frame) {
    a.pose(0.3 + 0.001 * frame, {0, 0, 0});
    b.pose(0.3, {0.01, 0.005, 0});
    std::vector<Face_pair> found;
    search.run(a.surface, b.surface, {}, found);
    if (a.surface.nodes_bounded() > 20) tries.push_back(frame);
    a.pose(0.3005 + 0.001 * frame, {0, 0, 0});
    a.surface.start_frame();
    a.surface.pose_all();
  }
  EXPECT_EQ(tries, (std::vector{0, 2, 5, 10}));
}

TEST(Bounded_search, poses_all_where_much_is_near) {
  Arm a(long_potato(12, 1), false), b(long_potato(12, 1), false);
  a.pose(0.3, {0, 0, 0});
  b.pose(0.3, {0.01, 0.005, 0});
  EXPECT_TRUE(expect_truth(a.surface, b.surface, a.mesh, b.mesh));
  EXPECT_EQ(a.surface.leaves_posed(), a.layout.leaf_count());
}

TEST(Bounded_search, that_notices_a_broken_bound_poses_all_and_is_right) {
  Arm a(long_potato(10, 1), false), b(long_potato(10, 2), false);
  a.pose(0.4, {0, 0, 0});
  b.pose(0.8, {1.5, 0.3, 0});
  int broken = 0;
  for (std::uint32_t from = 0; from < a.bound.node_count(); ++from) {
    const Shrunk_bound lie{a.bound, from};
    Tree_surface tree = a.tree;
    Bounded_surface surface(tree, a.points, lie);
    Bounded_search search;
    std::vector<Face_pair> found;
    search.run(surface, b.surface, {}, found);
    if (surface.violations() == 0) continue;
    ++broken;
    EXPECT_FALSE(surface.is_broken());
    EXPECT_EQ(found, exhaustive_face_pairs(a.mesh, b.mesh));
    EXPECT_EQ(surface.leaves_posed(), a.layout.leaf_count());
  }
  EXPECT_GT(broken, 10);
}

TEST(Bounded_search, shows_each_contact_once_where_a_broken_bound_is_noticed_in_the_middle_of_a_visit) {
  Arm a(long_potato(10, 1), false), b(long_potato(10, 2), false);
  a.pose(0.4, {0, 0, 0});
  b.pose(0.8, {1.5, 0.3, 0});
  const auto truth = exhaustive_face_pairs(a.mesh, b.mesh);
  int broken = 0;  // visits that began anew after some contacts
  for (std::uint32_t from = 0; from < a.bound.node_count(); ++from) {
    const Shrunk_bound lie{a.bound, from};
    Tree_surface tree = a.tree;
    Bounded_surface surface(tree, a.points, lie);
    std::vector<Face_pair> shown;
    std::size_t before = 0;  // contacts that are shown before the surface is posed as a whole
    Bounded_search().visit(surface, b.surface, 0, [&](Face_pair contact) {
      shown.push_back(contact);
      before += surface.all_posed() ? 0 : 1;
      return Visit::go_on;
    });
    if (surface.violations() == 0) continue;
    std::ranges::sort(shown);
    EXPECT_EQ(shown, truth) << from;
    broken += before > 0 ? 1 : 0;
  }
  EXPECT_GT(broken, 10);
}

TEST(Bounded_surface, compares_what_it_poses_with_the_boxes_that_were_in_use) {
  Arm a(long_potato(20, 1), false);
  a.pose(0.4, {0, 0, 0});
  const std::uint32_t leaf = 3, node = a.layout.leaf_node(leaf);
  const Shrunk_bound lie{a.bound, 1};  // of all nodes but the root
  std::array<Tree_surface, 3> trees{a.tree, a.tree, a.tree};
  Bounded_surface by_leaf(trees[0], a.points, lie), by_node(trees[1], a.points, lie), unused(trees[2], a.points, lie);
  by_leaf.pose(leaf);
  EXPECT_EQ(by_leaf.violations(), 1U);
  EXPECT_TRUE(by_leaf.is_broken());
  by_leaf.settle();
  EXPECT_FALSE(by_leaf.is_broken());
  by_node.box(node);
  by_node.pose_all();
  EXPECT_EQ(by_node.violations(), 1U);
  EXPECT_TRUE(by_node.is_broken());
  unused.pose_all();
  EXPECT_EQ(unused.violations(), 0U);  // no box was in use
  a.pose(0.5, {0, 0, 0});
  by_node.start_frame();
  EXPECT_EQ(by_node.violations(), 0U);
}

TEST(Bounded_surface, compares_a_leaf_that_it_poses_with_the_box_of_the_whole) {
  Arm a(long_potato(20, 1), false);
  a.pose(0.4, {0, 0, 0});
  struct Lie_about_the_whole {
    const Skin_bound& truth;
    std::size_t node_count() const { return truth.node_count(); }
    Aabb box(std::uint32_t node) const {
      return node == 0 ? Aabb{.low = {900, 900, 900, 0}, .high = {901, 901, 901, 0}} : truth.box(node);
    }
  };
  const Lie_about_the_whole lie{a.bound};
  Bounded_surface surface(a.tree, a.points, lie);
  surface.pose(3);
  ASSERT_FALSE(surface.all_posed());
  EXPECT_EQ(surface.violations(), 1U);
  EXPECT_TRUE(surface.is_broken());
}

TEST(Bounded_surface, fits_a_node_when_all_leaves_below_it_have_been_posed) {
  Arm a(long_potato(30, 1), false);
  a.pose(0.4, {0, 0, 0});
  Bounded_surface surface(a.tree, a.points, a.bound);
  Tree_surface fitted_tree = a.tree;
  Bounded_surface fitted(fitted_tree, a.points, a.bound);
  fitted.pose_all();
  std::uint32_t node = 0;  // with a few leaves below it
  while (a.layout.node(node).end_leaf - a.layout.node(node).leaf > 6) ++node;
  const auto [second, first_leaf, end_leaf] = a.layout.node(node);
  ASSERT_GT(end_leaf - first_leaf, 2U);
  EXPECT_NE(surface.box(node), fitted.box(node));
  for (std::uint32_t leaf = first_leaf; leaf < end_leaf; ++leaf) surface.pose(leaf);
  ASSERT_FALSE(surface.all_posed());
  for (const auto n : {node, node + 1, second}) EXPECT_EQ(surface.box(n), fitted.box(n));
  EXPECT_NE(surface.box(0), fitted.box(0));
  EXPECT_EQ(surface.violations(), 0U);
}

/// The box of a node holds the last leaf below it only, and is made when all others have been posed.
TEST(Bounded_surface, notices_a_wrong_box_of_a_node_when_all_leaves_below_it_have_been_posed) {
  Arm a(long_potato(30, 1), false);
  a.pose(0.4, {0, 0, 0});
  std::uint32_t node = 0;
  while (a.layout.node(node).end_leaf - a.layout.node(node).leaf > 6) ++node;
  const std::uint32_t last = a.layout.node(node).end_leaf - 1;
  struct One_lie {
    const Skin_bound& truth;
    std::uint32_t wrong;
    Aabb around_last;
    std::size_t node_count() const { return truth.node_count(); }
    Aabb box(std::uint32_t n) const { return n == wrong ? around_last : truth.box(n); }
  };
  const One_lie lie{a.bound, node, a.surface.pose(last)};
  Tree_surface tree = a.tree;
  Bounded_surface surface(tree, a.points, lie);
  for (auto leaf = a.layout.node(node).leaf; leaf < last; ++leaf) surface.pose(leaf);
  surface.box(node);
  EXPECT_FALSE(surface.is_broken());
  surface.pose(last);
  ASSERT_FALSE(surface.all_posed());
  EXPECT_EQ(surface.violations(), 1U);
}

TEST(Bounded_search, settles_a_surface_that_is_broken_already) {
  Arm a(long_potato(10, 1), false), b(long_potato(10, 2), false);
  a.pose(0.4, {0, 0, 0});
  b.pose(0.8, {1.5, 0.3, 0});
  struct Far_away {
    const Skin_bound& truth;
    std::size_t node_count() const { return truth.node_count(); }
    Aabb box(std::uint32_t) const { return {.low = {900, 900, 900, 0}, .high = {901, 901, 901, 0}}; }
  };
  const Far_away lie{a.bound};
  Bounded_surface surface(a.tree, a.points, lie);
  surface.pose(0);
  EXPECT_TRUE(surface.is_broken());
  Bounded_search search;
  std::vector<Face_pair> found;
  search.run(surface, b.surface, {}, found);
  EXPECT_EQ(found, exhaustive_face_pairs(a.mesh, b.mesh));
}

TEST(Bounded_surface, refuses_what_belongs_to_other_meshes) {
  Arm a(long_potato(6, 1), false), small(long_potato(3, 1), false);
  EXPECT_THROW(Bounded_surface(a.tree, small.points, a.bound), Bad_argument);
  EXPECT_THROW(Bounded_surface(a.tree, a.points, small.bound), Bad_argument);
  EXPECT_THROW(Skin_bound(small.points, a.layout), Bad_argument);
  EXPECT_THROW(Linear_bound(small.points.shape(), a.layout), Bad_argument);
}

TEST(Bounded_surface, lies_in_what_several_bounds_have_in_common) {
  Arm a(long_potato(5, 1), false);
  a.pose(0.4, {0, 0, 0});
  struct Half_space {
    std::size_t nodes;
    std::size_t node_count() const { return nodes; }
    Aabb box(std::uint32_t) const {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      return {.low = {-infinity, -infinity, 0.25, 0}, .high = {infinity, infinity, infinity, 0}};
    }
  };
  const Half_space above{a.bound.node_count()};
  Bounded_surface surface(a.tree, a.points, a.bound, above);
  EXPECT_EQ(surface.box(0).low[2], 0.25);
  EXPECT_EQ(surface.box(0).high[2], a.bound.box(0).high[2]);
}

TEST(Bounded_search, names_a_vertex_that_is_not_finite) {
  Arm a(long_potato(5, 1), false), b(long_potato(5, 2), false);
  b.pose(0.4, {0, 0, 0});
  std::vector<Eigen::Affine3d> motions(3, Eigen::Affine3d::Identity());
  motions[2] = Eigen::Translation3d(1.7e308, 0, 0) * Eigen::Scaling(1.7e308);
  a.points.set_joints(motions);
  Bounded_search search;
  std::vector<Face_pair> found;
  const auto message = message_of<Bad_mesh>([&] { search.run(a.surface, b.surface, {}, found); });
  EXPECT_NE(message.find("has a coordinate that is not finite"), std::string::npos) << message;
  a.pose(0, {0, 0, 0});
  EXPECT_TRUE(expect_truth(a.surface, b.surface, a.mesh, b.mesh));
}

}  // namespace
}  // namespace lodestone
