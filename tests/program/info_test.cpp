// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "program/run_program.h"
#include "support/gltf_samples.h"
#include "support/mesh_samples.h"
#include "support/scene_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

using Json = nlohmann::json;

/// The square with a triangle through it, an unused vertex, a duplicate vertex, and a zero-area face.
const std::string trouble =
    "OFF\n9 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.7 0.2 -1\n0.7 0.2 1\n0.8 0.2 1\n5 5 5\n0 0 0\n"
    "3 0 1 2\n3 0 2 3\n3 4 5 6\n3 0 8 1\n";

class Info : public testing::Test {
 protected:
  static Json info(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "info");
    arguments.emplace_back("--json");
    const auto result = run_program(arguments);
    expect_success(result);
    return Json::parse(result.out);
  }
  std::string write(const std::string& name, const std::string& bytes) const {
    return folder.write(name, bytes).string();
  }

  Temporary_folder folder;
};

TEST_F(Info, of_a_mesh_reports_its_defects) {
  const Json found = info({write("a.off", trouble)});
  EXPECT_EQ(found["kind"], "mesh");
  EXPECT_EQ(found["frames"], 1);
  const Json& object = found["objects"].at(0);
  EXPECT_EQ(object["vertices"], 9);
  EXPECT_EQ(object["faces"], 4);
  EXPECT_EQ(object["components"], 2);
  EXPECT_EQ(object["closed"], false);
  EXPECT_EQ(object["border_edges"], 8);
  EXPECT_EQ(object["non_manifold_edges"], 0);
  EXPECT_EQ(object["degenerate_faces"], 1);
  EXPECT_EQ(object["duplicate_vertices"], 1);
  EXPECT_EQ(object["unused_vertices"], 1);
  EXPECT_EQ(object["self_intersections"], 1);
  EXPECT_EQ(object["box"], Json({{0, 0, -1}, {1, 1, 1}}));
}

/// Parallel triangles, tilted and so close together that the boxes of all overlap.
std::string stack_of_triangles(int faces) {
  std::string bytes = "OFF\n" + std::to_string(3 * faces) + " " + std::to_string(faces) + " 0\n";
  for (int face = 0; face < faces; ++face)
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis)
        bytes += std::to_string(face + (axis == corner ? 2'000'000 : -1'000'000)) + (axis == 2 ? "\n" : " ");
  for (int v = 0; v < 3 * faces; v += 3)
    bytes += "3 " + std::to_string(v) + " " + std::to_string(v + 1) + " " + std::to_string(v + 2) + "\n";
  return bytes;
}

TEST_F(Info, that_is_interrupted_reports_nothing) {
  using Clock = std::chrono::steady_clock;
  using std::chrono::milliseconds;
  Program_result result;
  milliseconds left{0};  // until it ended
  // A fast machine needs more faces to be still at work.
  for (int faces = 20'000; faces <= 160'000 && result.exit_code != 130 && left < milliseconds(200); faces *= 2) {
    Running_program program({"info", write("a.off", stack_of_triangles(faces))});
    std::this_thread::sleep_for(milliseconds(700));
    const auto sent = Clock::now();
    program.send(SIGINT);
    result = program.wait();
    left = std::chrono::duration_cast<milliseconds>(Clock::now() - sent);
  }
  expect_error(result, 130, "interrupted");
}

TEST_F(Info, as_text_reports_the_same) {
  const auto result = run_program({"info", write("a.off", trouble)});
  expect_success(result);
  for (const std::string part : {"a.off", "open", "degenerate faces", "(0 0 -1) to (1 1 1)"})
    EXPECT_NE(result.out.find(part), std::string::npos) << part << "\n" << result.out;
}

TEST_F(Info, of_a_closed_mesh_reports_that_it_is_closed) {
  const Json object = info({write("a.off", tetrahedron_off())})["objects"].at(0);
  EXPECT_EQ(object["closed"], true);
  EXPECT_EQ(object["self_intersections"], 0);
}

TEST_F(Info, faces_that_meet_in_an_edge_of_three_do_not_intersect) {
  const Json object = info({write("a.off",
                                  "OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n"
                                  "3 0 1 2\n3 0 1 3\n3 0 1 4\n")})["objects"]
                          .at(0);
  EXPECT_EQ(object["non_manifold_edges"], 1);
  EXPECT_EQ(object["self_intersections"], 0);
}

