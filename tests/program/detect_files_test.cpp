// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "lodestone/version.h"
#include "program/run_program.h"
#include "support/gltf_samples.h"
#include "support/mesh_samples.h"
#include "support/moving_mesh_files.h"
#include "support/scene_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

using Json = nlohmann::json;

/// Three unit squares in a row as quads, from x = 0 to 3, in the plane z = 0.
const std::string three_quads =
    "OFF\n8 3 0\n0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n3 0 0\n3 1 0\n4 0 2 3 1\n4 2 4 5 3\n4 4 6 7 5\n";
/// A triangle that cuts the third of them, near its corner (3, 0).
const std::string needle_off = "OFF\n3 1 0\n2.8 0.1 -1\n2.8 0.1 1\n2.9 0.1 1\n3 0 1 2\n";

/// `detect` on files given without a scene.
class Detect_files : public testing::Test {
 protected:
  Program_result detect(std::vector<std::string> arguments, const std::string& mode = "exact") const {
    arguments.insert(arguments.begin(), "detect");
    arguments.insert(arguments.end(), {"--mode", mode, "--contacts", "all", "--out", out.string()});
    return run_program(arguments);
  }
  std::vector<Json> frames() const { return read_json_lines(out / "frames.jsonl"); }
  std::vector<bool> collisions() const {
    std::vector<bool> result;
    for (const auto& frame : frames()) {
      bool any = false;
      for (const auto& pair : frame["pairs"]) any |= pair["collides"].get<bool>();
      result.push_back(any);
    }
    return result;
  }
  std::string write(const std::string& name, const std::string& bytes) const {
    return folder.write(name, bytes).string();
  }
  std::string path(const std::string& name) const { return (folder.path() / name).string(); }

  Temporary_folder folder;
  std::filesystem::path out = folder.path() / "out";
};

TEST_F(Detect_files, two_meshes_are_answered_without_building_anything_unless_options_need_it) {
  const auto a = write("a.off", tetrahedron_off(0)), b = write("b.off", tetrahedron_off(0));
  const auto far = write("far.off", tetrahedron_off(9));
  const std::string note = "lodestone: only --out and --html tell what was found for --points, --normals\n";
  const auto table_of = [](const Program_result& result) { return result.out.substr(0, result.out.rfind("\n\n")); };
  for (const auto& other : {b, far})
    for (const std::vector<std::string>& options :
         {std::vector<std::string>{}, {"--contacts", "all", "--points", "--normals"}, {"--contacts", "yes_no"}}) {
      std::vector<std::string> quick{"detect", a, other}, built{"detect", a, other, "--epsilon", "0.01"};
      quick.insert(quick.end(), options.begin(), options.end());
      built.insert(built.end(), options.begin(), options.end());
      const auto answer = run_program(quick), expected = run_program(built);
      EXPECT_EQ(answer.exit_code, 0);
      EXPECT_EQ(answer.err, std::ranges::count(options, "--points") == 0 ? "" : note);
      EXPECT_EQ(table_of(answer), table_of(expected));
      EXPECT_EQ(answer.out.find("to build"), std::string::npos) << answer.out;
      EXPECT_NE(expected.out.find("to build 2 objects"), std::string::npos) << expected.out;
    }
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--within", "0.1"}, {"--closest"}, {"--self"}}) {
    std::vector<std::string> arguments{"detect", a, b};
    arguments.insert(arguments.end(), options.begin(), options.end());
    EXPECT_NE(run_program(arguments).out.find("to build 2 objects"), std::string::npos);
  }
}

TEST_F(Detect_files, particles_cross_seams_and_the_program_says_so) {
  // A square of two triangles that share no vertex.
  const auto square = write("square.off", "OFF 6 2 0\n0 0 0\n1 0 0\n1 1 0\n0 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 3 4 5\n");
  const auto needle = write("needle.off", needle_off);
  const auto joined = detect({square, needle}, "particles");
  EXPECT_EQ(joined.exit_code, 0);
  EXPECT_EQ(
      joined.err,
      "lodestone: square: 2 of 6 vertices lie on others along seams: particles walk across (--open-seams: they do "
      "not)\n");
  EXPECT_EQ(read_json(out / "summary.json")["objects"].at(0)["joined_vertices"], 2);
  EXPECT_EQ(detect({square, needle, "--open-seams"}, "particles").err, "");
  EXPECT_EQ(read_json(out / "summary.json")["objects"].at(0)["joined_vertices"], 0);
  EXPECT_EQ(detect({square, needle}).err, "");
  EXPECT_EQ(detect({square, needle, "--open-seams"}).exit_code, 2);
}

