// SPDX-License-Identifier: GPL-3.0-or-later
// `detect --mode certified`: the contacts of mode exact, and little of each object is read.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "program/html_pages.h"
#include "program/run_program.h"
#include "support/page_decoder.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

using Json = nlohmann::json;

class Certified_program : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    return folder.write(name, text).string();
  }
  std::string write_bodies() const {
    return write("bodies.json", R"({"frames": 12, "objects": [
      {"name": "knot", "shape": {"torus_knot": {"segments": 200, "sides": 12}},
       "motion": {"deform": [{"twist": {"degrees": 40, "period": 9}},
                             {"travel": {"path": "linear", "way_points": [{"frame": 0, "at": [-9, 0, 0]},
                                                                          {"frame": 9, "at": [0, 0, 0]}]}}]}},
      {"name": "ball", "shape": {"icosphere": {"frequency": 20}}, "place": {"scale": 2}}]})");
  }
  /// Two characters that move, one of them placed so that they touch.
  std::string write_characters() const {
    const std::filesystem::path from = std::filesystem::path(LODESTONE_DATA) / "characters";
    for (const char* name : {"hand.glb", "face.glb", "body.glb"})
      std::filesystem::copy_file(from / name, folder.path() / name, std::filesystem::copy_options::skip_existing);
    return write("characters.json", R"({"frames": 20, "objects": [
      {"name": "hand", "mesh": "hand.glb", "motion": {"gltf": "hand.glb"}},
      {"name": "face", "mesh": "face.glb", "motion": {"gltf": "face.glb"}, "place": {"translate": [0.6, 0.3, 0.2]}},
      {"name": "body", "mesh": "body.glb", "motion": {"gltf": "body.glb"}, "place": {"translate": [-0.4, 0.1, 0.3]}}]})");
  }
  Program_result detect(const std::string& scene, const std::string& mode, const std::string& out,
                        std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"detect",     scene, "--mode", mode,
                                       "--contacts", "all", "--out",  (folder.path() / out).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto result = run_program(arguments);
    expect_success(result);
    return result;
  }
  std::vector<Json> frames(const std::string& out) const {
    return read_json_lines(folder.path() / out / "frames.jsonl");
  }
  /// The pairs of a frame that collide.
  static Json collisions(const Json& frame) {
    Json colliding = Json::array();
    for (const auto& pair : frame["pairs"])
      if (pair["collides"]) colliding.push_back(pair);
    return colliding;
  }
  /// @return how many frames collide
  std::size_t expect_contacts_of_exact(const std::string& scene) {
    detect(scene, "certified", "certified");
    detect(scene, "exact", "exact");
    const auto found = frames("certified"), truth = frames("exact");
    EXPECT_EQ(found.size(), truth.size());
    std::size_t colliding = 0;
    for (std::size_t i = 0; i < std::min(found.size(), truth.size()); ++i) {
      EXPECT_EQ(collisions(found[i]), collisions(truth[i])) << i;
      EXPECT_EQ(found[i]["statistics"]["violations"], 0);
      colliding += collisions(found[i]).empty() ? 0 : 1;
    }
    return colliding;
  }

  Temporary_folder folder;
};

TEST_F(Certified_program, lists_the_contacts_of_mode_exact_for_built_in_motion) {
  EXPECT_GT(expect_contacts_of_exact(write_bodies()), 2U);
  std::size_t unread = 0;
  for (const auto& frame : frames("certified")) unread += frame["statistics"]["vertices_read"] == 0 ? 1 : 0;
  EXPECT_GT(unread, 1U);
}

TEST_F(Certified_program, lists_the_contacts_of_mode_exact_for_characters) {
  EXPECT_GT(expect_contacts_of_exact(write_characters()), 5U);
}

TEST_F(Certified_program, says_what_it_has_read) {
  const auto result = detect(write_bodies(), "certified", "results");
  EXPECT_NE(result.out.find("vertices read"), std::string::npos);
  EXPECT_NE(result.out.find("nodes bounded"), std::string::npos);
  const auto summary = Json::parse(read_bytes(folder.path() / "results" / "summary.json"));
  EXPECT_EQ(summary["mode"], "certified");
  EXPECT_TRUE(summary["may_miss"].is_null());
  EXPECT_EQ(summary["mean_violations"], 0);
  EXPECT_GT(summary["mean_nodes_bounded"], 0);
}

TEST_F(Certified_program, says_what_needs_all_positions) {
  const std::string line = "all objects were also posed as a whole, outside the times, for ";
  const auto scene = write_bodies(), paraview = (folder.path() / "paraview").string();
  EXPECT_EQ(detect(scene, "certified", "plain").out.find(line), std::string::npos);
  for (const std::vector<std::string>& option : {{"--truth"}, std::vector<std::string>{"--paraview", paraview}}) {
    const auto said = line + option.front() + "\n";
    EXPECT_NE(detect(scene, "certified", "whole", option).out.find(said), std::string::npos) << option.front();
    EXPECT_EQ(detect(scene, "exact", "exact", option).out.find(line), std::string::npos) << option.front();
  }
}

TEST_F(Certified_program, writes_the_same_bytes_for_any_number_of_threads_and_with_the_truth_beside) {
  const auto scene = write_characters();
  detect(scene, "certified", "one");
  detect(scene, "certified", "two", {"--threads", "2"});
  EXPECT_EQ(read_bytes(folder.path() / "one" / "frames.jsonl"), read_bytes(folder.path() / "two" / "frames.jsonl"));
  const auto result = detect(scene, "certified", "checked", {"--truth", "--containment", "--closest"});
  for (const auto& frame : frames("checked"))
    for (const auto& pair : frame["pairs"]) EXPECT_EQ(pair["collides"], pair["truth"]);
}

TEST_F(Certified_program, a_page_has_a_state_for_each_vertex) {
  if (!LODESTONE_HAS_VIEWER) GTEST_SKIP() << "the program was built without the viewer";
  const auto file = (folder.path() / "page.html").string();
  detect(write_bodies(), "certified", "results", {"--html", file});
  const Decoded_page page(data_of(read_bytes(file)));
  EXPECT_EQ(page.header["mode"], "certified");
  EXPECT_EQ(page.header["states"], (Json{"far", "bounded", "posed"}));
  std::size_t partitions = 0;
  for (const auto& object : page.header["objects"]) {
    partitions += object["partitions"].size();
    for (const auto& partition : object["partitions"]) EXPECT_LE(partition["regions"], 3);
  }
  EXPECT_GT(partitions, 4U);
}

}  // namespace
}  // namespace lodestone::test
