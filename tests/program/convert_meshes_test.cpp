// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "lodestone/io/meshes/mesh_file.h"
#include "program/run_program.h"
#include "support/gltf_samples.h"
#include "support/mesh_samples.h"
#include "support/read_file.h"
#include "support/scene_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

/// `convert` on single meshes, shapes and objects of scenes.
class Convert_meshes : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder.path() / name).string(); }
  std::string write(const std::string& name, const std::string& bytes) const {
    return folder.write(name, bytes).string();
  }
  Mesh_file convert(const std::string& from, const std::string& to, std::vector<std::string> options = {}) const {
    options.insert(options.begin(), {"convert", from, path(to), "--quiet"});
    expect_success(run_program(options));
    return read_mesh(path(to));
  }

  Temporary_folder folder;
};

TEST_F(Convert_meshes, every_format_of_meshes_is_written) {
  const auto square = write("square.off", square_off);
  for (const auto* to : {"a.off", "a.obj", "a.ply", "a.stl", "a.gltf", "a.glb"}) {
    SCOPED_TRACE(to);
    const auto file = convert(square, to);
    ASSERT_EQ(file.mesh.number_of_faces(), 2U);
    EXPECT_EQ(file.file_vertices, 4U);
    EXPECT_EQ(file.mesh.point(Surface_mesh::Vertex_index(2)), Point(1, 1, 0));
  }
}

TEST_F(Convert_meshes, polygons_are_written_as_triangles_and_said_so) {
  const auto quad = write("quad.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n");
  const auto result = run_program({"convert", quad, path("a.obj")});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err,
            "lodestone: quad.off: 1 of 1 faces have more than three corners: cut into triangles, 2 in all\n");
  EXPECT_EQ(read_mesh(path("a.obj")).file_face.size(), 2U);
  EXPECT_EQ(run_program({"convert", quad, path("b.obj"), "--triangulate"}).exit_code, 0);
  EXPECT_EQ(read_bytes(path("b.obj")), read_bytes(path("a.obj")));
}

TEST_F(Convert_meshes, rounding_to_floats_is_said_where_it_is_coarse_for_the_size_of_the_mesh) {
  // Floats near 2^25 are four apart: corners move by up to 1, and the triangle's box has a diagonal of 25.
  const auto far = write("far.off", "OFF\n4 1 0\n33554432 0 0\n33554447 0 0\n33554432 20 0\n0 0 0\n3 0 1 2\n");
  const std::string note =
      ": coordinates are rounded to floats: by up to 1, which is 4 % of the mesh's size; move it to the origin first\n";
  for (const std::string name : {"a.stl", "a.glb", "a.gltf", "a.pc2", "a.mdd"})
    EXPECT_NE(run_program({"convert", far, path(name)}).err.find("lodestone: " + path(name) + note), std::string::npos)
        << name;
  for (const auto* exact : {"a.off", "a.obj", "a.ply"}) expect_success(run_program({"convert", far, path(exact)}));
  expect_success(run_program({"convert", far, path("b.stl"), "--quiet"}));
  // Six digits remain.
  const auto near = write("near.off", "OFF\n3 1 0\n0.1 0 0\n10.1 0 0\n0.1 10.1 0\n3 0 1 2\n");
  expect_success(run_program({"convert", near, path("b.stl")}));
}

