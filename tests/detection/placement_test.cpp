// SPDX-License-Identifier: GPL-3.0-or-later
// Objects that a rotation and a translation move, while their meshes stay as they are.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>

#include "detection/detector_scenes.h"
#include "lodestone/detector.h"

namespace lodestone {
namespace {

constexpr int moves = 12;

/// From frame to frame an object turns, and comes nearer to the origin.
Eigen::Isometry3d motion(int frame) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.rotate(Eigen::AngleAxisd(0.2 * frame, Eigen::Vector3d(1, -2, 3).normalized()));
  result.pretranslate(Eigen::Vector3d(2.2 - 0.15 * frame, 0.1, 0.05 * frame));
  return result;
}

Eigen::Isometry3d far_away() {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.translation().x() = 8;
  return result;
}

Point moved(const Eigen::Isometry3d& motion, const Point& p) {
  const Eigen::Vector3d q = motion * coordinates(p);
  return {q.x(), q.y(), q.z()};
}

Positions positions_of(const Surface_mesh& mesh) {
  return read_positions(Mesh_numbering<Surface_mesh>(mesh), mesh.points());
}

class Placed : public testing::TestWithParam<Mode> {
 protected:
  Detector_options options{.mode = GetParam(), .particles = 24, .contact_points = true, .contact_normals = true};
  const Surface_mesh shape = potato(12, 2);
  Surface_mesh still = potato(12), placed = shape, written = shape;
};

TEST_P(Placed, an_object_gives_the_frames_of_one_whose_vertices_are_written) {
  Detector<> by_placement(options), by_writing(options);
  by_placement.add(still), by_writing.add(still);
  by_placement.add(placed), by_writing.add(written);
  std::size_t contacts = 0;
  for (int frame = 0; frame < moves; ++frame) {
    by_placement.place(1, motion(frame));
    for (const auto v : written.vertices()) written.point(v) = moved(motion(frame), shape.point(v));
    by_placement.update(), by_writing.update();
    const Frame& expected = by_writing.detect();
    expect_equal(by_placement.detect(), expected);
    contacts += expected.face_pairs.size();
  }
  EXPECT_GT(contacts, 50U);
  for (const auto v : placed.vertices()) EXPECT_EQ(placed.point(v), shape.point(v));
}

TEST_P(Placed, the_identity_ends_a_placement) {
  Detector<> detector(options), expected(options);
  detector.add(still), expected.add(still);
  detector.add(placed), expected.add(written);
  detector.place(1, far_away());
  EXPECT_TRUE(detector.detect().face_pairs.empty());
  detector.place(1, Eigen::Isometry3d::Identity());
  detector.update();
  const bool collides = detector.detect().collides();
  EXPECT_TRUE(collides);
  EXPECT_EQ(collides, expected.detect().collides());
}

TEST_P(Placed, an_object_stays_placed_when_it_is_rebuilt) {
  Detector<> detector(options);
  detector.add(still), detector.add(placed);
  detector.place(1, far_away());
  detector.rebuild(1);
  EXPECT_TRUE(detector.detect().face_pairs.empty());
}

TEST_P(Placed, turning_and_shifting_is_no_growth) {
  Detector<> detector(options);
  detector.add(still), detector.add(placed);
  detector.detect();
  for (int frame = 0; frame < moves; ++frame) {
    detector.place(1, motion(frame));
    detector.update();
    EXPECT_EQ(detector.detect().statistics.repartitions, 0U);
  }
}

TEST_P(Placed, a_position_that_is_not_finite_is_refused) {
  placed.point(Surface_mesh::Vertex_index(5)) = {1e308, 0, 0};
  Eigen::Isometry3d far = Eigen::Isometry3d::Identity();
  far.translation().x() = 1.5e308;
  Detector<> detector(options);
  detector.add(still), detector.add(placed);
  detector.place(1, far);
  EXPECT_THROW(detector.detect(), Bad_mesh);
}

TEST_P(Placed, what_is_no_rotation_is_refused_and_changes_nothing) {
  Detector<> detector(options);
  detector.add(still), detector.add(placed);
  detector.place(1, far_away());
  Eigen::Isometry3d larger = Eigen::Isometry3d::Identity(), mirrored = larger, unknown = larger, sheared = larger;
  larger.linear() *= 1.001;
  mirrored.linear().col(0) *= -1;
  unknown.translation().y() = std::numeric_limits<double>::quiet_NaN();
  sheared.linear()(0, 1) = 0.001;
  for (const auto& wrong : {larger, mirrored, unknown, sheared}) EXPECT_THROW(detector.place(1, wrong), Bad_argument);
  EXPECT_THROW(detector.place(2, motion(0)), Bad_argument);
  EXPECT_TRUE(detector.detect().face_pairs.empty());
}

INSTANTIATE_TEST_SUITE_P(modes, Placed, testing::Values(Mode::particles, Mode::senin, Mode::exact),
                         [](const auto& mode) { return std::string(name_of(mode.param)); });

TEST(Placed_exact, given_positions_are_placed_as_well) {
  const auto still = sphere(8), shape = sphere(6);
  auto other = shape;
  shift(other, 100);
  Detector<> detector;
  detector.add(still), detector.add(other);
  Eigen::Isometry3d nearer = Eigen::Isometry3d::Identity();
  nearer.translation().x() = 1.5;
  detector.update(1, positions_of(shape));
  detector.place(1, nearer);
  EXPECT_TRUE(detector.detect().collides());
  detector.update(1);
  EXPECT_FALSE(detector.detect().collides());
}

TEST(Placed_exact, every_query_sees_the_placement) {
  const auto large = sphere(8), small = sphere(6, 0.25);
  Detector<> detector({.exact = {.containment = true}});
  const auto outer = detector.add(large), inner = detector.add(small);
  EXPECT_TRUE(detector.contains(outer, inner));
  Eigen::Isometry3d away = Eigen::Isometry3d::Identity();
  away.translation().x() = 3;
  detector.place(inner, away);
  EXPECT_FALSE(detector.contains(outer, inner));
  EXPECT_NEAR(detector.closest(outer, inner).points.distance, 1.75, 1e-6);
  away.translation().x() = 1;
  detector.place(inner, away);
  std::size_t seen = 0;
  detector.visit(outer, inner, [&](const Face_pair&) {
    ++seen;
    return Visit::go_on;
  });
  EXPECT_GT(seen, 0U);
}

}  // namespace
}  // namespace lodestone