TEST_F(Detect_files, a_surface_in_which_nothing_can_lie_is_told) {
  const auto square = write("square.off", "OFF 4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
  const auto body = write("body.off", tetrahedron_off());
  const std::string told =
      "lodestone: square: the surface is not closed, so nothing counts as inside it; lodestone info tells more\n";
  for (const char* option : {"--containment", "--parting"}) EXPECT_EQ(detect({square, body, option}).err, told);
  EXPECT_EQ(detect({square, body}).err, "");
}

TEST_F(Detect_files, faces_of_polygons_have_their_numbers_in_the_file) {
  const auto result = detect({write("quads.off", three_quads), write("needle.off", needle_off)});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "lodestone: quads: 3 of 3 faces have more than three corners: cut into triangles, 6 in all\n");
  EXPECT_EQ(frames().at(0)["pairs"].at(0)["faces"], Json({{2, 0}}));
  const Json object = read_json(out / "summary.json")["objects"].at(0);
  EXPECT_EQ(object["faces"], 3);
  EXPECT_EQ(object["triangles"], 6);
}

TEST_F(Detect_files, a_polygon_is_listed_once_per_triangle_that_collides) {
  // Cuts both triangles of the first quad.
  const auto across = write("across.off", "OFF\n3 1 0\n0.1 0.5 -1\n0.1 0.5 1\n0.9 0.5 1\n3 0 1 2\n");
  const auto wall = write("wall.off", "OFF\n4 1 0\n0.5 -1 -1\n0.5 2 -1\n0.5 2 1\n0.5 -1 1\n4 0 1 2 3\n");
  detect({write("quads.off", three_quads), wall, across, "--points"});
  for (const auto& pair : frames().at(0)["pairs"]) {
    for (const auto& faces : pair["faces"]) EXPECT_EQ(faces, Json({0, 0}));
    EXPECT_EQ(pair["points"].size(), pair["faces"].size());
    EXPECT_GT(pair["faces"].size(), 1U);
  }
}

TEST_F(Detect_files, face_pairs_of_polygons_are_sorted_as_the_files_number_them) {
  // A needle through each of the six triangles; the later triangles of quads come after all first ones.
  std::string corners, faces;
  int count = 0;
  for (int quad = 0; quad < 3; ++quad)
    for (const double side : {0.25, 0.75}) {
      const double x = quad + side;
      corners += fmt::format("{} {} -1\n{} {} 1\n{} {} 1\n", x, 1 - side, x, 1 - side, x + 0.01, 1 - side);
      faces += fmt::format("3 {} {} {}\n", count, count + 1, count + 2);
      count += 3;
    }
  const auto needles = write("needles.off", fmt::format("OFF\n{} {} 0\n{}{}", count, count / 3, corners, faces));
  detect({write("quads.off", three_quads), needles, "--points", "--patches"});
  const Json pair = frames().at(0)["pairs"].at(0);
  ASSERT_EQ(pair["faces"].size(), 6U);
  EXPECT_TRUE(std::ranges::is_sorted(pair["faces"]));
  for (std::size_t i = 0; i < 6; ++i) {
    const double x = pair["points"][i][0][0];
    const int quad = pair["faces"][i][0], needle = pair["faces"][i][1];
    EXPECT_EQ(needle / 2, quad);
    EXPECT_NEAR(x, quad + (needle % 2 == 0 ? 0.25 : 0.75), 0.02);
  }
  ASSERT_EQ(pair["patches"].size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(pair["patches"][i]["contacts"], Json({i}));
    EXPECT_NEAR(pair["patches"][i]["point"][0].get<double>(), pair["points"][i][0][0].get<double>(), 0.02);
  }
}

