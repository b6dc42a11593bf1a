// SPDX-License-Identifier: GPL-3.0-or-later
// What glTF files hold: containers, faces, numbers; as parts of scenes.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "io/gltf/gltf_files.h"
#include "lodestone/io/meshes/mesh_file.h"
#include "lodestone/io/motion/animation.h"
#include "lodestone/mesh/errors.h"
#include "support/scene_samples.h"

namespace lodestone::test {
namespace {

using Json = nlohmann::json;

// Containers

TEST_F(Gltf, text_binary_and_separate_buffer_give_the_same_scene) {
  const auto sample = square_gltf();
  folder.write("own buffer.bin", sample.bytes + "more");
  for (const auto& file : {folder.write("a.glb", sample.glb()), folder.write("a.gltf", sample.gltf()),
                           folder.write("b.gltf", sample.gltf("own%20buffer.bin")),
                           folder.write("d.gltf", sample.gltf("data:;base64," + base64(sample.bytes))),
                           folder.write("e.gltf", sample.gltf("data:a/b;c=d;base64," + base64(sample.bytes))),
                           folder.write("c.GLTF", sample.gltf("./own buffer.bin"))}) {
    const auto mesh = read_mesh(file);
    EXPECT_EQ(mesh.file_vertices, 4U);
    EXPECT_EQ(mesh.mesh.number_of_faces(), 2U);
    for (const auto v : mesh.mesh.vertices()) EXPECT_EQ(mesh.mesh.point(v), square_points[mesh.file_vertex[v]]);
  }
}

TEST_F(Gltf, images_are_ignored) {
  auto sample = square_gltf();
  sample.json["images"] = {{{"uri", "none.png"}}, {{"uri", "data:image/png;base64,rubbish"}}};
  sample.json["textures"] = {{{"source", 99}}};
  sample.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 77}}}}}}};
  expect_near(at_rest(sample), square_points);
}

// Faces

TEST_F(Gltf, vertices_duplicated_at_a_seam_are_joined) {
  auto sample = square_gltf();
  auto& primitive = sample.json["meshes"][0]["primitives"][0];
  primitive["attributes"]["POSITION"] = sample.add_points({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0});
  primitive.erase("indices");
  const auto mesh = read_mesh(write(sample));
  EXPECT_EQ(mesh.file_vertices, 6U);
  EXPECT_EQ(mesh.mesh.number_of_vertices(), 4U);
  EXPECT_EQ(mesh.file_vertex, (std::vector<std::uint32_t>{0, 1, 2, 5}));
  EXPECT_EQ(read_animation(write(sample)).faces, (std::vector<Corners>{{0, 1, 2}, {0, 2, 5}}));
}

TEST_F(Gltf, vertices_that_separate_in_motion_stay_two) {
  auto sample = square_gltf();
  auto& primitive = sample.json["meshes"][0]["primitives"][0];
  primitive["attributes"]["POSITION"] = sample.add_points({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0});
  primitive.erase("indices");
  primitive["targets"] = {{{"POSITION", sample.add_points({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0})}}};
  EXPECT_EQ(read_animation(write(sample)).faces, (std::vector<Corners>{{0, 1, 2}, {3, 2, 5}}));
}

TEST_F(Gltf, strips_and_fans_become_triangles) {
  auto sample = square_gltf();
  auto& primitive = sample.json["meshes"][0]["primitives"][0];
  primitive["indices"] = sample.add_indices({0, 1, 3, 2});
  primitive["mode"] = 5;
  EXPECT_EQ(read_animation(write(sample)).faces, (std::vector<Corners>{{0, 1, 3}, {1, 2, 3}}));
  primitive["indices"] = sample.add_indices({3, 0, 1, 2});
  primitive["mode"] = 6;
  EXPECT_EQ(read_animation(write(sample)).faces, (std::vector<Corners>{{3, 0, 1}, {3, 1, 2}}));
}

TEST_F(Gltf, points_and_lines_have_no_faces) {
  auto sample = square_gltf();
  auto primitive = sample.json["meshes"][0]["primitives"][0];
  for (const int mode : {0, 1, 2, 3}) {
    primitive["mode"] = mode;
    sample.json["meshes"][0]["primitives"].push_back(primitive);
  }
  EXPECT_EQ(read_animation(write(sample)).faces, (std::vector<Corners>{{0, 1, 2}, {0, 2, 3}}));
}

