// SPDX-License-Identifier: GPL-3.0-or-later
// Impacts between frames, asked of a detector. The search itself is tested in queries/impact_search_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <vector>

#include "lodestone/bounds/displacement_bound.h"
#include "lodestone/detector.h"
#include "lodestone/find_first_impact.h"
#include "lodestone/io/shapes/shapes.h"
#include "lodestone/mesh/errors.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

using Exact_detector = Detector<>;

/// A sphere with its positions now and some time later.
struct Moving_ball {
  Surface_mesh mesh = icosphere(4);
  Positions end;

  Moving_ball(const Eigen::RowVector3d& from, const Eigen::RowVector3d& to) {
    end = Numbered_mesh(mesh).positions.rowwise() + to;
    for (const auto v : mesh.vertices()) {
      const Point& p = mesh.point(v);
      mesh.point(v) = Point(p.x() + from.x(), p.y() + from.y(), p.z() + from.z());
    }
  }
  /// As a property map of the mesh.
  auto end_points() {
    auto map = mesh.add_property_map<Surface_mesh::Vertex_index, Point>("v:end").first;
    for (const auto v : mesh.vertices()) {
      const auto row = end.row(static_cast<Eigen::Index>(v.idx()));
      map[v] = Point(row.x(), row.y(), row.z());
    }
    return map;
  }
};

void expect_same(const std::optional<Impact>& a, const std::optional<Impact>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (!a) return;
  EXPECT_EQ(a->time, b->time);
  EXPECT_EQ(a->faces, b->faces);
  EXPECT_EQ(a->point, b->point);
}

TEST(Detector_first_impact, is_that_of_one_call) {
  Moving_ball a({-3, 0, 0}, {3, 0.25, 0}), b({3, 0.1, 0}, {-3, 0, 0.3}), beside({0, 9, 0}, {1, 9, 0});
  Exact_detector detector;
  const auto id_a = detector.add(a.mesh), id_b = detector.add(b.mesh), id_beside = detector.add(beside.mesh);
  const auto impact = detector.first_impact(id_a, a.end, id_b, b.end);
  ASSERT_TRUE(impact);
  EXPECT_NEAR(impact->time, 1.0 / 3, 0.05);
  expect_same(impact, find_first_impact(a.mesh, a.end_points(), b.mesh, b.end_points()));
  EXPECT_FALSE(detector.first_impact(id_a, a.end, id_beside, beside.end));
  const auto swapped = detector.first_impact(id_b, b.end, id_a, a.end);
  ASSERT_TRUE(swapped);
  EXPECT_EQ(swapped->time, impact->time);
}

TEST(Detector_first_impact, of_one_object_is_that_of_one_call) {
  Moving_ball ball({0, 0, 0}, {0, 0, 0});
  ball.end.col(0) *= -1;  // turned inside out
  Exact_detector detector;
  const auto id = detector.add(ball.mesh);
  const auto impact = detector.first_self_impact(id, ball.end);
  ASSERT_TRUE(impact);
  expect_same(impact, find_first_self_impact(ball.mesh, ball.end_points()));
  EXPECT_FALSE(detector.first_self_impact(id, Numbered_mesh(ball.mesh).positions));
  EXPECT_THROW(detector.first_self_impact(id + 1, ball.end), Bad_argument);
  EXPECT_THROW(detector.first_self_impact(id, ball.end.topRows(3)), Bad_mesh);
  ball.end(0, 0) = std::nan("");
  EXPECT_THROW(detector.first_self_impact(id, ball.end), Bad_mesh);
}

