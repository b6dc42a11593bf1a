// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "lodestone/io/meshes/mesh_file.h"
#include "lodestone/io/scenes/scene_file.h"
#include "lodestone/queries/exhaustive.h"
#include "program/run_program.h"
#include "support/mesh_samples.h"
#include "support/scene_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

using Json = nlohmann::json;
using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// A triangle that stands upright on its tip and cuts the plane z = 0 from (x, y, 0) to (x + 0.05, y, 0).
std::string needle(double x, double y) {
  return fmt::format("OFF\n3 1 0\n{0} {1} -1\n{0} {1} 1\n{2} {1} 1\n3 0 1 2\n", x, y, x + 0.1);
}

/// The rectangle from (0, 0) to (squares, 1) of the plane z = 0. Square i is cut into face 2 i, below its diagonal, and
/// face 2 i + 1; the file lists the faces backwards.
std::string backward_strip(int squares) {
  std::string text = fmt::format("OFF\n{} {} 0\n", 2 * squares + 2, 2 * squares);
  for (int i = 0; i <= squares; ++i) text += fmt::format("{0} 0 0\n{0} 1 0\n", i);
  for (int i = squares - 1; i >= 0; --i)
    text += fmt::format("3 {0} {3} {1}\n3 {0} {2} {3}\n", 2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3);
  return text;
}

/// A point cache of four vertices, those of `tetrahedron_off()`, moved along the x-axis by another distance in each
/// frame.
std::string moving_tetrahedron(const std::vector<double>& distances) {
  auto bytes = std::string("POINTCACHE2\0", 12) + packed<std::int32_t>({1, 4}) + packed<float>({0, 1}) +
               packed<std::int32_t>({static_cast<double>(distances.size())});
  for (const double x : distances) bytes += packed<float>({x, 0, 0, x + 1, 0, 0, x, 1, 0, x, 0, 1});
  return bytes;
}

Pairs face_pairs(const Json& pair) { return pair.at("faces").get<Pairs>(); }

Pairs exhaustive_pairs(const Surface_mesh& a, const Surface_mesh& b) {
  Pairs pairs;
  for (const auto& [face_a, face_b] : exhaustive_face_pairs(a, b)) pairs.emplace_back(face_a, face_b);
  return pairs;
}

class Detect : public testing::Test {
 protected:
  /// Runs `detect` with these inputs and options, by particles unless the options name a mode; results to `out`.
  Program_result detect(std::vector<std::string> arguments) const {
    arguments = detect_by_particles(std::move(arguments));
    arguments.insert(arguments.end(), {"--out", out.string()});
    return run_program(arguments);
  }
  std::vector<Json> frames() const { return read_json_lines(out / "frames.jsonl"); }
  Json summary() const { return read_json(out / "summary.json"); }
  std::string write(const std::string& name, const std::string& bytes) const {
    return folder.write(name, bytes).string();
  }

  /// The two tetrahedra of a scene, the first of which moves by these distances. Their surfaces meet where the distance
  /// is 1 or less.
  std::string write_meeting_tetrahedra(const std::vector<double>& distances) const {
    write("moving.off", tetrahedron_off());
    write("still.off", tetrahedron_off());
    write("moving.pc2", moving_tetrahedron(distances));
    return write("scene.json", R"({"name": "meeting", "objects": [
      {"name": "moving", "mesh": "moving.off", "motion": {"pc2": "moving.pc2"}},
      {"name": "still", "mesh": "still.off"}]})");
  }

  /// Two spheres and a knot that deform and meet.
  std::string write_shapes() const {
    return write("shapes.json", R"({"name": "shapes", "frames": 12, "objects": [
      {"name": "z", "shape": {"icosphere": {"frequency": 5}},
       "motion": {"deform": [{"wobble": {"amplitude": 0.05, "period": 10}},
                             {"travel": {"path": "linear", "way_points": [{"frame": 0, "at": [-2.5, 0, 0]},
                                                                          {"frame": 11, "at": [0, 0, 0]}]}}]}},
      {"name": "a", "shape": {"uv_sphere": {"slices": 14, "stacks": 9}}, "place": {"translate": [0.3, 0.2, 0.1]}},
      {"name": "m", "shape": {"torus_knot": {"segments": 60, "sides": 6}},
       "motion": {"deform": [{"twist": {"degrees": 40, "period": 9}}]}}]})");
  }

  Temporary_folder folder;
  std::filesystem::path out = folder.path() / "results" / "of" / "the" / "run";
};