TEST_F(Gltf, one_mesh_at_two_nodes_appears_twice) {
  auto sample = square_gltf();
  sample.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {0, 0, 5}}}, {{"mesh", 0}}};
  sample.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {0, 1}}}};
  sample.json["scene"] = 1;
  auto expected = square_points;
  for (const Point& p : square_points) expected.emplace_back(p.x(), p.y(), 5);
  expect_near(at_rest(sample), expected);
  EXPECT_EQ(read_mesh(write(sample)).mesh.number_of_faces(), 4U);
}

TEST_F(Gltf, nodes_that_mirror_a_mesh_turn_its_faces_round) {
  auto sample = square_gltf();
  const std::vector<Corners> as_they_are{{0, 1, 2}, {0, 2, 3}}, turned{{0, 2, 1}, {0, 3, 2}};
  const auto faces_at = [&](const Json& node, const Json& parent) {
    sample.json["nodes"] = {node, parent};
    sample.json["nodes"][0]["mesh"] = 0;
    sample.json["nodes"][1]["children"] = {0};
    sample.json["scenes"] = {{{"nodes", {1}}}};
    return read_animation(write(sample)).faces;
  };
  const Json plain = Json::object(), scaled{{"scale", {-1, 2, 1}}}, twice{{"scale", {-1, -2, 1}}};
  const Json matrix{{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1}}};
  EXPECT_EQ(faces_at(plain, plain), as_they_are);
  EXPECT_EQ(faces_at(scaled, plain), turned);
  EXPECT_EQ(faces_at(plain, matrix), turned);
  EXPECT_EQ(faces_at(scaled, matrix), as_they_are);
  EXPECT_EQ(faces_at(twice, plain), as_they_are);
}

TEST_F(Gltf, skins_turn_faces_round_where_their_joints_mirror_them) {
  auto sample = rich_gltf();
  sample.json.erase("animations");
  sample.json["nodes"][0].erase("children");
  sample.json["nodes"].push_back({{"children", {0, 1}}});
  sample.json["scenes"] = {{{"nodes", {3}}}};
  const auto turns = [&](std::size_t node, double scale) {
    auto changed = sample;
    changed.json["nodes"][node]["scale"] = {scale, 1, 1};
    return read_animation(write(changed)).faces.front() == Corners{0, 2, 1};
  };
  EXPECT_FALSE(turns(3, 1));
  EXPECT_TRUE(turns(3, -1)) << "the joints are below this node";
  EXPECT_FALSE(turns(0, -1)) << "of the skin; the joints are not below it";
  EXPECT_TRUE(turns(1, -1)) << "both joints";
  EXPECT_FALSE(turns(2, -1)) << "one joint of two";
  sample.json["skins"][0]["inverseBindMatrices"] =
      sample.add_floats("MAT4", 16, {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,  //
                                     -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1});
  EXPECT_TRUE(turns(3, 1));
  EXPECT_FALSE(turns(3, -1)) << "both mirror";
}

TEST_F(Gltf, what_exporters_leave_behind_moves_nothing) {
  auto sample = square_gltf();
  sample.animate(0, "translation", sample.add_numbers({0, 1}), sample.add_points({0, 0, 0, 0, 0, 9}));
  sample.animate(0, "weights", sample.add_numbers({0, 1}), sample.add_numbers({0, 1}));  // of a mesh without targets
  sample.json["animations"].push_back({{"name", "Take 001"}, {"channels", Json::array()}, {"samplers", Json::array()}});
  sample.json["meshes"][0]["weights"] = sample.json["nodes"][0]["weights"] = Json::array();
  expect_near(at(sample, 1), moved([](double x, double y, double z) { return Point(x, y, z + 9); }));
}

// Numbers

TEST_F(Gltf, normalized_integers_and_strides_are_read) {
  auto sample = square_gltf();
  const auto view =
      sample.add_view(packed<std::int16_t>({0, 0, 0, 99, 32767, 0, 0, 99, 32767, 32767, 0, 99, 0, 32767, -32768, 99}));
  sample.json["bufferViews"][view]["byteStride"] = 8;
  sample.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = sample.add_accessor(
      {{"bufferView", view}, {"componentType", 5122}, {"normalized", true}, {"count", 4}, {"type", "VEC3"}});
  sample.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  expect_near(at_rest(sample), {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, -1}});
}

