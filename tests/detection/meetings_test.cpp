// SPDX-License-Identifier: GPL-3.0-or-later
// What a frame by meetings reads, counts, lists and refuses.
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <string>
#include <tuple>

#include "detection/detector_scenes.h"
#include "lodestone/io/scenes/scene_file.h"
#include "lodestone/io/shapes/shapes.h"
#include "support/counting_points.h"
#include "support/exact_truth.h"
#include "support/special_numbers.h"

namespace lodestone {
namespace {

Detector_options by_meetings(Contact_query query = Contact_query::all) {
  return {.mode = Mode::particles, .particles = 16, .contacts = query};
}

TEST(Meetings, a_frame_of_two_large_spheres_that_touch_reads_few_of_their_vertices) {
  // Around the contact two spheres are near each other over a wide area, all of which is read for all contacts. How
  // much of it is read before one contact is found depends on where the regions happen to end. The smaller spheres have
  // regions that would be read as a whole for all contacts.
  for (const auto& [query, frequency, part] :
       {std::tuple(Contact_query::yes_no, 63U, 20U), std::tuple(Contact_query::all, 126U, 10U)}) {
    Owned_meshes scene{icosphere(frequency), icosphere(frequency)};
    shift(scene[1], 1.999);
    ASSERT_EQ(num_faces(scene[0]), 20 * frequency * frequency);
    Detector<> detector({.mode = Mode::particles, .contacts = query});
    add_all(detector, scene);
    for (int frame = 0; frame < 3; ++frame) {
      const Frame& found = detector.detect();
      EXPECT_TRUE(found.collides());
      EXPECT_LT(found.statistics.vertices_read, (num_vertices(scene[0]) + num_vertices(scene[1])) / part);
      detector.update();
    }
  }
}

TEST(Meetings, the_statistics_count_every_position_that_is_read) {
  for (const std::size_t budget : {std::size_t{50}, Detector_options{}.opening_budget})
    for (const auto query : {Contact_query::yes_no, Contact_query::all}) {
      auto scene = two_spheres(2.1);
      auto options = by_meetings(query);
      options.opening_budget = budget;
      std::size_t reads = 0;
      Detector<> detector(options);
      for (auto& mesh : scene) detector.add(mesh, Counting_points{&mesh, &reads});
      detector.detect();
      for (int frame = 0; frame < 10; ++frame) {
        shift(scene[1], -0.03);
        detector.update();
        reads = 0;
        const auto& statistics = detector.detect().statistics;
        EXPECT_LE(reads, statistics.vertices_read) << budget;
        EXPECT_GE(reads + 200, statistics.vertices_read) << budget;
      }
    }
}

TEST(Meetings, a_small_budget_finds_nearly_all_contacts_since_known_curves_are_followed_first) {
  auto scene = read_scene(std::filesystem::path(LODESTONE_DATA) / "scenes" / "torus_knots.json");
  Detector<> particles({.mode = Mode::particles, .opening_budget = 500, .contacts = Contact_query::all});
  Detector<> exact({.mode = Mode::exact, .contacts = Contact_query::all});
  for (const auto& object : scene.objects) particles.add(object.mesh), exact.add(object.mesh);
  std::size_t found = 0, contacts = 0;
  for (std::size_t frame = 0; frame < scene.frames; ++frame) {
    for (auto& object : scene.objects) pose(object, frame);
    particles.update(), exact.update();
    found += particles.detect().face_pairs.size();
    contacts += exact.detect().face_pairs.size();
  }
  EXPECT_GT(contacts, 10'000U);
  EXPECT_LE(found, contacts);
  EXPECT_GT(found, contacts - contacts / 30) << "curves that are looked for anew in each frame: 7 of 8 contacts";
}

TEST(Meetings, positions_that_are_read_by_a_point_map_give_the_frames_of_those_in_memory) {
  auto one = two_spheres(2.2), other = two_spheres(2.2);
  std::size_t reads = 0;
  Detector<> expected(by_meetings()), detector(by_meetings());
  add_all(expected, one);
  for (auto& mesh : other) detector.add(mesh, Counting_points{&mesh, &reads});
  std::size_t contacts = 0;
  for (int frame = 0; frame < 12; ++frame) {
    expect_same_frame(detector.detect(), expected.detect());
    contacts += detector.detect().face_pairs.size();
    expected.detect();
    for (auto* scene : {&one, &other}) {
      shift((*scene)[1], -0.05, 0.01);
      scale((*scene)[0], 1.01);
    }
    expected.update(), detector.update();
  }
  EXPECT_GT(contacts, 100U);
}

TEST(Meetings, the_same_scene_gives_the_same_frames_for_any_number_of_threads) {
  for (const std::size_t budget : {std::size_t{20}, Detector_options{}.opening_budget})
    for (const auto query : {Contact_query::first, Contact_query::all}) {
      auto one = two_spheres(2.2), other = two_spheres(2.2);
      auto options = by_meetings(query);
      options.opening_budget = budget;
      Detector<> first(options);
      options.threads = 3;
      Detector<> second(options);
      add_all(first, one), add_all(second, other);
      for (int frame = 0; frame < 10; ++frame) {
        expect_same_frame(first.detect(), second.detect());
        for (auto* scene : {&one, &other}) {
          shift((*scene)[1], -0.05, 0.01);
          scale((*scene)[0], 1.02);
        }
        first.update(), second.update();
      }
    }
}

TEST(Meetings, where_the_particles_still_meet_nothing_else_is_looked_at) {
  for (const auto query : {Contact_query::yes_no, Contact_query::first}) {
    auto scene = two_spheres(1.9);
    Detector<> detector(by_meetings(query));
    add_all(detector, scene);
    const auto first = detector.detect().statistics;
    EXPECT_GT(first.leaf_tests, 0U);
    EXPECT_GT(first.exact_tests, 0U);
    for (int frame = 0; frame < 3; ++frame) {
      const auto& next = detector.detect().statistics;
      EXPECT_EQ(next.leaf_tests + next.meetings + next.moves, 0U);
      EXPECT_EQ(next.exact_tests, 1U);
      EXPECT_EQ(next.candidates, 1U);
      EXPECT_LT(next.vertices_read, 100U);
    }
  }
}

TEST(Meetings, particles_are_where_they_met) {
  auto scene = two_spheres(1.9);
  Detector<> detector(by_meetings(Contact_query::first));
  add_all(detector, scene);
  const Frame& frame = detector.detect();
  ASSERT_EQ(frame.face_pairs.size(), 1U);
  const auto [face_a, face_b] = frame.face_pairs[0];
  for (const auto& [object, face] : {std::pair{0U, face_a}, std::pair{1U, face_b}}) {
    const auto& surface = detector.object(object);
    const auto& corners = surface.corners()[face];
    EXPECT_TRUE(std::ranges::any_of(surface.particles().at,
                                    [&](std::uint32_t at) { return std::ranges::find(corners, at) != corners.end(); }));
    for (Region_index region = 0; region < surface.particles().at.size(); ++region)
      EXPECT_EQ(surface.labels()[surface.particles().at[region]], region);
  }
}

TEST(Meetings, happen_only_where_the_budget_has_ended_the_openings) {
  for (const bool tiny : {true, false}) {
    auto scene = two_spheres(1.9);
    auto options = by_meetings(Contact_query::first);
    if (tiny) options.opening_budget = 1;
    Detector<> detector(options);
    add_all(detector, scene);
    const Frame& frame = detector.detect();
    expect_true(frame, scene);
    expect_sums_of_pairs(frame);
    EXPECT_EQ(frame.statistics.meetings > 0, tiny);
    EXPECT_EQ(frame.statistics.iterations > 0, tiny);
    EXPECT_EQ(frame.statistics.leaf_tests > 0, !tiny);
    EXPECT_LE(frame.statistics.meetings, options.meetings);
  }
}

TEST(Meetings, a_frame_tells_where_the_budget_has_ended_the_search) {
  auto scene = two_spheres(1.9);
  scene.push_back(sphere(4));
  shift(scene[2], 50);
  for (const auto query : {Contact_query::yes_no, Contact_query::first, Contact_query::all})
    for (const std::size_t budget : {std::size_t{1}, Detector_options{}.opening_budget})
      for (const bool apart : {false, true}) {
        auto options = by_meetings(query);
        options.opening_budget = budget;
        Detector<> detector(options);
        auto meshes = scene;
        if (apart) shift(meshes[1], 0.12);  // near, but not touching
        add_all(detector, meshes);
        const Frame& frame = detector.detect();
        const bool has_more_to_find = query == Contact_query::all || !frame.collides();
        EXPECT_EQ(frame.collides(), !apart);
        EXPECT_EQ(frame.unfinished(), budget == 1 && has_more_to_find);
        for (const auto& pair : frame.pairs) EXPECT_EQ(pair.unfinished, frame.unfinished() && pair.b == 1);
      }
}

TEST(Meetings, curves_that_were_found_once_are_found_again_and_leave_the_budget_to_others) {
  Surface_mesh balls, plate = grid(60, 60);
  for (int i = 0; i < 36; ++i) append(balls, sphere(6, 0.4, {1.3 + i % 6, 1.3 + i / 6, 0.1}));
  deform(plate, [](const Point& p) { return Point(p.x() * 7 / 60, p.y() * 7 / 60, 0.03 * std::sin(p.x())); });
  Owned_meshes scene{balls, plate};
  auto options = by_meetings();
  options.opening_budget = 700;
  Detector<> detector(options);
  add_all(detector, scene);
  std::size_t found = 0, at_first = 0, truth = 0;
  for (int frame = 0; frame < 40; ++frame) {
    shift(scene[0], 1e-5);
    const Frame& now = detector.detect();
    expect_true(now, scene);
    EXPECT_GE(now.face_pairs.size() + 2, found) << frame;
    found = now.face_pairs.size();
    if (frame == 0) at_first = found;
  }
  truth = exhaustive_face_pairs(scene[0], scene[1]).size();
  EXPECT_LT(at_first, truth / 2);
  EXPECT_EQ(found, truth);
}

TEST(Meetings, may_be_as_many_as_there_are_numbers) {
  auto scene = two_spheres(1.9);
  auto options = by_meetings();
  options.meetings = std::numeric_limits<std::size_t>::max();
  Detector<> detector(options);
  add_all(detector, scene);
  for (int again = 0; again < 2; ++again) EXPECT_EQ(expect_exhaustive(detector.detect(), {&scene[0], &scene[1]}), 1U);
}

TEST(Meetings, with_a_small_budget_all_contacts_are_those_of_the_whole_curve) {
  for (const std::size_t budget : {1, 50, 200, 1000}) {
    auto scene = two_spheres(1.9);
    auto options = by_meetings();
    options.opening_budget = budget;
    Detector<> detector(options);
    add_all(detector, scene);
    for (int again = 0; again < 2; ++again)
      EXPECT_EQ(expect_exhaustive(detector.detect(), {&scene[0], &scene[1]}), 1U) << budget;
  }
}

TEST(Meetings, near_regions_are_listed_as_candidates_the_nearest_first) {
  for (const auto query : {Contact_query::yes_no, Contact_query::all}) {
    auto scene = two_spheres(2.05);
    scene.push_back(sphere(8, 0.7, {1, 1.5, 0}));
    auto options = by_meetings(query);
    options.list_candidates = true;
    Detector<> detector(options);
    add_all(detector, scene);
    std::size_t several = 0;
    for (int number = 0; number < 8; ++number) {
      const Frame& frame = detector.detect();
      expect_sums_of_pairs(frame);
      ASSERT_EQ(frame.candidates.size(), frame.statistics.candidates);
      std::size_t next = 0;
      for (const auto& pair : frame.pairs) {
        EXPECT_TRUE(!pair.collides || pair.candidates > 0);
        const auto listed = std::span(frame.candidates).subspan(next, pair.candidates);
        EXPECT_TRUE(std::ranges::is_sorted(listed, {}, &Candidate_regions::distance));
        for (const auto& candidate : listed) {
          EXPECT_EQ(candidate.a, pair.a);
          EXPECT_EQ(candidate.b, pair.b);
          EXPECT_LT(candidate.region_a, detector.object(pair.a).particles().at.size());
          EXPECT_LT(candidate.region_b, detector.object(pair.b).particles().at.size());
        }
        next += pair.candidates;
        several += pair.candidates > 1 ? 1 : 0;
      }
      shift(scene[1], -0.05);
      detector.update();
    }
    EXPECT_GT(several, 3U);
  }
}

TEST(Meetings, a_coordinate_that_is_not_finite_where_objects_meet_names_the_object) {
  for (const Object_id bad : {0U, 1U})
    for (const std::size_t budget : {std::size_t{1}, Detector_options{}.opening_budget}) {
      auto scene = two_spheres(1.9);
      auto options = by_meetings();
      options.opening_budget = budget;
      Detector<> detector(options);
      detector.add(scene[0], {.name = "ball"});
      detector.add(scene[1], {.name = "cloth"});
      const Frame& frame = detector.detect();
      if (!frame.collides()) continue;
      const auto face = bad == 0 ? frame.face_pairs[0].a : frame.face_pairs[0].b;
      const auto corners = detector.object(bad).corners()[face];
      const Surface_mesh before = scene[bad];
      for (const auto corner : corners)
        scene[bad].point(Surface_mesh::Vertex_index(corner)) = Point(0, not_a_number, 0);
      try {
        detector.detect();
        ADD_FAILURE() << "not refused";
      } catch (const Bad_mesh& error) {
        const std::string expected = bad == 0 ? "object 0 (ball)" : "object 1 (cloth)";
        EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
      }
      for (const auto v : before.vertices()) scene[bad].point(v) = before.point(v);
      EXPECT_TRUE(detector.detect().collides());
    }
}

TEST(Meetings, without_them_the_openings_have_no_effect_and_whole_regions_are_checked) {
  auto one = two_spheres(2.1), other = two_spheres(2.1);
  auto options = by_meetings();
  options.meetings = 0;
  options.list_candidates = true;
  Detector<> first(options);
  options.opening_budget = 7;
  options.opening_reach = 3;
  Detector<> second(options);
  add_all(first, one), add_all(second, other);
  std::size_t contacts = 0;
  for (int number = 0; number < 12; ++number) {
    const Frame& frame = first.detect();
    expect_same_frame(frame, second.detect());
    EXPECT_EQ(frame.statistics.meetings + frame.statistics.leaf_tests, 0U);
    // What is reported are the contacts of the candidate regions, no more and no less.
    const auto touches = [&](Object_id object, Region_index region, std::uint32_t face) {
      const auto& surface = first.object(object);
      return std::ranges::any_of(surface.corners()[face], [&](auto v) { return surface.labels()[v] == region; });
    };
    std::vector<Face_pair> expected;
    for (const auto pair : exhaustive_face_pairs(one[0], one[1]))
      if (std::ranges::any_of(frame.candidates, [&](const Candidate_regions& candidate) {
            return touches(0, candidate.region_a, pair.a) && touches(1, candidate.region_b, pair.b);
          }))
        expected.push_back(pair);
    EXPECT_EQ(frame.face_pairs, expected);
    contacts += expected.size();
    for (auto* scene : {&one, &other}) shift((*scene)[1], -0.04, 0.01);
    first.update(), second.update();
  }
  EXPECT_GT(contacts, 10U);
}

TEST(Meetings, options_out_of_range_are_refused) {
  for (const double bad : {0.0, -1.0, infinity, not_a_number})
    EXPECT_THROW(Detector<>({.mode = Mode::particles, .opening_reach = bad}), Bad_argument) << bad;
  for (const double good : {0.01, 0.5, 10.0})
    EXPECT_NO_THROW(Detector<>({.mode = Mode::particles, .opening_reach = good}));
}

TEST(Meetings, options_of_meetings_are_refused_in_other_modes) {
  for (const auto mode : {Mode::exact, Mode::senin}) {
    EXPECT_THROW(Detector<>({.mode = mode, .meetings = 0}), Bad_argument);
    EXPECT_THROW(Detector<>({.mode = mode, .meetings = 5}), Bad_argument);
    EXPECT_THROW(Detector<>({.mode = mode, .opening_budget = 100}), Bad_argument);
    EXPECT_THROW(Detector<>({.mode = mode, .opening_reach = 0.5}), Bad_argument);
    EXPECT_NO_THROW(Detector<>({.mode = mode}));
  }
}

TEST(Meetings, options_of_the_published_method_are_refused_with_meetings_and_taken_without) {
  for (const std::size_t meetings : {1, 4, 0}) {
    std::vector<Detector_options> all(3, {.mode = Mode::particles, .meetings = meetings});
    all[0].collision_distance = 2;
    all[1].distance_measure = Distance_measure::all_vertices;
    all[2].candidates = Candidate_choice::closest;
    for (const auto& options : all)
      if (meetings > 0) {
        EXPECT_THROW(Detector<>{options}, Bad_argument);
      } else {
        EXPECT_NO_THROW(Detector<>{options});
      }
  }
}

}  // namespace
}  // namespace lodestone