TEST_F(Convert_meshes, what_is_not_kept_is_listed) {
  const auto rich = write("rich.obj", "mtllib a.mtl\no one\n" + square_obj + "vt 0 0\nvn 0 0 1\ng two\nusemtl red\n");
  EXPECT_EQ(run_program({"convert", rich, path("a.stl")}).err,
            "lodestone: rich.obj: not kept: groups, materials, normals, texture coordinates\n");
  const auto colours = write("colours.off", "COFF\n3 1 0\n0 0 0 1\n1 0 0 1\n0 1 0 1\n3 0 1 2\n");
  EXPECT_EQ(run_program({"convert", colours, path("a.stl")}).err, "lodestone: colours.off: not kept: colours\n");
  auto ply = square_ply();
  ply.insert(ply.find("element face"), "property float nx\n");
  for (const auto* at : {"0 0 0\n", "1 0 0\n", "1 1 0\n", "0 1 0\n"})
    ply.replace(ply.find(at), 5, std::string(at, 5) + " 7");
  EXPECT_EQ(run_program({"convert", write("normals.ply", ply), path("a.stl")}).err,
            "lodestone: normals.ply: not kept: normals\n");
  EXPECT_EQ(run_program({"convert", rich, path("b.stl"), "--quiet"}).err, "");
  auto nodes = square_gltf();
  nodes.json["nodes"].push_back({{"mesh", 0}});
  nodes.json["scenes"] = {{{"nodes", {0, nodes.json["nodes"].size() - 1}}}};
  nodes.json["meshes"][0]["primitives"].push_back(nodes.json["meshes"][0]["primitives"][0]);
  nodes.json["meshes"][0]["primitives"][1]["mode"] = 1;
  EXPECT_EQ(run_program({"convert", write("nodes.glb", nodes.glb()), path("a.stl")}).err,
            "lodestone: nodes.glb: not kept: groups, lines\n");
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  const std::string solid = "solid a\n" + facet + "endsolid a\n";
  EXPECT_EQ(run_program({"convert", write("solids.stl", solid + solid), path("a.off")}).err,
            "lodestone: solids.stl: not kept: groups\n");
  EXPECT_EQ(run_program({"convert", write("solid.stl", solid), path("a.off")}).err, "");
}

TEST_F(Convert_meshes, names_with_colons_are_read_back) {
  EXPECT_EQ(convert("shape:teapot", "run_12:30.gltf").mesh.number_of_faces(), 5680U);
  expect_error(run_program({"convert", "shape:teapot", path("a\nb.gltf")}), 2, "no control characters");
}

TEST_F(Convert_meshes, objects_of_scenes_are_converted_where_they_are_placed) {
  write("a.off", square_off);
  const auto scene = write("scene.json", R"({"objects": [
      {"name": "square", "mesh": "a.off", "place": {"translate": [5, 0, 0]}},
      {"name": "teapot", "shape": {"teapot": {}}}]})");
  const auto square = convert(scene + "#square", "square.obj");
  EXPECT_EQ(square.mesh.point(Surface_mesh::Vertex_index(0)), Point(5, 0, 0));
  EXPECT_EQ(convert(scene + "#teapot", "teapot.ply").mesh.number_of_faces(), 5680U);
  expect_error(run_program({"convert", scene, path("b.obj")}), 2, "#NAME: square, teapot");
  expect_error(run_program({"convert", scene + "#kettle", path("b.obj")}), 2,
               "no object 'kettle'; its objects are square, teapot");
}

TEST_F(Convert_meshes, built_in_shapes_are_converted) {
  EXPECT_EQ(convert("shape:teapot", "teapot.obj").mesh.number_of_faces(), 5680U);
  EXPECT_EQ(convert(R"(shape:{"icosphere": {"frequency": 2}})", "ball.stl").mesh.number_of_faces(), 80U);
  expect_error(run_program({"convert", "shape:kettle", path("b.obj")}), 3, "teapot");
  const auto mesh = write("a.off", square_off);
  expect_error(run_program({"convert", "shape:teapot", path("b.obj"), "--mesh", mesh}), 2, "only a point cache");
}

