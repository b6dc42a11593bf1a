// SPDX-License-Identifier: GPL-3.0-or-later
// The pages that the program writes, decoded.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "lodestone/io/meshes/mesh_file.h"
#include "lodestone/io/scenes/scene_file.h"
#include "lodestone/queries/exhaustive.h"
#include "program/run_program.h"
#include "support/mesh_samples.h"
#include "support/page_decoder.h"
#include "support/scene_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

using Json = nlohmann::json;

/// A sphere that inflates and goes through another, and a third body, for ten frames.
constexpr std::string_view bodies = R"({"name": "bodies <&> \"more\"", "frames": 10, "objects": [
  {"name": "balloon", "shape": {"icosphere": {"frequency": 6}},
   "motion": {"deform": [{"inflate": {"factor": 1.5, "frames": 8}},
                         {"travel": {"path": "linear", "way_points": [{"frame": 0, "at": [-3, 0, 0]},
                                                                      {"frame": 9, "at": [-1, 0, 0]}]}}]}},
  {"name": "ball", "shape": {"uv_sphere": {"slices": 14, "stacks": 9}}},
  {"name": "</script><script>alert(1)</script>", "shape": {"icosphere": {"frequency": 3}},
   "place": {"translate": [4, 3, 0]}}]})";

class Html : public testing::Test {
 protected:
  void SetUp() override {
    if (!LODESTONE_HAS_VIEWER) GTEST_SKIP() << "the program was built without the viewer";
  }
  std::string write(const std::string& name, std::string_view bytes) const {
    return folder.write(name, bytes).string();
  }
  std::string bodies_file() const { return write("bodies.json", bodies); }
  /// Runs a command with `--html`, which must succeed.
  Decoded_page page_of(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--html", page.string()});
    expect_success(run_program(arguments));
    return Decoded_page(data_of(read_bytes(page)));
  }
  /// A run by particles unless the options name a mode.
  Decoded_page detect(const std::vector<std::string>& options = {}) const {
    std::vector<std::string> arguments{bodies_file()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return page_of(detect_by_particles(arguments));
  }

  Temporary_folder folder;
  std::filesystem::path page = folder.path() / "pages" / "page.html", out = folder.path() / "out";
};

/// The lines of a section, each with its line break.
std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const auto end = text.find('\n', at) + 1;
    lines.push_back(text.substr(at, end - at));
    at = end;
  }
  return lines;
}

TEST_F(Html, numbers_equal_those_of_the_results_byte_for_byte) {
  const std::vector<std::vector<std::string>> runs{
      {}, {"--truth"}, {"--mode", "senin"}, {"--contacts", "first", "--points"}, {"--mode", "exact", "--normals"}};
  for (const auto& options : runs) {
    SCOPED_TRACE(testing::PrintToString(options));
    auto with_results = options;
    with_results.insert(with_results.end(), {"--out", out.string()});
    const auto shown = detect(with_results);
    EXPECT_EQ(shown.section(shown.header["numbers"]), read_bytes(out / "frames.jsonl"));
    shown.expect_packed();
  }
}

TEST_F(Html, the_results_equal_those_of_a_run_without_a_page_for_all_contacts) {
  detect({"--out", out.string()});
  const auto with = read_bytes(out / "frames.jsonl");
  expect_success(run_program(detect_by_particles({bodies_file(), "--contacts", "all", "--out", out.string()})));
  EXPECT_EQ(read_bytes(out / "frames.jsonl"), with);
}

TEST_F(Html, the_same_run_gives_the_same_page_except_for_times) {
  for (const auto* mode : {"particles", "exact", "senin"}) {
    const auto first = detect({"--mode", mode}), second = detect({"--mode", mode});
    auto head = first.header, other_head = second.header;
    for (auto* h : {&head, &other_head}) h->erase("sections");
    EXPECT_EQ(head, other_head);
    EXPECT_EQ(first.timeless(), second.timeless());
  }
}

TEST_F(Html, objects_have_the_positions_of_the_scene) {
  const auto file = bodies_file();
  const auto shown = detect();
  EXPECT_EQ(shown.header["kind"], "detect");
  EXPECT_EQ(shown.header["title"], "bodies <&> \"more\"");
  EXPECT_EQ(shown.header["mode"], "particles");
  EXPECT_EQ(shown.header["strategy"], "lbg");
  EXPECT_EQ(shown.header["frames"], 10);
  EXPECT_EQ(shown.header["first_frame"], 0);
  EXPECT_EQ(shown.header["frame_step"], 1);
  Scene scene = read_scene(file);
  ASSERT_EQ(shown.header["objects"].size(), scene.objects.size());
  for (std::size_t o = 0; o < scene.objects.size(); ++o) {
    auto& object = scene.objects[o];
    EXPECT_EQ(shown.object(o)["name"], object.name);
    EXPECT_EQ(shown.topology(o).size(), 3 * object.mesh.number_of_faces());
    const auto box = shown.object(o)["box"].get<std::array<double, 6>>();
    const auto decoded = shown.positions(o);
    for (std::size_t frame = 0; frame < scene.frames; ++frame) {
      pose(object, frame);
      for (const auto v : object.mesh.vertices())
        for (int axis = 0; axis < 3; ++axis)
          ASSERT_NEAR(decoded[frame][3 * v + axis], object.mesh.point(v)[axis],
                      (box[3 + axis] - box[axis]) / 65535 * 0.500001);
    }
  }
}

