// SPDX-License-Identifier: GPL-3.0-or-later
// The characters of the experiment `certified`: made, written, read, subdivided and brought together.
#include "certified/character.h"

#include <CGAL/boost/graph/helpers.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "certified/character_race.h"
#include "certified/character_scene.h"
#include "certified/made_character.h"
#include "lodestone/detector.h"
#include "lodestone/mesh/computed_points.h"
#include "support/temporary_folder.h"

namespace lodestone {
namespace {

/// A square of two joints and a target that lifts one corner.
Character square() {
  Character square{.name = "square",
                   .mesh = {},
                   .points = {Morphed_points({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0},
                                             std::vector<Morph_target>{{.vertices = {2}, .offsets = {0, 0, 1}}}),
                              Joint_influences::of(2, std::vector<std::uint32_t>{0, 1, 0, 1, 0, 1, 0, 1},
                                                   std::vector<double>{1, 0, 0, 1, 0.5, 0.5, 1, 0}),
                              2}};
  for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) square.mesh.add_vertex(Point(x, y, 0));
  using Vertex_index = Surface_mesh::Vertex_index;
  square.mesh.add_face(Vertex_index(0), Vertex_index(1), Vertex_index(2));
  square.mesh.add_face(Vertex_index(0), Vertex_index(2), Vertex_index(3));
  return square;
}

TEST(Subdivided_character, has_the_faces_edges_and_vertices_of_a_cut_mesh) {
  for (const std::size_t parts : {1, 2, 3, 5}) {
    const Character fine = subdivided(square(), parts);
    EXPECT_EQ(fine.mesh.number_of_faces(), 2 * parts * parts);
    EXPECT_EQ(fine.mesh.number_of_vertices(), (parts + 1) * (parts + 1));
    EXPECT_EQ(fine.points.vertex_count(), fine.mesh.number_of_vertices());
    EXPECT_TRUE(CGAL::is_valid_polygon_mesh(fine.mesh));
  }
}

TEST(Subdivided_character, weights_and_offsets_are_the_means_of_those_of_the_corners) {
  const Character fine = subdivided(square(), 4);
  for (std::uint32_t v = 0; v < fine.points.vertex_count(); ++v) {
    const double x = fine.points.shape().rest()[3 * v], y = fine.points.shape().rest()[3 * v + 1];
    // Both are linear on each of the two triangles.
    const double second = x >= y ? (x - y) + 0.5 * y : 0.5 * x;
    double found = 0, sum = 0;
    const auto influences = fine.points.influences(v);
    for (std::size_t i = 0; i < influences.joints.size(); ++i) {
      sum += influences.weights[i];
      if (influences.joints[i] == 1) found = influences.weights[i];
    }
    EXPECT_NEAR(sum, 1, 1e-15);
    EXPECT_NEAR(found, second, 1e-15) << x << ' ' << y;
    double lifted = 0;
    fine.points.shape().for_each_offset(v,
                                        [&](std::uint32_t, std::span<const double, 3> offset) { lifted += offset[2]; });
    EXPECT_NEAR(lifted, std::min(x, y), 1e-15);
  }
}

TEST(Subdivided_character, old_vertices_are_where_they_were_in_every_pose) {
  Character coarse = square();
  Character fine = subdivided(coarse, 3);
  const Skin_pose pose{.joints = {Eigen::Affine3d(Eigen::Translation3d(0, 0, 2)),
                                  Eigen::Affine3d(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()))},
                       .weights = {0.7}};
  pose.give_to(coarse.points);
  Skin_pose::of(coarse.points).give_to(fine.points);
  for (std::uint32_t v = 0; v < 4; ++v) EXPECT_NEAR((coarse.points(v) - fine.points(v)).norm(), 0, 1e-15);
}

TEST(Subdivided_character, has_nearly_as_many_faces_as_asked) {
  const Character coarse = square();
  EXPECT_EQ(parts_for(coarse, 2), 1U);
  EXPECT_EQ(parts_for(coarse, 1), 1U);
  EXPECT_EQ(parts_for(coarse, 200), 10U);
  EXPECT_EQ(parts_for(coarse, 190), 10U);
}

