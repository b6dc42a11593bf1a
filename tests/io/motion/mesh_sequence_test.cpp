// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "lodestone/io/motion/animation.h"
#include "lodestone/io/motion/motion.h"
#include "lodestone/io/results/animation_output.h"
#include "lodestone/mesh/errors.h"
#include "support/mesh_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

/// A triangle at height z, with a vertex in the middle of the list that no face uses.
std::string raised_triangle(const std::string& z) {
  return "OFF\n4 1 0\n0 0 " + z + "\n9 9 " + z + "\n1 0 " + z + "\n0 1 " + z + "\n3 0 2 3\n";
}

class Mesh_sequence : public testing::Test {
 protected:
  /// The motion of these two frames must fail at the second with a message that begins with its name and `rest`.
  void expect_error(const std::string& second, const std::string& rest) const {
    const auto first_file = folder.write("0.off", raised_triangle("0")), second_file = folder.write("1.off", second);
    const auto motion = read_mesh_sequence({first_file, second_file}, 4);
    std::vector<Point> positions(4);
    EXPECT_NO_THROW(motion.pose(0, positions));
    try {
      motion.pose(1, positions);
      ADD_FAILURE() << "expected" << rest;
    } catch (const Bad_motion& error) {
      EXPECT_EQ(std::string(error.what()).substr(0, second_file.string().size() + rest.size()),
                second_file.string() + rest);
    }
  }

  Temporary_folder folder;
};

TEST_F(Mesh_sequence, gives_positions_in_file_order_including_unused_vertices) {
  const auto motion =
      read_mesh_sequence({folder.write("0.off", raised_triangle("0")), folder.write("1.off", raised_triangle("5"))}, 4);
  EXPECT_EQ(motion.frames, 2U);
  std::vector<Point> positions(4);
  for (const std::size_t frame : {1, 0}) {
    motion.pose(frame, positions);
    const double z = frame == 0 ? 0 : 5;
    EXPECT_EQ(positions, (std::vector<Point>{{0, 0, z}, {9, 9, z}, {1, 0, z}, {0, 1, z}}));
  }
}

TEST_F(Mesh_sequence, mixes_formats) {
  std::vector<std::filesystem::path> files;
  for (const auto& [name, bytes] : all_squares()) files.push_back(folder.write(name, bytes));
  const auto motion = read_mesh_sequence(files, 4);
  std::vector<Point> positions(4);
  for (std::size_t frame = 0; frame < files.size(); ++frame) {
    positions.assign(4, Point(7, 7, 7));
    motion.pose(frame, positions);
    EXPECT_EQ(positions, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  }
}

/// Two triangles with an edge in common; the last corner is at height z.
std::string stl_of_two_triangles(const std::string& z, const std::string& common = "0 1 0") {
  const auto triangle = [](const std::string& a, const std::string& b, const std::string& c) {
    return "facet normal 0 0 0\nouter loop\nvertex " + a + "\nvertex " + b + "\nvertex " + c + "\nendloop\nendfacet\n";
  };
  return "solid s\n" + triangle("0 0 0", "1 0 0", "0 1 0") + triangle("1 0 0", "1 1 " + z, common) + "endsolid s\n";
}

TEST_F(Mesh_sequence, of_stl_files_follows_vertices_that_come_to_one_place) {
  const auto first = folder.write("0.stl", stl_of_two_triangles("5"));
  auto flat = stl_of_two_triangles("0");
  flat.replace(flat.find("vertex 1 1 0"), 12, "vertex 1 0 0");  // where another vertex is
  const auto motion = read_mesh_sequence({first, folder.write("1.stl", flat)}, 4);
  std::vector<Point> positions(4);
  motion.pose(1, positions);
  EXPECT_EQ(positions, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}}));
  motion.pose(0, positions);
  EXPECT_EQ(positions, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 5}}));
}