TEST_F(Detect, two_meshes_that_intersect_collide_and_the_output_folder_is_created) {
  const auto result = detect({write("square.off", square_off), write("needle.off", needle(0.7, 0.2))});
  expect_success(result);
  const auto lines = frames();
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0]["frame"], 0);
  ASSERT_EQ(lines[0]["pairs"].size(), 1U);
  const Json& pair = lines[0]["pairs"][0];
  EXPECT_EQ(pair["a"], "square");
  EXPECT_EQ(pair["b"], "needle");
  EXPECT_EQ(pair["collides"], true);
  EXPECT_EQ(face_pairs(pair), (Pairs{{0, 0}}));
  EXPECT_EQ(content_of(out), (std::set<std::string>{"frames.jsonl", "summary.json"}));
  for (const auto* part : {"| square ", "| needle ", "colliding"})
    EXPECT_NE(result.out.find(part), std::string::npos) << result.out;
}

TEST_F(Detect, two_meshes_apart_do_not_collide) {
  expect_success(detect({write("a.off", tetrahedron_off()), write("b.off", tetrahedron_off(2)), "--meetings", "0",
                         "--collision-distance", "9"}));
  const auto lines = frames();
  ASSERT_EQ(lines.size(), 1U);
  for (const auto& pair : lines[0]["pairs"]) {
    EXPECT_EQ(pair["collides"], false);
    EXPECT_EQ(face_pairs(pair), Pairs{});
  }
}

TEST_F(Detect, every_mesh_format_gives_the_same_faces) {
  const auto other = write("needle.off", needle(0.2, 0.7));
  for (const auto& [name, bytes] : all_squares()) {
    SCOPED_TRACE(name);
    expect_success(
        detect({write(name, bytes), other, "--contacts", "all", "--meetings", "0", "--collision-distance", "9"}));
    EXPECT_EQ(face_pairs(frames().at(0)["pairs"][0]), (Pairs{{1, 0}}));
  }
}

TEST_F(Detect, faces_have_their_indices_in_the_file) {
  constexpr int squares = 40;
  const auto strip = write("strip.off", backward_strip(squares));
  for (const int square : {0, 17, 39}) {
    SCOPED_TRACE(square);
    expect_success(detect({strip, write("needle.off", needle(square + 0.7, 0.2)), "--contacts", "all", "--meetings",
                           "0", "--collision-distance", "99"}));
    // The file's last face is below the diagonal of square 0.
    EXPECT_EQ(face_pairs(frames().at(0)["pairs"][0]), (Pairs{{2 * squares - 1 - 2 * square, 0}}));
  }
}

TEST_F(Detect, with_candidates_everywhere_all_contacts_equal_exhaustive_checking) {
  const auto file = write_shapes();
  expect_success(detect({file, "--contacts", "all", "--meetings", "0", "--collision-distance", "1000"}));
  Scene scene = read_scene(file);
  const auto lines = frames();
  ASSERT_EQ(lines.size(), scene.frames);
  std::size_t positive = 0;
  for (std::size_t frame = 0; frame < scene.frames; ++frame) {
    SCOPED_TRACE(frame);
    EXPECT_EQ(lines[frame]["frame"], frame);
    for (auto& object : scene.objects) pose(object, frame);
    const auto& pairs = lines[frame]["pairs"];
    ASSERT_EQ(pairs.size(), 3U);
    std::size_t next = 0;
    for (const auto& [a, b] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)}) {
      const Json& pair = pairs[next++];
      EXPECT_EQ(pair["a"], scene.objects[a].name);
      EXPECT_EQ(pair["b"], scene.objects[b].name);
      const auto expected = exhaustive_pairs(scene.objects[a].mesh, scene.objects[b].mesh);
      EXPECT_EQ(pair["collides"], !expected.empty());
      EXPECT_EQ(face_pairs(pair), expected);
      positive += expected.empty() ? 0 : 1;
    }
  }
  EXPECT_GT(positive, 12U);
  EXPECT_LT(positive, 36U);
}

