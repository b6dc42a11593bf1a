// SPDX-License-Identifier: GPL-3.0-or-later
// The mode exact gives the same bytes for any number of threads.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "lodestone/io/shapes/shapes.h"
#include "support/exact_truth.h"

namespace lodestone {
namespace {

/// Frames of a scene that gives work to several threads: large trees, many objects, collisions within objects.
std::vector<Frame> frames(Detector_options options, std::size_t threads) {
  // Points take longer to construct than all the rest.
  const int parts = options.contact_points ? 8 : 36;
  std::deque<Surface_mesh> owned{
      sphere(parts), potato(parts, 2),
      torus_knot({.tube = 0.5, .segments = 8 * static_cast<std::size_t>(parts), .sides = 10})};
  for (int i = 0; i < 5; ++i) owned.push_back(sphere(6, 0.4, {std::cos(1.0 * i), std::sin(1.0 * i), 0.1 * i}));
  options.mode = Mode::exact;
  options.threads = threads;
  options.exact.self_collision = true;
  options.exact.containment = true;
  options.exact.parting = true;
  Exact_detector detector(options);
  add_all(detector, all_of(owned));
  std::vector<Frame> result;
  for (int frame = 0; frame < 3; ++frame) {
    result.push_back(detector.detect());
    shift(owned[0], 0.11, -0.07);
    crumple(owned[2], 0.003, 1);
  }
  result.push_back(detector.detect(2, 2));
  result.push_back(detector.detect(1, 0));
  return result;
}

void expect_the_same_for_any_number_of_threads(const Detector_options& options) {
  const auto expected = frames(options, 1);
  for (const auto& frame : expected) EXPECT_TRUE(frame.collides());
  for (const std::size_t threads : {2, 3, 5, 0}) {
    const auto found = frames(options, threads);
    for (std::size_t i = 0; i < expected.size(); ++i) expect_same_frame(found[i], expected[i]);
  }
}

TEST(Exact_threads, all_contacts_do_not_depend_on_their_number) { expect_the_same_for_any_number_of_threads({}); }

TEST(Exact_threads, points_and_normals_do_not_depend_on_their_number) {
  expect_the_same_for_any_number_of_threads({.contact_points = true, .contact_normals = true, .most_contacts = 50});
}

TEST(Exact_threads, contact_patches_do_not_depend_on_their_number) {
  expect_the_same_for_any_number_of_threads({.contact_points = true, .exact = {.patches = true}});
}

TEST(Exact_threads, yes_or_no_does_not_depend_on_their_number) {
  expect_the_same_for_any_number_of_threads({.contacts = Contact_query::yes_no});
}

TEST(Exact_threads, the_first_contact_does_not_depend_on_their_number) {
  expect_the_same_for_any_number_of_threads({.contacts = Contact_query::first});
}

/// Two slanted cloths, one above the other: the boxes of many leaves overlap, and faces intersect at one corner only.
TEST(Exact_threads, a_first_contact_that_is_met_late_does_not_depend_on_their_number) {
  const auto low_end = [](double x, double y) { return x < 0.3 && y < 0.3; };
  const auto high_end = [](double x, double y) { return x > 0.7 && y > 0.7; };
  const std::vector<std::function<bool(double, double)>> ends{low_end, high_end};
  std::size_t most_looked_at = 0;
  for (const auto& dips : ends)
    for (const auto query : {Contact_query::yes_no, Contact_query::first}) {
      auto low = cloth(60, 60), high = cloth(60, 60);
      deform(low, [](const Point& p) { return Point(p.x(), p.y(), p.x()); });
      deform(high, [&](const Point& p) { return Point(p.x(), p.y(), p.x() + (dips(p.x(), p.y()) ? -0.01 : 0.02)); });
      std::vector<Frame> found;
      for (const std::size_t threads : {1, 2, 3, 0}) {
        Exact_detector detector(
            {.mode = Mode::exact, .contacts = query, .threads = threads, .tree = {.leaf_faces = 8}});
        add_all(detector, {&low, &high});
        found.push_back(detector.detect());
        EXPECT_TRUE(found.back().collides());
        expect_same_frame(found.back(), found.front());
      }
      most_looked_at = std::max(most_looked_at, found.front().statistics.leaf_tests);
    }
  EXPECT_GT(most_looked_at, 1000U);  // far more than one thread looks at before it wakes others
}

TEST(Exact_threads, capped_contacts_do_not_depend_on_their_number) {
  for (const std::size_t most : {1, 7, 100}) expect_the_same_for_any_number_of_threads({.most_contacts = most});
}

TEST(Exact_threads, near_faces_do_not_depend_on_their_number) {
  expect_the_same_for_any_number_of_threads({.exact = {.tolerance = 0.01}, .tree = {.leaf_faces = 8}});
}

TEST(Exact_threads, any_number_may_be_allowed_and_nothing_is_printed) {
  const auto a = sphere(20), b = sphere(20, 1, {1.5, 0, 0});
  const auto truth = exhaustive_face_pairs(a, b);
  testing::internal::CaptureStderr();
  for (const std::size_t threads : {std::size_t{64}, std::size_t{1} << 31, std::numeric_limits<std::size_t>::max()}) {
    Exact_detector detector({.mode = Mode::exact, .threads = threads});
    add_all(detector, {&a, &b});
    expect_contacts(detector.detect(), 0, 1, truth);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Exact_threads, closest_faces_and_containment_do_not_depend_on_their_number) {
  std::vector<Closest_faces> expected;
  for (const std::size_t threads : {1, 2, 3, 5, 0}) {
    const auto a = sphere(20), b = potato(20), c = sphere(9, 0.25);
    Exact_detector detector({.mode = Mode::exact, .threads = threads});
    add_all(detector, {&a, &b, &c});
    std::vector<Closest_faces> found{detector.closest(0, 1), detector.closest(0, 2), detector.closest(2, 1)};
    EXPECT_TRUE(detector.contains(0, 2));
    if (expected.empty()) expected = found;
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].faces, expected[i].faces);
      EXPECT_EQ(found[i].points.distance, expected[i].points.distance);
      EXPECT_EQ(found[i].points.a, expected[i].points.a);
    }
  }
}

