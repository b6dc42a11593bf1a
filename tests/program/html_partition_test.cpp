// SPDX-License-Identifier: GPL-3.0-or-later
// The pages of partitions and experiments.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lodestone/io/meshes/mesh_file.h"
#include "program/html_pages.h"
#include "support/mesh_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

using Json = nlohmann::json;

TEST_F(Html, of_a_partition_shows_regions_and_particles) {
  const auto mesh = write("square.off", square_off), json = (folder.path() / "statistics.json").string();
  const auto shown = page_of({"partition", mesh, "--regions", "2", "--json", json});
  const auto statistics = read_json(json);
  EXPECT_EQ(shown.header["kind"], "partition");
  EXPECT_EQ(shown.header["title"], "square.off");
  EXPECT_EQ(shown.header["mode"], nullptr);
  EXPECT_EQ(shown.header["strategy"], "lbg");
  EXPECT_EQ(shown.header["frames"], 1);
  for (const char* key : {"stages", "candidates", "contacts", "report"}) EXPECT_EQ(shown.header[key], nullptr);
  const auto surface = read_mesh(mesh).mesh;
  const auto positions = shown.positions(0).at(0);
  for (const auto v : surface.vertices())
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(positions[3 * v + axis], surface.point(v)[axis], 1e-5);
  EXPECT_EQ(shown.topology(0).size(), 3 * surface.number_of_faces());
  ASSERT_EQ(shown.object(0)["partitions"].size(), 1U);
  std::vector<int> sizes(2);
  for (const auto label : shown.labels(0, 0)) ++sizes.at(label);
  EXPECT_EQ(Json(sizes), statistics["region_sizes"]);
  EXPECT_EQ(Json(shown.particles(0).at(0)), statistics["particles"]);
  auto numbers = Json::parse(shown.section(shown.header["numbers"]));
  EXPECT_FALSE(numbers.contains("seconds"));
  for (const auto* key : {"seconds", "labels"}) numbers[key] = statistics[key];
  EXPECT_EQ(numbers, statistics);
}

TEST_F(Html, of_a_partition_is_the_same_twice) {
  const auto mesh = write("square.off", square_off);
  page_of({"partition", mesh, "--regions", "2"});
  const auto first = read_bytes(page);
  page_of({"partition", mesh, "--regions", "2"});
  EXPECT_EQ(read_bytes(page), first);
}

/// Two spheres that meet, under the names of all scenes that the experiment plays.
void write_small_scenes(const Temporary_folder& folder) {
  for (const std::string name :
       {"teapot_sphere_1", "torus_knots", "cloth_sphere", "bodies_20", "spheres_5k", "spheres_50k", "torus_knots_20k",
        "cloth_sphere_80k", "bodies_20_5k", "torus_knots_200k", "spheres_500k", "spheres_2m"})
    folder.write(name + ".json", R"({"frames": 3, "objects": [
      {"name": "still", "shape": {"icosphere": {"frequency": 5}}},
      {"name": "moving", "shape": {"icosphere": {"frequency": 4}}, "motion": {"deform": [{"travel":
        {"path": "linear", "way_points": [{"frame": 0, "at": [2.5, 0, 0]}, {"frame": 2, "at": [1.6, 0, 0]}]}}]}}]})");
}

TEST_F(Html, of_an_experiment_has_its_report_and_its_plots_with_their_data) {
  write_small_scenes(folder);
  const auto shown = page_of({"experiment", "modes", "--scenes", folder.path().string(), "--out", out.string()});
  EXPECT_EQ(shown.header["kind"], "experiment");
  EXPECT_EQ(shown.header["frames"], 0);
  EXPECT_EQ(shown.header["objects"], Json::array());
  EXPECT_EQ(shown.header["report"], read_bytes(out / "modes.md"));
  EXPECT_TRUE(shown.header["title"].get<std::string>().starts_with("modes: "));
  ASSERT_EQ(shown.header["plots"].size(), 1U);
  const auto& plot = shown.header["plots"][0];
  EXPECT_EQ(plot["name"], "recall_against_time");
  EXPECT_EQ(plot["title"], plot["spec"]["title"]);
  EXPECT_FALSE(plot["description"].get<std::string>().empty());
  const auto figures = read_json(out / "modes.json");
  EXPECT_EQ(plot["spec"]["data"], Json({{"values", figures}}));
  for (const auto& row : figures)
    for (const char* field : {"/scene", "/setting", "/recall", "/median_microseconds/without_build"})
      EXPECT_TRUE(row.contains(Json::json_pointer(field))) << field;
}

TEST_F(Html, of_an_experiment_without_plots_has_its_report) {
  write_small_scenes(folder);
  const auto shown =
      page_of({"experiment", "collision_distance", "--scenes", folder.path().string(), "--out", out.string()});
  EXPECT_EQ(shown.header["report"], read_bytes(out / "collision_distance.md"));
  EXPECT_EQ(shown.header["plots"], Json::array());
}

}  // namespace
}  // namespace lodestone::test