TEST(Detector_first_impact, starts_where_the_vertices_are_now) {
  Moving_ball a({-3, 0, 0}, {3, 0, 0}), b({3, 0.1, 0}, {-3, 0, 0.3}), near({-1.5, 0, 0}, {3, 0, 0});
  Exact_detector detector;
  detector.add(a.mesh), detector.add(b.mesh), detector.add(near.mesh);
  const auto truth = detector.first_impact(2, near.end, 1, b.end);
  detector.place(0, Eigen::Isometry3d(Eigen::Translation3d(1.5, 0, 0)));
  expect_same(detector.first_impact(0, near.end, 1, b.end), truth);
  detector.place(0, Eigen::Isometry3d::Identity());
  detector.update(0, Numbered_mesh(near.mesh).positions);
  expect_same(detector.first_impact(0, near.end, 1, b.end), truth);
  for (const auto v : a.mesh.vertices()) a.mesh.point(v) = near.mesh.point(v);
  detector.update(0);
  expect_same(detector.first_impact(0, near.end, 1, b.end), truth);
}

TEST(Detector_first_impact, in_mode_certified_reads_all_of_both) {
  Moving_ball a({-3, 0, 0}, {3, 0.25, 0}), b({3, 0.1, 0}, {-3, 0, 0.3});
  Exact_detector exact, certified({.mode = Mode::certified});
  exact.add(a.mesh), exact.add(b.mesh);
  certified.add(a.mesh), certified.add(b.mesh);
  Displacement_promise still;
  certified.promise(0, still);
  certified.detect();
  expect_same(certified.first_impact(0, a.end, 1, b.end), exact.first_impact(0, a.end, 1, b.end));
}

/// Four balls in a row; the outer ones move inwards, the first faster than the last.
struct Row_of_balls {
  std::deque<Moving_ball> balls;
  std::vector<Positions> ends;

  Row_of_balls() {
    balls.emplace_back(Eigen::RowVector3d(-6, 0, 0), Eigen::RowVector3d(0.5, 0, 0));
    balls.emplace_back(Eigen::RowVector3d(-2, 0, 0), Eigen::RowVector3d(-2, 0, 0));
    balls.emplace_back(Eigen::RowVector3d(2, 0, 0), Eigen::RowVector3d(2, 0, 0));
    balls.emplace_back(Eigen::RowVector3d(6, 0, 0), Eigen::RowVector3d(3, 0, 0));
    for (const Moving_ball& ball : balls) ends.push_back(ball.end);
  }
};

TEST(Detector_first_impact, of_all_objects_is_the_earliest_of_those_that_may_collide) {
  for (const std::size_t threads : {1, 2, 5}) {
    Row_of_balls row;
    Exact_detector detector({.threads = threads});
    for (auto& ball : row.balls) detector.add(ball.mesh);
    const auto all = detector.first_impact(row.ends);
    ASSERT_TRUE(all);
    EXPECT_EQ(all->objects, (Object_pair{0, 1}));
    expect_same(all->impact, detector.first_impact(0, row.ends[0], 1, row.ends[1]));
    detector.ignore(1, 0);
    const auto other = detector.first_impact(row.ends);
    ASSERT_TRUE(other);
    EXPECT_EQ(other->objects, (Object_pair{2, 3}));
    EXPECT_GT(other->impact.exact_time, all->impact.exact_time);
    detector.remove(3);
    const auto last = detector.first_impact(row.ends);
    ASSERT_TRUE(last);
    EXPECT_EQ(last->objects, (Object_pair{0, 2}));  // the first ball passes the second
    row.ends[0].resize(0, 3);                       // stays where it is
    EXPECT_FALSE(detector.first_impact(row.ends));
  }
}