TEST_F(Info, reads_a_point_cache_with_and_without_its_mesh) {
  const auto cache =
      write("a.mdd", packed<std::int32_t>({2, 4}, std::endian::big) + packed<float>({0, 0.04}, std::endian::big) +
                         packed<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 7}, std::endian::big) +
                         packed<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 9}, std::endian::big));
  const Json alone = info({cache});
  EXPECT_EQ(alone["kind"], "mdd");
  EXPECT_EQ(alone["frames"], 2);
  EXPECT_NEAR(alone["frames_per_second"].get<double>(), 25, 1e-4);
  EXPECT_EQ(alone["objects"][0]["vertices"], 4);
  EXPECT_EQ(alone["objects"][0]["box"], Json({{0, 0, 0}, {1, 1, 7}}));
  EXPECT_FALSE(alone["objects"][0].contains("faces"));
  const Json both = info({cache, "--mesh", write("a.off", square_off)});
  EXPECT_EQ(both["objects"][0]["faces"], 2);
  EXPECT_EQ(both["objects"][0]["box"], alone["objects"][0]["box"]);
}

TEST_F(Info, reads_a_sequence_a_gltf_file_and_a_scene) {
  write("f1.off", square_off);
  write("f2.off", square_off);
  EXPECT_EQ(info({(folder.path() / "f*.off").string()})["frames"], 2);
  const Json gltf = info({write("a.glb", rich_gltf().glb())});
  EXPECT_EQ(gltf["kind"], "gltf");
  EXPECT_EQ(gltf["frames"], 61);
  EXPECT_EQ(gltf["objects"][0]["faces"], 2);
  const Json scene = info({write("scene.json", R"({"frames": 5, "objects": [{"name": "one", "mesh": "f1.off"},
    {"name": "two", "shape": {"icosphere": {"frequency": 2}}, "motion": {"deform": [{"spin": {}}]}}]})")});
  EXPECT_EQ(scene["kind"], "scene");
  EXPECT_EQ(scene["frames"], 5);
  EXPECT_EQ(scene["objects"].size(), 2U);
  EXPECT_EQ(scene["objects"][1]["name"], "two");
  EXPECT_EQ(scene["objects"][1]["faces"], 80);
  EXPECT_EQ(scene["objects"][1]["closed"], true);
}

TEST_F(Info, lists_the_animations_of_a_gltf_file) {
  const auto file = write("walk.glb", square_with_two_animations().glb());
  const Json object = info({file})["objects"].at(0);
  EXPECT_EQ(object["animations"], Json({"idle", "walk"}));
  EXPECT_EQ(object["played_animation"], 0);
  const auto text = run_program({"info", file}).out;
  EXPECT_NE(text.find("| 'idle', 'walk' "), std::string::npos) << text;
  EXPECT_FALSE(info({write("a.off", square_off)})["objects"].at(0).contains("animations"));
  auto unnamed = square_with_two_animations();
  unnamed.json["animations"].erase(1);
  unnamed.json["animations"][0].erase("name");
  EXPECT_NE(run_program({"info", write("unnamed.glb", unnamed.glb())}).out.find("| 0 (unnamed) "), std::string::npos);
  auto foreign = square_with_two_animations();
  const std::string rig = "CharacterArmature:CharacterArmature:CharacterArmature:";
  foreign.json["animations"][0]["name"] = "歩く";
  foreign.json["animations"][1]["name"] = rig + "Walk";
  const auto names = run_program({"info", write("foreign.glb", foreign.glb())}).out;
  EXPECT_NE(names.find("| '歩く', '" + rig + "Walk' "), std::string::npos) << names;
  foreign.json["animations"][0]["name"] = "\x1b[2J" + std::string(300, 'x');
  const auto hostile = run_program({"info", write("hostile.glb", foreign.glb())}).out;
  EXPECT_NE(hostile.find("'?[2J" + std::string(196, 'x') + "...'"), std::string::npos) << hostile;
  const auto scene = write("scene.json", R"({"objects": [{"name": "a", "mesh": "walk.glb",
    "motion": {"gltf": {"file": "walk.glb", "animation": "walk"}}}]})");
  EXPECT_EQ(info({scene})["objects"].at(0)["played_animation"], 1);
}

