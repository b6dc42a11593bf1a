// SPDX-License-Identifier: GPL-3.0-or-later
// Many rays through a Ray_tree. That each answer is true is tested with those of the surface: ray_search_test.cpp.
#include "lodestone/queries/ray_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lodestone/mesh/errors.h"
#include "support/face_soup.h"
#include "support/instruction_sets.h"

namespace lodestone {
namespace {

/// Rays from around an object of the size of the unit sphere to points in and near it, some of limited length.
std::vector<Ray> rays_at(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto point = [&](double size) {
    return Eigen::Vector3d(size * unit(random), size * unit(random), size * unit(random));
  };
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d origin = point(i % 3 == 0 ? 0.8 : 3), target = point(1.2);
    rays.push_back({origin, target - origin});
    if (i % 5 == 0) rays.back().length = 0.5 + 0.5 * unit(random);
    if (i % 7 == 0)
      rays.back().direction = Eigen::Vector3d::Unit(static_cast<Eigen::Index>(i / 7 % 3)) * (i % 2 == 0 ? 1 : -2);
  }
  return rays;
}

void expect_same(const std::optional<Ray_hit>& a, const std::optional<Ray_hit>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (!a) return;
  EXPECT_EQ(a->face, b->face);
  EXPECT_EQ(a->t, b->t);
  EXPECT_EQ(a->point, b->point);
}

void expect_same(std::span<const Ray_hit> a, std::span<const Ray_hit> b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) expect_same(a[i], b[i]);
}

/// Asks about all rays at once, and one by one, and compares the answers with those of the surface.
/// @return number of rays that meet it
std::size_t expect_answers_of_the_surface(const Ray_tree& tree, std::span<const Ray> rays) {
  const Layout_view& surface = tree.surface();
  const auto first = first_hits(tree, rays);
  const auto all = all_hits(tree, rays);
  EXPECT_EQ(first.size(), rays.size());
  EXPECT_EQ(all.size(), rays.size());
  std::size_t meeting = 0;
  for (std::size_t i = 0; i < rays.size() && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "ray " << i);
    expect_same(first[i], first_hit(surface, rays[i]));
    expect_same(first_hit(tree, rays[i]), first[i]);
    const auto truth = all_hits(surface, rays[i]);
    expect_same(all[i], truth);
    expect_same(all_hits(tree, rays[i]), truth);
    meeting += first[i] ? 1 : 0;
  }
  return meeting;
}

std::size_t expect_answers_of_the_surface(const Layout_view& surface, std::span<const Ray> rays) {
  return expect_answers_of_the_surface(Ray_tree(surface), rays);
}

/// Each block's faces and corners are those of the layout's leaves, each face once, and lie in the box of the child
/// that leads to them.
void expect_valid(const Ray_tree& tree, const Face_soup& soup) {
  std::vector<int> seen(soup.faces.size());
  std::vector<int> parents(tree.blocks().size() + tree.nodes().size());
  for (const auto& block : tree.blocks()) {
    ASSERT_GE(block.count, 1U);
    ASSERT_LE(block.count, ray_tree_width);
    for (std::size_t lane = 0; lane < block.count; ++lane) {
      ++seen[block.faces[lane]];
      for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(block.vertices[c][lane], soup.faces[block.faces[lane]][c]);
    }
    for (std::size_t lane = block.count; lane < ray_tree_width; ++lane)
      for (const auto& corner : block.corners)
        for (const auto& coordinates : corner) EXPECT_GT(coordinates[lane], 1e6F) << "rays could meet a face twice";
  }
  EXPECT_EQ(seen, std::vector<int>(soup.faces.size(), 1));
  for (const auto& node : tree.nodes())
    for (std::size_t i = 0; i < ray_tree_width; ++i) {
      if (node.sides[0][0][i] > node.sides[1][0][i]) continue;
      const std::uint32_t child = node.children[i] & ~is_ray_block;
      if (child == node.children[i]) {
        ++parents[tree.blocks().size() + child];
        continue;
      }
      ++parents[child];
      const auto& block = tree.blocks()[child];
      for (std::size_t lane = 0; lane < block.count; ++lane)
        for (std::size_t c = 0; c < 3; ++c)
          for (std::size_t axis = 0; axis < 3; ++axis) {
            EXPECT_LE(node.sides[0][axis][i], block.corners[c][axis][lane]);
            EXPECT_GE(node.sides[1][axis][i], block.corners[c][axis][lane]);
            EXPECT_NEAR(block.corners[c][axis][lane],
                        (soup.coordinates[3 * std::size_t{block.vertices[c][lane]} + axis] - tree.middle()[axis]) *
                            tree.scale(),
                        0x1p-24);
          }
    }
  ASSERT_FALSE(tree.nodes().empty());
  parents[tree.blocks().size()] += 1;  // the root has none
  EXPECT_EQ(parents, std::vector<int>(parents.size(), 1));
}