TEST_F(Html, names_cannot_inject_markup) {
  detect();
  const auto html = read_bytes(page);
  EXPECT_NE(html.find("<title>bodies &lt;&amp;&gt; &quot;more&quot;"), std::string::npos);
  EXPECT_EQ(html.find("alert(1)"), std::string::npos);
  EXPECT_EQ(html.find("@LODESTONE"), std::string::npos);
}

TEST_F(Html, regions_change_when_an_object_is_repartitioned) {
  const auto shown = detect({"--particles", "16"});
  std::set<std::size_t> repartitioned{0};
  const auto lines = lines_of(shown.section(shown.header["numbers"]));
  for (std::size_t f = 0; f < lines.size(); ++f)
    if (Json::parse(lines[f])["statistics"]["repartitions"] > 0) repartitioned.insert(f);
  EXPECT_GT(repartitioned.size(), 1U) << "the balloon has not grown";
  std::set<std::size_t> changed;
  for (std::size_t o = 0; o < 3; ++o) {
    const auto& partitions = shown.object(o)["partitions"];
    EXPECT_EQ(partitions.at(0)["frame"], 0);
    for (std::size_t p = 0; p < partitions.size(); ++p) {
      changed.insert(partitions[p]["frame"].get<std::size_t>());
      const auto labels = shown.labels(o, p);
      EXPECT_EQ(std::set<std::uint32_t>(labels.begin(), labels.end()).size(), partitions[p]["regions"]);
      // A particle stays in its region.
      const auto particles = shown.particles(o);
      const std::size_t end = p + 1 < partitions.size() ? partitions[p + 1]["frame"].get<std::size_t>() : 10;
      for (std::size_t f = partitions[p]["frame"]; f < end; ++f) {
        ASSERT_EQ(particles[f].size(), partitions[p]["regions"]);
        for (std::uint32_t region = 0; region < particles[f].size(); ++region)
          EXPECT_EQ(labels.at(particles[f][region]), region);
      }
    }
  }
  EXPECT_TRUE(std::ranges::includes(repartitioned, changed));
}

TEST_F(Html, candidates_are_as_many_as_counted) {
  for (const auto* mode : {"particles", "senin"}) {
    const auto shown = detect({"--mode", mode, "--collision-distance", "2"});
    const auto candidates = shown.json_section("candidates");
    const auto lines = lines_of(shown.section(shown.header["numbers"]));
    ASSERT_EQ(candidates.size(), lines.size());
    std::size_t all = 0;
    for (std::size_t f = 0; f < lines.size(); ++f) {
      EXPECT_EQ(candidates[f].size(), Json::parse(lines[f])["statistics"]["candidates"]);
      all += candidates[f].size();
      for (const auto& candidate : candidates[f]) {
        ASSERT_EQ(candidate.size(), 5U);
        EXPECT_LT(candidate[0], candidate[2]);
        EXPECT_LT(candidate[1], shown.particles(candidate[0])[f].size());
        EXPECT_LT(candidate[3], shown.particles(candidate[2])[f].size());
      }
    }
    EXPECT_GT(all, 10U);
  }
}

/// Face pairs of one frame of a page, by objects.
std::set<std::array<std::size_t, 4>> faces_of(const Json& contacts) {
  std::set<std::array<std::size_t, 4>> faces;
  for (const auto& c : contacts) faces.insert(std::array<std::size_t, 4>{c[0], c[1], c[2], c[3]});
  return faces;
}

