// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "program/run_program.h"
#include "support/mesh_samples.h"
#include "support/read_file.h"
#include "support/scene_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

using Json = nlohmann::json;

/// A tetrahedron that moves from x = 3 to x = 0.25, where it meets another that rests.
class Paraview : public testing::Test {
 protected:
  Paraview() {
    folder.write("a.off", tetrahedron_off());
    scene = folder.write("scene.json", R"({"frames": 3, "objects": [
      {"name": "moving", "mesh": "a.off", "motion": {"deform": [{"travel": {"path": "linear", "way_points":
        [{"frame": 0, "at": [3, 0, 0]}, {"frame": 2, "at": [0.25, 0, 0]}]}}]}},
      {"name": "still", "mesh": "a.off"}]})");
  }
  /// A run by particles unless the options name a mode.
  void detect(const std::vector<std::string>& options) const {
    std::vector<std::string> arguments{scene.string(), "--paraview", out.string(), "--quiet"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expect_success(run_program(detect_by_particles(arguments)));
  }
  std::filesystem::path frame(const std::string& name) const { return out / "frames" / (name + ".vtp"); }

  Temporary_folder folder;
  std::filesystem::path scene, out = folder.path() / "out";
};

TEST_F(Paraview, lists_have_every_frame_with_its_time) {
  detect({});
  EXPECT_EQ(content_of(out), (std::set<std::string>{"frames", "meshes.pvd", "particles.pvd", "contacts.pvd"}));
  EXPECT_EQ(content_of(out / "frames").size(), 9U);
  for (const std::string name : {"meshes", "particles", "contacts"}) {
    const Json list = read_vtk({out / (name + ".pvd")}).at(0);
    ASSERT_EQ(list.size(), 3U);
    for (std::size_t t = 0; t < 3; ++t) {
      EXPECT_EQ(list[t][0], t);
      EXPECT_TRUE(exists(out / list[t][1].get<std::string>()));
    }
  }
}

TEST_F(Paraview, the_folder_is_named_after_the_table) {
  const auto result = run_program({"detect", scene.string(), "--paraview", out.string()});
  expect_success(result);
  EXPECT_TRUE(result.out.ends_with("ParaView: " + out.string() + "\n")) << result.out;
}