TEST_F(Gltf, sparse_values_have_offsets_and_may_be_normalized) {
  auto sample = square_gltf();
  const auto view =
      sample.add_view(packed<std::int16_t>({0, 0, 0, 99, 32767, 0, 0, 99, 32767, 32767, 0, 99, 0, 32767, 0, 99}));
  sample.json["bufferViews"][view]["byteStride"] = 8;
  const auto indices = sample.add_view(packed<std::uint8_t>({0, 0, 1, 3}));
  const auto values = sample.add_view(packed<std::int16_t>({7, 7, 0, 0, 32767, 0, 0, -32767}));
  const Json sparse{{"count", 2},
                    {"indices", {{"bufferView", indices}, {"byteOffset", 2}, {"componentType", 5121}}},
                    {"values", {{"bufferView", values}, {"byteOffset", 4}}}};
  sample.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = sample.add_accessor({{"bufferView", view},
                                                                                             {"componentType", 5122},
                                                                                             {"normalized", true},
                                                                                             {"count", 4},
                                                                                             {"type", "VEC3"},
                                                                                             {"sparse", sparse}});
  sample.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  const auto points = at_rest(sample);
  EXPECT_EQ(points.at(0), Point(0, 0, 0));
  EXPECT_EQ(points.at(1), Point(0, 0, 1));
  EXPECT_EQ(points.at(3), Point(0, 0, -1));
}

TEST_F(Gltf, a_sparse_accessor_may_hold_all_that_is_stored) {
  auto sample = square_gltf();
  const auto indices = sample.add_view(packed<std::uint8_t>({0, 1, 2, 3, 4, 5, 6}));
  const auto values = sample.add_view(packed<float>({9, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 5, 5, 5, 5, 5, 5, 5, 5, 5}));
  sample.json["accessors"][0] = {{"componentType", 5126},
                                 {"count", 7},
                                 {"type", "VEC3"},
                                 {"sparse",
                                  {{"count", 7},
                                   {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                   {"values", {{"bufferView", values}}}}}};
  EXPECT_EQ(at_rest(sample).at(0), Point(9, 0, 0));
}

TEST_F(Gltf, what_programs_add_for_themselves_may_be_nested_deeply) {
  auto sample = square_gltf();
  nlohmann::json extras = 1;
  for (int level = 0; level < 100; ++level) extras = {{"inner", extras}};
  sample.json["extras"] = extras;
  expect_near(at_rest(sample), at_rest(square_gltf()));
}

TEST_F(Gltf, a_primitive_without_positions_shows_nothing) {
  auto sample = square_gltf();
  auto empty = sample.json["meshes"][0]["primitives"][0];
  empty["attributes"].erase("POSITION");
  sample.json["meshes"][0]["primitives"].push_back(empty);
  expect_near(at_rest(sample), at_rest(square_gltf()));
}

TEST_F(Gltf, sparse_accessors_replace_the_elements_they_name) {
  auto sample = square_gltf();
  const auto indices = sample.add_view(packed<std::uint8_t>({1, 3}));
  const auto values = sample.add_view(packed<float>({5, 5, 5, 6, 6, 6}));
  sample.json["accessors"][0]["sparse"] = {{"count", 2},
                                           {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                           {"values", {{"bufferView", values}}}};
  expect_near(at_rest(sample), {{0, 0, 0}, {5, 5, 5}, {1, 1, 0}, {6, 6, 6}});
}

// Scenes

TEST_F(Gltf, can_be_mesh_and_motion_of_a_scene) {
  folder.write("a.gltf", rich_gltf().gltf());
  auto scene = read(folder, with_object(R"("mesh": "a.gltf", "place": {"translate": [0, 0, 7]},
    "motion": {"gltf": {"file": "a.gltf", "animation": "walk", "frames_per_second": 10}})"));
  EXPECT_EQ(scene.frames, 21U);
  pose(scene.objects[0], 10);
  const auto& mesh = scene.objects[0].mesh;
  EXPECT_NEAR(mesh.point(Surface_mesh::Vertex_index(0)).z(), 8, 1e-6);
  EXPECT_EQ(read(folder, with_object(R"("mesh": "a.gltf", "motion": {"gltf": "a.gltf"})")).frames, 61U);
  EXPECT_THROW(
      read(folder, with_object(R"("mesh": "a.gltf", "motion": {"gltf": {"file": "a.gltf", "animation": "x"}})")),
      Bad_motion);
}

}  // namespace
}  // namespace lodestone::test