TEST_F(Detect_files, info_and_partition_count_the_faces_of_the_file) {
  const auto quads = write("quads.off", three_quads);
  const auto info = run_program({"info", quads, "--json"});
  expect_success(info);
  const Json object = Json::parse(info.out)["objects"].at(0);
  EXPECT_EQ(object["faces"], 3);
  EXPECT_EQ(object["triangles"], 6);
  EXPECT_NE(run_program({"info", quads}).out.find("faces of more than three corners"), std::string::npos);
  EXPECT_EQ(run_program({"partition", quads, "--regions", "2", "--json", path("p.json")}).exit_code, 0);
  EXPECT_EQ(read_json(path("p.json"))["faces"], 3);
}

TEST_F(Detect_files, a_numbered_sequence_is_played) {
  for (int frame = 0; frame < 4; ++frame) write("b_" + std::to_string(frame) + ".off", tetrahedron_off(3 - frame));
  expect_success(detect({path("b_*.off"), write("a.off", tetrahedron_off())}));
  EXPECT_EQ(collisions(), (std::vector<bool>{false, false, true, true}));
}

TEST_F(Detect_files, that_differ_only_in_a_number_may_be_a_pattern_without_quotes) {
  const std::string rest =
      " inputs differ only in a number; if they are frames of one object, put the pattern in quotes: '";
  std::vector<std::string> inputs{write("2_a.off", tetrahedron_off(9))};
  for (const std::string number : {"08", "09", "10"}) inputs.push_back(write("2_f" + number + ".off", square_off));
  const auto result = detect(inputs);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "lodestone: 3" + rest + path("2_f*.off") + "'\n");
  inputs.emplace_back("--quiet");
  expect_success(detect(inputs));
  // Two are too few, one file that is given three times has one number, and no pattern leaves out a number.
  expect_success(detect({inputs[1], inputs[2], write("2_f12.off", square_off)}));
  expect_success(detect({inputs[0], inputs[1], inputs[2]}));
  expect_success(detect({inputs[1], inputs[1], inputs[1]}));
}

TEST_F(Detect_files, that_move_for_different_times_are_said_to_once) {
  for (const std::string number : {"0", "1", "2"}) {
    write("long_" + number + ".off", tetrahedron_off());
    if (number != "2") write("short_" + number + ".off", tetrahedron_off());
  }
  const std::string start =
      "lodestone: the shortest motion, of short, has 2 frames, the longest, of long, has 3 frames: ";
  const auto files = detect({path("long_#.off"), path("short_#.off"), path("long_0.off")});
  EXPECT_EQ(files.exit_code, 0);
  EXPECT_EQ(files.err, start + "an object whose motion has ended keeps its last pose\n");
  EXPECT_EQ(frames().size(), 3U);
  const std::string objects = R"("objects": [
    {"name": "long", "mesh": "long_0.off", "motion": {"sequence": "long_#.off"}},
    {"name": "still", "mesh": "long_0.off"},
    {"name": "short", "mesh": "long_0.off", "motion": {"sequence": "short_#.off"}}]})";
  EXPECT_EQ(detect({write("scene.json", "{" + objects)}).err, start + "the scene ends with the shortest\n");
  EXPECT_EQ(frames().size(), 2U);
  expect_success(detect({write("scene.json", R"({"frames": 1, )" + objects)}));
  expect_success(detect({path("long_#.off"), path("short_#.off"), "--quiet"}));
  expect_success(detect({path("long_#.off"), path("long_0.off")}));
}

TEST_F(Detect_files, a_point_cache_is_played_with_its_mesh) {
  const auto mesh = write("a.off", tetrahedron_off());
  auto bytes = std::string("POINTCACHE2\0", 12) + packed<std::int32_t>({1, 4}) + packed<float>({0, 1}) +
               packed<std::int32_t>({3});
  for (const double x : {5.0, 0.25, 5.0}) bytes += packed<float>({x, 0, 0, x + 1, 0, 0, x, 1, 0, x, 0, 1});
  const auto cache = write("a.pc2", bytes);
  expect_success(detect({mesh + "+" + cache, mesh}));
  EXPECT_EQ(collisions(), (std::vector<bool>{false, true, false}));
  expect_error(detect({cache, mesh}), 2, "MESH+");
}

TEST_F(Detect_files, an_animation_of_gltf_is_played_as_long_as_info_says) {
  const auto file = write("a.glb", rich_gltf().glb());
  expect_success(detect({file, write("still.off", tetrahedron_off(50))}));
  const Json info = Json::parse(run_program({"info", file, "--json"}).out);
  EXPECT_EQ(info["frames"], 61);
  EXPECT_EQ(frames().size(), 61U);
}