/// Rays and points around the object, spread as evenly as a lattice of golden ratios does.
std::vector<Ray> rays_around(std::size_t count) {
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const double at = 0.618 * static_cast<double>(i), up = std::fmod(0.3247 * static_cast<double>(i), 2.0) - 1;
    const Eigen::Vector3d origin(2 * std::cos(at), 2 * std::sin(at), up);
    const Eigen::Vector3d inwards = Eigen::Vector3d(up, 0.2, -0.1) - origin;
    rays.push_back({origin, i % 7 == 0 ? Eigen::Vector3d(-inwards) : inwards});
  }
  return rays;
}

std::vector<Point> points_around(std::span<const Ray> rays) {
  std::vector<Point> points;
  for (const Ray& ray : rays) {
    const Eigen::Vector3d at = ray.origin + 0.4 * ray.direction;
    points.emplace_back(at.x(), at.y(), at.z());
  }
  return points;
}

TEST(Exact_threads, rays_and_points_get_the_answers_that_each_of_them_gets_alone) {
  const auto mesh = potato(24);
  for (const std::size_t count : {0, 1, 31, 32, 33, 700, 1600}) {  // the last make a Ray_tree
    const auto rays = rays_around(count);
    const auto points = points_around(rays);
    for (const std::size_t threads : {1, 2, 3, 5, 0}) {
      Exact_detector detector({.mode = Mode::exact, .threads = threads});
      detector.add(mesh);
      const auto hits = detector.first_hits(0, rays);
      const auto nearest = detector.closest_points(0, points);
      const auto sides = detector.point_sides(0, points);
      ASSERT_EQ(hits.size(), count);
      ASSERT_EQ(nearest.size(), count);
      ASSERT_EQ(sides.size(), count);
      std::size_t hit_count = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const auto hit = detector.first_hit(0, rays[i]);
        ASSERT_EQ(hits[i].has_value(), hit.has_value());
        if (hit) {
          ++hit_count;
          EXPECT_EQ(hits[i]->face, hit->face);
          EXPECT_EQ(hits[i]->t, hit->t);
          EXPECT_EQ(hits[i]->point, hit->point);
        }
        const auto closest = detector.closest_point(0, points[i]);
        EXPECT_EQ(nearest[i].face, closest.face);
        EXPECT_EQ(nearest[i].point, closest.point);
        EXPECT_EQ(nearest[i].distance, closest.distance);
        EXPECT_EQ(sides[i], detector.point_side(0, points[i]));
      }
      if (count > 100) {
        EXPECT_GT(hit_count, count / 10);
        EXPECT_LT(hit_count, count);
        EXPECT_EQ(std::set(sides.begin(), sides.end()).size(), 2U);
      }
    }
  }
}

TEST(Exact_threads, the_first_of_the_rays_that_are_wrong_is_told) {
  auto rays = rays_around(500);
  rays[300].length = -1;
  rays[301].origin.x() = std::nan("");
  for (const std::size_t threads : {1, 2, 5}) {
    Exact_detector detector({.mode = Mode::exact, .threads = threads});
    const auto mesh = potato(12);
    detector.add(mesh);
    const auto told = [&] {
      try {
        detector.first_hits(0, rays);
      } catch (const Bad_argument& error) {
        return std::string(error.what());
      }
      return std::string();
    };
    EXPECT_NE(told().find("the length of a ray must be 0 or more"), std::string::npos);
    EXPECT_EQ(detector.first_hits(0, std::span(rays).first(300)).size(), 300U);
  }
}

}  // namespace
}  // namespace lodestone