TEST(Ray_tree, has_every_face_in_one_block_below_boxes_that_enclose_it) {
  for (const auto& [name, soup] : small_objects())
    for (const std::size_t leaf_faces : {2, 7, 96, 128}) {
      SCOPED_TRACE(testing::Message() << name << ", leaves of " << leaf_faces);
      const Posed_object object(soup, leaf_faces);
      expect_valid(Ray_tree(object.view()), soup);
    }
  const Face_soup one(single_triangle());
  const Posed_object object(one);
  expect_valid(Ray_tree(object.view()), one);
}

TEST(Ray_tree, gives_rays_in_turns_the_answers_of_the_surface) {
  const auto rays = rays_at(400, 1);
  for (const auto& [name, soup] : small_objects()) {
    SCOPED_TRACE(name);
    const Posed_object object(soup, 96);
    EXPECT_GT(expect_answers_of_the_surface(object.view(), rays), 20U);
  }
  const Posed_object large{Face_soup(icosphere(40)), 96, false};
  EXPECT_GT(expect_answers_of_the_surface(large.view(), rays_at(2000, 2)), 500U);
}

TEST(Ray_tree, follows_the_surface_to_other_poses) {
  const auto rays = rays_at(300, 8);
  std::mt19937_64 random(9);
  for (const auto& [name, soup] : small_objects())
    for (const std::size_t leaf_faces : {7, 96}) {
      SCOPED_TRACE(testing::Message() << name << ", leaves of " << leaf_faces);
      Posed_object object(soup, leaf_faces);
      Ray_tree tree(object.view());
      for (const double size : {0.1, 1e9, 1.0}) {
        const Face_soup pose = crumpled(posed_at_random(placed(soup, size), 0.5 * size, random), 0.05 * size, 10);
        object.move_to(pose);
        tree.refit(object.view());
        expect_valid(tree, pose);
        if (size <= 1) expect_answers_of_the_surface(tree, rays);
      }
      EXPECT_GT(expect_answers_of_the_surface(tree, rays), 10U);
    }
}

TEST(Ray_tree, follows_the_positions_into_other_memory) {
  const Face_soup ball(icosphere(6));
  const Posed_object first(ball), second(crumpled(ball, 0.05, 13));
  Ray_tree tree(first.view());
  tree.refit(second.view());
  for (const Ray& ray : rays_at(100, 14)) expect_same(first_hit(tree, ray), first_hit(second.view(), ray));
}

TEST(Ray_tree, follows_a_surface_that_was_too_large_small_or_a_point) {
  const auto rays = rays_at(60, 11);
  const Face_soup ball(icosphere(4));
  for (const double size : {0.0, 0x1p-600, 0x1p600}) {
    SCOPED_TRACE(size);
    Posed_object object(placed(ball, size));
    Ray_tree tree(object.view());
    for (int time = 0; time < 2; ++time) {
      EXPECT_TRUE(tree.nodes().empty());
      expect_answers_of_the_surface(tree, rays);
      object.move_to(ball);
      tree.refit(object.view());
      expect_valid(tree, ball);
      EXPECT_GT(expect_answers_of_the_surface(tree, rays), 20U);
      object.move_to(placed(ball, size));
      tree.refit(object.view());
    }
  }
}

TEST(Ray_tree, does_not_follow_a_surface_of_other_faces) {
  const Posed_object ball(icosphere(4)), finer(icosphere(5));
  Ray_tree tree(ball.view());
  EXPECT_THROW(tree.refit(finer.view()), Bad_argument);
  EXPECT_GT(expect_answers_of_the_surface(tree, rays_at(60, 12)), 20U);
}