TEST_F(Html, contacts_of_mode_exact_equal_exhaustive_checking_and_lie_on_both_faces) {
  const auto file = bodies_file();
  const auto shown = detect({"--mode", "exact"});
  EXPECT_EQ(shown.header["candidates"], nullptr);
  EXPECT_EQ(shown.object(0)["particles"], nullptr);
  const auto contacts = shown.json_section("contacts");
  Scene scene = read_scene(file);
  std::size_t found = 0;
  for (std::size_t f = 0; f < scene.frames; ++f) {
    for (auto& object : scene.objects) pose(object, f);
    std::set<std::array<std::size_t, 4>> expected;
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = a + 1; b < 3; ++b)
        for (const auto& [face_a, face_b] : exhaustive_face_pairs(scene.objects[a].mesh, scene.objects[b].mesh))
          expected.insert({a, face_a, b, face_b});
    EXPECT_EQ(faces_of(contacts.at(f)), expected);
    found += expected.size();
    for (const auto& contact : contacts.at(f)) {
      ASSERT_EQ(contact.size(), 10U);
      for (const int side : {0, 2}) {
        const auto& mesh = scene.objects[contact[side].get<std::size_t>()].mesh;
        const auto h = mesh.halfedge(Surface_mesh::Face_index(contact[side + 1].get<std::uint32_t>()));
        const Kernel::Triangle_3 triangle(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
                                          mesh.point(mesh.target(mesh.next(h))));
        for (const int end : {4, 7}) {
          const Point point(contact[end].get<double>(), contact[end + 1].get<double>(), contact[end + 2].get<double>());
          EXPECT_LT(CGAL::squared_distance(triangle, point), 1e-24);
        }
      }
    }
  }
  EXPECT_GT(found, 10U);
}

TEST_F(Html, notes_that_the_mode_may_miss_collisions) {
  for (const auto* mode : {"particles", "senin"}) {
    const auto note = detect({"--mode", mode}).header["note"].get<std::string>();
    EXPECT_NE(note.find("may miss collisions"), std::string::npos) << note;
  }
  EXPECT_EQ(detect({"--mode", "exact"}).header["note"], nullptr);
}

TEST_F(Html, contacts_are_those_that_were_requested) {
  EXPECT_EQ(detect({"--contacts", "yes_no"}).header["contacts"], nullptr);
  const auto first = detect({"--contacts", "first"}).json_section("contacts");
  std::size_t most = 0;
  for (const auto& frame : first) most = std::max(most, frame.size());
  EXPECT_EQ(most, 1U);
}

TEST_F(Html, coplanar_faces_are_marked_by_the_sides_of_their_common_polygon) {
  const auto a = write("a.off", "OFF\n3 1 0\n0 0 0\n4 0 0\n0 4 0\n3 0 1 2\n");
  const auto b = write("b.off", "OFF\n3 1 0\n1 1 0\n-3 1 0\n1 -3 0\n3 0 1 2\n");
  const auto contacts = page_of({"detect", a, b, "--mode", "exact"}).json_section("contacts");
  // The square from (0, 0) to (1, 1): four sides, each of which ends where the next begins.
  ASSERT_EQ(contacts.at(0).size(), 4U);
  std::set<std::pair<double, double>> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto &side = contacts[0][i], &next = contacts[0][(i + 1) % 4];
    EXPECT_EQ(Json({side[7], side[8], side[9]}), Json({next[4], next[5], next[6]}));
    corners.emplace(side[4], side[5]);
  }
  EXPECT_EQ(corners, (std::set<std::pair<double, double>>{{0, 0}, {1, 0}, {0, 1}, {1, 1}}));
}

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

TEST_F(Html, has_no_more_frames_than_requested) {
  const auto shown = detect({"--html-frames", "4", "--out", out.string()});
  EXPECT_EQ(shown.header["frames"], 4);
  EXPECT_EQ(shown.header["frame_step"], 3);
  const auto all = lines_of(read_bytes(out / "frames.jsonl"));
  ASSERT_EQ(all.size(), 10U);
  EXPECT_EQ(shown.section(shown.header["numbers"]), all[0] + all[3] + all[6] + all[9]);
  EXPECT_EQ(shown.json_section("stages").size(), 4U);
  EXPECT_EQ(shown.json_section("contacts").size(), 4U);
  EXPECT_EQ(shown.particles(0).size(), 4U);
  Scene scene = read_scene(bodies_file());
  pose(scene.objects[0], 9);
  const auto last = shown.positions(0).at(3);
  for (const auto v : scene.objects[0].mesh.vertices())
    EXPECT_NEAR(last[3 * v], scene.objects[0].mesh.point(v).x(), 1e-3);
}

TEST_F(Html, reports_what_was_written) {
  const auto all = run_program({"detect", "--mode", "particles", bodies_file(), "--html", page.string()});
  EXPECT_NE(all.out.find("page: " + page.string() + ", "), std::string::npos) << all.out;
  EXPECT_EQ(all.out.find("--html-frames"), std::string::npos) << all.out;
  const auto some =
      run_program({"detect", "--mode", "particles", bodies_file(), "--html", page.string(), "--html-frames", "5"});
  EXPECT_NE(some.out.find("5 of 10 frames: one of every 2 (see --html-frames)\n"), std::string::npos) << some.out;
  const auto quiet = run_program({"detect", "--mode", "particles", bodies_file(), "--html", page.string(), "--quiet"});
  EXPECT_EQ(quiet.out.find("page:"), std::string::npos) << quiet.out;
}

