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
#include "lodestone/io/shapes/shapes.h"
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
        EXPECT_EQ(error.what(),
                  path("rest.glb").string() +
                      ": vertices 1 and 4 (counted from 0) are one vertex there, since they are at one "
                      "place, but frame " +
                      std::to_string(frame) +
                      " of the motion moves them apart: export the mesh in a format that keeps them, such "
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

TEST_F(Joined_vertices_of_a_file, are_at_one_place_in_a_scene_that_does_not_read_their_motion) {
  const auto motion_with = [&](const std::string& rest) {
    return read(folder, R"({"frames": 20, "objects": [{"name": "a", "mesh": "rest.glb", )" + rest + "}]}")
        .objects[0]
        .motion;
  };
  const auto at_rest = posed(motion_with(R"("place": {"scale": 2})"), 0);
  const auto moved = posed(motion_with(R"("motion": {"deform": [{"travel": {"way_points": [
      {"frame": 0, "at": [0, 0, 0]}, {"frame": 10, "at": [10, 0, 0]}]}}]})"),
                           10);
  const Kernel::Vector_3 corners[]{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                   {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}};
  for (std::size_t vertex = 0; vertex < 8; ++vertex) {
    EXPECT_EQ(at_rest[vertex] - at_rest[0], 2 * corners[vertex]) << vertex;
    EXPECT_EQ(moved[vertex] - moved[0], corners[vertex]) << vertex;
  }
}

TEST_F(Joined_vertices_of_a_file, are_told_of_every_motion) {
  const Joined_vertices joined{0, 1, 2, 3, 1, 5, 6, 2};
  EXPECT_EQ(read_animation(path("rest.glb")).motion.joined, joined);
  EXPECT_EQ(read_animation(path("rest.glb").string() + "+" + path("still.pc2").string()).motion.joined, joined);
  EXPECT_EQ(motion_of_scene("rest.glb", R"({"pc2": "still.pc2"})").joined, joined);
  EXPECT_TRUE(motion_of_scene("rest.obj", R"({"pc2": "still.pc2"})").joined.empty());
}

TEST_F(Joined_vertices_of_a_file, are_kept_apart_by_other_formats) {
  const Motion motion = read_animation(path("rest.obj").string() + "+" + path("apart.pc2").string()).motion;
  EXPECT_EQ(posed(motion, 2)[1], Point(1, 0, 0));
  EXPECT_EQ(posed(motion, 2)[4], Point(3, 0, 0));
}

TEST_F(Joined_vertices_of_a_file, may_be_apart_by_what_floats_are_rounded) {
  const auto write = [&](const std::string& name, double step) {
    Animation animation = two_squares(1, 0);
    animation.motion.pose = [step](std::size_t, std::span<Point> positions) {
      two_squares(1, 0).motion.pose(0, positions);
      positions[4] = Point(1 + step, 0, 0);
    };
    write_animation(path(name), animation);
    return read_animation(path("rest.glb").string() + "+" + path(name).string()).motion;
  };
  EXPECT_EQ(posed(write("rounded.pc2", 0x1p-23), 0)[4], Point(1 + 0x1p-23, 0, 0));
  EXPECT_THROW(posed(write("moved.pc2", 0x1p-16), 0), Bad_motion);
}

TEST_F(Joined_vertices_of_a_file, are_none_that_no_face_uses) {
  Animation animation = two_squares(1, 0);
  animation.faces.resize(2);
  animation.file_face.resize(2);
  write_animation(path("half.glb"), animation);
  EXPECT_TRUE(read_mesh(path("half.glb")).joined.empty());
  const Motion motion = read_animation(path("half.glb").string() + "+" + path("apart.pc2").string()).motion;
  EXPECT_EQ(posed(motion, 2)[4], Point(3, 0, 0));
}

class Sequence_of_a_mesh : public Joined_vertices_of_a_file {
 protected:
  /// The last frame's first vertex of the second square.
  Point moved(const std::string& mesh, const std::string& files) const {
    return posed(motion_of_scene(mesh, R"({"sequence": ")" + files + "\"}"), 2)[4];
  }
  void expect_other(const std::string& mesh, const std::string& files, const std::string& rest) const {
    try {
      motion_of_scene(mesh, R"({"sequence": ")" + files + "\"}");
      ADD_FAILURE() << "expected an error";
    } catch (const Bad_motion& error) {
      EXPECT_NE(std::string(error.what()).find(rest), std::string::npos) << error.what();
    }
  }
  /// Writes three frames of the two squares with faces of its own.
  void write_frames(const std::string& name, double step, const std::string& faces) const {
    for (int frame = 0; frame < 3; ++frame) {
      std::vector<Point> positions(8);
      two_squares(3, step).motion.pose(static_cast<std::size_t>(frame), positions);
      std::string text;
      for (const Point& p : positions)
        text += "v " + std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + "\n";
      folder.write(name + "_" + std::to_string(frame) + ".obj", text + faces);
    }
  }
};