TEST_F(Detect_files, say_which_extensions_of_gltf_are_left_out) {
  auto sample = square_gltf();
  sample.json["nodes"][0]["extensions"] = {{"EXT_mesh_gpu_instancing", {{"attributes", Json::object()}}}};
  const auto file = write("copies.glb", sample.glb());
  const std::string note = "copies.glb: not read: EXT_mesh_gpu_instancing, which says where surfaces are\n";
  EXPECT_EQ(detect({file, write("still.off", tetrahedron_off(9))}).err,
            "lodestone: copies: not read: EXT_mesh_gpu_instancing, which says where surfaces are\n");
  EXPECT_EQ(run_program({"convert", file, (folder.path() / "a.off").string()}).err, "lodestone: " + note);
  EXPECT_EQ(run_program({"partition", file, "--out", (folder.path() / "a.ply").string()}).err, "lodestone: " + note);
}

TEST_F(Detect_files, say_which_extensions_of_the_gltf_of_a_motion_are_left_out) {
  auto sample = square_gltf();
  write("rest.glb", sample.glb());
  sample.animate(0, "translation", sample.add_numbers({0, 0.1}), sample.add_points({0, 0, 0, 0, 0, 1}));
  sample.json["nodes"][0]["extensions"] = {{"EXT_mesh_gpu_instancing", {{"attributes", Json::object()}}}};
  write("motion.glb", sample.glb());
  const auto scene = write("scene.json", R"({"frames": 1, "objects": [
    {"name": "a", "mesh": "rest.glb", "motion": {"gltf": "motion.glb"}},
    {"name": "b", "shape": {"icosphere": {"frequency": 2}}}]})");
  EXPECT_EQ(detect({scene}).err, "lodestone: a: not read: EXT_mesh_gpu_instancing, which says where surfaces are\n");
}

TEST_F(Detect_files, of_gltf_with_several_animations_play_the_first_and_say_so_unless_a_scene_chooses) {
  const std::string note =
      ": plays the animation 'idle', the first of 2: 'idle', 'walk'; `gltf.animation` of a scene chooses another\n";
  const auto file = write("walk.glb", square_with_two_animations().glb());
  const auto result = detect({file, write("still.off", tetrahedron_off(9))});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "lodestone: walk" + note);
  // Chosen, and then sampled at the rate of the other.
  const auto scene = write("scene.json", R"({"objects": [
    {"name": "chosen", "mesh": "walk.glb", "motion": {"gltf": {"file": "walk.glb", "animation": "idle"}}},
    {"name": "first", "mesh": "walk.glb", "motion": {"gltf": {"file": "walk.glb", "frames_per_second": 10}}}]})");
  EXPECT_EQ(detect({scene}).err, "lodestone: first" + note);
  expect_success(detect({scene, "--quiet"}));
}

TEST_F(Detect_files, shapes_and_objects_of_scenes_are_inputs) {
  write("a.off", tetrahedron_off());
  const auto scene = write("scene.json", R"({"frames": 3, "objects": [{"name": "still", "mesh": "a.off"},
    {"name": "comes", "mesh": "a.off", "motion": {"deform": [{"travel": {"path": "linear", "way_points":
    [{"frame": 0, "at": [90, 0, 0]}, {"frame": 2, "at": [0, 0, 0]}]}}]}}]})");
  expect_success(detect({scene + "#comes", R"(shape:{"icosphere": {"frequency": 2}})", "shape:teapot"}));
  EXPECT_EQ(collisions().size(), 3U);
  std::vector<std::string> names;
  const Json summary = read_json(out / "summary.json");
  for (const auto& object : summary["objects"]) names.push_back(object["name"]);
  EXPECT_EQ(names, (std::vector<std::string>{"comes", "icosphere", "teapot"}));
  expect_success(detect({scene + "#comes", path("a.off")}));
  EXPECT_EQ(collisions(), (std::vector<bool>{false, false, true}));
  expect_error(detect({scene + "#gone", path("a.off")}), 2, "still, comes");
  expect_error(detect({"shape:kettle", path("a.off")}), 3, "kettle");
  expect_error(detect({"shape:teapot"}), 2, "one mesh alone");
}

