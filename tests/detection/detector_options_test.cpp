// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string_view>

#include "lodestone/detector.h"
#include "lodestone/find_collisions.h"
#include "lodestone/queries/exhaustive.h"
#include "support/message_of.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

TEST(Detector_options, all_contacts_are_reported_unless_less_is_asked_for) {
  EXPECT_EQ(Detector_options{}.contacts, Contact_query::all);
  const auto a = sphere(12), b = sphere(12, 1, {1.8, 0.1, 0.2});
  const auto truth = exhaustive_face_pairs(a, b);
  const auto found = find_collisions(a, b, {.mode = Mode::particles, .particles = 32});
  EXPECT_TRUE(found.collides);
  EXPECT_GT(found.faces.size(), 1U);
  EXPECT_TRUE(std::ranges::includes(truth, found.faces));
}

TEST(Detector_options, the_mode_that_misses_nothing_answers_unless_another_is_asked_for) {
  EXPECT_EQ(Detector_options{}.mode, Mode::exact);
  auto a = sphere(12), b = sphere(12, 1, {1.8, 0.1, 0.2});
  Detector<> detector;
  detector.add(a), detector.add(b);
  const Frame& frame = detector.detect();
  EXPECT_EQ(frame.face_pairs, exhaustive_face_pairs(a, b));
}

TEST(Detector_options, contact_points_need_contacts) {
  EXPECT_THROW(Detector<>({.mode = Mode::particles, .contacts = Contact_query::yes_no, .contact_points = true}),
               Bad_argument);
  EXPECT_NO_THROW(Detector<>({.mode = Mode::particles, .contacts = Contact_query::first, .contact_points = true}));
  EXPECT_NO_THROW(Detector<>({.mode = Mode::particles, .contact_points = true}));
  const auto a = sphere(4), b = sphere(4, 1, {1, 0, 0});
  EXPECT_THROW(
      find_collisions(a, b, {.mode = Mode::particles, .contacts = Contact_query::yes_no, .contact_points = true}),
      Bad_argument);
}

TEST(Detector_options, without_effect_are_refused) {
  EXPECT_THROW(Detector<>({.mode = Mode::senin, .growth = 2}), Bad_argument);
  EXPECT_NO_THROW(Detector<>({.mode = Mode::particles, .opening_budget = 9, .opening_reach = 2, .growth = 2}));
  EXPECT_THROW(Detector<>({.contacts = Contact_query::yes_no, .exact = {.patches = true}}), Bad_argument);
}

TEST(Detector_options, of_another_mode_are_named_with_the_modes_that_take_them) {
  const auto refusal = [](Detector_options options, Mode mode) {
    options.mode = mode;
    return message_of<Bad_argument>([&] { check(options); });
  };
  const std::vector<std::pair<std::string, Detector_options>> of_all{
      {"tolerance", {.exact = {.tolerance = 1}}},
      {"self_tolerance", {.exact = {.self_tolerance = 1}}},
      {"self_collision", {.exact = {.self_collision = true}}},
      {"containment", {.exact = {.containment = true}}},
      {"parting", {.exact = {.parting = true}}},
      {"patches", {.exact = {.patches = true}}},
      {"loosest", {.exact = {.loosest = 3}}}};
  for (const auto& [name, options] : of_all) {
    for (const auto mode : {Mode::exact, Mode::certified}) EXPECT_EQ(refusal(options, mode), "no error") << name;
    for (const auto mode : {Mode::particles, Mode::senin})
      EXPECT_EQ(refusal(options, mode), name + " needs the mode exact or certified");
  }
  const std::vector<std::pair<std::string, Detector_options>> of_particles{
      {"collision_distance", {.meetings = 0, .collision_distance = 2}},
      {"distance_measure", {.meetings = 0, .distance_measure = Distance_measure::all_vertices}},
      {"candidates", {.meetings = 0, .candidates = Candidate_choice::closest}},
      {"close_seams", {.close_seams = false}},
      {"least_particles", {.least_particles = 3}}};
  for (auto [name, options] : of_particles) {
    EXPECT_EQ(refusal(options, Mode::particles), "no error") << name;
    options.meetings = Detector_options().meetings;
    EXPECT_EQ(refusal(options, Mode::senin), "no error") << name;
    for (const auto mode : {Mode::exact, Mode::certified})
      EXPECT_EQ(refusal(options, mode), name + " needs the mode particles or senin");
  }
  const std::vector<std::pair<std::string, Detector_options>> of_meetings{{"meetings", {.meetings = 5}},
                                                                          {"opening_budget", {.opening_budget = 9}},
                                                                          {"opening_reach", {.opening_reach = 2}},
                                                                          {"growth", {.growth = 2}}};
  for (const auto& [name, options] : of_meetings) {
    EXPECT_EQ(refusal(options, Mode::particles), "no error") << name;
    for (const auto mode : {Mode::exact, Mode::certified, Mode::senin})
      EXPECT_EQ(refusal(options, mode), name + " needs the mode particles");
  }
  EXPECT_EQ(refusal({.least_particles = 0}, Mode::particles), "least_particles must be at least 1");
}

