// SPDX-License-Identifier: GPL-3.0-or-later
// Fine parts of a coarse surface, as a bolt in a hall: the answers do not depend on how fine, and nor does the effort.
#include <gtest/gtest.h>

#include <vector>

#include "lodestone/find_collisions.h"
#include "lodestone/io/shapes/shapes.h"
#include "support/instruction_sets.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

/// How the coarse faces lie. They meet nothing.
enum class Hall { floor, far_face, row_of_faces };

void add_square(Surface_mesh& mesh, double x, double z, double half_side) {
  const auto p = mesh.add_vertex(Point(x - half_side, -half_side, z));
  const auto q = mesh.add_vertex(Point(x + half_side, -half_side, z));
  const auto r = mesh.add_vertex(Point(x + half_side, half_side, z));
  const auto s = mesh.add_vertex(Point(x - half_side, half_side, z));
  mesh.add_face(p, q, r);
  mesh.add_face(p, r, s);
}

/// A part of a given size, a power of two, and the hall that it stands in.
Surface_mesh in_hall(const Surface_mesh& part, double size, Hall hall, double side) {
  Surface_mesh mesh = part;
  scale(mesh, size);
  if (hall == Hall::floor) add_square(mesh, 0, 3 * side, 2);
  if (hall == Hall::far_face) add_square(mesh, 4, 3 * side, 0.1 * size);
  if (hall == Hall::row_of_faces)
    for (double x = 4; x > size; x /= 5) add_square(mesh, x, 3 * side, 0.1 * size);
  return mesh;
}

/// Two spheres of 2000 faces that cross.
Surface_mesh ball(double x) {
  Surface_mesh mesh = icosphere(10);
  deform(mesh, [x](const Point& p) { return Point(p.x() + x, p.y() + 0.013, p.z() + 0.31); });
  return mesh;
}

/// Both in one mesh.
Surface_mesh two_balls() {
  Surface_mesh mesh = ball(0);
  mesh += ball(1.7);
  return mesh;
}

const std::vector<double> sizes{0x1p-3, 0x1p-10, 0x1p-14, 0x1p-20, 0x1p-27, 0x1p-60, 0x1p-300};
constexpr Hall halls[]{Hall::floor, Hall::far_face, Hall::row_of_faces};

/// The frame after a step in which nothing moves.
Frame frame_of(const std::vector<const Surface_mesh*>& meshes, const Detector_options& options) {
  Detector<> detector(options);
  for (const Surface_mesh* mesh : meshes) detector.add(*mesh);
  detector.update();
  return detector.detect();
}

TEST(Fine_parts, of_two_surfaces_give_the_same_contacts_at_any_size_for_about_the_same_effort) {
  const Surface_mesh a = ball(0), b = ball(1.7);
  const Collisions truth = find_collisions(a, b);
  ASSERT_GT(truth.faces.size(), 50U);
  for (const Hall hall : halls)
    for (const double size : sizes) {
      SCOPED_TRACE(testing::Message() << "hall " << static_cast<int>(hall) << ", size " << size);
      const Surface_mesh fine_a = in_hall(a, size, hall, -1), fine_b = in_hall(b, size, hall, 1);
      for_instruction_sets([&] {
        const Collisions found = find_collisions(fine_a, fine_b);
        EXPECT_EQ(found.faces, truth.faces);
        EXPECT_LE(found.statistics.leaf_tests, 4 * truth.statistics.leaf_tests);
        // Leaves of a row of faces have faces of any size.
        if (hall != Hall::row_of_faces) {
          EXPECT_LE(found.statistics.exact_tests, 2 * truth.statistics.exact_tests);
        }
        EXPECT_TRUE(find_collisions(fine_a, fine_b, {.contacts = Contact_query::yes_no}).collides);
        const Frame frame = frame_of({&fine_a, &fine_b}, {});
        EXPECT_EQ(frame.face_pairs, truth.faces);
        if (hall != Hall::row_of_faces) {
          EXPECT_LE(frame.statistics.exact_tests, 2 * truth.statistics.exact_tests);
        }
      });
    }
}

/// What is found at one place must not change how the other is searched.
TEST(Fine_parts, at_two_places_are_found_for_about_twice_the_effort) {
  const Collisions once = find_collisions(ball(0), ball(1.7));
  const auto at_two_places = [](const Surface_mesh& part, double side) {
    Surface_mesh mesh = in_hall(part, 0x1p-30, Hall::floor, side);
    Surface_mesh other = part;
    scale(other, 0x1p-30);
    shift(other, 0.75, 0.5);
    return mesh += other;
  };
  const Collisions twice = find_collisions(at_two_places(ball(0), -1), at_two_places(ball(1.7), 1));
  EXPECT_GT(twice.faces.size(), once.faces.size());
  EXPECT_LE(twice.statistics.leaf_tests, 8 * once.statistics.leaf_tests);
}

TEST(Fine_parts, of_two_surfaces_are_near_within_the_same_share_of_their_size) {
  const Surface_mesh a = ball(0), b = ball(2.01);
  Detector_options options;
  options.exact.tolerance = 0x1p-5;
  const auto truth = frame_of({&a, &b}, options).face_pairs;
  ASSERT_GT(truth.size(), 20U);
  for (const Hall hall : halls)
    for (const double size : sizes) {
      SCOPED_TRACE(testing::Message() << "hall " << static_cast<int>(hall) << ", size " << size);
      const Surface_mesh fine_a = in_hall(a, size, hall, -1), fine_b = in_hall(b, size, hall, 1);
      options.exact.tolerance = 0x1p-5 * size;
      for_instruction_sets([&] { EXPECT_EQ(frame_of({&fine_a, &fine_b}, options).face_pairs, truth); });
    }
}

TEST(Fine_parts, of_one_surface_give_the_same_self_collisions_at_any_size) {
  const Surface_mesh both = two_balls();
  Detector_options options;
  options.exact.self_collision = true;
  const Collisions found = find_self_collisions(both);
  const auto& truth = found.faces;
  ASSERT_GT(truth.size(), 50U);
  for (const Hall hall : halls)
    for (const double size : sizes) {
      SCOPED_TRACE(testing::Message() << "hall " << static_cast<int>(hall) << ", size " << size);
      const Surface_mesh fine = in_hall(both, size, hall, 1);
      for_instruction_sets([&] {
        EXPECT_EQ(find_self_collisions(fine).faces, truth);
        const Frame frame = frame_of({&fine}, options);
        EXPECT_EQ(frame.face_pairs, truth);
        if (hall != Hall::row_of_faces) {
          EXPECT_LE(frame.statistics.exact_tests, 2 * found.statistics.exact_tests);
        }
      });
    }
}

}  // namespace
}  // namespace lodestone