TEST_F(Paraview, meshes_have_objects_regions_and_particles) {
  detect({"--particles", "2"});
  const auto found = read_vtk({frame("meshes_0000"), frame("meshes_0002"), frame("particles_0000")});
  const Json& first = found[0];
  EXPECT_EQ(first["bounds"], Json({0, 4, 0, 1, 0, 1}));
  EXPECT_EQ(found[1]["bounds"], Json({0, 1.25, 0, 1, 0, 1}));
  EXPECT_EQ(first["points"].size(), 8U);
  EXPECT_EQ(first["polygons"][7], Json({4, 7, 6}));
  EXPECT_EQ(first["point_data"]["object"], Json({0, 0, 0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(first["point_data"]["vertex"], Json({0, 1, 2, 3, 0, 1, 2, 3}));
  EXPECT_EQ(first["cell_data"]["face"], Json({0, 1, 2, 3, 0, 1, 2, 3}));
  EXPECT_EQ(first["cell_data"]["contact"], Json({0, 0, 0, 0, 0, 0, 0, 0}));

  const Json& particles = found[2];
  EXPECT_EQ(particles["point_data"]["object"], Json({0, 0, 1, 1}));
  EXPECT_EQ(particles["vertices"].size(), 4U);
  std::size_t marked = 0;
  for (std::size_t v = 0; v < 8; ++v) {
    EXPECT_LT(first["point_data"]["region"][v].get<double>(), 2);
    if (first["point_data"]["particle"][v] == 0) continue;
    EXPECT_EQ(particles["points"][marked], first["points"][v]);
    EXPECT_EQ(particles["point_data"]["region"][marked], first["point_data"]["region"][v]);
    ++marked;
  }
  EXPECT_EQ(marked, 4U);
}

TEST_F(Paraview, mode_certified_writes_the_meshes_and_contacts_of_mode_exact) {
  const auto shown = [&](const std::string& mode) {
    expect_success(run_program({"detect", scene.string(), "--mode", mode, "--particles", "2", "--contacts", "all",
                                "--paraview", out.string(), "--quiet"}));
    return read_vtk({frame("meshes_0000"), frame("meshes_0002"), frame("contacts_0002")});
  };
  const auto certified = shown("certified");
  EXPECT_EQ(certified[1]["bounds"], Json({0, 1.25, 0, 1, 0, 1}));
  auto exact = shown("exact");
  // Objects whose positions are computed carry no particles.
  for (std::size_t i = 0; i < 2; ++i) exact[i]["point_data"]["particle"] = certified[i]["point_data"]["particle"];
  EXPECT_EQ(certified, exact);
}

TEST_F(Paraview, contacts_are_those_of_the_frame_log) {
  detect({"--mode", "exact", "--contacts", "all", "--points", "--out", (folder.path() / "log").string()});
  const auto lines = read_json_lines(folder.path() / "log" / "frames.jsonl");
  const auto found = read_vtk({frame("contacts_0000"), frame("contacts_0002"), frame("meshes_0002")});
  EXPECT_EQ(found[0]["points"].size(), 0U);

  const Json& pair = lines.at(2)["pairs"].at(0);
  const Json& contacts = found[1];
  const Json& data = contacts["cell_data"];
  std::vector<Json> cells;
  for (const auto* kind : {"vertices", "lines", "polygons"})
    cells.insert(cells.end(), contacts[kind].begin(), contacts[kind].end());
  ASSERT_EQ(cells.size(), pair["faces"].size());
  ASSERT_GT(cells.size(), 0U);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    EXPECT_EQ(data["object_a"][i], 0);
    EXPECT_EQ(data["object_b"][i], 1);
    const Json faces{data["face_a"][i].get<int>(), data["face_b"][i].get<int>()};
    const auto at = std::ranges::find(pair["faces"], faces) - pair["faces"].begin();
    ASSERT_LT(at, static_cast<std::ptrdiff_t>(pair["faces"].size()));
    Json points = Json::array();
    for (const auto& point : cells[i]) points.push_back(contacts["points"][point.get<std::size_t>()]);
    EXPECT_EQ(points, pair["points"][static_cast<std::size_t>(at)]);
    EXPECT_EQ(found[2]["cell_data"]["contact"][faces[0].get<std::size_t>()], 1);
    EXPECT_EQ(found[2]["cell_data"]["contact"][4 + faces[1].get<std::size_t>()], 1);
  }
}

TEST_F(Paraview, faces_that_are_only_near_are_joined_by_a_line) {
  scene = folder.write("apart.json", R"({"objects": [{"name": "a", "mesh": "a.off"},
    {"name": "b", "mesh": "a.off", "place": {"translate": [1.5, 0, 0]}}]})");
  detect({"--mode", "exact", "--contacts", "all", "--within", "0.6"});
  const Json contacts = read_vtk({frame("contacts_0000")}).at(0);
  ASSERT_GT(contacts["lines"].size(), 0U);
  EXPECT_EQ(contacts["bounds"], Json({1, 1.5, 0, 0, 0, 0}));
}

TEST_F(Paraview, a_run_that_fails_leaves_nothing) {
  folder.write("bad.pc2", std::string("POINTCACHE2\0", 12) + packed<std::int32_t>({1, 4}) + packed<float>({0, 1}) +
                              packed<std::int32_t>({2}) + packed<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) +
                              std::string(48, '\xff'));
  scene = folder.write("bad.json", R"({"objects": [{"name": "a", "mesh": "a.off"},
    {"name": "b", "mesh": "a.off", "motion": {"pc2": "bad.pc2"}}]})");
  expect_error(run_program({"detect", "--mode", "particles", scene.string(), "--paraview", out.string()}), 3,
               "frame 1");
  EXPECT_EQ(content_of(out), std::set<std::string>{});
}

TEST_F(Paraview, a_folder_that_cannot_be_created_is_an_error) {
  const auto file = folder.write("file", "");
  expect_error(run_program({"detect", "--mode", "particles", scene.string(), "--paraview", (file / "out").string()}), 4,
               "file");
  expect_error(run_program({"detect", "--mode", "particles", scene.string(), "--paraview", ""}), 2, "");
}

TEST_F(Paraview, a_file_in_the_place_of_a_folder_is_noticed_before_any_result_is_there) {
  create_directory(out);
  folder.write("out/frames", "");
  const auto results = folder.path() / "results";
  expect_error(run_program({"detect", scene.string(), "--paraview", out.string(), "--out", results.string()}), 4,
               "frames: is not a folder");
  EXPECT_FALSE(exists(results / "frames.jsonl"));
  EXPECT_EQ(content_of(out), (std::set<std::string>{"frames"}));
}

}  // namespace
}  // namespace lodestone::test