TEST_F(Info, lists_what_a_file_holds_and_the_library_does_not_read) {
  auto sample = square_with_two_animations();
  sample.json["materials"] = Json::array({Json::object()});
  sample.json["nodes"][0]["extensions"] = {{"EXT_mesh_gpu_instancing", {{"attributes", Json::object()}}}};
  const auto moved = [](const char* pointer) {
    return Json{{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
  };
  sample.json["animations"][1]["channels"][0]["target"] = moved("/nodes/0/translation");
  const auto file = write("copies.glb", sample.glb());
  const Json unread{"EXT_mesh_gpu_instancing", "KHR_animation_pointer", "materials"};
  EXPECT_EQ(info({file})["objects"].at(0)["not_read"], unread);
  const auto text = run_program({"info", file}).out;
  EXPECT_NE(text.find("EXT_mesh_gpu_instancing, KHR_animation_pointer, materials"), std::string::npos) << text;
  sample.json["animations"][1]["channels"][0]["target"] = moved("/materials/0/alphaCutoff");
  sample.json["nodes"][0]["extensions"] = {{"KHR_node_visibility", {{"visible", false}}}};
  const Json hidden{"KHR_node_visibility", "materials"};
  EXPECT_EQ(info({write("hidden.glb", sample.glb())})["objects"].at(0)["not_read"], hidden);
  sample.json["nodes"][0]["extensions"] = {{"KHR_node_visibility", {{"visible", true}}}};
  EXPECT_EQ(info({write("faded.glb", sample.glb())})["objects"].at(0)["not_read"], Json{"materials"});
  EXPECT_FALSE(info({write("a.off", square_off)})["objects"].at(0).contains("not_read"));
}

TEST_F(Info, reads_an_object_of_a_scene_and_a_built_in_shape) {
  write("a.off", square_off);
  const auto scene = write("scene.json", R"({"frames": 5, "objects": [
    {"name": "square", "mesh": "a.off", "place": {"translate": [5, 0, 0]}},
    {"name": "ball", "shape": {"icosphere": {"frequency": 2}}, "motion": {"deform": [{"spin": {}}]}}]})");
  const Json square = info({scene + "#square"});
  EXPECT_EQ(square["kind"], "object");
  EXPECT_EQ(square["objects"].size(), 1U);
  EXPECT_EQ(square["objects"][0]["name"], "square");
  EXPECT_EQ(square["objects"][0]["box"][0][0], 5);
  const Json ball = info({scene + "#ball"});
  EXPECT_EQ(ball["frames"], 5);
  EXPECT_EQ(ball["objects"][0]["faces"], 80);
  EXPECT_EQ(info({"shape:teapot"})["objects"][0]["faces"], 5680);
  expect_error(run_program({"info", scene + "#kettle"}), 2,
               "the scene has no object 'kettle'; its objects are square, ball");
  expect_error(run_program({"info", "shape:kettle"}), 3, "teapot");
}

TEST_F(Info, refuses_a_mesh_beside_what_is_no_point_cache) {
  const auto mesh = write("a.off", square_off);
  const auto scene = write("scene.json", R"({"objects": [{"name": "square", "mesh": "a.off"}]})");
  for (const auto& input : {mesh, scene, scene + "#square", std::string("shape:teapot")})
    expect_error(run_program({"info", input, "--mesh", mesh}), 2, "only a point cache needs a mesh");
}

/// An outward cube of quads, a tetrahedron that looks inward, and an open triangle.
const std::string three_bodies =
    "OFF\n15 11 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
    "5 0 0\n6 0 0\n5 1 0\n5 0 1\n9 0 0\n9 1 0\n9 0 1\n"
    "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n"
    "3 8 9 10\n3 8 11 9\n3 9 11 10\n3 8 10 11\n3 12 13 14\n";

TEST_F(Info, says_to_which_side_the_faces_of_each_component_look) {
  const auto file = write("a.off", three_bodies);
  const Json object = info({file})["objects"].at(0);
  EXPECT_EQ(object["orientation"], Json({{"outward", 1}, {"inward", 1}, {"open", 1}}));
  EXPECT_EQ(object["component_list"], Json::parse(R"([{"first_face": 0, "faces": 6, "orientation": "outward"},
    {"first_face": 6, "faces": 4, "orientation": "inward"}, {"first_face": 10, "faces": 1, "orientation": "open"}])"));
  EXPECT_FALSE(object.contains("component_list_capped"));
  const auto table = run_program({"info", file});
  EXPECT_NE(table.out.find("1 component outward, 1 inward (first face 6), 1 open and consistent (first face 10)"),
            std::string::npos)
      << table.out;
  EXPECT_NE(run_program({"info", write("b.off", tetrahedron_off())}).out.find("| outward"), std::string::npos);
}