/// Halves a surface, and notes how many threads it may use.
struct Threaded_halves {
  static constexpr std::string_view name = "threaded_halves";
  struct {
    std::size_t threads = 1;
  } options;
  std::size_t* used = nullptr;

  Labelling operator()(const Partition_input<Surface_mesh>& input, std::size_t /*regions*/) const {
    *used = options.threads;
    Labelling result{.labels = std::vector<Region_index>(num_vertices(input.surface().graph), 0)};
    for (std::size_t v = 0; 2 * v < result.labels.size(); ++v) result.labels[v] = 1;
    return result;
  }
};

TEST(Detector_options, threads_are_those_of_a_strategy_that_asks_for_no_other_number) {
  const auto used_by = [](std::size_t of_detector, std::size_t of_strategy) {
    std::size_t used = 0;
    const auto mesh = sphere(4);
    Detector<Threaded_halves> detector({.particles = 2, .threads = of_detector}, {{of_strategy}, &used});
    detector.add(mesh);
    detector.detect();
    return used;
  };
  EXPECT_EQ(used_by(2, 1), 2U);
  EXPECT_EQ(used_by(2, 3), 3U);
  EXPECT_EQ(used_by(1, 1), 1U);
}

TEST(Detector, an_unknown_object_has_neither_state_nor_maps) {
  constexpr auto largest = std::numeric_limits<Object_id>::max();
  Detector<> detector({.mode = Mode::particles});
  auto mesh = sphere(3);
  for (const Object_id bad : {Object_id{0}, Object_id{1}, largest}) {
    EXPECT_THROW(detector.object(bad), Bad_argument);
    EXPECT_THROW(detector.maps(bad), Bad_argument);
  }
  const auto id = detector.add(mesh);
  EXPECT_NO_THROW(detector.object(id));
  EXPECT_NO_THROW(detector.maps(id));
  for (const Object_id bad : {Object_id{1}, largest}) {
    EXPECT_THROW(detector.object(bad), Bad_argument);
    EXPECT_THROW(detector.maps(bad), Bad_argument);
  }
}

TEST(Detector, an_object_whose_mesh_cannot_be_written_to_has_no_maps) {
  Detector<> detector({.mode = Mode::particles});
  const auto mesh = sphere(3);
  const auto id = detector.add(mesh);
  EXPECT_THROW(detector.maps(id), Bad_argument);
  detector.detect();
  EXPECT_THROW(detector.maps(id), Bad_argument);
  EXPECT_NO_THROW(detector.object(id));
}

