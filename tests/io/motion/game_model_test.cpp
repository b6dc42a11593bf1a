// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "io/motion/damaged_animations.h"
#include "lodestone/io/meshes/mesh_file.h"
#include "lodestone/io/motion/animation.h"
#include "lodestone/mesh/errors.h"
#include "support/mesh_samples.h"
#include "support/scene_samples.h"
#include "support/temporary_folder.h"
#include "support/vandal.h"

namespace lodestone::test {
namespace {

std::string numbers(std::initializer_list<double> values) { return packed<std::int32_t>(values); }
std::string padded(std::string text, std::size_t length) {
  text.resize(length);
  return text;
}

/// The square in two frames: in frame t it is at x = t, and its third corner at z = 1.5 t.
std::string square_md2() {
  auto bytes = "IDP2" + numbers({8, 64, 64, 56, 0, 4, 0, 2, 0, 2, 68, 68, 68, 92, 204, 204});
  bytes += packed<std::uint16_t>({0, 1, 2, 0, 0, 0, 0, 2, 3, 0, 0, 0});
  for (const double t : {0, 1}) {
    bytes += packed<float>({0.5, 0.5, 0.5, t, 0, 0}) + padded("frame", 16);
    bytes += packed<std::uint8_t>({0, 0, 0, 9, 2, 0, 0, 9, 2, 2, 3 * t, 9, 0, 2, 0, 9});
  }
  return bytes;
}

/// The same with five vertices, the last coinciding with the first, in two surfaces of one triangle each.
std::string square_md3() {
  const auto surface = [](std::initializer_list<double> corners) {
    auto bytes = "IDP3" + padded("body", 64) + numbers({0, 2, 0, 5, 1, 108, 120, 120, 120, 200});
    bytes += numbers(corners);
    for (const double t : {0, 1})
      bytes += packed<std::int16_t>(
          {64 * t, 0, 0, 1, 64 * (t + 1), 0, 0, 2, 64 * (t + 1), 64, 96 * t, 3, 64 * t, 64, 0, 4, 64 * t, 0, 0, 5});
    return bytes;
  };
  return "IDP3" + numbers({15}) + padded("square", 64) + numbers({0, 2, 0, 2, 0, 108, 108, 108, 508}) +
         surface({0, 1, 2}) + surface({4, 2, 3});
}

std::vector<Point> square_at(double t) { return {{t, 0, 0}, {t + 1, 0, 0}, {t + 1, 1, 1.5 * t}, {t, 1, 0}}; }

class Game_models : public Damaged_animations {
 protected:
  void expect_error(const std::string& name, const std::string& bytes, const std::string& rest) const {
    const auto file = folder.write(name, bytes);
    try {
      read_mesh(file);
      ADD_FAILURE() << "expected " << rest;
    } catch (const Bad_mesh& error) {
      EXPECT_EQ(std::string(error.what()).substr(0, file.string().size() + rest.size()), file.string() + rest);
    }
  }
};

TEST_F(Game_models, of_quake_ii_are_read) {
  const auto animation = read_animation(folder.write("a.md2", square_md2()));
  EXPECT_EQ(animation.kind, "md2");
  EXPECT_EQ(animation.motion.frames, 2U);
  EXPECT_EQ(animation.faces, (std::vector<Corners>{{0, 2, 1}, {0, 3, 2}}));  // clockwise in the file
  std::vector<Point> positions(4);
  for (const std::size_t frame : {1, 0}) {
    animation.motion.pose(frame, positions);
    EXPECT_EQ(positions, square_at(static_cast<double>(frame)));
  }
  EXPECT_THROW(animation.motion.pose(2, positions), Bad_motion);
}

TEST_F(Game_models, of_quake_iii_are_read_and_welded_within_a_surface) {
  const auto animation = read_animation(folder.write("a.md3", square_md3()));
  EXPECT_EQ(animation.kind, "md3");
  EXPECT_EQ(animation.vertices, 10U);
  EXPECT_EQ(animation.faces, (std::vector<Corners>{{0, 2, 1}, {5, 8, 7}}));
  std::vector<Point> positions(10);
  for (const std::size_t frame : {1, 0}) {
    animation.motion.pose(frame, positions);
    const auto expected = square_at(static_cast<double>(frame));
    for (std::size_t v = 0; v < 4; ++v) {
      EXPECT_EQ(positions[v], expected[v]);
      EXPECT_EQ(positions[5 + v], expected[v]);
    }
  }
}

TEST_F(Game_models, can_be_mesh_and_motion_of_a_scene) {
  folder.write("a.md2", square_md2());
  auto scene = read(folder, with_object(R"("mesh": "a.md2", "motion": {"keyframes": "a.md2"})"));
  EXPECT_EQ(scene.frames, 2U);
  pose(scene.objects[0], 1);
  EXPECT_EQ(scene.objects[0].mesh.point(Surface_mesh::Vertex_index(2)), Point(2, 1, 1.5));
  EXPECT_THROW(read_game_motion(folder.path() / "a.md2", 5), Bad_motion);
}

TEST_F(Game_models, must_not_part_what_the_mesh_has_joined) {
  auto parted = square_md3();
  const std::size_t last_vertex = 308 + 120 + 5 * 8 + 4 * 8;  // of the second surface, in the second frame
  parted.replace(last_vertex, 2, packed<std::int16_t>({99}));
  folder.write("rest.md3", square_md3());
  folder.write("parted.md3", parted);
  EXPECT_EQ(read_mesh(folder.path() / "rest.md3").joined, (Joined_vertices{0, 1, 2, 3, 4, 5, 6, 7, 8, 5}));
  const auto scene = [&](const std::string& mesh) {
    return read(folder, with_object(R"("mesh": ")" + mesh + R"(", "motion": {"keyframes": "parted.md3"})"));
  };
  std::vector<Point> positions(10);
  const auto kept = scene("parted.md3"), lost = scene("rest.md3");
  kept.objects[0].motion.pose(1, positions);
  lost.objects[0].motion.pose(0, positions);
  EXPECT_THROW(lost.objects[0].motion.pose(1, positions), Bad_motion);
}

TEST_F(Game_models, may_end_with_an_empty_surface) {
  auto bytes = square_md3();
  bytes.replace(84, 4, numbers({3}));
  bytes += "IDP3" + padded("nothing", 64) + numbers({0, 2, 0, 0, 0, 108, 108, 108, 108, 108});
  EXPECT_EQ(read_mesh(folder.write("a.md3", bytes)).file_vertices, 10U);
}

TEST_F(Game_models, have_limits) {
  folder.write("a.md2", square_md2());
  EXPECT_THROW(read_game_motion(folder.path() / "a.md2", 4, {.max_faces = 1}), Bad_motion);
  EXPECT_EQ(read_game_motion(folder.path() / "a.md2", 4, {.max_faces = 2}).frames, 2U);
}

TEST_F(Game_models, with_wrong_counts_and_offsets_are_refused) {
  const auto md2 = square_md2();
  const auto changed = [](std::string bytes, std::size_t at, double value) {
    return bytes.replace(at, 4, numbers({value}));
  };
  expect_error("a.md2", "IDP4" + md2.substr(4), ": byte 0: expected IDP2 or IDP3");
  expect_error("a.md2", changed(md2, 4, 7), ": byte 4: expected version 8, found 7");
  expect_error("a.md2", changed(md2, 16, 55), ": byte 16: frames of 55 bytes cannot hold 4 vertices");
  expect_error("a.md2", changed(md2, 24, 2e9), ": byte 16: frames of 56 bytes cannot hold 2000000000 vertices");
  expect_error("a.md2", changed(md2, 32, 2e9), ": byte 32: 2000000000 triangles from byte 68 on do not fit");
  for (const std::size_t count_at : {24, 32, 40})
    expect_error("a.md2", changed(md2, count_at, 0), ": byte 24: the file holds no face or no frame");
  expect_error("a.md2", changed(md2, 40, 3), ": byte 40: 3 frames from byte 92 on do not fit into a file of 204");
  expect_error("a.md2", changed(md2, 40, -1), ": byte 40: expected a number of 0 or more, found -1");
  expect_error("a.md2", changed(md2, 68, 7), ": byte 68: face refers to vertex 7 of 4 (counted from 0)");
  auto endless = md2;
  endless.replace(92, 4, packed<float>({std::numeric_limits<double>::infinity()}));
  expect_error("a.md2", endless, ": frame 0 (counted from 0): a scale or offset is not finite");
  const auto md3 = square_md3();
  expect_error("a.md3", changed(md3, 108 + 72, 3), ": byte 180: the surface has 3 frames, the file 2");
  expect_error("a.md3", changed(md3, 108 + 104, 8), ": byte 212: a surface cannot have 8 bytes");
  expect_error("a.md3", changed(md3, 108 + 104, 199), ": byte 212: the surface does not end within its 199 bytes");
  expect_error("a.md3", changed(md3, 84, 0), ": byte 84: the file holds no face");
  expect_error("a.md3", changed(md3, 84, 3), ": byte 100: 1 surface headers from byte 508 on do not fit");
}

TEST_F(Game_models, truncated_or_damaged_give_an_error_or_a_model) {
  for (const auto& [name, bytes] : {Sample{"a.md2", square_md2()}, Sample{"a.md3", square_md3()}}) {
    for (std::size_t length = 0; length < bytes.size(); ++length) read_all(folder.write(name, bytes.substr(0, length)));
    EXPECT_EQ(good, 0U) << name;
    for (std::size_t at = 0; at < bytes.size(); ++at)
      for (const unsigned flip : {0x01U, 0x80U, 0xffU}) {
        auto wrong = bytes;
        wrong[at] = static_cast<char>(static_cast<unsigned char>(wrong[at]) ^ flip);
        read_all(folder.write(name, wrong));
      }
    EXPECT_GT(good, 100U);
    Vandal vandal;
    for (int round = 0; round < 1000; ++round) read_all(folder.write(name, vandal.damaged(bytes)));
    good = 0;
  }
  EXPECT_GT(bad, 1000U);
}

}  // namespace
}  // namespace lodestone::test
