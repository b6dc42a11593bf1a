// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "lodestone/io/meshes/mesh_file.h"
#include "lodestone/io/motion/animation.h"
#include "lodestone/io/results/coloured_ply.h"
#include "lodestone/io/shapes/shapes.h"
#include "program/run_program.h"
#include "support/gltf_samples.h"
#include "support/mesh_samples.h"
#include "support/scene_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

using Json = nlohmann::json;

/// Of a mesh written as PLY with colours: per vertex its region.
std::vector<int> regions_in(const std::filesystem::path& ply, std::size_t vertices) {
  const auto bytes = read_bytes(ply);
  constexpr std::size_t vertex_bytes = 3 * 8 + 3 + 4, region_at = 3 * 8 + 3;
  const auto start = bytes.find("end_header\n") + 11;
  std::vector<int> regions;
  for (std::size_t v = 0; v < vertices; ++v)
    regions.push_back(static_cast<unsigned char>(bytes.at(start + v * vertex_bytes + region_at)));
  return regions;
}

class Partition_program : public testing::Test {
 protected:
  Partition_program() {
    const auto sphere = icosphere(8);
    write_coloured_ply(mesh, sphere, std::vector<Region_index>(sphere.number_of_vertices(), 0));
  }

  Program_result divide(std::vector<std::string> options) const {
    options.insert(options.begin(), {"partition", mesh.string()});
    options.insert(options.end(), {"--out", ply.string(), "--json", json.string()});
    return run_program(options);
  }
  void expect_no_results() const {
    EXPECT_FALSE(exists(ply));
    EXPECT_FALSE(exists(json));
  }

  static constexpr int vertices = 10 * 8 * 8 + 2, faces = 20 * 8 * 8;  // of an icosphere of frequency 8
  Temporary_folder folder;
  std::filesystem::path mesh = folder.path() / "sphere.ply";
  std::filesystem::path ply = folder.path() / "new" / "coloured.ply", json = folder.path() / "new" / "stats.json";
};

TEST_F(Partition_program, writes_a_mesh_with_the_same_counts_and_positions) {
  const auto result = divide({"--strategy", "lbg", "--regions", "16"});
  expect_success(result);
  const auto before = read_mesh(mesh).mesh, after = read_mesh(ply).mesh;
  ASSERT_EQ(after.number_of_vertices(), vertices);
  ASSERT_EQ(after.number_of_faces(), faces);
  for (const auto v : after.vertices()) EXPECT_EQ(after.point(v), before.point(v));
  EXPECT_NE(result.out.find("16"), std::string::npos);
  EXPECT_EQ(content_of(folder.path() / "new"), (std::set<std::string>{"coloured.ply", "stats.json"}));
}

TEST_F(Partition_program, divides_the_first_of_numbered_files_and_the_only_object_of_a_scene) {
  const std::string bytes = read_bytes(mesh);
  folder.write("ball_1.ply", bytes), folder.write("ball_2.ply", bytes);
  const auto scene = folder.write("one.json", R"({"objects": [{"name": "ball", "mesh": "sphere.ply"}]})");
  for (const auto& input : {(folder.path() / "ball_#.ply").string(), scene.string()}) {
    SCOPED_TRACE(input);
    expect_success(run_program({"partition", input, "--out", ply.string()}));
    EXPECT_EQ(read_mesh(ply).mesh.number_of_vertices(), vertices);
  }
  const auto two = folder.write("two.json", R"({"objects": [{"name": "a", "mesh": "sphere.ply"},
                                                            {"name": "b", "mesh": "sphere.ply"}]})");
  expect_error(run_program({"partition", two.string()}), 2, "#NAME: a, b");
  const auto second = folder.path() / "ball_2.ply";
  expect_error(run_program({"partition", (folder.path() / "ball_#.ply").string(), "--out", second.string()}), 2,
               "never overwritten");
  expect_error(run_program({"partition", mesh.string(), "--json", "-"}), 2, "--json writes a file");
}

