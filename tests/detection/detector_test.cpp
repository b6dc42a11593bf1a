// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "detection/detector_scenes.h"
#include "support/count_allocations.h"
#include "support/counting_points.h"

namespace lodestone {
namespace {

TEST(Detector, reports_only_faces_that_intersect_in_both_modes) {
  for (const auto mode : modes) {
    auto scene = two_spheres(2.5);
    auto options = all_contacts;
    options.mode = mode;
    Detector<> detector(options);
    add_all(detector, scene);
    std::size_t found = 0;
    for (int frame = 0; frame < 30; ++frame) {
      found += expect_true(detector.detect(), scene);
      shift(scene[1], frame < 15 ? -0.05 : 0.05, 0.01);
      detector.update();
    }
    EXPECT_GT(found, 0U);
  }
}

TEST(Detector, is_right_in_more_than_nine_of_ten_frames_of_two_spheres) {
  auto scene = two_spheres(2.6);
  Detector<> detector({.mode = Mode::particles, .particles = 32});
  add_all(detector, scene);
  int right = 0;
  for (int frame = 0; frame < 100; ++frame) {
    const bool said = detector.detect().collides();
    const bool truth = !exhaustive_face_pairs(scene[0], scene[1]).empty();
    EXPECT_FALSE(said && !truth);
    right += said == truth ? 1 : 0;
    shift(scene[1], frame < 50 ? -0.02 : 0.02, 0.002, -0.001);
    detector.update();
  }
  EXPECT_GT(right, 90);
}

TEST(Detector, two_equal_detectors_give_equal_frames) {
  for (const auto mode : modes) {
    auto one = two_spheres(2.3), other = two_spheres(2.3);
    auto options = all_contacts;
    options.mode = mode;
    Detector<> first(options), second(options);
    add_all(first, one);
    add_all(second, other);
    for (int frame = 0; frame < 15; ++frame) {
      expect_equal(first.detect(), second.detect());
      for (Object_id object : {0U, 1U})
        EXPECT_EQ(first.object(object).particles().at, second.object(object).particles().at);
      for (auto* scene : {&one, &other}) {
        shift((*scene)[1], -0.04, 0.01);
        scale((*scene)[0], 1.02);
      }
      first.update();
      second.update();
    }
  }
}

TEST(Detector, does_not_depend_on_the_unit) {
  for (const double unit : {0x1p-100, 0x1p100}) {
    auto one = two_spheres(2.3), other = two_spheres(2.3);
    for (auto& mesh : other) scale(mesh, unit);
    Detector<> first(all_contacts), second(all_contacts);
    add_all(first, one);
    add_all(second, other);
    std::size_t contacts = 0;
    for (int frame = 0; frame < 10; ++frame) {
      expect_equal(first.detect(), second.detect());
      contacts += first.detect().statistics.contacts;
      second.detect();
      shift(one[1], -0.0625);
      shift(other[1], -0.0625 * unit);
      first.update();
      second.update();
    }
    EXPECT_GT(contacts, 0U);
  }
}

TEST(Detector, follows_many_objects) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(-3, 3), step(-0.1, 0.1), size(0.5, 1);
  Owned_meshes scene;
  for (int i = 0; i < 24; ++i) scene.push_back(sphere(5, size(random), {place(random), place(random), place(random)}));
  auto options = all_contacts;
  options.particles = 12;
  Detector<> detector(options);
  add_all(detector, scene);
  EXPECT_EQ(detector.size(), 24U);
  std::size_t found = 0;
  for (int frame = 0; frame < 6; ++frame) {
    const Frame& result = detector.detect();
    found += expect_true(result, scene);
    for (std::size_t i = 1; i < result.pairs.size(); ++i)
      EXPECT_LT(std::tie(result.pairs[i - 1].a, result.pairs[i - 1].b), std::tie(result.pairs[i].a, result.pairs[i].b));
    for (auto& mesh : scene) shift(mesh, step(random), step(random), step(random));
    detector.update();
  }
  EXPECT_GT(found, 20U);
}

/// A vertex point map that counts how often it is read.
using Counting_detector = Detector<>;

TEST(Detector, far_objects_cost_the_reads_of_their_regions_and_tips) {
  auto scene = two_spheres(1000, 80);
  ASSERT_GE(num_faces(scene[0]), 50000U);
  std::size_t reads = 0;
  Counting_detector detector({.mode = Mode::particles, .particles = 32});
  for (auto& mesh : scene) detector.add(mesh, Counting_points{&mesh, &reads});
  detector.detect();
  reads = 0;
  shift(scene[1], -1);
  detector.update();
  EXPECT_LE(reads, 2 * 32 * 20U);  // at most 5 samples in 4 directions
  reads = 0;
  EXPECT_TRUE(detector.detect().pairs.empty());
  EXPECT_LE(reads, 2 * (32 + 6U));  // an object has a tip in each of six directions
}

TEST(Detector, a_frame_tells_how_many_vertices_it_has_read_and_how_many_candidates_its_pairs_had) {
  for (const double distance : {5.0, 2.02, 1.9}) {
    auto scene = two_spheres(distance, 20);
    std::size_t reads = 0;
    for (const Mode mode : {Mode::particles, Mode::exact}) {
      Counting_detector detector({.mode = mode});
      for (auto& mesh : scene) detector.add(mesh, Counting_points{&mesh, &reads});
      detector.detect();
      for (int frame = 0; frame < 3; ++frame) {
        reads = 0;
        const Frame& result = detector.detect();
        EXPECT_EQ(result.statistics.vertices_read, reads) << name_of(mode) << ' ' << distance;
        std::size_t candidates = 0, leaf_tests = 0;
        for (const auto& pair : result.pairs) candidates += pair.candidates, leaf_tests += pair.leaf_tests;
        EXPECT_EQ(result.statistics.candidates, candidates) << name_of(mode) << ' ' << distance;
        EXPECT_EQ(result.statistics.leaf_tests, leaf_tests) << name_of(mode) << ' ' << distance;
      }
    }
  }
}

TEST(Detector, a_frame_reads_only_where_particles_look_and_in_candidate_regions) {
  auto scene = two_spheres(2.02, 80);
  std::size_t reads = 0;
  Counting_detector detector({.mode = Mode::particles, .particles = 64, .contacts = Contact_query::all});
  for (auto& mesh : scene) detector.add(mesh, Counting_points{&mesh, &reads});
  detector.detect();
  std::size_t largest_patch = 0, most_reads = 0;
  for (const Object_id id : {0U, 1U}) {
    const auto& object = detector.object(id);
    for (const auto& patch : region_patches(object.corners(), object.labels(), object.particles().at.size()))
      largest_patch = std::max(largest_patch, patch.vertices.size());
  }
  for (int frame = 0; frame < 10; ++frame) {
    shift(scene[1], -0.004);
    reads = 0;
    detector.update();
    const auto& statistics = detector.detect().statistics;
    const std::size_t particles = 128, reach = 7, samples = 20;
    EXPECT_LE(reads,
              particles * (1 + samples + reach * statistics.iterations) + 2 * statistics.candidates * largest_patch);
    most_reads = std::max(most_reads, reads);
  }
  EXPECT_LT(most_reads, num_vertices(scene[0]));
}

TEST(Detector, particles_stay_where_they_have_walked) {
  auto scene = two_spheres(2.1);
  Detector<> detector({.mode = Mode::particles, .particles = 16, .meetings = 0});
  add_all(detector, scene);
  const std::size_t first = detector.detect().statistics.moves;
  ASSERT_GT(first, 10U);
  const auto at = detector.object(0).particles().at;
  const Frame& second = detector.detect();
  EXPECT_EQ(second.number, 2U);
  EXPECT_LT(second.statistics.moves, first / 2);
  std::size_t moved = 0;
  for (std::size_t p = 0; p < at.size(); ++p) moved += at[p] != detector.object(0).particles().at[p] ? 1 : 0;
  EXPECT_LE(moved, second.statistics.moves);
}

TEST(Detector, a_frame_in_which_no_particle_walks_has_no_iterations) {
  for (const Mode mode : modes) {
    auto scene = two_spheres(2.02);
    const std::size_t meetings = mode == Mode::particles ? 0 : Detector_options().meetings;
    Detector<> detector({.mode = mode, .particles = 16, .meetings = meetings});
    add_all(detector, scene);
    EXPECT_EQ(detector.detect().object_iterations.size(), 2U);
    shift(scene[1], 9);
    const Frame& apart = detector.detect();
    EXPECT_EQ(apart.statistics.iterations, 0U);
    EXPECT_TRUE(apart.object_iterations.empty());
  }
}

/// Frames of a scene that swings to and fro; gives the number of contacts, and of allocations once it is steady.
std::pair<std::size_t, std::size_t> swing_steadily(const Detector_options& options) {
  auto scene = two_spheres(2.1);
  scene.push_back(sphere(8, 1, {40, 0, 0}));
  Detector<> detector(options);
  add_all(detector, scene);
  std::size_t contacts = 0;
  const auto swing = [&](int frames) {
    for (int frame = 0; frame < frames; ++frame) {
      shift(scene[1], frame % 8 < 4 ? -0.0625 : 0.0625);
      detector.update();
      contacts += detector.detect().statistics.contacts;
    }
  };
  swing(32);
  const std::size_t before = allocations;
  swing(32);
  return {contacts, allocations - before};
}

TEST(Detector, allocates_nothing_in_a_steady_scene) {
  for (const std::size_t meetings : {0, 4})
    for (const std::size_t budget : {std::size_t{1}, std::size_t{200}, Detector_options{}.opening_budget})
      for (const auto query : {Contact_query::first, Contact_query::all}) {
        auto options = all_contacts;
        options.meetings = meetings;
        options.opening_budget = budget;
        options.contacts = query;
        const auto [contacts, allocated] = swing_steadily(options);
        EXPECT_EQ(allocated, 0U) << meetings << ' ' << budget;
        EXPECT_GT(contacts, 0U);
      }
}

void expect_maps_of(const Detector<>& detector, Object_id object, const Surface_mesh& mesh) {
  const auto region = mesh.property_map<Surface_mesh::Vertex_index, Region_index>("v:region");
  const auto particle = mesh.property_map<Surface_mesh::Vertex_index, Region_index>("v:particle");
  ASSERT_TRUE(region.second && particle.second);
  const auto& surface = detector.object(object);
  const auto& at = surface.particles().at;
  for (const auto v : mesh.vertices()) {
    EXPECT_EQ(region.first[v], surface.labels()[v]);
    const auto here = std::ranges::find(at, static_cast<std::uint32_t>(v));
    EXPECT_EQ(particle.first[v], here == at.end() ? no_particle : static_cast<Region_index>(here - at.begin()));
    if (particle.first[v] != no_particle) {
      EXPECT_EQ(region.first[v], particle.first[v]);
    }
  }
}

TEST(Detector, regions_and_particles_are_on_the_mesh_before_and_after_walking) {
  auto scene = two_spheres(100);
  Detector<> detector({.mode = Mode::particles, .particles = 16, .meetings = 0});
  add_all(detector, scene);
  detector.detect();  // too far apart to walk
  for (const Object_id object : {0U, 1U}) expect_maps_of(detector, object, scene[object]);
  const auto at = detector.object(0).particles().at;
  shift(scene[1], -98.1);
  detector.update();
  ASSERT_GT(detector.detect().statistics.moves, 0U);
  EXPECT_NE(detector.object(0).particles().at, at);
  for (const Object_id object : {0U, 1U}) expect_maps_of(detector, object, scene[object]);
  scale(scene[0], 1.5);
  detector.update();
  ASSERT_EQ(detector.detect().statistics.repartitions, 1U);
  for (const Object_id object : {0U, 1U}) expect_maps_of(detector, object, scene[object]);
}

TEST(Detector, contact_points_lie_on_both_faces) {
  auto scene = two_spheres(1.8);
  auto options = all_contacts;
  options.contact_points = true;
  Detector<> detector(options);
  add_all(detector, scene);
  const Frame& frame = detector.detect();
  ASSERT_GT(frame.face_pairs.size(), 5U);
  ASSERT_EQ(frame.contact_points.size(), frame.face_pairs.size());
  const auto triangle = [](const Surface_mesh& mesh, std::uint32_t face) {
    const auto h = mesh.halfedge(Surface_mesh::Face_index(face));
    return Kernel::Triangle_3(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
                              mesh.point(mesh.target(mesh.next(h))));
  };
  for (std::size_t i = 0; i < frame.face_pairs.size(); ++i) {
    EXPECT_FALSE(frame.contact_points[i].empty());
    for (const auto& p : frame.contact_points[i]) {
      EXPECT_LT(CGAL::squared_distance(p, triangle(scene[0], frame.face_pairs[i].a)), 1e-28);
      EXPECT_LT(CGAL::squared_distance(p, triangle(scene[1], frame.face_pairs[i].b)), 1e-28);
    }
  }
}

TEST(Detector, a_query_tells_no_more_than_was_asked) {
  for (const auto query : {Contact_query::yes_no, Contact_query::first, Contact_query::all}) {
    auto scene = two_spheres(1.8);
    Detector<> detector({.mode = Mode::particles, .particles = 32, .contacts = query});
    add_all(detector, scene);
    const Frame& frame = detector.detect();
    ASSERT_TRUE(frame.collides());
    const std::size_t contacts = frame.face_pairs.size();
    EXPECT_EQ(frame.pairs[0].contacts, contacts);
    if (query == Contact_query::yes_no) {
      EXPECT_EQ(contacts, 0U);
    } else {
      EXPECT_EQ(contacts > 1, query == Contact_query::all);
      EXPECT_TRUE(std::ranges::includes(exhaustive_face_pairs(scene[0], scene[1]), frame.face_pairs));
    }
  }
}

TEST(Detector, with_closest_only_one_pair_of_regions_is_checked) {
  auto scene = two_spheres(1.7);
  auto options = all_contacts;
  options.meetings = 0;
  options.candidates = Candidate_choice::closest;
  options.collision_distance = 3;
  Detector<> detector(options);
  add_all(detector, scene);
  const Frame& frame = detector.detect();
  expect_true(frame, scene);
  EXPECT_EQ(frame.statistics.candidates, 1U);
}

TEST(Detector, a_larger_collision_distance_makes_more_candidates) {
  std::size_t before = 0;
  for (const double distance : {0.5, 2.0, 8.0}) {
    auto scene = two_spheres(1.9);
    Detector<> detector({.mode = Mode::particles,
                         .particles = 32,
                         .meetings = 0,
                         .collision_distance = distance,
                         .contacts = Contact_query::all});
    add_all(detector, scene);
    const std::size_t candidates = detector.detect().statistics.candidates;
    EXPECT_GE(candidates, before);
    before = candidates;
  }
  EXPECT_GT(before, 20U);
}

TEST(Detector, statistics_agree_with_the_frame) {
  auto scene = two_spheres(2.2);
  scene.push_back(sphere(8, 0.7, {1, 1.5, 0}));
  auto options = all_contacts;
  options.meetings = 0;
  Detector<> detector(options);
  add_all(detector, scene);
  for (std::uint64_t number = 1; number < 8; ++number) {
    const Frame& frame = detector.detect();
    const auto& statistics = frame.statistics;
    EXPECT_EQ(frame.number, number);
    expect_sums_of_pairs(frame);
    EXPECT_GE(statistics.iterations, 1U);
    for (const double seconds :
         {statistics.seconds.repartition, statistics.seconds.broad_phase, statistics.seconds.relaxation,
          statistics.seconds.candidates, statistics.seconds.confirmation})
      EXPECT_GE(seconds, 0);
    shift(scene[1], -0.1);
    detector.update();
  }
}

TEST(Detector, objects_may_have_particles_of_their_own_number) {
  auto scene = two_spheres(3);
  Detector<> detector({.mode = Mode::particles, .particles = 9});
  detector.add(scene[0], {.particles = 5});
  detector.add(scene[1]);
  detector.detect();
  EXPECT_EQ(detector.object(0).particles().at.size(), 5U);
  EXPECT_EQ(detector.object(1).particles().at.size(), 9U);
}

TEST(Detector, scattered_particles_of_objects_of_one_shape_do_not_start_alike) {
  auto scene = two_spheres(90);
  Detector<> detector({.mode = Mode::senin, .particles = 20});
  add_all(detector, scene);
  EXPECT_TRUE(detector.detect().pairs.empty());
  EXPECT_NE(detector.object(0).particles().at, detector.object(1).particles().at);
}

TEST(Detector, objects_may_join_between_frames) {
  auto scene = two_spheres(1.8);
  Detector<> detector(all_contacts);
  detector.add(scene[0]);
  EXPECT_TRUE(detector.detect().pairs.empty());
  EXPECT_EQ(detector.add(scene[1]), 1U);
  EXPECT_EQ(expect_true(detector.detect(), scene), 1U);
}

TEST(Detector, without_objects_finds_nothing) {
  Detector<> detector({.mode = Mode::particles});
  EXPECT_FALSE(detector.detect().collides());
  EXPECT_EQ(detector.detect().number, 2U);
}

}  // namespace
}  // namespace lodestone