TEST_F(Mesh_sequence, of_stl_files_refuses_corners_of_one_vertex_at_two_places_and_other_numbers_of_faces) {
  const auto first = folder.write("0.stl", stl_of_two_triangles("5"));
  std::vector<Point> positions(4);
  const auto expect_refused = [&](const std::string& second, const std::string& reason) {
    const auto motion = read_mesh_sequence({first, folder.write("1.stl", second)}, 4);
    try {
      motion.pose(1, positions);
      ADD_FAILURE() << "expected " << reason;
    } catch (const Bad_motion& error) {
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
  };
  expect_refused(stl_of_two_triangles("5", "0 2 0"), "1.stl: corner 2 of face 1 (counted from 0)");
  const auto two = stl_of_two_triangles("5");
  expect_refused(two.substr(0, two.find("endfacet") + 9) + "endsolid s\n", "1.stl: the mesh has 1 faces");
}

TEST_F(Mesh_sequence, refuses_an_empty_list_and_a_file_that_does_not_exist) {
  EXPECT_THROW(read_mesh_sequence({}, 4), Bad_motion);
  const auto first = folder.write("0.off", raised_triangle("0"));
  EXPECT_THROW(read_mesh_sequence({first, folder.path() / "none.off"}, 4), Bad_motion);
}

TEST_F(Mesh_sequence, refuses_a_first_file_that_is_broken_or_has_a_wrong_number_of_vertices) {
  EXPECT_THROW(read_mesh_sequence({folder.write("0.off", "OFF\n")}, 4), Bad_motion);
  EXPECT_THROW(read_mesh_sequence({folder.write("0.off", raised_triangle("0"))}, 3), Bad_motion);
}

TEST_F(Mesh_sequence, refuses_a_frame_past_the_end_and_too_few_positions) {
  const auto motion = read_mesh_sequence({folder.write("0.off", raised_triangle("0"))}, 4);
  std::vector<Point> positions(4);
  EXPECT_THROW(motion.pose(1, positions), Bad_motion);
  positions.pop_back();
  EXPECT_THROW(motion.pose(0, positions), Bad_motion);
}

TEST_F(Mesh_sequence, names_file_and_line_of_a_broken_frame) {
  expect_error(raised_triangle("nan"), ":3: 'nan' is not a finite number");
}

TEST_F(Mesh_sequence, refuses_a_frame_with_a_wrong_number_of_vertices) {
  expect_error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", ": the mesh has 3 vertices, expected 4");
}

TEST_F(Mesh_sequence, refuses_a_frame_with_other_faces) {
  expect_error("OFF\n4 1 0\n0 0 0\n9 9 0\n1 0 0\n0 1 0\n3 0 3 2\n", ": face 0 (counted from 0) has other corners than");
  expect_error(square_off, ": the mesh has 2 faces, ");
}

/// Each of these files is read by itself, so vertices may be joined in one and not in the next.
TEST_F(Mesh_sequence, tells_that_vertices_are_joined_in_files_of_their_own) {
  const auto squares = [&](const std::string& name, double seam) {
    Animation animation{.kind = "test", .vertices = 6, .faces = {{0, 1, 2}, {3, 4, 5}}, .file_face = {0, 1}};
    animation.motion.frames = 1;
    animation.motion.pose = [seam](std::size_t, std::span<Point> positions) {
      const Point corners[]{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {seam, 0, 0}, {2, 0, 0}, {2, 1, 0}};
      std::ranges::copy(corners, positions.begin());
    };
    write_animation(folder.path() / name, animation);
    return folder.path() / name;
  };
  const auto motion = read_mesh_sequence({squares("0.glb", 1), squares("1.glb", 1.5)}, 6);
  std::vector<Point> positions(6);
  motion.pose(0, positions);
  try {
    motion.pose(1, positions);
    ADD_FAILURE() << "expected an error";
  } catch (const Bad_motion& error) {
    EXPECT_NE(std::string(error.what()).find("in each of these files, vertices that are alike are joined"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace lodestone::test