TEST_F(Info, of_a_surface_in_thousands_of_pieces_lists_a_thousand_of_them) {
  std::string off = "OFF\n3003 1001 0\n", faces;
  for (int i = 0; i < 1001; ++i) {
    off += "0 0 " + std::to_string(i) + "\n1 0 0\n0 1 0\n";
    faces += "3 " + std::to_string(3 * i) + " " + std::to_string(3 * i + 1) + " " + std::to_string(3 * i + 2) + "\n";
  }
  const Json object = info({write("a.off", off + faces)})["objects"].at(0);
  EXPECT_EQ(object["orientation"], Json({{"open", 1001}}));
  EXPECT_EQ(object["component_list"].size(), 1000U);
  EXPECT_EQ(object["component_list_capped"], true);
}

TEST_F(Info, gives_the_box_with_all_its_digits) {
  const auto file =
      write("a.off", "OFF\n3 1 0\n0.1234567890123456 -1e-7 0\n123456.78901234567 0 0\n0.2 1 0\n3 0 1 2\n");
  const auto table = run_program({"info", file}).out;
  EXPECT_NE(table.find("(0.1234567890123456 -1e-07 0) to (123456.78901234567 1 0)"), std::string::npos) << table;
}

TEST_F(Info, gives_the_box_of_all_frames) {
  write("f1.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0\n9 9 9\n3 0 1 2\n");
  write("f2.off", "OFF\n4 1 0\n0 0 -2\n1 0 5\n0 0.5 0\n9 9 9\n3 0 1 2\n");
  const auto pattern = (folder.path() / "f*.off").string();
  const Json object = info({pattern})["objects"].at(0);
  EXPECT_EQ(object["box"], Json({{0, 0, 0}, {1, 1, 0}}));
  EXPECT_EQ(object["box_of_all_frames"], Json({{0, 0, -2}, {1, 1, 5}}));
  const auto table = run_program({"info", pattern}).out;
  for (const std::string part :
       {"box of the first frame", "(0 0 0) to (1 1 0)", "box of all frames", "(0 0 -2) to (1 1 5)"})
    EXPECT_NE(table.find(part), std::string::npos) << part << "\n" << table;
  const Json scene = info({write("scene.json", R"({"frames": 3, "objects": [{"name": "two",
    "mesh": "f1.off", "motion": {"deform": [{"travel": {"way_points": [{"frame": 0, "at": [0, 0, 0]},
      {"frame": 2, "at": [10, 0, 0]}]}}]}}]})")});
  EXPECT_EQ(scene["objects"][0]["box"][1][0], 1);
  EXPECT_EQ(scene["objects"][0]["box_of_all_frames"][1][0], 11);
  for (int frame = 3; frame < 6; ++frame)
    write("f" + std::to_string(frame) + ".off", read_bytes(folder.path() / "f1.off"));
  const auto cut = write("cut.json", R"({"frames": 2, "objects": [{"name": "five", "mesh": "f1.off",
    "motion": {"sequence": "f#.off"}}]})");
  const auto five = run_program({"info", cut}).out;
  for (const std::string part : {"| frames                          | 5", "box of the first 2 frames"})
    EXPECT_NE(five.find(part), std::string::npos) << part << "\n" << five;
}

TEST_F(Info, of_an_unreadable_file_is_an_error) {
  expect_error(run_program({"info", write("a.off", "rubbish")}), 3, "a.off:1: ");
  expect_error(run_program({"info", write("a.glb", "glTF")}), 3, "a.glb: byte 4");
  expect_error(run_program({"info", write("a.mdd", "rubbish")}), 3, "a.mdd");
  expect_error(run_program({"info", write("a.xyz", "")}), 3, "a.xyz");
  expect_error(run_program({"info", (folder.path() / "none*.off").string()}), 3, "no file matches this");
  expect_error(run_program({"info", write("b.off", square_off), "--mesh", write("c.off", square_off)}), 2, "b.off");
  expect_error(run_program({"info"}), 2, "");
}

}  // namespace
}  // namespace lodestone::test
