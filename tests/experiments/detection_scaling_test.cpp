// SPDX-License-Identifier: GPL-3.0-or-later
#include "scaling/detection_scaling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "lodestone/io/shapes/shapes.h"
#include "shared/made_object.h"

namespace lodestone {
namespace {

/// Two unit spheres that approach, touch in the last frames, and wobble.
Scene meeting_spheres(std::size_t frequency) {
  Scene scene;
  scene.name = "spheres";
  scene.frames = 12;
  scene.objects.push_back(made_object("still", icosphere(frequency), {Wobble{.period = 12}}));
  scene.objects.push_back(
      made_object("moving", icosphere(frequency),
                  {Travel{.way_points = {{.frame = 0, .at = {2.6, 0, 0}}, {.frame = 11, .at = {1.7, 0, 0}}}}}));
  return scene;
}

TEST(Detection_scaling, measures_meetings_and_the_published_method_against_triangles_in_the_same_run) {
  std::vector<Scene> scenes;
  scenes.push_back(meeting_spheres(4));
  scenes.push_back(meeting_spheres(8));
  std::size_t steps = 0;
  nlohmann::ordered_json json;
  const auto text = detection_against_triangles(
      scenes, [&] { ++steps; }, json);
  EXPECT_EQ(steps, 2U);
  const auto& figures = json["triangles"];
  ASSERT_EQ(figures["rows"].size(), 2U * 5);
  for (const char* name : {"12, with meetings", "128, with meetings", "12, published", "128, published", "exact"}) {
    std::vector<double> triangles, medians;
    for (const auto& row : figures["rows"])
      if (row["name"] == name) {
        triangles.push_back(row["triangles"]);
        medians.push_back(row["figures"]["median_microseconds"]["without_build"]);
      }
    EXPECT_EQ(triangles, (std::vector<double>{2 * 20 * 16, 2 * 20 * 64})) << name;
    EXPECT_NEAR(figures["exponents"][name]["median"].get<double>(), std::log(medians[1] / medians[0]) / std::log(4),
                1e-9)
        << name;
    EXPECT_NE(text.find(std::string("| ") + name), std::string::npos) << text;
  }
}

TEST(Detection_scaling, measures_both_methods_with_every_number_of_particles) {
  std::size_t steps = 0;
  nlohmann::ordered_json json;
  detection_against_particles(
      meeting_spheres(8), [&] { ++steps; }, json);
  EXPECT_EQ(steps, 1 + std::size(scaling_particle_counts));
  const auto& frames = json["detection"]["frames"];
  EXPECT_EQ(frames["rows"].size(), 2 * std::size(scaling_particle_counts));
  EXPECT_TRUE(frames["exponents"].contains("published"));
  EXPECT_TRUE(frames["exponents"].contains("with meetings"));
  EXPECT_EQ(json["detection"]["N"].size(), std::size(scaling_particle_counts));
}

}  // namespace
}  // namespace lodestone