TEST(Made_character, surfaces_are_closed_and_the_files_bring_them_back) {
  const test::Temporary_folder folder;
  for (const auto& made : made_characters()) {
    SCOPED_TRACE(made.name);
    const auto file = folder.path() / (made.name + ".glb");
    write_glb(made, file);
    const auto character = read_character(file);
    ASSERT_TRUE(character);
    EXPECT_TRUE(CGAL::is_closed(character->mesh));
    const auto euler = static_cast<long>(character->mesh.number_of_vertices() + character->mesh.number_of_faces()) -
                       static_cast<long>(character->mesh.number_of_edges());
    EXPECT_EQ(euler, 2);  // a single piece without handles
    EXPECT_EQ(character->points.shape().target_count(), made.targets.size());
    EXPECT_GE(character->points.joint_count(), std::max<std::size_t>(made.joints.size(), 1));
    EXPECT_EQ(character->animation.size(), 91U);
    const auto& first = character->animation.front();
    const auto changes = [&](const Skin_pose& pose) { return pose.weights != first.weights; };
    EXPECT_EQ(std::ranges::any_of(character->animation, changes), !made.targets.empty());
  }
}

TEST(Made_character, each_point_is_moved_by_few_joints_with_weights_of_sum_1) {
  const auto& hand = made_characters().front();
  for (const auto& capsule : hand.capsules) {
    const auto joints = joints_at(hand, 0.5 * (capsule.from + capsule.to));
    EXPECT_LE(joints.size(), 4U);
    EXPECT_EQ(joints.front().first, capsule.joint);
    EXPECT_NEAR(
        std::accumulate(joints.begin(), joints.end(), 0.0, [](double s, const auto& j) { return s + j.second; }), 1,
        1e-15);
  }
}

TEST(Character_scene, characters_touch_at_a_small_part_in_some_frames) {
  const auto hand = read_character(std::filesystem::path(LODESTONE_DATA) / "characters" / "hand.glb");
  ASSERT_TRUE(hand);
  Character_scene scene = touching("hands", *hand, *hand);
  Detector<> exact;
  for (const auto& character : scene.characters) exact.add(character.mesh, point_map(character.mesh, character.points));
  std::size_t colliding = 0, frames = 0;
  for (std::size_t frame = 0; frame < scene.frames.size(); frame += 3, ++frames) {
    scene.pose(frame);
    const Frame& found = exact.detect();
    colliding += found.collides() ? 1 : 0;
    EXPECT_LT(found.face_pairs.size(), hand->mesh.number_of_faces() / 10);
    EXPECT_LT(exact.closest(0, 1).points.distance, 0.05);
  }
  EXPECT_GT(colliding, frames / 4);
  EXPECT_LT(colliding, 3 * frames / 4);
}

TEST(Character_race, all_ways_agree_and_certified_reads_little_of_what_is_far) {
  const auto body = read_character(std::filesystem::path(LODESTONE_DATA) / "characters" / "body.glb");
  ASSERT_TRUE(body);
  Character_scene coarse = touching("bodies", *body, *body);
  coarse.frames.resize(12);
  Character_scene scene = with_triangles(coarse, 40'000);
  const auto figures = race(scene, {.most_frames = 4, .passes = 1}, [](double) {});
  ASSERT_GE(figures.rivals.size(), 3U);
  EXPECT_EQ(figures.frames.size(), 4U);
  EXPECT_EQ(figures.rivals[0].name, "certified");
  EXPECT_TRUE(figures.rivals[0].is_right());
  EXPECT_TRUE(figures.rivals[1].is_right());
  for (const auto& rival : figures.rivals)
    EXPECT_TRUE(std::ranges::all_of(rival.any_seconds, [](double s) { return s > 0 && s < 10; })) << rival.name;
  EXPECT_EQ(figures.certified.violations, 0U);
  EXPECT_GE(figures.certified.tightness, 1);
  EXPECT_LT(figures.certified.tightness, 3);
  for (const double share : figures.certified.near_faces) EXPECT_LT(share, 0.3);
}

}  // namespace
}  // namespace lodestone