TEST(Ray_tree, does_not_follow_a_surface_of_other_vertices) {
  const Face_soup connected(icosphere(4));
  Face_soup loose;  // as many faces in the same places
  for (std::size_t face = 0; face < connected.faces.size(); ++face) {
    const std::uint32_t first = loose.vertex_count();
    loose.faces.push_back({first, first + 1, first + 2});
    for (const Point& p : connected.triangle(face))
      loose.coordinates.insert(loose.coordinates.end(), {p.x(), p.y(), p.z()});
  }
  const Posed_object ball(connected), other(loose);
  Ray_tree tree(ball.view());
  EXPECT_THROW(tree.refit(other.view()), Bad_argument);
  EXPECT_GT(expect_answers_of_the_surface(tree, rays_at(60, 12)), 20U);
}

TEST(Ray_tree, gives_the_same_answers_with_every_instruction_set) {
  const Posed_object object{Face_soup(potato(12)), 96};
  const auto rays = rays_at(300, 3);
  for_instruction_sets([&] {
    EXPECT_GT(expect_answers_of_the_surface(object.view(), rays), 50U);
    Ray_tree tree(object.view());
    tree.refit(object.view());
    EXPECT_GT(expect_answers_of_the_surface(tree, rays), 50U);
  });
}

TEST(Ray_tree, asks_the_surface_where_single_precision_is_not_enough) {
  const Face_soup ball(icosphere(4));
  const Posed_object object(ball);
  auto rays = rays_at(60, 4);
  for (std::size_t i = 0; i < rays.size(); i += 2) {
    const double distance = std::ldexp(1.0, 20 + static_cast<int>(i));
    rays[i].origin -= distance * rays[i].direction;  // beyond 2^24 times the size for most
    rays[i].length = std::numeric_limits<double>::infinity();
  }
  EXPECT_GT(expect_answers_of_the_surface(object.view(), rays), 10U);

  Face_soup point;
  point.coordinates = {1, 2, 3};
  point.faces = {{0, 0, 0}, {0, 0, 0}};
  const Posed_object dot(point, 16, false);
  EXPECT_TRUE(Ray_tree(dot.view()).nodes().empty());
  EXPECT_EQ(expect_answers_of_the_surface(dot.view(), std::vector<Ray>{{{0, 2, 3}, {1, 0, 0}}, {{0, 0, 0}}}), 1U);
  for (const double factor : {0x1p-600, 0x1p600}) {
    const Posed_object scaled(placed(ball, factor));
    std::vector<Ray> scaled_rays = rays_at(40, 5);
    for (Ray& ray : scaled_rays) ray.origin *= factor;
    EXPECT_TRUE(Ray_tree(scaled.view()).nodes().empty());
    EXPECT_GT(expect_answers_of_the_surface(scaled.view(), scaled_rays), 5U);
  }
}

TEST(Ray_tree, asks_the_surface_where_most_leaves_are_small_beside_the_whole) {
  const auto rays = rays_at(60, 12);
  const Face_soup near = joined(Face_soup(icosphere(20)), moved(Face_soup(single_triangle()), 2, 0, 0));
  Face_soup far = near;
  far.coordinates[far.coordinates.size() - 1] += 1e7;
  Posed_object object(near);
  Ray_tree tree(object.view());
  EXPECT_FALSE(tree.nodes().empty());
  object.move_to(far);
  tree.refit(object.view());
  EXPECT_TRUE(tree.nodes().empty());
  EXPECT_TRUE(Ray_tree(object.view()).nodes().empty());
  EXPECT_GT(expect_answers_of_the_surface(tree, rays), 20U);
  object.move_to(near);
  tree.refit(object.view());
  expect_valid(tree, near);
}

TEST(Ray_tree, is_complete_far_from_the_origin_where_its_middle_is_rounded) {
  for (const double factor : {0.999, 0.5001, 0.7})
    for (const double offset : {0x1p40, 0x1p46, 0x1p51}) {
      const Face_soup ball = placed(icosphere(4), factor, offset);
      const Posed_object object(ball, 16, false);
      std::vector<Ray> rays;
      std::mt19937_64 random(10);
      std::uniform_real_distribution<double> unit(-3, 3);
      for (std::size_t i = 0; i < 300; ++i) {
        const Point p = ball.point(static_cast<std::uint32_t>(random() % ball.vertex_count()));
        const Eigen::Vector3d way(unit(random), unit(random), unit(random));
        rays.push_back({Eigen::Vector3d(p.x(), p.y(), p.z()) - 4 * way, way});
      }
      SCOPED_TRACE(testing::Message() << factor << ' ' << offset);
      EXPECT_GT(expect_answers_of_the_surface(object.view(), rays), 50U);
    }
}