TEST_F(Sequence_of_a_mesh, may_have_its_faces_in_other_forms) {
  write_frames("same", 1, "f 1 2 3\nf 1 3 4\nf 5 6 7\nf 5 7 8\n");
  write_frames("turned", 1, "f 2 3 1\nf 4 1 3\nf 7 5 6\nf 7 8 5\n");
  write_frames("quads", 1, "f 1 2 3 4\nf 5 6 7 8\n");
  for (const char* files : {"same_#.obj", "turned_#.obj", "quads_#.obj"})
    EXPECT_EQ(moved("rest.obj", files), Point(3, 0, 0)) << files;
  folder.write("quads.obj",
               "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nf 1 2 3 4\nf 5 6 7 8\n");
  write_frames("other_way", 1, "f 1 2 4\nf 2 3 4\nf 5 6 8\nf 6 7 8\n");
  EXPECT_EQ(moved("quads.obj", "other_way_#.obj"), Point(3, 0, 0));
}

TEST_F(Sequence_of_a_mesh, must_have_its_faces) {
  write_frames("swapped", 1, "f 5 6 7\nf 5 7 8\nf 1 2 3\nf 1 3 4\n");
  write_frames("fewer", 1, "f 1 2 3\nf 1 3 4\nf 5 6 7\n");
  write_frames("more", 1, "f 1 2 3\nf 1 3 4\nf 5 6 7\nf 5 7 8\nf 5 7 8\n");
  write_frames("mixed", 1, "f 1 2 3 4\nf 5 6 7\nf 1 7 8\n");
  write_frames("quads", 1, "f 5 6 7 8\nf 1 2 3 4\n");
  const auto other = [](const std::string& face) {
    return ": face " + face + " (counted from 0) has other corners than in ";
  };
  expect_other("rest.obj", "swapped_#.obj", "swapped_0.obj" + other("0"));
  expect_other("rest.obj", "fewer_#.obj", "fewer_0.obj" + other("2"));
  expect_other("rest.obj", "more_#.obj", "more_0.obj" + other("4"));
  expect_other("rest.obj", "mixed_#.obj", "mixed_0.obj" + other("2"));
  expect_other("rest.obj", "quads_#.obj", "quads_0.obj" + other("0"));
  // The polygon has a corner that none of its two triangles has.
  folder.write("thin.obj",
               "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\n"
               "f 4 1 1\nf 1 1 4\nf 5 6 7\nf 5 7 8\n");
  write_frames("twice", 1, "f 4 1 2 1\nf 5 6 7\nf 5 7 8\n");
  expect_other("thin.obj", "twice_#.obj", "twice_0.obj" + other("0"));
}

TEST_F(Sequence_of_a_mesh, may_move_joined_vertices_together_and_not_apart) {
  const std::string faces = "f 1 2 3\nf 1 3 4\nf 5 6 7\nf 5 7 8\n";
  write_frames("together", 0, faces);
  write_frames("parted", 1, faces);
  EXPECT_EQ(moved("rest.glb", "together_#.obj"), Point(1, 0, 0));
  expect_parted(motion_of_scene("rest.glb", R"({"sequence": "parted_#.obj"})"));
}

TEST_F(Sequence_of_a_mesh, must_have_the_faces_of_a_shape) {
  const Surface_mesh ball = icosphere(1);
  const auto write = [&](const std::string& name, bool reversed) {
    const auto count = static_cast<std::uint32_t>(ball.number_of_vertices());
    const auto number = [&](std::uint32_t vertex) { return reversed ? count - 1 - vertex : vertex; };
    std::string text = "OFF\n" + std::to_string(count) + " " + std::to_string(ball.number_of_faces()) + " 0\n";
    for (std::uint32_t i = 0; i < count; ++i) {
      const Point& p = ball.point(Surface_mesh::Vertex_index(number(i)));
      text += std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + "\n";
    }
    for (const auto f : ball.faces()) {
      text += "3";
      for (const auto v : ball.vertices_around_face(ball.halfedge(f))) text += " " + std::to_string(number(v));
      text += "\n";
    }
    folder.write(name, text);
  };
  write("same_0.off", false);
  write("reversed_0.off", true);
  const auto scene = [&](const std::string& files) {
    return read(folder,
                with_object(R"("shape": {"icosphere": {"frequency": 1}}, "motion": {"sequence": ")" + files + "\"}"));
  };
  EXPECT_EQ(scene("same_#.off").objects[0].motion.frames, 1U);
  try {
    scene("reversed_#.off");
    ADD_FAILURE() << "expected an error";
  } catch (const Bad_motion& error) {
    EXPECT_NE(std::string(error.what()).find("has other corners than in the shape"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lodestone::test
