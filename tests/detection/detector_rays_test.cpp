// SPDX-License-Identifier: GPL-3.0-or-later
// Many rays, frame after frame: the tree that a detector keeps for them.
#include <CGAL/boost/graph/Euler_operations.h>
#include <gtest/gtest.h>

#include <random>

#include "lodestone/io/shapes/shapes.h"
#include "support/exact_truth.h"
#include "support/message_of.h"

namespace lodestone {
namespace {

std::vector<Ray> rays_around(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> number(-1.5, 1.5);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i)
    rays.push_back({.origin = {number(random), number(random), number(random)},
                    .direction = {number(random), number(random), number(random)}});
  return rays;
}

/// Many rays, few, and one by one have the answers of a detector that never saw another pose.
void expect_answers_of_a_fresh_detector(Exact_detector& detector, const Surface_mesh& mesh) {
  Exact_detector fresh;
  fresh.add(mesh);
  const auto rays = rays_around(mesh.number_of_faces() / 8, 1);
  const auto same = [](const std::optional<Ray_hit>& a, const std::optional<Ray_hit>& b) {
    return a.has_value() == b.has_value() && (!a || (a->face == b->face && a->t == b->t));
  };
  std::size_t met = 0;
  for (const std::size_t count : {rays.size(), rays.size() / 4, std::size_t{3}}) {
    const auto hits = detector.first_hits(0, std::span(rays).first(count));
    ASSERT_EQ(hits.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto truth = fresh.first_hit(0, rays[i]);
      EXPECT_TRUE(same(hits[i], truth)) << i << " of " << count;
      met += truth ? 1 : 0;
    }
  }
  EXPECT_GT(met, rays.size() / 3);
  const Ray_tree& tree = detector.ray_tree(0);
  for (const Ray& ray : rays) EXPECT_TRUE(same(first_hit(tree, ray), fresh.first_hit(0, ray)));
}

TEST(Detector_rays, follow_the_positions) {
  auto mesh = potato(10);
  Exact_detector detector;
  detector.add(mesh);
  for (int frame = 0; frame < 3; ++frame) {
    expect_answers_of_a_fresh_detector(detector, mesh);
    deform(mesh, [](const Point& p) { return Point(p.x() + 0.2 * std::sin(3 * p.y()), p.y(), 1.1 * p.z()); });
  }
}

TEST(Detector_rays, follow_a_tree_that_is_built_anew_since_it_was_loose) {
  auto mesh = sphere(10);
  Exact_detector detector({.exact = {.loosest = 1.2}, .tree = {.leaf_faces = 8}});
  detector.add(mesh);
  expect_answers_of_a_fresh_detector(detector, mesh);
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> number(-1, 1);
  deform(mesh, [&](const Point&) { return Point(number(random), number(random), number(random)); });
  EXPECT_EQ(detector.detect().statistics.repartitions, 1U);
  expect_answers_of_a_fresh_detector(detector, mesh);
}

TEST(Detector_rays, follow_a_change_of_faces) {
  auto mesh = potato(10);
  Exact_detector detector;
  detector.add(mesh);
  expect_answers_of_a_fresh_detector(detector, mesh);
  // As many faces and vertices as before.
  std::vector<std::uint32_t> changed;
  for (std::uint32_t edge = 0; edge < 900; edge += 60) {
    const auto h = mesh.halfedge(CGAL::SM_Edge_index(edge));
    if (mesh.halfedge(mesh.target(mesh.next(h)), mesh.target(mesh.next(mesh.opposite(h)))).is_valid()) continue;
    changed.push_back(mesh.face(h));
    changed.push_back(mesh.face(mesh.opposite(h)));
    CGAL::Euler::flip_edge(h, mesh);
  }
  ASSERT_GT(changed.size(), 4U);
  detector.rebuild(0, Changed_faces{changed});
  expect_answers_of_a_fresh_detector(detector, mesh);
  detector.rebuild(0);
  expect_answers_of_a_fresh_detector(detector, mesh);
}

TEST(Detector_rays, need_an_object_and_a_mode_with_trees) {
  const auto mesh = sphere(4);
  Exact_detector detector;
  detector.add(mesh);
  EXPECT_THROW(detector.ray_tree(1), Bad_argument);
  detector.ray_tree(0);
  detector.remove(0);
  EXPECT_THROW(detector.ray_tree(0), Bad_argument);
  Detector<> particles({.mode = Mode::particles});
  particles.add(mesh);
  EXPECT_THROW(particles.ray_tree(0), Bad_argument);
  const Ray ray{.origin = {-3, 0, 0}, .direction = {1, 0, 0}};
  const Object_id ids[] = {0};
  const auto refusal = [](const auto& ask) { return message_of<Bad_argument>(ask).substr(0, 16); };
  EXPECT_EQ(refusal([&] { particles.first_hit(0, ray); }), "first_hit needs ");
  EXPECT_EQ(refusal([&] { particles.first_hit(ray); }), "first_hit needs ");
  EXPECT_EQ(refusal([&] { particles.first_hit(ids, ray); }), "first_hit needs ");
  EXPECT_EQ(refusal([&] { particles.first_hits(ids, {&ray, 1}); }), "first_hits needs");
}

}  // namespace
}  // namespace lodestone