TEST_F(Detect_files, components_of_an_input_are_objects_on_demand) {
  write_two_tetrahedra_in_one_mesh(path("pair"), 4);
  const std::string input = path("pair.off") + '+' + path("pair.pc2");
  expect_error(detect({input}), 2,
               "pair.pc2: one mesh alone has nothing to collide with; give a scene or two meshes, "
               "or --self for collisions with itself, or --components");
  for (const std::string mode : {"exact", "certified", "particles"}) {
    expect_success(detect({input, "--components"}, mode));
    EXPECT_EQ(collisions(), (std::vector<bool>{false, false, true, true})) << mode;
  }
  const Json pair = read_json(out / "summary.json")["pairs"][0];
  EXPECT_EQ(pair["a"], "pair_1");
  EXPECT_EQ(pair["b"], "pair_2");
  write("a.off", tetrahedron_off());
  expect_error(detect({path("a.off"), "--components"}), 2, "a.off: one connected component alone has nothing to ");
  const auto scene = write("scene.json", R"({"objects": [{"name": "both", "mesh": "pair.off"}]})");
  const auto of_scene = detect({scene, "--components"});
  expect_success(of_scene);
  EXPECT_EQ(of_scene.err.find("alone"), std::string::npos) << of_scene.err;
  EXPECT_EQ(read_json(out / "summary.json")["objects"].size(), 2U);
}