TEST_F(Detect, no_contact_is_invented_and_contacts_are_sorted) {
  const auto file = write_shapes();
  for (const auto* mode : {"particles", "senin"}) {
    SCOPED_TRACE(mode);
    expect_success(detect({file, "--contacts", "all", "--mode", mode}));
    Scene scene = read_scene(file);
    const auto lines = frames();
    ASSERT_EQ(lines.size(), scene.frames);
    std::size_t found = 0;
    for (std::size_t frame = 0; frame < scene.frames; ++frame) {
      for (auto& object : scene.objects) pose(object, frame);
      for (const auto& pair : lines[frame]["pairs"]) {
        const auto place = [&](const char* key) {
          const auto same_name = [&](const Scene_object& object) { return object.name == pair[key]; };
          return std::ranges::find_if(scene.objects, same_name) - scene.objects.begin();
        };
        ASSERT_LT(place("a"), place("b"));
        ASSERT_LT(place("b"), 3);
        const auto real = exhaustive_pairs(scene.objects[place("a")].mesh, scene.objects[place("b")].mesh);
        const auto faces = face_pairs(pair);
        EXPECT_TRUE(std::ranges::is_sorted(faces));
        EXPECT_TRUE(std::ranges::includes(real, faces));
        EXPECT_EQ(pair["collides"], !faces.empty());
        found += faces.size();
      }
    }
    EXPECT_GT(found, 0U);
    EXPECT_EQ(summary()["mode"], mode);
  }
}

TEST_F(Detect, the_first_contact_is_one_real_pair_of_faces) {
  const auto file = write_shapes();
  expect_success(detect({file, "--contacts", "first", "--meetings", "0", "--collision-distance", "1000"}));
  Scene scene = read_scene(file);
  const auto lines = frames();
  pose(scene.objects[1], 11);
  pose(scene.objects[0], 11);
  const Json& pair = lines.at(11)["pairs"].at(0);
  const auto faces = face_pairs(pair);
  ASSERT_EQ(faces.size(), 1U);
  EXPECT_TRUE(std::ranges::includes(exhaustive_pairs(scene.objects[0].mesh, scene.objects[1].mesh), faces));
}

TEST_F(Detect, a_point_cache_moves_its_mesh) {
  expect_success(detect(
      {write_meeting_tetrahedra({3, 1.5, 1, 0.5, 0, -0.75, -1.25}), "--meetings", "0", "--collision-distance", "99"}));
  std::vector<bool> collides;
  for (const auto& frame : frames()) collides.push_back(frame["pairs"].at(0)["collides"]);
  EXPECT_EQ(collides, (std::vector<bool>{false, false, true, true, true, true, false}));
  const Json result = summary();
  EXPECT_EQ(result["scene"], "meeting");
  EXPECT_EQ(result["frames"], 7);
  EXPECT_EQ(result["pairs"].at(0)["colliding_frames"], 4);
}

TEST_F(Detect, the_truth_is_listed_beside_the_answer) {
  const auto scene = write_meeting_tetrahedra({2, 1, 0.5, 2, 0.25});
  const auto result = detect({scene, "--truth", "--meetings", "0", "--collision-distance", "99"});
  expect_success(result);
  std::vector<bool> truth;
  for (const auto& frame : frames()) truth.push_back(frame["pairs"].at(0)["truth"]);
  EXPECT_EQ(truth, (std::vector<bool>{false, true, true, false, true}));
  const Json score = summary()["pairs"].at(0)["truth"];
  EXPECT_EQ(score["colliding_frames"], 3);
  EXPECT_EQ(score["collisions"], 2);
  EXPECT_EQ(score["never_seen"], 0);
  for (const auto* key : {"recall", "precision", "accuracy"}) EXPECT_EQ(score[key], 1.0) << key;
  EXPECT_NE(result.out.find("recall"), std::string::npos);
  EXPECT_NE(result.out.find("1.000"), std::string::npos);
}

TEST_F(Detect, the_truth_shows_what_was_missed) {
  // No vertex of the needle is near one of the square: particles at this distance never call for a check.
  const auto result = detect({write("square.off", square_off), write("needle.off", needle(0.7, 0.2)), "--truth",
                              "--meetings", "0", "--collision-distance", "0.001"});
  expect_success(result);
  const Json pair = frames().at(0)["pairs"].at(0);
  EXPECT_EQ(pair["collides"], false);
  EXPECT_EQ(pair["truth"], true);
  const Json score = summary()["pairs"].at(0)["truth"];
  EXPECT_EQ(score["recall"], 0.0);
  EXPECT_EQ(score["precision"], 1.0);
  EXPECT_EQ(score["accuracy"], 0.0);
  EXPECT_EQ(score["never_seen"], 1);
  EXPECT_NE(result.out.find("0.000"), std::string::npos);
}