/// The points of a mesh, moved along x.
struct Moved_points {
  using key_type = Surface_mesh::Vertex_index;
  using value_type = Point;
  using reference = Point;
  using category = boost::readable_property_map_tag;
  const Surface_mesh* mesh = nullptr;
  double x = 0;
  friend Point get(const Moved_points& map, Surface_mesh::Vertex_index v) {
    const Point& p = map.mesh->point(v);
    return {p.x() + map.x, p.y(), p.z()};
  }
};

TEST(Detector, one_constant_mesh_may_be_two_objects_with_point_maps_of_their_own) {
  const auto mesh = potato(8);
  const Moved_points here{.mesh = &mesh}, there{.mesh = &mesh, .x = 2.5};
  Detector<> detector({.mode = Mode::particles, .particles = 32});
  EXPECT_EQ(detector.add(mesh, here), 0U);
  EXPECT_EQ(detector.add(mesh, there), 1U);
  const Frame& frame = detector.detect();
  ASSERT_EQ(frame.pairs.size(), 1U);
  const auto truth = exhaustive_face_pairs(mesh, mesh, CGAL::parameters::vertex_point_map(here),
                                           CGAL::parameters::vertex_point_map(there));
  ASSERT_FALSE(truth.empty());
  EXPECT_TRUE(frame.collides());
  EXPECT_TRUE(std::ranges::includes(truth, frame.contacts(frame.pairs[0])));
}

TEST(Detector, one_mesh_may_not_carry_the_maps_of_two_objects) {
  auto mesh = sphere(3);
  Detector<> detector({.mode = Mode::particles});
  detector.add(mesh);
  EXPECT_THROW(detector.add(mesh), Bad_argument);
  EXPECT_EQ(detector.size(), 1U);
}

TEST(Detector_options, there_are_never_more_particles_by_rule_than_the_most) {
  for (const std::size_t most : {1, 4, 20}) {
    auto a = sphere(8), b = sphere(8, 1, {9, 0, 0});
    Detector<> detector({.mode = Mode::particles, .least_particles = 50, .particle_count = {.most_particles = most}});
    for (auto* mesh : {&a, &b}) detector.add(*mesh);
    detector.detect();
    for (const Object_id object : {0U, 1U}) EXPECT_EQ(detector.object(object).particles().at.size(), most);
  }
  auto a = sphere(8), b = sphere(8, 1, {9, 0, 0});
  Detector<> detector({.mode = Mode::particles, .least_particles = 50});
  for (auto* mesh : {&a, &b}) detector.add(*mesh);
  detector.detect();
  for (const Object_id object : {0U, 1U}) EXPECT_EQ(detector.object(object).particles().at.size(), 50U);
}

/// Regions in a row by vertex number: enough particles without the work of LBG.
struct By_number {
  static constexpr std::string_view name = "by_number";
  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    const std::size_t vertices = input.numbering.vertex_count();
    Labelling result;
    for (std::size_t v = 0; v < vertices; ++v)
      result.labels.push_back(static_cast<Region_index>(v * regions / vertices));
    return result;
  }
};

/// Address space of this process in bytes: memory that is reserved counts, whether it is used or not. 0: not known.
std::size_t address_space() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

TEST(Detector, many_particles_that_are_far_apart_ask_for_little_memory) {
  const std::size_t particles = 3000;
  auto a = sphere(28), b = sphere(28, 1, {100, 0, 0});
  ASSERT_GE(num_vertices(a), particles);
  Detector<By_number> detector({.mode = Mode::particles, .particles = particles, .partition = {.keep_islands = true}});
  for (auto* mesh : {&a, &b}) detector.add(*mesh);
  const std::size_t before = address_space();
  if (before == 0) GTEST_SKIP() << "the system does not tell the memory of a process";
  EXPECT_FALSE(detector.detect().collides());
  ASSERT_EQ(detector.object(0).particles().at.size(), particles);
  // Room for every pair of particles would be 9 000 000 candidates of 16 bytes.
  EXPECT_LT(address_space(), before + particles * particles * sizeof(Candidate_pair) / 2);
}

}  // namespace
}  // namespace lodestone
