// SPDX-License-Identifier: GPL-3.0-or-later
// Rays and points in mode certified.
#include "detection/certified_scene.h"
#include "lodestone/bounds/displacement_bound.h"

namespace lodestone {
namespace {

TEST(Certified, rays_and_points_have_the_answers_of_mode_exact) {
  Certified_scene scene;
  Detector certified(in_mode(Mode::certified, {})), exact(in_mode(Mode::exact, {}));
  scene.add_to(certified);
  scene.add_to(exact);
  std::size_t hits = 0, inside = 0;
  const auto same = [](const Ray_hit& a, const Ray_hit& b) { return a.face == b.face && a.t == b.t; };
  for (int frame = 0; frame < 6; ++frame) {
    scene.pose(frame);
    for (Object_id object = 0; object < 4; ++object) {
      for (int i = 0; i < 12; ++i) {
        const Ray ray{.origin = {3 * std::cos(i), 3 * std::sin(i), 0.3 * i},
                      .direction = {-std::cos(i), -std::sin(i) + 0.05 * i, -0.12 * i}};
        const auto hit = certified.first_hit(object, ray), true_hit = exact.first_hit(object, ray);
        ASSERT_EQ(hit.has_value(), true_hit.has_value());
        if (!hit) continue;
        ++hits;
        EXPECT_TRUE(same(*hit, *true_hit));
        EXPECT_TRUE(std::ranges::equal(certified.all_hits(object, ray), exact.all_hits(object, ray), same));
        const Point beyond(hit->point.x() - 0.1 * std::cos(i), hit->point.y() - 0.1 * std::sin(i), hit->point.z());
        const Point_side side = certified.point_side(object, beyond);
        EXPECT_EQ(side, exact.point_side(object, beyond));
        inside += side == Point_side::inside ? 1 : 0;
        EXPECT_EQ(certified.closest_point(object, beyond).face, exact.closest_point(object, beyond).face);
        EXPECT_EQ(certified.closest_point(object, beyond).distance, exact.closest_point(object, beyond).distance);
      }
      const Ray through{.origin = {3, 0.1, 0.2}, .direction = {-1, 0, 0}};
      const auto hit = first_hit(certified.ray_tree(object), through), true_hit = exact.first_hit(object, through);
      ASSERT_EQ(hit.has_value(), true_hit.has_value());
      if (hit) {
        EXPECT_TRUE(same(*hit, *true_hit));
      }
    }
  }
  EXPECT_GT(hits, 100U);
  EXPECT_GT(inside, 30U);
}

TEST(Certified, a_ray_poses_only_what_it_passes) {
  Surface_mesh mesh = long_body(40, 1);
  Skinned_points points = limb(mesh);
  Detector detector({.mode = Mode::certified});
  detector.add(mesh, point_map(mesh, points));
  detector.detect();
  bend(points, 0.4, {0, 0, 0});
  EXPECT_TRUE(detector.first_hit(0, {.origin = {0.3, 9, 0.1}, .direction = {0, -1, 0}}).has_value());
  EXPECT_GT(detector.bounded(0)->vertices_posed(), 0U);
  EXPECT_LT(detector.bounded(0)->vertices_posed(), mesh.number_of_vertices() / 8);
  EXPECT_FALSE(detector.first_hit(0, {.origin = {0, 9, 0}, .direction = {0, 1, 0}}).has_value());
  EXPECT_THROW(detector.first_hit(0, {.direction = {0, 0, 0}}), Bad_argument);
  EXPECT_THROW(detector.first_hit(1, {}), Bad_argument);
  EXPECT_THROW(Detector<>({.mode = Mode::particles}).point_side(0, Point(0, 0, 0)), Bad_argument);
}

TEST(Certified, many_rays_or_points_pose_all_and_have_the_answers_of_mode_exact) {
  Surface_mesh mesh = long_body(20, 1);
  Skinned_points points = limb(mesh);
  Detector certified({.mode = Mode::certified}), exact({.mode = Mode::exact});
  for (auto* detector : {&certified, &exact}) detector->add(mesh, point_map(mesh, points));
  std::vector<Ray> rays;
  std::vector<Point> places;
  for (std::size_t i = 0; i <= mesh.number_of_faces() / 16; ++i) {
    const double t = static_cast<double>(i);
    rays.push_back({.origin = {2.5 * std::sin(t), 9, 0.5 * std::cos(3 * t)}, .direction = {0, -1, 0}});
    places.emplace_back(2.5 * std::sin(t), std::cos(2 * t), 0.5 * std::cos(3 * t));
  }
  std::size_t hits = 0;
  for (int frame = 1; frame < 4; ++frame) {
    bend(points, 0.2 * frame, {0, 0, 0});
    const auto found = certified.first_hits(0, rays), truth = exact.first_hits(0, rays);
    EXPECT_TRUE(certified.bounded(0)->all_posed());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ASSERT_EQ(found[i].has_value(), truth[i].has_value());
      if (!found[i]) continue;
      ++hits;
      EXPECT_EQ(found[i]->face, truth[i]->face);
      EXPECT_EQ(found[i]->t, truth[i]->t);
    }
    bend(points, 0.2 * frame + 0.1, {0, 0, 0});
    EXPECT_EQ(certified.point_sides(0, places), exact.point_sides(0, places));
    EXPECT_TRUE(certified.bounded(0)->all_posed());
    bend(points, 0.2 * frame + 0.15, {0, 0, 0});
    certified.first_hits(0, std::span(rays).first(1));
    EXPECT_FALSE(certified.bounded(0)->all_posed());
  }
  EXPECT_GT(hits, 30U);
}

/// A ball that has promised to stand still, and of which the part with the largest x has moved far up. Who asks up
/// there does not notice; who asks beside the ball does.
struct Broken_promise {
  Surface_mesh ball = icosphere(16), other = icosphere(4);
  Displacement_promise nothing_moves;
  Detector<> certified{in_mode(Mode::certified, {})}, exact{in_mode(Mode::exact, {})};
  const std::vector<Ray> rays{{.origin = {0.275, 9, 5}, .direction = {0, -1, 0}},
                              {.origin = {5, 0.01, 0.02}, .direction = {-1, 0, 0}}};
  const std::vector<Point> points{Point(0.275, 0, 5), Point(0.97, 0.01, 0.02)};