TEST_F(Detect, the_same_run_gives_the_same_bytes) {
  const auto scene = write_shapes();
  for (const auto* mode : {"particles", "senin"}) {
    SCOPED_TRACE(mode);
    const std::vector<std::string> arguments{scene, "--mode", mode, "--contacts", "all", "--points", "--truth"};
    expect_success(detect(arguments));
    const auto first = read_bytes(out / "frames.jsonl");
    expect_success(detect(arguments));
    EXPECT_EQ(read_bytes(out / "frames.jsonl"), first);
  }
}

TEST_F(Detect, points_are_where_two_faces_meet) {
  expect_success(detect({write("square.off", square_off), write("needle.off", needle(0.75, 0.25)), "--points",
                         "--contacts", "all", "--meetings", "0", "--collision-distance", "9"}));
  const Json pair = frames().at(0)["pairs"].at(0);
  ASSERT_EQ(face_pairs(pair), (Pairs{{0, 0}}));
  auto points = pair["points"].at(0).get<std::vector<std::vector<double>>>();
  std::ranges::sort(points);
  ASSERT_EQ(points.size(), 2U);
  const std::vector<std::vector<double>> expected{{0.75, 0.25, 0}, {0.8, 0.25, 0}};
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(points[i].at(axis), expected[i][axis], 1e-14);
}

TEST_F(Detect, the_number_of_particles_is_the_requested_one) {
  const auto scene = write("scene.json", R"({"objects": [
    {"name": "fixed", "shape": {"icosphere": {"frequency": 6}}, "particles": 7},
    {"name": "free", "shape": {"icosphere": {"frequency": 6}}}]})");
  const auto particles = [&] {
    std::vector<int> counts;
    const Json result = summary();
    for (const auto& object : result["objects"]) counts.push_back(object["particles"]);
    return counts;
  };
  expect_success(detect({scene}));
  EXPECT_EQ(particles().at(0), 7);
  expect_success(detect({scene, "--particles", "20"}));
  EXPECT_EQ(particles(), (std::vector<int>{20, 20}));

  // Regions at the top of a tree: no leaf holds faces of two of them.
  const auto leaves = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {scene, "--mode", "exact"});
    expect_success(detect(options));
    std::vector<int> counts;
    const Json result = summary();
    for (const auto& object : result["objects"]) counts.push_back(object["leaves"]);
    return counts;
  };
  const auto of_scene = leaves({"--strategy", "metis"}), of_both = leaves({"--strategy", "metis", "--particles", "12"});
  EXPECT_EQ(of_scene.at(1), of_both.at(1));  // the free one has 12 regions
  EXPECT_NE(of_scene.at(0), of_both.at(0));  // the other its own 7
}

TEST_F(Detect, the_summary_counts_vertices_and_faces) {
  expect_success(detect({write("square.off", square_off), write("tetrahedron.off", tetrahedron_off())}));
  const Json objects = summary()["objects"];
  EXPECT_EQ(objects.at(0)["name"], "square");
  EXPECT_EQ(objects.at(0)["vertices"], 4);
  EXPECT_EQ(objects.at(0)["faces"], 2);
  EXPECT_EQ(objects.at(1)["name"], "tetrahedron");
  EXPECT_EQ(objects.at(1)["faces"], 4);
}

TEST_F(Detect, files_of_equal_names_are_told_apart) {
  create_directory(folder.path() / "other");
  expect_success(detect({write("a.off", tetrahedron_off()), write("other/a.off", tetrahedron_off()),
                         write("a_2.off", tetrahedron_off()), write("a.obj", square_obj)}));
  std::set<std::string> names;
  const Json result = summary();
  for (const auto& object : result["objects"]) names.insert(object["name"]);
  EXPECT_EQ(names.size(), 4U);
  EXPECT_TRUE(names.contains("a"));
}