TEST_F(Partition_program, divides_a_shape_and_an_object_of_a_scene_in_its_first_frame) {
  expect_success(run_program({"partition", "shape:{\"icosphere\": {\"frequency\": 8}}", "--out", ply.string()}));
  EXPECT_EQ(read_mesh(ply).mesh.number_of_vertices(), vertices);
  const auto scene = folder.write("scene.json", R"({"frames": 2, "objects": [
    {"name": "still", "shape": {"icosphere": {"frequency": 2}}}, {"name": "moving", "mesh": "sphere.ply", "motion": {"deform": [{"travel":
      {"path": "linear", "way_points": [{"frame": 0, "at": [40, 0, 0]}, {"frame": 1, "at": [50, 0, 0]}]}}]}}]})");
  const auto moving = scene.string() + "#moving";
  expect_success(run_program({"partition", moving, "--out", ply.string()}));
  const auto divided = read_mesh(ply).mesh;
  ASSERT_EQ(divided.number_of_vertices(), vertices);
  for (const auto v : divided.vertices()) EXPECT_NEAR(divided.point(v).x(), 40, 1.5);
  const auto cache = folder.path() / "moving.pc2";
  expect_success(run_program({"convert", moving, cache.string(), "--quiet"}));
  const auto both = mesh.string() + "+" + cache.string(), again = (folder.path() / "again.ply").string();
  expect_success(run_program({"partition", both, "--out", again}));
  const auto divided_again = read_mesh(again).mesh;
  ASSERT_EQ(divided_again.number_of_vertices(), vertices);
  for (const auto v : divided_again.vertices()) EXPECT_NEAR(divided_again.point(v).x(), divided.point(v).x(), 1e-5);
  expect_error(run_program({"partition", both, "--out", mesh.string()}), 2, "never overwritten");
  expect_error(run_program({"partition", moving, "--json", scene.string()}), 2, "never overwritten");
  expect_error(run_program({"partition", moving, "--out", mesh.string()}), 2, "never overwritten");
  expect_error(run_program({"partition", scene.string() + "#none"}), 2, "the scene has no object 'none'");
}

TEST_F(Partition_program, divides_the_first_frame_of_a_gltf_animation) {
  auto sample = square_gltf();
  sample.animate(0, "translation", sample.add_numbers({0, 1}), sample.add_points({40, 0, 0, 50, 0, 0}));
  const auto file = folder.write("moving.glb", sample.glb());
  expect_success(run_program({"partition", file.string(), "--regions", "1", "--out", ply.string()}));
  const auto divided = read_mesh(ply).mesh;
  for (const auto v : divided.vertices()) EXPECT_GE(divided.point(v).x(), 40);
}

TEST_F(Partition_program, writes_consistent_statistics) {
  for (const int regions : {1, 7, 16, 50}) {
    SCOPED_TRACE(regions);
    expect_success(divide({"--regions", std::to_string(regions)}));
    const Json statistics = read_json(json);
    EXPECT_EQ(statistics["mesh"], "sphere.ply");
    EXPECT_EQ(statistics["strategy"], "lbg");
    EXPECT_EQ(statistics["vertices"], vertices);
    EXPECT_EQ(statistics["faces"], faces);
    EXPECT_EQ(statistics["regions_wanted"], regions);
    const auto sizes = statistics["region_sizes"].get<std::vector<int>>();
    EXPECT_EQ(statistics["regions"], sizes.size());
    EXPECT_EQ(std::accumulate(sizes.begin(), sizes.end(), 0), vertices);
    EXPECT_GT(*std::ranges::min_element(sizes), 0);
    const auto particles = statistics["particles"].get<std::set<int>>();
    EXPECT_EQ(particles.size(), sizes.size());
    EXPECT_GE(*particles.begin(), 0);
    EXPECT_LT(*particles.rbegin(), vertices);
    EXPECT_GE(statistics["seconds"], 0.0);
  }
}

TEST_F(Partition_program, divides_a_sphere_into_the_requested_number_of_regions) {
  expect_success(divide({"--regions", "16", "--keep-islands"}));
  EXPECT_EQ(read_json(json)["regions"], 16);
}

TEST_F(Partition_program, the_regions_of_the_coloured_mesh_are_those_of_the_statistics) {
  expect_success(divide({"--regions", "9"}));
  const auto sizes = read_json(json)["region_sizes"].get<std::vector<int>>();
  std::vector<int> counted(sizes.size());
  for (const int region : regions_in(ply, vertices)) ++counted.at(region);
  EXPECT_EQ(counted, sizes);
}

