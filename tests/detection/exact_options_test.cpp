// SPDX-License-Identifier: GPL-3.0-or-later
// What the mode exact refuses, and what only it is asked.
#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>
#include <vector>

#include "support/exact_truth.h"
#include "support/special_numbers.h"

namespace lodestone {
namespace {

TEST(Exact_options, out_of_range_are_refused) {
  for (const double bad : {-1.0, -1e-300, infinity, not_a_number})
    EXPECT_THROW(Exact_detector({.mode = Mode::exact, .exact = {.tolerance = bad}}), Bad_argument) << bad;
  for (const double bad : {1.0, 0.5, 0.0, -2.0, -infinity, not_a_number})
    EXPECT_THROW(Exact_detector({.mode = Mode::exact, .exact = {.loosest = bad}}), Bad_argument) << bad;
  for (const std::size_t bad : {0, 1, 129, 1000000})
    EXPECT_THROW(Exact_detector({.mode = Mode::exact, .tree = {.leaf_faces = bad}}), Bad_argument) << bad;
  for (const auto mode : {Mode::particles, Mode::senin, Mode::exact}) {
    EXPECT_THROW(Detector<>({.mode = mode, .most_contacts = 0}), Bad_argument);
    EXPECT_THROW(Detector<>({.mode = mode, .contacts = Contact_query::yes_no, .contact_points = true}), Bad_argument);
    EXPECT_THROW(Detector<>({.mode = mode, .contacts = Contact_query::yes_no, .contact_normals = true}), Bad_argument);
    EXPECT_THROW(Detector<>({.mode = mode, .contacts = Contact_query::yes_no, .exact = {.patches = true}}),
                 Bad_argument);
    for (const double bad : {0.0, -1.0, infinity, not_a_number})
      EXPECT_THROW(Detector<>({.mode = mode, .collision_distance = bad}), Bad_argument);
    for (const double bad : {0.0, -1.0, not_a_number})
      EXPECT_THROW(Detector<>({.mode = mode, .growth = bad}), Bad_argument);
  }
}

TEST(Exact_options, at_the_ends_of_their_ranges_are_taken) {
  const auto a = sphere(6), b = sphere(6, 1, {1.5, 0, 0});
  const auto truth = exhaustive_face_pairs(a, b);
  for (const std::size_t leaf_faces : {2, 3, 128})
    for (const double loosest : {std::nextafter(1.0, 2.0), infinity})
      for (const std::size_t particles : {1, 5, 5000}) {
        Exact_detector detector({.mode = Mode::exact,
                                 .particles = particles,
                                 .exact = {.loosest = loosest},
                                 .tree = {.leaf_faces = leaf_faces}});
        add_all(detector, {&a, &b});
        expect_contacts(detector.detect(), 0, 1, truth);
        const Region_tree& tree = detector.tree(0);
        for (std::size_t leaf = 0; leaf < tree.leaf_count(); ++leaf) EXPECT_LE(tree.faces(leaf).size(), leaf_faces);
      }
  Exact_detector detector({.mode = Mode::exact, .exact = {.tolerance = std::numeric_limits<double>::max()}});
  add_all(detector, {&a, &b});
  EXPECT_EQ(detector.detect().face_pairs.size(), num_faces(a) * num_faces(b));
  EXPECT_TRUE(detector.detect().near());
}

TEST(Exact_options, of_the_mode_exact_alone_are_refused_by_the_others) {
  for (const auto mode : {Mode::particles, Mode::senin}) {
    EXPECT_THROW(Detector<>({.mode = mode, .exact = {.tolerance = 0.1}}), Bad_argument);
    EXPECT_THROW(Detector<>({.mode = mode, .exact = {.self_collision = true}}), Bad_argument);
    EXPECT_THROW(Detector<>({.mode = mode, .exact = {.containment = true}}), Bad_argument);
    EXPECT_THROW(Detector<>({.mode = mode, .exact = {.parting = true}}), Bad_argument);
    EXPECT_THROW(Detector<>({.mode = mode, .exact = {.patches = true}}), Bad_argument);
    EXPECT_THROW(Detector<>({.mode = mode, .exact = {.loosest = 2 * Exact_options().loosest}}), Bad_argument);
    EXPECT_NO_THROW(Detector<>({.mode = mode}));
  }
}

TEST(Exact_options, of_particles_alone_are_refused_by_the_mode_exact) {
  const std::vector<Detector_options> of_particles{
      {.mode = Mode::exact, .collision_distance = 2},
      {.mode = Mode::exact, .distance_measure = Distance_measure::all_vertices},
      {.mode = Mode::exact, .candidates = Candidate_choice::closest},
      {.mode = Mode::exact, .growth = infinity},
      {.mode = Mode::exact, .meetings = 0},
      {.mode = Mode::exact, .opening_budget = 7},
      {.mode = Mode::exact, .opening_reach = 2}};
  for (auto options : of_particles) {
    try {
      const Exact_detector detector(options);
      ADD_FAILURE() << "an option that the mode exact ignores";
    } catch (const Bad_argument& error) {
      EXPECT_NE(std::string(error.what()).find("mode particles"), std::string::npos) << error.what();
    }
    options.mode = Mode::particles;
    if (options.opening_budget == Detector_options().opening_budget) options.meetings = 0;
    EXPECT_NO_THROW(const Exact_detector detector(options));
  }
}

TEST(Exact_options, particles_are_the_regions_of_an_object) {
  auto mesh = sphere(8);
  for (const std::size_t particles : {1, 5, 40}) {
    Surface_mesh copy = mesh;
    Exact_detector detector({.mode = Mode::exact, .particles = particles});
    detector.add(copy);
    detector.detect();
    const auto& regions = detector.maps(0).region();
    std::set<Region_index> seen;
    for (const auto v : copy.vertices()) seen.insert(regions[v]);
    EXPECT_EQ(seen.size(), particles);
  }
}

TEST(Exact_options, queries_of_the_mode_exact_are_refused_by_the_others) {
  for (const auto mode : {Mode::particles, Mode::senin}) {
    const auto a = sphere(4), b = sphere(4, 1, {1.5, 0, 0});
    Detector<> detector({.mode = mode});
    add_all(detector, {&a, &b});
    EXPECT_THROW(detector.detect(0, 1), Bad_argument);
    EXPECT_THROW(detector.detect(0, 0), Bad_argument);
    EXPECT_THROW(detector.closest(0, 1), Bad_argument);
    EXPECT_THROW(detector.contains(0, 1), Bad_argument);
    EXPECT_THROW(detector.parting(0, 1), Bad_argument);
    EXPECT_THROW(detector.update(0, positions_of(a)), Bad_argument);
    EXPECT_THROW(detector.tree(0), Bad_argument);
    EXPECT_NO_THROW(detector.detect());
  }
}

TEST(Exact_options, particles_are_refused_by_the_mode_exact) {
  const auto a = sphere(4);
  Exact_detector detector({.mode = Mode::exact});
  detector.add(a);
  detector.detect();
  EXPECT_THROW(detector.object(0), Bad_argument);
  EXPECT_NO_THROW(detector.tree(0));
}

TEST(Exact_detector, unknown_objects_are_refused) {
  const auto a = sphere(4), b = sphere(4, 1, {1.5, 0, 0});
  Exact_detector detector({.mode = Mode::exact});
  EXPECT_THROW(detector.detect(0, 0), Bad_argument);
  add_all(detector, {&a, &b});
  for (const Object_id bad : {Object_id{2}, std::numeric_limits<Object_id>::max()}) {
    EXPECT_THROW(detector.detect(0, bad), Bad_argument);
    EXPECT_THROW(detector.detect(bad, 0), Bad_argument);
    EXPECT_THROW(detector.detect(bad, bad), Bad_argument);
    EXPECT_THROW(detector.closest(0, bad), Bad_argument);
    EXPECT_THROW(detector.closest(bad, 1), Bad_argument);
    EXPECT_THROW(detector.contains(bad, 1), Bad_argument);
    EXPECT_THROW(detector.contains(1, bad), Bad_argument);
    EXPECT_THROW(detector.update(bad), Bad_argument);
    EXPECT_THROW(detector.update(bad, positions_of(a)), Bad_argument);
    EXPECT_THROW(detector.rebuild(bad), Bad_argument);
    EXPECT_THROW(detector.tree(bad), Bad_argument);
    EXPECT_THROW(detector.object(bad), Bad_argument);
    EXPECT_THROW(detector.maps(bad), Bad_argument);
  }
  EXPECT_EQ(expect_exhaustive(detector.detect(), {&a, &b}), 1U);
}

TEST(Exact_detector, an_object_and_itself_have_neither_closest_faces_nor_containment) {
  const auto a = sphere(4);
  Exact_detector detector({.mode = Mode::exact});
  detector.add(a);
  EXPECT_THROW(detector.closest(0, 0), Bad_argument);
  EXPECT_THROW(detector.contains(0, 0), Bad_argument);
}

TEST(Exact_detector, meshes_without_faces_or_with_other_faces_than_triangles_are_refused) {
  Exact_detector detector({.mode = Mode::exact});
  Surface_mesh empty, quadrilateral, points_only;
  points_only.add_vertex(Point(0, 0, 0));
  std::vector<Surface_mesh::Vertex_index> corners;
  for (const auto& p : {Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(0, 1, 0)})
    corners.push_back(quadrilateral.add_vertex(p));
  quadrilateral.add_face(corners);
  for (auto* mesh : {&empty, &quadrilateral, &points_only}) {
    EXPECT_THROW(detector.add(*mesh), Bad_mesh);
    EXPECT_THROW(detector.add(std::as_const(*mesh)), Bad_mesh);
  }
  EXPECT_EQ(detector.size(), 0U);
  auto mesh = sphere(3);
  detector.add(mesh);
  EXPECT_THROW(detector.add(mesh), Bad_argument);
  EXPECT_EQ(detector.size(), 1U);
  EXPECT_NO_THROW(detector.detect());
}

}  // namespace
}  // namespace lodestone