TEST_F(Detect, names_of_files_may_be_any_bytes) {
  const auto result =
      detect({write("\xff\xfe.off", tetrahedron_off()), write("two\nlines\x1b[2J.off", tetrahedron_off())});
  expect_success(result);
  EXPECT_EQ(frames().at(0)["pairs"].at(0)["collides"], true);
  EXPECT_EQ(summary()["objects"].at(1)["name"], "two?lines?[2J");
  EXPECT_EQ(result.out.find('\x1b'), std::string::npos);
}

TEST_F(Detect, quiet_prints_the_answer_alone) {
  const auto result = detect({write_meeting_tetrahedra({1}), "--quiet", "--truth"});
  expect_success(result);
  EXPECT_EQ(result.out,
            "meeting: 1 colliding pair, first in frame 0, last in frame 0 of 1 frame; truth: 1 colliding frame, summed "
            "over the pairs, 1 found\n");
  EXPECT_EQ(frames().size(), 1U);
}

TEST_F(Detect, quiet_tells_what_was_missed_in_all_pairs) {
  const auto square = write("square.off", square_off);
  const auto result =
      run_program({"detect", square, write("needle.off", needle(0.7, 0.2)), square, "--truth", "--quiet", "--meetings",
                   "0", "--mode", "particles", "--collision-distance", "0.001"});
  expect_success(result);
  EXPECT_NE(result.out.find("; truth: 3 colliding frames, summed over the pairs, 1 found"), std::string::npos)
      << result.out;
}

TEST_F(Detect, what_is_asked_of_contacts_and_not_written_is_noted) {
  const auto scene = write_meeting_tetrahedra({1});
  const std::string note = "only --out and --html tell what was found for --points, --normals";
  EXPECT_EQ(detect({scene, "--points", "--normals"}).err.find(note), std::string::npos);
  EXPECT_NE(run_program({"detect", scene, "--points", "--normals"}).err.find(note), std::string::npos);
}

TEST_F(Detect, growth_may_be_infinite) {
  expect_success(detect({write_shapes(), "--growth", "inf"}));
  EXPECT_EQ(summary()["mean_repartitions"], 0.0);
}

TEST_F(Detect, degenerate_meshes_are_legal_and_answered_exactly) {
  // A needle of zero area, a face that is a point, three faces on one edge, a duplicate vertex, two components.
  const std::vector<Sample> odd{
      {"line.off", "OFF\n3 1 0\n0.7 0.2 -1\n0.7 0.2 1\n0.7 0.2 0.5\n3 0 1 2\n"},
      {"point.off", "OFF\n1 1 0\n0.7 0.2 0\n3 0 0 0\n"},
      {"fan.off", "OFF\n5 3 0\n0.7 0.2 -1\n0.7 0.2 1\n2 0 0\n2 1 0\n2 2 0\n3 0 1 2\n3 0 1 3\n3 0 1 4\n"},
      {"twice.off", "OFF\n4 2 0\n0.7 0.2 -1\n0.7 0.2 1\n0.8 0.2 1\n0.7 0.2 1\n3 0 1 2\n3 0 3 2\n"},
      {"parts.off", needle(0.7, 0.2).replace(4, 5, "6 2 0") + "3 3 4 5\n"}};
  const auto square = write("square.off", square_off);
  for (auto [name, bytes] : odd) {
    SCOPED_TRACE(name);
    if (name == "parts.off") {
      const auto at = bytes.find("3 0 1 2");
      bytes.insert(at, "8 8 8\n9 8 8\n8 9 8\n");
    }
    const auto file = write(name, bytes);
    expect_success(detect(
        {square, file, "--contacts", "all", "--truth", "--meetings", "0", "--collision-distance", "99", "--quiet"}));
    const Json pair = frames().at(0)["pairs"].at(0);
    EXPECT_EQ(pair["collides"], true);
    EXPECT_EQ(pair["truth"], true);
    EXPECT_EQ(face_pairs(pair), exhaustive_pairs(read_mesh(square).mesh, read_mesh(file).mesh));
  }
}

TEST_F(Detect, a_scene_of_the_collection_runs) {
  const auto result = detect({LODESTONE_DATA "/scenes/wrong_side.json", "--quiet"});
  expect_success(result);
  const auto scene = read_scene(LODESTONE_DATA "/scenes/wrong_side.json");
  EXPECT_EQ(frames().size(), scene.frames);
}

}  // namespace
}  // namespace lodestone::test
