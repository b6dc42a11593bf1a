// SPDX-License-Identifier: GPL-3.0-or-later
// What the page of a run says is true: which frames collide, and how far objects are from each other.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lodestone/io/scenes/scene_file.h"
#include "lodestone/queries/exhaustive.h"
#include "program/html_pages.h"
#include "support/scene_samples.h"

namespace lodestone::test {
namespace {

using Json = nlohmann::json;

TEST_F(Html, the_truth_equals_exhaustive_checking_in_every_mode) {
  const auto file = bodies_file();
  std::vector<bool> truth;
  Scene scene = read_scene(file);
  for (std::size_t f = 0; f < scene.frames; ++f) {
    for (auto& object : scene.objects) pose(object, f);
    truth.push_back(!exhaustive_face_pairs(scene.objects[0].mesh, scene.objects[1].mesh).empty());
  }
  EXPECT_TRUE(std::ranges::count(truth, true) > 2 && std::ranges::count(truth, false) > 2);
  for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{{"--truth"},
                                                                                       {"--particles", "2"},
                                                                                       {"--mode", "exact"},
                                                                                       {"--mode", "senin"},
                                                                                       {"--mode", "exact", "--self"}}) {
    SCOPED_TRACE(testing::PrintToString(options));
    const auto shown = detect(options);
    const auto stages = shown.json_section("stages");
    const auto lines = lines_of(shown.section(shown.header["numbers"]));
    ASSERT_EQ(stages.size(), truth.size());
    for (std::size_t f = 0; f < truth.size(); ++f) {
      EXPECT_EQ(stages[f]["positive"], truth[f]);
      bool found = false;
      const auto line = Json::parse(lines[f]);
      for (const auto& pair : line["pairs"]) found |= pair["collides"].get<bool>();
      EXPECT_EQ(stages[f]["found"], found);
      EXPECT_EQ(stages[f]["nearest"] == 0, truth[f]);
      EXPECT_EQ(stages[f]["microseconds"].size(), 7U);
      EXPECT_EQ(stages[f]["microseconds"]["build"] > 0, f == 0);
      for (const auto& time : stages[f]["microseconds"]) EXPECT_GE(time, 0);
    }
  }
}

TEST_F(Html, near_is_not_found) {
  const auto stages = page_of({"detect", write("a.off", tetrahedron_off()), write("b.off", tetrahedron_off(2)),
                               "--mode", "exact", "--within", "1.5"})
                          .json_section("stages");
  EXPECT_EQ(stages.at(0)["near"], true);
  EXPECT_EQ(stages.at(0)["found"], false);
  EXPECT_EQ(stages.at(0)["positive"], false);
  EXPECT_DOUBLE_EQ(stages.at(0)["nearest"].get<double>(), 1);
  EXPECT_EQ(detect().json_section("stages").at(0)["near"], nullptr);
}

TEST_F(Html, nearest_is_the_distance_of_the_two_nearest_objects) {
  // Each reaches from a face in the plane x = 0 to a tip at x = 1, and is moved along the x-axis.
  const std::vector<std::string> arguments{"detect",
                                           "--mode",
                                           "particles",
                                           write("a.off", tetrahedron_off()),
                                           write("b.off", tetrahedron_off(7)),
                                           write("c.off", tetrahedron_off(3)),
                                           write("d.off", tetrahedron_off(9))};
  const auto stages = page_of(arguments).json_section("stages");
  EXPECT_DOUBLE_EQ(stages.at(0)["nearest"].get<double>(), 1);  // from the tip of b to d
}

TEST_F(Html, a_single_object_has_no_nearest_distance) {
  const auto file = write("one.json", R"({"objects": [{"name": "a", "shape": {"icosphere": {"frequency": 3}}}]})");
  const auto stages = page_of({"detect", file, "--mode", "exact", "--self"}).json_section("stages");
  EXPECT_EQ(stages.at(0)["nearest"], nullptr);
  EXPECT_EQ(stages.at(0)["positive"], false);
}

TEST_F(Html, pairs_that_the_scene_ignores_do_not_count_as_nearest) {
  write("a.off", tetrahedron_off());
  const std::string objects = R"({"objects": [{"name": "a", "mesh": "a.off"}, {"name": "b", "mesh": "a.off"}])";
  const auto positive = [&](const std::string& ignored) {
    const auto stages =
        page_of({"detect", write("two.json", objects + ignored + "}"), "--mode", "exact"}).json_section("stages");
    EXPECT_EQ(stages.at(0)["nearest"].is_null(), !ignored.empty());
    return stages.at(0)["positive"].get<bool>();
  };
  EXPECT_TRUE(positive(""));
  EXPECT_FALSE(positive(R"(, "ignore": [["b", "a"]])"));
}

}  // namespace
}  // namespace lodestone::test