TEST(Detector_first_impact, of_each_pair_is_that_of_the_pair_alone) {
  for (const std::size_t threads : {1, 2, 5})
    for (const bool self : {false, true}) {
      Row_of_balls row;
      row.ends[1].col(0) *= -1;  // turned inside out on the way
      Exact_detector detector({.exact = {.self_collision = self}, .threads = threads});
      for (auto& ball : row.balls) detector.add(ball.mesh);
      detector.ignore(2, 3);
      const auto expect_all = [&](Object_id objects) {
        std::vector<Object_impact> expected;
        for (Object_id a = 0; a < objects; ++a)
          for (Object_id b = a; b < objects; ++b) {
            if ((a == b && !self) || (a == 2 && b == 3)) continue;
            const auto impact = a == b ? detector.first_self_impact(a, row.ends[a])
                                       : detector.first_impact(a, row.ends[a], b, row.ends[b]);
            if (impact) expected.push_back({{a, b}, *impact});
          }
        const auto all = detector.first_impacts(row.ends);
        ASSERT_EQ(all.size(), expected.size());
        for (std::size_t i = 0; i < all.size(); ++i) {
          EXPECT_EQ(all[i].objects, expected[i].objects);
          expect_same(all[i].impact, expected[i].impact);
        }
        // The earliest of them, the first of equals.
        const auto earliest = std::ranges::min_element(expected, [](const auto& one, const auto& other) {
          return one.impact.exact_time < other.impact.exact_time;
        });
        const auto found = detector.first_impact(row.ends);
        ASSERT_TRUE(found);
        EXPECT_EQ(found->objects, earliest->objects);
        expect_same(found->impact, earliest->impact);
        EXPECT_GE(all.size(), self ? 2U : 1U);
      };
      expect_all(4);
      detector.remove(3);
      expect_all(3);
      EXPECT_THROW(detector.first_impacts(std::span(row.ends).first(3)), Bad_argument);
    }
}

TEST(Detector_first_impact, of_several_pairs_at_the_same_time_is_that_of_the_lowest_ids) {
  Row_of_balls row;
  row.balls[3] = Moving_ball({6, 0, 0}, {0, 0, 0});
  // The mirror image, so that both pairs meet at exactly the same time.
  for (const auto v : row.balls[3].mesh.vertices()) {
    const Point& p = row.balls[0].mesh.point(v);
    row.balls[3].mesh.point(v) = Point(-p.x(), p.y(), p.z());
    const Point& q = row.balls[1].mesh.point(v);
    row.balls[2].mesh.point(v) = Point(-q.x(), q.y(), q.z());
  }
  row.ends[3] = row.ends[0], row.ends[3].col(0) *= -1;
  row.ends[2] = row.ends[1], row.ends[2].col(0) *= -1;
  Exact_detector detector;
  for (const std::size_t i : {3, 2, 1, 0}) detector.add(row.balls[i].mesh);
  const std::vector<Positions> ends(row.ends.rbegin(), row.ends.rend());
  const auto first = detector.first_impact(ends);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->objects, (Object_pair{0, 1}));
  const auto other = detector.first_impact(2, ends[2], 3, ends[3]);
  ASSERT_TRUE(other);
  EXPECT_EQ(other->exact_time, first->impact.exact_time);
}

TEST(Detector_first_impact, refuses_what_is_no_motion_of_two_objects) {
  Moving_ball a({-3, 0, 0}, {3, 0, 0}), b({3, 0, 0}, {-3, 0, 0});
  Exact_detector detector;
  detector.add(a.mesh), detector.add(b.mesh);
  EXPECT_THROW(detector.first_impact(0, a.end, 0, a.end), Bad_argument);
  EXPECT_THROW(detector.first_impact(0, a.end, 2, b.end), Bad_argument);
  EXPECT_THROW(detector.first_impact(0, a.end.topRows(5), 1, b.end), Bad_mesh);
  Positions broken = b.end;
  broken(7, 2) = std::nan("");
  EXPECT_THROW(detector.first_impact(0, a.end, 1, broken), Bad_mesh);
  EXPECT_TRUE(detector.first_impact(0, a.end, 1, b.end));
  EXPECT_THROW(detector.first_impact(std::vector<Positions>{a.end}), Bad_argument);
  EXPECT_THROW(detector.first_impact(std::vector<Positions>{a.end, broken}), Bad_mesh);
  EXPECT_TRUE(detector.first_impact(std::vector<Positions>{a.end, b.end}));
  Exact_detector particles({.mode = Mode::particles});
  particles.add(a.mesh), particles.add(b.mesh);
  EXPECT_THROW(particles.first_impact(0, a.end, 1, b.end), Bad_argument);
}

}  // namespace
}  // namespace lodestone
