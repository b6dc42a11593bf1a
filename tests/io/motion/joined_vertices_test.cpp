// SPDX-License-Identifier: GPL-3.0-or-later
// A reader joins vertices that are alike in their own file; another file may move them apart.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lodestone/io/meshes/mesh_file.h"
#include "lodestone/io/motion/animation.h"
#include "lodestone/io/results/animation_output.h"
#include "lodestone/mesh/errors.h"
#include "support/scene_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

/// Two squares along a seam, whose vertices 1 and 2 the second square has again, as 4 and 7. It moves along x from the
/// second frame on.
Animation two_squares(std::size_t frames, double step) {
  Animation animation{
      .kind = "test", .vertices = 8, .faces = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}}, .file_face = {0, 1, 2, 3}};
  animation.motion.frames = frames;
  animation.motion.pose = [step](std::size_t frame, std::span<Point> positions) {
    const double x = 1 + step * static_cast<double>(frame);
    const Point corners[]{{0, 0, 0}, {1, 0, 0},     {1, 1, 0},     {0, 1, 0},
                          {x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}};
    std::ranges::copy(corners, positions.begin());
  };
  return animation;
}

class Joined_vertices_of_a_file : public testing::Test {
 protected:
  Joined_vertices_of_a_file() {
    write_animation(path("rest.glb"), two_squares(1, 0));
    write_animation(path("rest.obj"), two_squares(1, 0), {.numbered = false});
    for (const char* name : {"apart.glb", "apart.pc2", "apart.mdd"}) write_animation(path(name), two_squares(3, 1));
    write_animation(path("still.pc2"), two_squares(3, 0));
  }
  std::filesystem::path path(const std::string& name) const { return folder.path() / name; }

  static std::vector<Point> posed(const Motion& motion, std::size_t frame) {
    std::vector<Point> positions(8);
    motion.pose(frame, positions);
    return positions;
  }
  void expect_parted(const Motion& motion) const {
    posed(motion, 0);
    for (const std::size_t frame : {1, 2}) {
      try {
        posed(motion, frame);
        ADD_FAILURE() << "expected an error";
      } catch (const Bad_motion& error) {
        EXPECT_EQ(error.what(), path("rest.glb").string() +
                                    ": vertices 1 and 4 (counted from 0) are one vertex there, since they are at one "
                                    "place, but frame " +
                                    std::to_string(frame) +
                                    " of the motion moves them apart: give the mesh in a format that keeps them, such "
                                    "as .obj");
      }
    }
  }
  Motion motion_of_scene(const std::string& mesh, const std::string& motion) const {
    return read(folder, with_object(R"("mesh": ")" + mesh + R"(", "motion": )" + motion)).objects[0].motion;
  }

  Temporary_folder folder;
};

TEST_F(Joined_vertices_of_a_file, are_told) {
  EXPECT_EQ(read_mesh(path("rest.glb")).joined, (Joined_vertices{0, 1, 2, 3, 1, 5, 6, 2}));
  EXPECT_TRUE(read_mesh(path("apart.glb")).joined.empty());
  EXPECT_TRUE(read_mesh(path("rest.obj")).joined.empty());
}

TEST_F(Joined_vertices_of_a_file, must_not_be_parted_by_another_file) {
  for (const char* cache : {"apart.pc2", "apart.mdd"}) {
    expect_parted(read_animation(path("rest.glb").string() + "+" + path(cache).string()).motion);
    expect_parted(read_animation(path(cache), {.mesh = path("rest.glb")}).motion);
  }
  expect_parted(motion_of_scene("rest.glb", R"({"pc2": "apart.pc2"})"));
  expect_parted(motion_of_scene("rest.glb", R"({"mdd": "apart.mdd"})"));
  const Motion gltf = motion_of_scene("rest.glb", R"({"gltf": "apart.glb"})");
  expect_parted(gltf);
  EXPECT_FALSE(gltf.computed) << "frames must be posed as a whole";
  expect_parted(gltf.resampled(gltf.frames_per_second, gltf.start));
}

TEST_F(Joined_vertices_of_a_file, may_be_moved_together) {
  const Motion motion = read_animation(path("rest.glb").string() + "+" + path("still.pc2").string()).motion;
  for (const std::size_t frame : {0, 1, 2}) EXPECT_EQ(posed(motion, frame)[4], Point(1, 0, 0));
  const Motion own = motion_of_scene("apart.glb", R"({"gltf": "apart.glb"})");
  EXPECT_EQ(posed(own, 2)[4], Point(3, 0, 0));
  EXPECT_TRUE(own.computed);
}

TEST_F(Joined_vertices_of_a_file, are_kept_apart_by_other_formats) {
  const Motion motion = read_animation(path("rest.obj").string() + "+" + path("apart.pc2").string()).motion;
  EXPECT_EQ(posed(motion, 2)[1], Point(1, 0, 0));
  EXPECT_EQ(posed(motion, 2)[4], Point(3, 0, 0));
}

TEST_F(Joined_vertices_of_a_file, are_not_moved_by_a_sequence_of_other_faces) {
  write_animation(path("f_#.obj"), two_squares(3, 1));
  EXPECT_EQ(posed(motion_of_scene("rest.obj", R"({"sequence": "f_#.obj"})"), 2)[4], Point(3, 0, 0));
  try {
    motion_of_scene("rest.glb", R"({"sequence": "f_#.obj"})");
    ADD_FAILURE() << "expected an error";
  } catch (const Bad_motion& error) {
    EXPECT_NE(std::string(error.what())
                  .find(path("f_0.obj").string() + ": face 2 (counted from 0) has other corners than in " +
                        path("rest.glb").string()),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace lodestone::test
