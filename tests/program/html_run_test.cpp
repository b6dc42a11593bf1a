// SPDX-License-Identifier: GPL-3.0-or-later
// What the page of a run shows.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "lodestone/io/scenes/scene_file.h"
#include "lodestone/queries/exhaustive.h"
#include "program/html_pages.h"

namespace lodestone::test {
namespace {

using Json = nlohmann::json;

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

TEST_F(Html, shows_regions_of_mode_exact_only_where_it_has_some) {
  const auto run = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"detect", R"(shape:{"icosphere": {"frequency": 4}})", "shape:teapot"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return page_of(arguments);
  };
  const auto without = run({}), with = run({"--strategy", "grid"});
  EXPECT_EQ(without.header["strategy"], nullptr);
  EXPECT_EQ(without.object(0)["partitions"].size(), 0U);
  EXPECT_EQ(with.header["strategy"], "grid");
  EXPECT_EQ(with.object(0)["partitions"].size(), 1U);
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
  const std::vector<std::vector<std::string>> runs{{"--mode", "particles"},
                                                   {"--mode", "particles", "--meetings", "0"},
                                                   {"--mode", "senin", "--collision-distance", "2"}};
  for (const auto& options : runs) {
    const auto shown = detect(options);
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

}  // namespace
}  // namespace lodestone::test
