// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/find_collisions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "lodestone/mesh/indexed_mesh.h"
#include "support/exact_truth.h"

namespace lodestone {
namespace {

TEST(Find_collisions, reports_faces_that_intersect_and_no_others) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> offset(-2, 2);
  const auto a = potato(8);
  std::size_t positive = 0, found = 0;
  for (int trial = 0; trial < 20; ++trial) {
    auto b = potato(8, 2);
    shift(b, offset(random), offset(random), offset(random));
    const auto truth = exhaustive_face_pairs(a, b);
    const auto collisions = find_collisions(a, b, {.mode = Mode::particles});
    EXPECT_EQ(collisions.collides, !collisions.faces.empty());
    EXPECT_TRUE(std::ranges::is_sorted(collisions.faces));
    EXPECT_TRUE(std::ranges::includes(truth, collisions.faces));
    EXPECT_EQ(collisions.statistics.contacts, collisions.faces.size());
    EXPECT_TRUE(collisions.points.empty());
    positive += truth.empty() ? 0 : 1;
    found += collisions.collides ? 1 : 0;
  }
  EXPECT_GT(positive, 5U);
  EXPECT_GT(found, 0U);
}

TEST(Find_collisions, misses_nothing_without_options) {
  const auto a = potato(8);
  for (const double x : {-1.9, -1.2, 0.4, 1.1, 1.8}) {
    auto b = potato(8, 2);
    shift(b, x, 0.2, -0.1);
    const auto truth = exhaustive_face_pairs(a, b);
    const auto collisions = find_collisions(a, b);
    EXPECT_EQ(collisions.collides, !truth.empty()) << x;
    EXPECT_EQ(collisions.faces, truth) << x;
  }
}

TEST(Find_collisions, in_mode_exact_gives_all_face_pairs_between_the_two_and_no_others) {
  const auto a = potato(8);
  auto b = potato(8, 2);
  shift(b, 0.7, 0.3, 0);
  const auto truth = exhaustive_face_pairs(a, b);
  ASSERT_FALSE(truth.empty());
  const Detector_options options{
      .mode = Mode::exact, .contact_normals = true, .exact = {.self_collision = true, .containment = true}};
  const auto collisions = find_collisions(a, b, options);
  EXPECT_EQ(collisions.faces, truth);
  EXPECT_EQ(collisions.normals.size(), truth.size());
  EXPECT_EQ(collisions.containment, Containment::none);
  auto capped = options;
  capped.most_contacts = 1;
  EXPECT_TRUE(find_collisions(a, b, capped).capped);
}

TEST(Find_collisions, in_mode_exact_sees_that_one_mesh_lies_inside_the_other) {
  auto small = sphere(6);
  for (const auto v : small.vertices()) small.point(v) = Point(0.1 * small.point(v).x(), 0, 0.1 * small.point(v).z());
  const auto collisions = find_collisions(sphere(6), small, {.mode = Mode::exact, .exact = {.containment = true}});
  EXPECT_FALSE(collisions.collides);
  EXPECT_EQ(collisions.containment, Containment::b_in_a);
}

TEST(Find_collisions, tells_near_from_colliding) {
  const auto a = cube(2);
  auto b = cube(2);
  shift(b, 1.25);
  const auto near = find_collisions(a, b, {.exact = {.tolerance = 0.3}});
  EXPECT_TRUE(near.near);
  EXPECT_FALSE(near.collides);
  EXPECT_EQ(near.faces, near_face_pairs(a, b, 0.3));
  EXPECT_FALSE(find_collisions(a, b).near);
}

TEST(Find_collisions, of_meshes_far_apart_finds_nothing) {
  auto b = sphere(6);
  shift(b, 500);
  const auto collisions = find_collisions(sphere(6), b, {.mode = Mode::particles});
  EXPECT_FALSE(collisions.collides);
  EXPECT_TRUE(collisions.faces.empty());
}

TEST(Find_collisions, with_regions_that_hold_everything_is_exhaustive) {
  auto b = potato(6, 2);
  shift(b, 1.5);
  const auto a = potato(6);
  const auto collisions = find_collisions(a, b,
                                          {.mode = Mode::particles,
                                           .particles = 1,
                                           .meetings = 0,
                                           .collision_distance = 1000,
                                           .contacts = Contact_query::all});
  EXPECT_EQ(collisions.faces, exhaustive_face_pairs(a, b));
  EXPECT_FALSE(collisions.faces.empty());
}

TEST(Find_collisions, gives_points_if_asked) {
  auto b = sphere(8);
  shift(b, 1.5, 0.1);
  const auto collisions = find_collisions(
      sphere(8), b, {.mode = Mode::particles, .particles = 24, .contacts = Contact_query::all, .contact_points = true});
  ASSERT_FALSE(collisions.faces.empty());
  EXPECT_EQ(collisions.points.size(), collisions.faces.size());
}

TEST(Find_collisions, leaves_the_meshes_as_they_are) {
  const auto a = sphere(4), b = sphere(4, 1, {1.5, 0, 0});
  const auto before = a.properties<Surface_mesh::Vertex_index>();
  for (const auto mode : {Mode::exact, Mode::particles}) find_collisions(a, b, {.mode = mode});
  EXPECT_EQ(a.properties<Surface_mesh::Vertex_index>(), before);
}

TEST(Find_collisions, refuses_bad_input) {
  const auto mesh = sphere(3);
  auto broken = sphere(3);
  broken.point(Surface_mesh::Vertex_index(0)) = Point(std::numeric_limits<double>::infinity(), 0, 0);
  for (const auto mode : {Mode::exact, Mode::particles}) {
    EXPECT_THROW(find_collisions(mesh, mesh, {.mode = mode}), Bad_argument);
    EXPECT_THROW(find_collisions(mesh, mesh, {.mode = mode}, CGAL::parameters::verbose(true)), Bad_argument);
    EXPECT_THROW(find_collisions(mesh, Surface_mesh(), {.mode = mode}), Bad_mesh);
    EXPECT_THROW(find_collisions(mesh, broken, {.mode = mode}), Bad_mesh);
  }
  EXPECT_THROW(find_collisions(mesh, sphere(2), {.mode = Mode::particles, .collision_distance = -1}), Bad_argument);
}

/// The same by a detector.
template <class Mesh_a, class Mesh_b>
Collisions by_detector(const Mesh_a& a, const Mesh_b& b, const Detector_options& options) {
  Detector<> detector(options);
  detector.add(a, {.name = "the first mesh"}), detector.add(b, {.name = "the second mesh"});
  return collisions_of(Frame(detector.detect(0, 1)));
}

Collisions self_by_detector(const Surface_mesh& mesh, Detector_options options,
                            const std::vector<std::uint32_t>& file_vertex = {}) {
  options.exact.self_collision = true;
  Detector<> detector(options);
  detector.add(mesh, {.file_vertex = file_vertex});
  return collisions_of(Frame(detector.detect(0, 0)));
}

void expect_same(const Collisions& found, const Collisions& expected) {
  EXPECT_EQ(found.collides, expected.collides);
  EXPECT_EQ(found.near, expected.near);
  EXPECT_EQ(found.faces, expected.faces);
  EXPECT_EQ(found.points, expected.points);
  expect_same_normals(found.normals, expected.normals);
  EXPECT_EQ(found.capped, expected.capped);
  EXPECT_EQ(found.containment, expected.containment);
  ASSERT_EQ(found.parting.has_value(), expected.parting.has_value());
  if (found.parting) {
    EXPECT_EQ(found.parting->translation, expected.parting->translation);
  }
  ASSERT_EQ(found.patches.size(), expected.patches.size());
  for (std::size_t i = 0; i < found.patches.size(); ++i)
    EXPECT_EQ(found.patches[i].contacts, expected.patches[i].contacts);
  EXPECT_EQ(found.statistics.contacts, expected.statistics.contacts);
}

/// Pairs of meshes that are apart, touch, lie in one plane, share vertices, coincide, enclose each other or cross.
std::vector<std::pair<Surface_mesh, Surface_mesh>> mesh_pairs() {
  const auto shifted = [](Surface_mesh mesh, double x, double y, double z) {
    shift(mesh, x, y, z);
    return mesh;
  };
  const auto scaled = [](Surface_mesh mesh, double factor) {
    scale(mesh, factor);
    return mesh;
  };
  const auto flattened = [](Surface_mesh mesh) {
    deform(mesh, [](const Point& p) { return Point(p.x(), 0.5 * p.x(), p.z() > 0 ? 1 : 0); });
    return mesh;
  };
  const Surface_mesh ball = sphere(5), box = cube(2), sheet = grid(4, 4), lump = potato(5);
  std::vector<std::pair<Surface_mesh, Surface_mesh>> pairs{{ball, shifted(ball, 5, 0, 0)},
                                                           {ball, shifted(ball, 2, 0, 0)},
                                                           {ball, shifted(ball, 1.7, 1.1, 0)},
                                                           {ball, shifted(ball, 1.5, 0.1, 0)},
                                                           {ball, ball},
                                                           {ball, scaled(ball, 0.5)},
                                                           {scaled(ball, 0.5), ball},
                                                           {box, shifted(box, 1, 0, 0)},
                                                           {box, shifted(box, 1, 1, 1)},
                                                           {box, box},
                                                           {sheet, sheet},
                                                           {sheet, shifted(sheet, 0.3, 0.2, 0)},
                                                           {sheet, shifted(sheet, 0, 0, 1)},
                                                           {sheet, lump},
                                                           {single_triangle(), single_triangle()},
                                                           {single_triangle(), ball},
                                                           {single_triangle(), tetrahedron()},
                                                           {flattened(ball), ball},
                                                           {flattened(ball), flattened(lump)},
                                                           {scaled(lump, 1e300), scaled(ball, 1e300)},
                                                           {scaled(lump, 1e-300), scaled(ball, 1e-300)}};
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> offset(-1.5, 1.5);
  for (int trial = 0; trial < 20; ++trial) {
    Surface_mesh other = potato(4, static_cast<std::uint64_t>(trial));
    crumple(other, trial % 3 == 0 ? 0.2 : 0, 1);
    pairs.emplace_back(lump, shifted(other, offset(random), offset(random), offset(random)));
  }
  return pairs;
}

TEST(Find_collisions, answers_as_a_detector_does_whatever_the_options_ask_for) {
  const std::vector<Detector_options> cases{{},
                                            {.contacts = Contact_query::yes_no},
                                            {.contact_points = true},
                                            {.contact_points = true, .contact_normals = true},
                                            {.most_contacts = 3},
                                            {.contacts = Contact_query::yes_no, .most_contacts = 3},
                                            {.exact = {.tolerance = 0.05}},
                                            {.exact = {.self_collision = true, .containment = true}},
                                            {.exact = {.parting = true, .patches = true}},
                                            {.threads = 2},
                                            {.contact_normals = true, .exact = {.self_tolerance = 0.1}}};
  std::size_t colliding = 0;
  const auto pairs = mesh_pairs();
  for (std::size_t p = 0; p < pairs.size(); ++p)
    for (std::size_t c = 0; c < cases.size(); ++c) {
      SCOPED_TRACE(testing::Message() << "meshes " << p << ", options " << c);
      const auto& [a, b] = pairs[p];
      const Collisions found = find_collisions(a, b, cases[c]);
      expect_same(found, by_detector(a, b, cases[c]));
      colliding += found.collides ? 1 : 0;
    }
  EXPECT_GT(colliding, pairs.size() * cases.size() / 4);
  EXPECT_LT(colliding, pairs.size() * cases.size());
}

TEST(Find_collisions, gives_a_single_true_contact_if_asked_for_the_first) {
  for (const auto& [a, b] : mesh_pairs()) {
    const auto truth = exhaustive_face_pairs(a, b);
    const auto found = find_collisions(a, b, {.contacts = Contact_query::first, .contact_points = true});
    EXPECT_EQ(found.collides, !truth.empty());
    EXPECT_EQ(found.faces.size(), truth.empty() ? 0U : 1U);
    EXPECT_EQ(found.points.size(), found.faces.size());
    EXPECT_TRUE(std::ranges::includes(truth, found.faces));
  }
}

TEST(Find_collisions, builds_nothing_unless_options_need_it) {
  const auto a = sphere(8), b = sphere(8, 1, {1.5, 0.1, 0});
  for (const auto contacts : {Contact_query::all, Contact_query::first, Contact_query::yes_no}) {
    const auto found = find_collisions(a, b, {.contacts = contacts});
    EXPECT_TRUE(found.collides);
    EXPECT_EQ(found.statistics.builds, 0U);
    EXPECT_EQ(found.statistics.seconds.build, 0);
    EXPECT_EQ(found.statistics.vertices_read, a.number_of_vertices() + b.number_of_vertices());
    EXPECT_GT(found.statistics.exact_tests, 0U);
  }
  EXPECT_EQ(find_collisions(a, b, {.exact = {.tolerance = 0.1}}).statistics.builds, 2U);
}

TEST(Find_collisions, the_frame_of_one_call_is_the_first_of_a_detector) {
  const auto a = sphere(8);
  for (const double x : {1.5, 2.5, 9.0}) {  // the boxes of the last two are apart from it
    SCOPED_TRACE(x);
    const auto b = sphere(8, 1, {x, 0.1, 0});
    const auto frame = frame_at_once(a, b, {});
    ASSERT_TRUE(frame);
    Detector<> detector;
    detector.add(a), detector.add(b);
    const Frame& truth = detector.detect();
    EXPECT_EQ(frame->number, truth.number);
    EXPECT_EQ(frame->pairs.size(), truth.pairs.size());
    EXPECT_EQ(frame->collides(), truth.collides());
    EXPECT_EQ(frame->face_pairs, truth.face_pairs);
    EXPECT_EQ(frame->statistics.object_candidates, truth.statistics.object_candidates);
    EXPECT_EQ(frame->statistics.contacts, truth.statistics.contacts);
    EXPECT_EQ(frame->statistics.vertices_read, a.number_of_vertices() + b.number_of_vertices());
    EXPECT_GT(frame->statistics.seconds.broad_phase, 0);
    EXPECT_EQ(frame->statistics.seconds.confirmation > 0, frame->collides());
    EXPECT_EQ(frame->statistics.seconds.total(),
              frame->statistics.seconds.broad_phase + frame->statistics.seconds.confirmation);
  }
}

/// What `ask` throws; empty: nothing.
template <class Ask>
std::string refusal(const Ask& ask) {
  try {
    ask();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(Find_collisions, refuses_what_a_detector_refuses_in_the_same_words) {
  const auto good = sphere(4);
  auto quadrilateral = sphere(4), infinite = sphere(4), unused = sphere(4), removed = sphere(4);
  std::vector<Surface_mesh::Vertex_index> corners;
  for (const auto& p : {Point(40, 0, 0), Point(41, 0, 0), Point(41, 1, 0), Point(40, 1, 0)})
    corners.push_back(quadrilateral.add_vertex(p));
  quadrilateral.add_face(corners);
  infinite.point(Surface_mesh::Vertex_index(17)) = Point(0, std::numeric_limits<double>::infinity(), 0);
  unused.add_vertex(Point(0, 0, std::numeric_limits<double>::quiet_NaN()));
  CGAL::Euler::remove_face(removed.halfedge(*removed.faces().begin()), removed);
  const Surface_mesh none;
  auto distant = quadrilateral;
  shift(distant, 500);
  const std::vector<const Surface_mesh*> meshes{&good, &quadrilateral, &infinite, &unused, &removed, &none, &distant};
  std::size_t refused = 0;
  for (const auto* a : meshes)
    for (const auto* b : meshes) {
      const std::string expected = refusal([&] { by_detector(*a, *b, {}); });
      EXPECT_EQ(refusal([&] { find_collisions(*a, *b); }), expected);
      refused += expected.empty() ? 0 : 1;
    }
  EXPECT_EQ(refusal([&] { find_collisions(good, infinite); }),
            "vertex 17 of object 1 (the second mesh) has a coordinate that is not finite");
  EXPECT_EQ(refused, meshes.size() * meshes.size());
  for (const Detector_options& options : {Detector_options{.most_contacts = 0},
                                          {.exact = {.tolerance = -1}},
                                          {.meetings = 1},
                                          {.exact = {.loosest = 0}}}) {
    const std::string expected = refusal([&] { by_detector(good, sphere(2), options); });
    EXPECT_FALSE(expected.empty());
    EXPECT_EQ(refusal([&] { find_collisions(good, sphere(2), options); }), expected);
    EXPECT_EQ(refusal([&] { find_self_collisions(good, options); }), expected);
  }
}

/// Surfaces with and without folds.
std::vector<Surface_mesh> folded_meshes() {
  std::vector<Surface_mesh> meshes{sphere(6), cube(3), grid(6, 5), single_triangle()};
  for (const double distance : {0.05, 0.2, 0.5}) {
    meshes.push_back(potato(8));
    crumple(meshes.back(), distance, 2);
    meshes.push_back(grid(12, 10));
    crumple(meshes.back(), 4 * distance, 3);
  }
  meshes.push_back(sphere(7));
  append(meshes.back(), sphere(6, 0.9, {0.8, 0, 0}));
  return meshes;
}

/// All faces of a cone share a vertex, so their boxes overlap.
TEST(Find_collisions, answers_by_trees_where_boxes_part_little) {
  constexpr std::uint32_t faces = 8000;
  const auto cone = [](double x, double z) {
    std::vector<double> coordinates{x, 0, z};
    for (std::uint32_t face = 0; face < faces; ++face) {
      const double angle = 2 * std::numbers::pi * face / faces;
      coordinates.insert(coordinates.end(), {x + std::cos(angle), std::sin(angle), z + 0.5});
    }
    return coordinates;
  };
  std::vector<Corners> corners;
  for (std::uint32_t face = 0; face < faces; ++face) corners.push_back({0, 1 + face, 1 + (face + 1) % faces});
  const auto at_rest = cone(0, 0);
  const Indexed_mesh a(at_rest, corners);
  for (const auto& [x, z, meet] : {std::tuple(0.0, 0.1, false), std::tuple(0.3, 0.0, true)}) {
    const auto moved = cone(x, z);
    const Indexed_mesh b(moved, corners);
    Detector detector;
    detector.add(a), detector.add(b);
    const auto collisions = find_collisions(a, b);
    const auto frame = detector.detect(0, 1);
    EXPECT_EQ(collisions.collides, meet);
    EXPECT_EQ(collisions.faces, frame.face_pairs);
    EXPECT_GT(collisions.statistics.leaf_tests, frame.statistics.leaf_tests) << "what was given up counts too";
    EXPECT_EQ(find_collisions(a, b, {.contacts = Contact_query::first}).faces.size(), meet ? 1U : 0U);
    EXPECT_EQ(find_collisions(a, b, {.contacts = Contact_query::yes_no}).collides, meet);
  }
}

/// So many faces that their boxes lie in large pages.
TEST(Find_collisions, answers_as_a_detector_does_where_large_meshes_overlap_deeply) {
  const auto a = sphere(60), b = sphere(60, 1, Point(0.3, 0.01, 0.02));
  ASSERT_GT(num_faces(a), 25'000U);
  Detector detector;
  detector.add(a), detector.add(b);
  const auto truth = detector.detect(0, 1).face_pairs;
  EXPECT_GT(truth.size(), 500U);
  for (int time = 0; time < 2; ++time) EXPECT_EQ(find_collisions(a, b).faces, truth);
}

TEST(Find_self_collisions, answers_as_a_detector_does) {
  const std::vector<Detector_options> cases{{},
                                            {.contacts = Contact_query::yes_no},
                                            {.contact_points = true, .contact_normals = true},
                                            {.exact = {.self_tolerance = 0.05}},
                                            {.exact = {.patches = true}},
                                            {.threads = 2}};
  std::size_t colliding = 0;
  for (const auto& mesh : folded_meshes())
    for (const auto& options : cases) {
      const Collisions found = find_self_collisions(mesh, options);
      expect_same(found, self_by_detector(mesh, options));
      colliding += found.collides ? 1 : 0;
    }
  EXPECT_GT(colliding, 4 * cases.size());
}

TEST(Find_self_collisions, lists_as_many_contacts_as_asked_for) {
  auto mesh = potato(8);
  crumple(mesh, 0.5, 2);
  const auto all = find_self_collisions(mesh);
  ASSERT_GT(all.faces.size(), 5U);
  const auto some = find_self_collisions(mesh, {.most_contacts = 5});
  EXPECT_TRUE(some.capped);
  EXPECT_EQ(some.faces.size(), 5U);
  EXPECT_TRUE(std::ranges::includes(all.faces, some.faces));
  EXPECT_EQ(find_self_collisions(mesh, {.contacts = Contact_query::first}).faces.size(), 1U);
}

TEST(Find_self_collisions, joins_vertices_of_one_file_vertex) {
  const auto mesh = flat_shaded(sphere(3));
  std::vector<std::uint32_t> file_vertex(mesh.number_of_vertices());
  std::map<Point, std::uint32_t> places;
  for (const auto v : mesh.vertices())
    file_vertex[v] = places.try_emplace(mesh.point(v), static_cast<std::uint32_t>(places.size())).first->second;
  EXPECT_TRUE(find_self_collisions(mesh).collides);
  EXPECT_FALSE(find_self_collisions(mesh, {}, file_vertex).collides);
  EXPECT_THROW(find_self_collisions(mesh, {}, std::vector<std::uint32_t>(3)), Bad_argument);
}

TEST(Find_self_collisions, refuses_what_a_detector_refuses_in_the_same_words) {
  auto infinite = sphere(4);
  infinite.point(Surface_mesh::Vertex_index(17)) = Point(0, std::numeric_limits<double>::infinity(), 0);
  for (const auto& mesh : {Surface_mesh(), infinite}) {
    const std::string expected = refusal([&] { self_by_detector(mesh, {}); });
    EXPECT_FALSE(expected.empty());
    EXPECT_EQ(refusal([&] { find_self_collisions(mesh); }), expected);
  }
  EXPECT_THROW(find_self_collisions(sphere(3), {.mode = Mode::particles}), Bad_argument);
}

}  // namespace
}  // namespace lodestone