TEST_F(Detect_files, parts_of_an_input_are_objects_on_demand) {
  const auto boxes = write("boxes.obj",
                           "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 1 1 -1\nv 1 1 1\nv 0 1 1\nv 9 9 9\n"
                           "o empty\no floor\nf 1 2 3\no wall\nf 4 5 6\nf 4 6 7\n");
  expect_success(detect({boxes, "--parts"}));
  EXPECT_EQ(collisions(), std::vector<bool>{true});
  const Json pair = frames().front()["pairs"][0];
  EXPECT_EQ(pair["a"], "floor");
  EXPECT_EQ(pair["b"], "wall");
  EXPECT_EQ(pair["faces"], Json({{0, 1}, {0, 2}}));
  expect_success(detect({boxes, "--parts", "--components"}));
  const auto info = run_program({"info", boxes});
  EXPECT_NE(info.out.find("floor, wall"), std::string::npos) << info.out;
  EXPECT_EQ(info.out.find("empty"), std::string::npos) << info.out;
  expect_error(detect({write("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "--parts"}), 2,
               "itself, or --components for those between its connected components");
}

TEST_F(Detect_files, a_note_about_many_objects_names_three) {
  std::string five_quads = "OFF\n20 5 0\n", faces;
  for (int quad = 0; quad < 5; ++quad) {
    five_quads += fmt::format("{0} 0 0\n{0} 1 0\n{1} 1 0\n{1} 0 0\n", 2 * quad, 2 * quad + 1);
    faces += fmt::format("4 {} {} {} {}\n", 4 * quad, 4 * quad + 1, 4 * quad + 2, 4 * quad + 3);
  }
  const auto result = run_program({"detect", write("quads.off", five_quads + faces), "--components"});
  EXPECT_EQ(result.exit_code, 0);
  const std::string note = ": 1 of 1 faces have more than three corners: cut into triangles, 2 in all\n";
  EXPECT_EQ(result.err, "lodestone: quads_1" + note + "lodestone: quads_2" + note + "lodestone: quads_3" + note +
                            "lodestone: the same holds for 2 more objects\n");
}

TEST_F(Detect_files, the_summary_names_the_command_and_the_files_of_each_object) {
  const auto a = write("a.off", tetrahedron_off());
  expect_success(detect({a, "shape:teapot"}));
  const Json summary = read_json(out / "summary.json");
  EXPECT_EQ(summary["command"], Json({"detect", a, "shape:teapot", "--mode", "exact", "--contacts", "all"}));
  EXPECT_EQ(summary["version"], version());
  EXPECT_FALSE(summary["revision"].get<std::string>().empty());
  EXPECT_EQ(summary["objects"][0]["files"], Json({a}));
  EXPECT_EQ(summary["objects"][1]["files"], Json::array());
}

TEST_F(Detect_files, a_scene_of_one_object_gets_a_note_unless_its_own_faces_are_asked_about) {
  write("a.off", tetrahedron_off());
  const auto scene = write("scene.json", R"({"objects": [{"name": "a", "mesh": "a.off"}]})");
  const std::string note = "scene.json: one object alone has nothing to collide with; add another to the scene";
  const auto alone = run_program({"detect", scene}), within = run_program({"detect", scene, "--self"});
  EXPECT_EQ(alone.exit_code, 0);
  EXPECT_NE(alone.err.find(note), std::string::npos) << alone.err;
  EXPECT_NE(alone.out.find("\n\nThere is no pair of objects.\n\n"), std::string::npos) << alone.out;
  expect_success(within);
  EXPECT_EQ(within.err.find(note), std::string::npos);
}

TEST_F(Detect_files, outside_the_folder_of_the_scene_are_used_if_allowed) {
  create_directory(folder.path() / "scenes");
  write("a.off", tetrahedron_off());
  const auto scene = write("scenes/scene.json", R"({"objects": [{"name": "a", "mesh": "../a.off"},
                                                                 {"name": "b", "mesh": "../a.off"}]})");
  expect_error(detect({scene}), 3, "not inside");
  expect_success(detect({scene, "--allow-outside"}));
  expect_error(detect({scene + "#a", path("a.off")}), 3, "not inside");
  expect_success(detect({scene + "#a", path("a.off"), "--allow-outside"}));
  expect_success(run_program({"info", scene, "--allow-outside"}));
  expect_success(run_program({"convert", scene + "#a", path("b.off"), "--allow-outside", "--quiet"}));
}

TEST_F(Detect_files, with_more_faces_than_allowed_are_refused_by_every_command) {
  write("a.off", tetrahedron_off());
  write("step_1.off", tetrahedron_off());
  write("step_2.off", tetrahedron_off());
  const auto scene = write("scene.json", R"({"objects": [{"name": "a", "mesh": "a.off"},
                                                          {"name": "b", "mesh": "a.off"}]})");
  const auto a = path("a.off");
  const std::vector<std::vector<std::string>> commands{{"detect", a, a},
                                                       {"detect", scene},
                                                       {"detect", scene + "#a", a},
                                                       {"detect", path("step_#.off"), path("step_#.off")},
                                                       {"info", a},
                                                       {"info", scene},
                                                       {"partition", a, "--regions", "1"},
                                                       {"convert", a, path("b.obj"), "--quiet"}};
  for (auto command : commands) {
    SCOPED_TRACE(testing::PrintToString(command));
    command.insert(command.end(), {"--max-faces", "3"});
    expect_error(run_program(command), 3, "at most 3 are allowed");
    command.back() = "4";
    expect_success(run_program(command));
    command.insert(command.end(), {"--max-bytes", "10"});
    expect_error(run_program(command), 3, "bytes, where at most 10 are allowed");
    command.back() = "1KB";
    expect_success(run_program(command));
  }
}

TEST_F(Detect_files, with_more_objects_or_frames_than_allowed_are_refused) {
  write("a.off", tetrahedron_off());
  const auto scene = write("scene.json", R"({"frames": 3, "objects": [{"name": "a", "mesh": "a.off"},
                                                                       {"name": "b", "mesh": "a.off"}]})");
  for (const auto& [option, most, part] : {std::tuple{"--max-objects", 2, "/objects"},
                                           {"--max-scene-faces", 8, "8 faces together, where at most 7"},
                                           {"--max-frames", 3, "/frames: 3 is not a whole number from 1 to 2"}}) {
    SCOPED_TRACE(option);
    expect_success(detect({scene, option, std::to_string(most)}));
    expect_error(detect({scene, option, std::to_string(most - 1)}), 3, part);
    expect_success(run_program({"info", scene, option, std::to_string(most)}));
    expect_error(run_program({"info", scene, option, std::to_string(most - 1)}), 3, part);
    expect_error(detect({scene, option, "0"}), 2, option);
  }
  for (const std::string size : {"10XB", "0", "-1", "1.5GB", "MB", "18446744073709551616", "99999999TB"})
    expect_error(detect({scene, "--max-bytes", size}), 2, "a size of 1 byte or more, such as 200MB, found '" + size);
}

}  // namespace
}  // namespace lodestone::test