TEST_F(Html, of_the_paper_s_pair_is_small) {
  const auto shown =
      page_of({"detect", LODESTONE_DATA "/scenes/teapot_sphere_1.json", "--mode", "particles", "--particles", "32"});
  EXPECT_EQ(shown.header["frames"], 300);
  EXPECT_EQ(shown.header["frame_step"], 1);
  EXPECT_LT(file_size(page), 15'000'000U);
}

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

TEST_F(Html, a_name_that_does_not_end_in_html_is_refused) {
  const auto mesh = write("square.off", square_off);
  for (const std::string& target : {mesh, (folder.path() / "page").string(), (folder.path() / "a.json").string()}) {
    expect_error(run_program({"partition", mesh, "--html", target}), 2, ".html");
    expect_error(run_program({"detect", "--mode", "particles", mesh, mesh, "--html", target}), 2, ".html");
    expect_error(run_program({"experiment", "collision_distance", "--out", out.string(), "--html", target}), 2,
                 ".html");
  }
  EXPECT_EQ(read_bytes(mesh), square_off);
  EXPECT_EQ(content_of(folder.path()), std::set<std::string>{"square.off"});
}

TEST_F(Html, a_page_with_the_path_of_another_result_is_refused) {
  const auto mesh = write("square.off", square_off);
  const auto there = folder.path() / "here" / ".." / "page.html", here = folder.path() / "page.html";
  create_directory(folder.path() / "here");
  expect_error(run_program({"partition", mesh, "--html", here.string(), "--json", there.string()}), 2, "the same file");
  expect_error(
      run_program({"detect", "--mode", "particles", mesh, mesh, "--html", here.string(), "--out", there.string()}), 2,
      "the same file");
  EXPECT_EQ(content_of(folder.path()), (std::set<std::string>{"here", "square.off"}));
}

TEST_F(Html, a_limit_of_frames_needs_a_page) {
  expect_error(run_program({"detect", "--mode", "particles", bodies_file(), "--html-frames", "5"}), 2, "--html");
  expect_error(
      run_program({"detect", "--mode", "particles", bodies_file(), "--html", page.string(), "--html-frames", "-1"}), 2,
      "--html-frames");
}

TEST_F(Html, a_path_that_cannot_be_written_is_an_error_before_the_run) {
  const auto file = folder.write("file", "mine");
  const auto mesh = write("square.off", square_off);
  for (const std::string& target : {(file / "page.html").string(), std::string("/proc/lodestone/page.html")}) {
    expect_error(run_program({"detect", "--mode", "particles", bodies_file(), "--out", out.string(), "--html", target}),
                 4, "");
    expect_error(run_program({"partition", mesh, "--html", target}), 4, "");
    expect_error(run_program({"experiment", "modes", "--out", out.string(), "--html", target}), 4, "");
  }
  EXPECT_EQ(content_of(out), std::set<std::string>{});
}

TEST_F(Html, a_full_disk_leaves_nothing) {
  const auto input = bodies_file();
  detect({"--out", out.string()});
  const auto size = file_size(page);
  ASSERT_GT(size, file_size(out / "frames.jsonl"));
  remove_all(out);
  remove(page);
  expect_error(run_program({"detect", "--mode", "particles", input, "--out", out.string(), "--html", page.string()},
                           {.largest_file = static_cast<rlim_t>(size / 2)}),
               4, "page.html");
  EXPECT_EQ(content_of(out), std::set<std::string>{});
  EXPECT_EQ(content_of(page.parent_path()), std::set<std::string>{});
}

TEST_F(Html, a_bad_input_keeps_the_old_page) {
  detect();
  const auto old = read_bytes(page);
  const auto bad = write("bad.off", "OFF\n");
  expect_error(run_program({"partition", bad, "--html", page.string()}), 3, "bad.off");
  expect_error(run_program({"detect", "--mode", "particles", bad, bad, "--html", page.string()}), 3, "bad.off");
  EXPECT_TRUE(read_bytes(page) == old);
  EXPECT_EQ(content_of(page.parent_path()), std::set<std::string>{"page.html"});
}

TEST(Html_without_a_viewer, is_an_error_that_states_the_reason) {
  if (LODESTONE_HAS_VIEWER) GTEST_SKIP() << "the program has the viewer";
  const Temporary_folder folder;
  const auto mesh = folder.write("square.off", square_off).string(), page = (folder.path() / "page.html").string();
  expect_error(run_program({"partition", mesh, "--html", page}), 4, "without the viewer, because ");
  expect_error(run_program({"detect", "--mode", "particles", mesh, mesh, "--html", page}), 4,
               "without the viewer, because ");
  EXPECT_EQ(content_of(folder.path()), std::set<std::string>{"square.off"});
}

}  // namespace
}  // namespace lodestone::test