  Broken_promise() {
    shift(other, -9);
    for (Detector<>* detector : {&certified, &exact}) {
      detector->add(std::as_const(ball));
      detector->add(std::as_const(other));
    }
    certified.promise(0, nothing_moves);
    certified.detect();
    for (Point& p : ball.points())
      if (p.x() > 0.9) p = Point(p.x() - 1, p.y(), p.z() + 8);
  }
  ~Broken_promise() { EXPECT_GT(certified.bounded(0)->violations(), 0U); }
};

TEST(Certified, all_rays_are_asked_anew_once_a_broken_bound_is_noticed) {
  Broken_promise of;
  const auto found = of.certified.first_hits(0, of.rays), truth = of.exact.first_hits(0, of.rays);
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_TRUE(truth[i] && found[i]) << i;
    EXPECT_EQ(found[i]->face, truth[i]->face);
  }
}

TEST(Certified, all_rays_among_objects_are_asked_anew_once_a_broken_bound_is_noticed) {
  Broken_promise of;
  const auto found = of.certified.first_hits(of.rays), truth = of.exact.first_hits(of.rays);
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_TRUE(truth[i] && found[i]) << i;
    EXPECT_EQ(found[i]->object, truth[i]->object);
    EXPECT_EQ(found[i]->hit.face, truth[i]->hit.face);
  }
}

TEST(Certified, all_points_are_asked_anew_once_a_broken_bound_is_noticed) {
  Broken_promise of_closest, of_sides;
  const auto found = of_closest.certified.closest_points(0, of_closest.points);
  const auto truth = of_closest.exact.closest_points(0, of_closest.points);
  EXPECT_LT(truth[0].distance, 1);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(found[i].distance, truth[i].distance);
  const auto sides = of_sides.exact.point_sides(0, of_sides.points);
  EXPECT_EQ(sides[0], Point_side::inside);
  EXPECT_EQ(of_sides.certified.point_sides(0, of_sides.points), sides);
}

}  // namespace
}  // namespace lodestone