TEST_F(Partition_program, particles_have_their_vertex_indices_in_the_file) {
  // The first vertex of this file belongs to no face and is not in the mesh.
  const auto file = folder.write("unused.off", "OFF\n4 1 0\n9 9 9\n0 0 0\n1 0 0\n0 1 0\n3 1 2 3\n");
  expect_success(run_program({"partition", file.string(), "--regions", "3", "--json", json.string()}));
  EXPECT_EQ(read_json(json)["particles"].get<std::set<int>>(), (std::set<int>{1, 2, 3}));
}

TEST_F(Partition_program, labels_sizes_particles_and_coloured_mesh_agree_where_an_edge_has_three_faces) {
  // Vertex 0 has no face. The faces meet at the edge from 1 to 2, and the second is turned.
  const auto file =
      folder.write("fin.off", "OFF\n6 3 0\n7 7 7\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 1 2 3\n3 1 2 4\n3 1 2 5\n");
  expect_success(
      run_program({"partition", file.string(), "--regions", "3", "--json", json.string(), "--out", ply.string()}));
  const Json statistics = read_json(json);
  EXPECT_EQ(statistics["vertices"], 6);
  EXPECT_EQ(statistics["faces"], 3);
  ASSERT_EQ(statistics["regions"], 3);
  Json all = statistics["labels"];
  ASSERT_EQ(all.size(), 6U);
  EXPECT_TRUE(all[0].is_null());
  all[0] = 0;  // as in the coloured mesh
  const auto labels = all.get<std::vector<int>>();
  std::vector<int> sizes(3);
  for (std::size_t v = 1; v < 6; ++v) ++sizes.at(labels[v]);
  EXPECT_EQ(statistics["region_sizes"], sizes);
  const auto particles = statistics["particles"].get<std::vector<int>>();
  for (int region = 0; region < 3; ++region) EXPECT_EQ(labels.at(particles.at(region)), region);
  const auto before = read_animation(file), after = read_animation(ply);
  EXPECT_EQ(regions_in(ply, 6), labels);
  EXPECT_EQ(after.vertices, 6U);
  std::vector<Point> points(6), points_after(6);
  before.motion.pose(0, points), after.motion.pose(0, points_after);
  EXPECT_EQ(points_after, points);
  const auto corners = [](const Animation& surface) {
    std::vector<std::set<std::uint32_t>> of_faces;
    for (const auto& face : surface.faces) of_faces.emplace_back(face.begin(), face.end());
    return of_faces;
  };
  EXPECT_EQ(corners(after), corners(before));
}

TEST_F(Partition_program, vertices_along_the_seam_of_a_texture_have_the_region_of_those_that_they_double) {
  auto sample = square_gltf();
  // Vertices 4 and 5 double 1 and 0, and are named by the face of a second primitive.
  const auto doubles = sample.add_points({1, 0, 0, 0, 0, 0, 0, -1, 0});
  sample.json["meshes"][0]["primitives"].push_back(
      {{"attributes", {{"POSITION", doubles}}}, {"indices", sample.add_indices({0, 1, 2})}});
  const auto file = folder.write("seam.glb", sample.glb());
  const auto scene = folder.write("one.json", R"({"objects": [{"name": "square", "mesh": "seam.glb"}]})");
  for (const int number : {1, 2}) folder.write("seam_" + std::to_string(number) + ".glb", sample.glb());
  for (const auto& input : {file, scene, folder.path() / "seam_#.glb"}) {
    SCOPED_TRACE(input);
    expect_success(run_program({"partition", input.string(), "--regions", "3", "--json", json.string()}));
    const Json statistics = read_json(json);
    const auto labels = statistics["labels"].get<std::vector<int>>();
    ASSERT_EQ(labels.size(), 7U);
    EXPECT_EQ(labels[4], labels[1]);
    EXPECT_EQ(labels[5], labels[0]);
    EXPECT_NE(labels[0] + labels[1], 0);
    const auto sizes = statistics["region_sizes"].get<std::vector<int>>();
    EXPECT_EQ(std::accumulate(sizes.begin(), sizes.end(), 0), 5);
  }
}

TEST_F(Partition_program, gives_each_vertex_a_region_when_more_are_requested) {
  const auto file = folder.write("square.off", square_off);
  expect_success(run_program({"partition", file.string(), "--regions", "1000000", "--json", json.string()}));
  const Json statistics = read_json(json);
  EXPECT_EQ(statistics["regions_wanted"], 1'000'000);
  EXPECT_EQ(statistics["regions"], 4);
  EXPECT_EQ(statistics["region_sizes"], (std::vector<int>{1, 1, 1, 1}));
}

