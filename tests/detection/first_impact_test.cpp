// SPDX-License-Identifier: GPL-3.0-or-later
// Impacts between frames, asked of a detector. The search itself is tested in queries/impact_search_test.cpp.
#include <gtest/gtest.h>

#include <cmath>

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
  Exact_detector particles({.mode = Mode::particles});
  particles.add(a.mesh), particles.add(b.mesh);
  EXPECT_THROW(particles.first_impact(0, a.end, 1, b.end), Bad_argument);
}

}  // namespace
}  // namespace lodestone