TEST(Ray_tree, is_complete_for_rays_from_far_away_that_are_nearly_orthogonal_to_an_axis) {
  const Face_soup ball(icosphere(6));
  const Posed_object object(ball, 96, false);
  std::vector<Ray> rays;
  std::mt19937_64 random(11);
  for (int i = 0; i < 600; ++i) {
    const Point p = ball.point(static_cast<std::uint32_t>(random() % ball.vertex_count()));
    Eigen::Vector3d way = Eigen::Vector3d::Unit(i % 3) * (i % 2 == 0 ? 1 : -1);
    way[(i + 1) % 3] = i % 5 == 0 ? 0 : std::ldexp(1.0, -30 - i % 40);
    rays.push_back({Eigen::Vector3d(p.x(), p.y(), p.z()) - std::ldexp(1.0, i % 30) * way, way});
  }
  EXPECT_GT(expect_answers_of_the_surface(object.view(), rays), 300U);
}

/// Rays a little beside a vertex, within and beyond what single precision can tell apart.
TEST(Ray_tree, keeps_faces_that_rays_meet_at_their_very_edge) {
  const Face_soup ball(icosphere(6));
  const Posed_object object(ball, 96, false);
  std::vector<Ray> rays;
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 600; ++i) {
    const Triangle t = ball.triangle(random() % ball.faces.size());
    const double part = unit(random) / 2 + 0.5, beside = std::ldexp(unit(random), -(i % 60));
    Eigen::Vector3d on_edge;
    for (int axis = 0; axis < 3; ++axis) on_edge[axis] = t[0][axis] + part * (t[1][axis] - t[0][axis]);
    const Eigen::Vector3d origin(3 * unit(random), 3 * unit(random), 3 * unit(random));
    rays.push_back({origin, on_edge + Eigen::Vector3d::Constant(beside) - origin});
  }
  EXPECT_GT(expect_answers_of_the_surface(object.view(), rays), 300U);
}

TEST(Ray_tree, does_not_depend_on_the_number_of_workers) {
  const Posed_object object{Face_soup(icosphere(30)), 96, false};
  const auto rays = rays_at(1000, 7);
  const auto alone = first_hits(Ray_tree(object.view()), rays);
  for (const std::size_t threads : {2, 5}) {
    Workers workers(threads);
    const Ray_tree tree(object.view(), workers);
    const auto shared = first_hits(tree, rays, workers);
    const auto all = all_hits(tree, rays, workers);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      expect_same(shared[i], alone[i]);
      expect_same(all[i].empty() ? std::nullopt : std::optional(all[i].front()), alone[i]);
    }
  }
}

TEST(Ray_tree, few_and_many_rays_get_the_same_answers) {
  const Face_soup ball(icosphere(8));
  const Posed_object object(ball, 96, false);
  const auto rays = rays_at(2 * ball.faces.size() / 8, 8);
  const auto many = first_hits(object.view(), rays);
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, ball.faces.size() / 8, ball.faces.size() / 8 + 1}) {
    const auto few = first_hits(object.view(), std::span(rays).first(count));
    ASSERT_EQ(few.size(), count);
    for (std::size_t i = 0; i < count; ++i) expect_same(few[i], many[i]);
  }
}

TEST(Ray_tree, refuses_what_is_no_ray) {
  const Posed_object object{Face_soup(cube(2))};
  const Ray_tree tree(object.view());
  auto rays = rays_at(20, 9);
  rays[13].direction.setZero();
  EXPECT_THROW(first_hits(tree, rays), Bad_argument);
  EXPECT_THROW(all_hits(tree, rays), Bad_argument);
  EXPECT_THROW(first_hits(object.view(), rays), Bad_argument);
  EXPECT_TRUE(first_hits(tree, {}).empty());
}

}  // namespace
}  // namespace lodestone