TEST_F(Partition_program, writes_the_same_mesh_twice) {
  expect_success(divide({"--regions", "20"}));
  const auto first = read_bytes(ply);
  expect_success(divide({"--regions", "20"}));
  EXPECT_EQ(read_bytes(ply), first);
}

TEST_F(Partition_program, trains_lbg_on_a_sample_where_asked_to) {
  const auto labels = [&](const std::vector<std::string>& options) {
    std::vector<std::string> all{"--regions", "3"};
    all.insert(all.end(), options.begin(), options.end());
    expect_success(divide(all));
    return Json::parse(read_bytes(json))["labels"];
  };
  EXPECT_EQ(labels({"--lbg-sample", "0"}), labels({}));  // so few vertices are all trained on
  EXPECT_NE(labels({"--lbg-sample", "1"}), labels({}));
}

TEST_F(Partition_program, quiet_prints_nothing) {
  const auto result = divide({"--quiet"});
  expect_success(result);
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(exists(ply));
}

TEST_F(Partition_program, prints_a_table_without_writing_a_file) {
  const auto result = run_program({"partition", mesh.string()});
  expect_success(result);
  EXPECT_NE(result.out.find("| vertices"), std::string::npos);
  EXPECT_NE(result.out.find(std::to_string(vertices)), std::string::npos);
  EXPECT_EQ(content_of(folder.path()), std::set<std::string>{"sphere.ply"});
}

TEST_F(Partition_program, refuses_an_unknown_strategy) {
  expect_error(divide({"--strategy", "guess"}), 2, "guess");
  expect_no_results();
}

TEST_F(Partition_program, refuses_zero_regions) {
  for (const auto* regions : {"0", "-1", "1.5", "many", "", "1000001", "99999999999999999999"}) {
    SCOPED_TRACE(regions);
    expect_error(divide({"--regions", regions}), 2, "--regions");
    expect_no_results();
  }
}

TEST_F(Partition_program, refuses_options_out_of_range) {
  for (const auto* weight : {"-1", "nan", "inf", "1e308", "heavy"}) {
    SCOPED_TRACE(weight);
    expect_error(divide({"--normal-weight", weight}), 2, "weight");
  }
  for (const auto* option : {"--epsilon", "--lbg-tolerance"})
    for (const auto* value : {"0", "-1", "nan", "small"}) {
      SCOPED_TRACE(std::string(option) + " " + value);
      expect_error(divide({option, value}), 2, option + std::string(": "));
    }
  for (const auto* sample : {"-1", "1.5", "all", "99999999999999999999"}) {
    SCOPED_TRACE(sample);
    expect_error(divide({"--lbg-sample", sample}), 2, "--lbg-sample");
  }
  expect_no_results();
}

TEST_F(Partition_program, refuses_to_write_a_mesh_without_the_extension_ply) {
  expect_error(run_program({"partition", mesh.string(), "--out", (folder.path() / "out.off").string()}), 2, "out.off");
  EXPECT_EQ(content_of(folder.path()), std::set<std::string>{"sphere.ply"});
}

TEST_F(Partition_program, refuses_one_file_for_both_results) {
  expect_error(run_program({"partition", mesh.string(), "--out", ply.string(), "--json", ply.string()}), 2,
               "coloured.ply");
  expect_no_results();
}

TEST_F(Partition_program, writes_no_mesh_if_the_statistics_cannot_be_written) {
  create_directories(json);
  expect_error(divide({}), 4, "stats.json");
  EXPECT_EQ(content_of(folder.path() / "new"), std::set<std::string>{"stats.json"});
}

TEST_F(Partition_program, refuses_a_broken_mesh) {
  for (const auto& [name, bytes] : std::vector<Sample>{
           {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n"}, {"a.obj", "f 1 2 3\n"}, {"a.stl", "solid"}}) {
    SCOPED_TRACE(name);
    const auto file = folder.write(name, bytes);
    expect_error(run_program({"partition", file.string(), "--out", ply.string(), "--json", json.string()}), 3, name);
    expect_no_results();
  }
}

}  // namespace
}  // namespace lodestone::test