TEST_F(Convert_meshes, welding_says_if_a_later_frame_moves_apart_what_it_makes_one) {
  const std::string faces = "f 1 2 3\nf 4 5 6\n";
  write("twins_0.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 0\nv 0 1 0\n" + faces);
  write("twins_1.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 2\nv 1 1 0\nv 0 1 0\n" + faces);
  const auto error_of = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"convert", path("twins_#.obj"), path("twins.glb"), "--weld", "0"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const auto result = run_program(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.err;
  };
  const std::string told =
      "--weld makes vertices 0 and 3 (counted from 0) one, but frame 1 moves them apart by 2. The faces of both follow "
      "vertex 0\n";
  EXPECT_NE(error_of({}).find(told), std::string::npos) << error_of({});
  EXPECT_EQ(error_of({"--frames", "0"}), "") << "no frame that is written moves them apart";
  EXPECT_EQ(error_of({"--quiet"}), "");
}

TEST_F(Convert_meshes, surfaces_are_welded_subdivided_and_scaled) {
  const auto twins =
      write("twins.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0.001\nv 1 1 0.001\nv 0 1 0\nf 1 2 3\nf 4 5 6\n");
  EXPECT_EQ(convert(twins, "a.off").file_vertices, 6U);
  EXPECT_EQ(convert(twins, "a.off", {"--weld", "0.01"}).file_vertices, 4U);
  EXPECT_EQ(convert(twins, "a.off", {"--weld", "0"}).file_vertices, 6U);
  EXPECT_EQ(convert(twins, "a.off", {"--subdivide", "2"}).mesh.number_of_faces(), 32U);
  const auto large = convert(twins, "a.off", {"--weld", "0.01", "--subdivide", "1", "--scale", "10"});
  EXPECT_EQ(large.file_vertices, 9U);
  EXPECT_EQ(large.mesh.point(Surface_mesh::Vertex_index(2)), Point(10, 10, 0));
  for (const std::vector<std::string>& wrong :
       {std::vector<std::string>{"--scale", "0"}, {"--weld", "-1"}, {"--subdivide", "99"}, {"--weld", "9"}}) {
    std::vector<std::string> arguments{"convert", twins, path("b.off")};
    arguments.insert(arguments.end(), wrong.begin(), wrong.end());
    expect_error(run_program(arguments), 2, "");
  }
}

TEST_F(Convert_meshes, the_input_is_never_overwritten) {
  const auto square = write("square.off", square_off);
  std::filesystem::create_symlink(square, path("link.off"));
  expect_error(run_program({"convert", square, square}), 2, "never overwritten");
  expect_error(run_program({"convert", square, path("link.off"), "--scale", "2"}), 2, "never overwritten");
  expect_error(run_program({"convert", square, path("./nothing/../square.off")}), 2, "never overwritten");
  write("f0.off", square_off);
  write("f1.off", square_off);
  expect_error(run_program({"convert", path("f*.off"), path("f#.off")}), 2, "never overwritten");
  const auto scene = write("scene.json", R"({"objects": [{"name": "a", "mesh": "square.off"}]})");
  expect_error(run_program({"convert", scene + "#a", square}), 2, "never overwritten");
  const auto sample = square_gltf();
  const auto gltf = write("g.gltf", sample.gltf("g.bin"));
  write("g.bin", sample.bytes);
  expect_error(run_program({"convert", gltf, path("./g.gltf")}), 2, "never overwritten");
  write("h.gltf", sample.gltf("g.bin"));
  remove(folder.path() / "g.gltf");
  expect_error(run_program({"convert", path("h.gltf"), path("g.gltf")}), 2, "g.bin: is a file of the input");
  const auto still = write("still.json", R"({"objects": [{"name": "a", "mesh": "h.gltf"}]})");
  expect_error(run_program({"convert", still + "#a", path("g.gltf")}), 2, "g.bin: is a file of the input");
  for (const auto& input : {path("h.gltf"), still + "#a"})
    expect_error(run_program({"partition", input, "--regions", "2", "--json", path("g.bin")}), 2, "never overwritten");
  EXPECT_EQ(read_bytes(path("g.bin")), sample.bytes);
  EXPECT_EQ(read_bytes(square), square_off);
}

}  // namespace
}  // namespace lodestone::test
