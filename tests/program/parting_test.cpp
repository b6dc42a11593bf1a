// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "program/run_program.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

using Json = nlohmann::json;

class Detect_parting : public testing::Test {
 protected:
  /// A ball that travels into another, in which it ends.
  std::string scene() const {
    return folder
        .write("balls.json", R"({"frames": 5, "objects": [
      {"name": "small", "shape": {"icosphere": {"frequency": 4}}, "place": {"scale": 0.25},
       "motion": {"deform": [{"travel": {"path": "linear", "way_points": [{"frame": 0, "at": [-2, 0, 0]},
                                                                         {"frame": 4, "at": [0.25, 0, 0]}]}}]}},
      {"name": "large", "shape": {"icosphere": {"frequency": 8}}}]})")
        .string();
  }
  Program_result detect(std::vector<std::string> options) const {
    options.insert(options.begin(), {"detect", scene(), "--out", out.string()});
    return run_program(options);
  }

  Temporary_folder folder;
  std::filesystem::path out = folder.path() / "results";
};

TEST_F(Detect_parting, reports_the_way_out_per_frame_and_its_greatest_length_per_pair) {
  const auto result = detect({"--parting"});
  expect_success(result);
  double longest = 0;
  std::size_t given = 0;
  for (const auto& frame : read_json_lines(out / "frames.jsonl"))
    for (const auto& pair : frame["pairs"]) {
      const Json& parting = pair["parting"];
      if (parting.is_null()) {
        EXPECT_EQ(pair["collides"], false);
        continue;
      }
      ++given;
      const double length = parting["length"];
      const auto& t = parting["translation"];
      EXPECT_NEAR(std::hypot(t[0].get<double>(), t[1].get<double>(), t[2].get<double>()), length, 1e-12);
      longest = std::max(longest, length);
    }
  EXPECT_GE(given, 2U);
  EXPECT_EQ(read_json(out / "summary.json")["pairs"][0]["longest_parting"], longest);
  EXPECT_NE(result.out.find("| parting |"), std::string::npos) << result.out;
}

TEST_F(Detect_parting, refuses_contact_patches_of_fewer_contacts_than_all) {
  for (const std::string contacts : {"first", "yes_no"}) {
    const auto result = detect({"--patches", "--contacts", contacts});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.err.find("patches need"), std::string::npos) << result.err;
  }
}

TEST_F(Detect_parting, reports_contact_patches_with_their_face_pairs) {
  expect_success(detect({"--patches", "--contacts", "all"}));
  std::size_t patches = 0;
  for (const auto& frame : read_json_lines(out / "frames.jsonl"))
    for (const auto& pair : frame["pairs"]) {
      EXPECT_EQ(pair["patches"].empty(), !pair["collides"]);
      EXPECT_FALSE(pair.contains("points"));
      for (const auto& patch : pair["patches"]) {
        EXPECT_EQ(patch["contacts"].size(), pair["faces"].size());
        EXPECT_LT(patch["normal"][0], -0.9);
        EXPECT_GT(patch["length"], 0);
        ++patches;
      }
    }
  EXPECT_GE(patches, 1U);
  EXPECT_EQ(detect({"--patches", "--contacts", "yes_no"}).exit_code, 2);
}

TEST_F(Detect_parting, is_refused_by_other_modes) {
  for (const char* option : {"--parting", "--patches"}) {
    const auto result = detect({"--mode", "particles", option});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.err.find("--mode exact"), std::string::npos) << result.err;
  }
}

}  // namespace
}  // namespace lodestone::test
