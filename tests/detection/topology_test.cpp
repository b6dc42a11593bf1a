// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes whose faces change: noticed where numbers change, and right after `rebuild`.
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <gtest/gtest.h>

#include <functional>
#include <numeric>
#include <random>
#include <set>

#include "lodestone/io/shapes/shapes.h"
#include "support/exact_truth.h"
#include "support/message_of.h"

namespace lodestone {
namespace {

namespace Euler = CGAL::Euler;
using Halfedge_index = Surface_mesh::Halfedge_index;

const Detector_options all_exact{.mode = Mode::exact, .exact = {.self_collision = true, .containment = true}};

/// Cuts the edge between two triangles in its middle, and both triangles in two.
void split(Surface_mesh& mesh, Halfedge_index h) {
  if (mesh.is_border(mesh.edge(h))) return;
  const Point middle = CGAL::midpoint(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)));
  const auto first_half = Euler::split_edge(h, mesh);
  mesh.point(mesh.target(first_half)) = middle;
  Euler::split_face(first_half, mesh.next(h), mesh);
  Euler::split_face(mesh.opposite(h), mesh.next(mesh.opposite(first_half)), mesh);
}

void flip_some(Surface_mesh& mesh) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 40; ++i) {
    const Halfedge_index h(static_cast<std::uint32_t>(random() % mesh.number_of_halfedges()));
    const auto from = mesh.target(mesh.next(h)), to = mesh.target(mesh.next(mesh.opposite(h)));
    if (!mesh.is_border(mesh.edge(h)) && !mesh.halfedge(from, to).is_valid()) Euler::flip_edge(h, mesh);
  }
}

void split_some(Surface_mesh& mesh) {
  for (std::uint32_t h = 0; h < 200; h += 14) split(mesh, Halfedge_index(h));
}

void collapse_some(Surface_mesh& mesh) {
  std::mt19937_64 random(2);
  for (int collapsed = 0; collapsed < 30;) {
    const Surface_mesh::Edge_index e(static_cast<std::uint32_t>(random() % mesh.number_of_edges()));
    if (mesh.is_removed(e) || !Euler::does_satisfy_link_condition(e, mesh)) continue;
    Euler::collapse_edge(e, mesh);
    ++collapsed;
  }
  mesh.collect_garbage();
}

void add_centres(Surface_mesh& mesh) {
  for (std::uint32_t f = 0; f < 40; f += 3) {
    const auto h = mesh.halfedge(Surface_mesh::Face_index(f));
    const auto t = triangle_of(mesh, f);
    const auto centre = Euler::add_center_vertex(h, mesh);
    mesh.point(mesh.target(centre)) = CGAL::centroid(t[0], t[1], t[2]);
  }
}

void add_a_piece(Surface_mesh& mesh) { append(mesh, sphere(4, 0.4, {0, 1.4, 0})); }

TEST(Topology, is_right_after_rebuild) {
  const std::vector<std::function<void(Surface_mesh&)>> changes{flip_some, split_some, collapse_some, add_centres,
                                                                add_a_piece};
  auto a = potato(8), b = potato(8, 2);
  shift(b, 1.5);
  for (const bool writable : {false, true}) {
    Exact_detector detector(all_exact);
    if (writable)
      detector.add(a), detector.add(b);
    else
      add_all(detector, {&a, &b});
    EXPECT_EQ(expect_exhaustive(detector.detect(), {&a, &b}), 1U);
    for (const auto& change : changes) {
      change(a);
      ASSERT_TRUE(CGAL::is_valid_polygon_mesh(a) && CGAL::is_triangle_mesh(a));
      detector.rebuild(0);
      for (int frame = 0; frame < 2; ++frame) {
        EXPECT_EQ(expect_exhaustive(detector.detect(), {&a, &b}), 1U);
        const Numbered_mesh now(a);
        EXPECT_EQ(detector.tree(0).validate(now.faces, now.coordinates()), "");
        shift(b, 0.01);
      }
    }
  }
}

/// The faces around both ends of an edge, and the new ones: what an Euler operation at the edge changes.
void list_faces_around(const Surface_mesh& mesh, Halfedge_index h, std::set<std::uint32_t>& faces) {
  for (const auto end : {mesh.source(h), mesh.target(h)})
    for (const auto f : mesh.faces_around_target(mesh.halfedge(end)))
      if (f.is_valid()) faces.insert(f);
}

TEST(Topology, is_right_after_known_faces_have_changed) {
  for (const auto mode : {Mode::exact, Mode::particles}) {
    auto a = sphere(25), b = sphere(25, 1, {1.9, 0, 0});
    Exact_detector detector({.mode = mode, .exact = {.self_collision = mode == Mode::exact}});
    detector.add(a);
    detector.add(b);
    detector.detect();
    std::mt19937_64 random(1);
    for (int round = 0; round < 6; ++round) {
      std::set<std::uint32_t> changed;
      for (int i = 0; i < 10; ++i) {
        const Halfedge_index h(static_cast<std::uint32_t>(random() % a.number_of_halfedges()));
        list_faces_around(a, h, changed);
        const auto from = a.target(a.next(h)), to = a.target(a.next(a.opposite(h)));
        if (i % 2 == 0)
          split(a, h);
        else if (!a.halfedge(from, to).is_valid())
          Euler::flip_edge(h, a);
      }
      detector.rebuild(0, Changed_faces{std::vector<std::uint32_t>(changed.begin(), changed.end())});
      const Frame& frame = detector.detect();
      EXPECT_EQ(frame.statistics.builds, 1U);
      if (mode == Mode::particles) continue;
      expect_exhaustive(frame, {&a, &b});
      const Numbered_mesh now(a);
      EXPECT_EQ(detector.tree(0).validate(now.faces, now.coordinates()), "");
      shift(b, -0.01);
    }
  }
}

TEST(Topology, an_object_with_regions_has_them_again_after_known_faces_have_changed) {
  auto a = sphere(25);
  const auto b = sphere(25, 1, {1.9, 0, 0});
  Exact_detector detector({.particles = 12});
  detector.add(a);
  detector.add(b);
  detector.detect();
  std::set<std::uint32_t> changed;
  list_faces_around(a, Halfedge_index(0), changed);
  split(a, Halfedge_index(0));
  detector.rebuild(0, Changed_faces{std::vector<std::uint32_t>(changed.begin(), changed.end())});
  for (int frame = 0; frame < 2; ++frame) {
    EXPECT_EQ(expect_exhaustive(detector.detect(), {&a, &b}), 1U);
    const Numbered_mesh now(a);
    EXPECT_EQ(detector.tree(0).validate(now.faces, now.coordinates()), "");
  }
  std::set<Region_index> seen;
  for (const auto v : a.vertices()) seen.insert(detector.maps(0).region()[v]);
  EXPECT_EQ(seen.size(), 12U);
}

TEST(Topology, is_right_after_known_faces_of_a_mesh_without_indices_have_changed) {
  using Polyhedron = CGAL::Polyhedron_3<Kernel>;
  Polyhedron a;
  CGAL::copy_face_graph(sphere(10), a);
  const auto b = sphere(5, 1, {1.5, 0, 0});
  Exact_detector detector;
  detector.add(a);
  detector.add(b);
  detector.detect();
  // Removing the first vertex gives all others another index.
  Euler::remove_center_vertex(a.vertices_begin()->halfedge(), a);
  CGAL::Polygon_mesh_processing::triangulate_faces(a);
  detector.rebuild(0, Changed_faces{});
  EXPECT_EQ(detector.detect().face_pairs, exhaustive_face_pairs(a, b));
}

TEST(Topology, a_list_without_faces_whose_corners_are_gone_is_refused) {
  auto a = sphere(5), b = sphere(5, 1, {1.5, 0, 0});
  Exact_detector detector(all_exact);
  add_all(detector, {&a, &b});
  detector.detect();
  collapse_some(a);
  EXPECT_THROW(detector.rebuild(0, Changed_faces{}), Bad_argument);
  EXPECT_THROW(detector.detect(), Bad_mesh) << "the object stays as it was";
  std::vector<std::uint32_t> all(a.number_of_faces());
  std::iota(all.begin(), all.end(), 0U);
  detector.rebuild(0, Changed_faces{all});
  EXPECT_EQ(expect_exhaustive(detector.detect(), {&a, &b}), 1U);
}

/// File vertices by which the last vertex of a mesh counts as its first.
std::vector<std::uint32_t> last_joined_to_first(const Surface_mesh& mesh) {
  std::vector<std::uint32_t> file_vertex(mesh.number_of_vertices());
  std::iota(file_vertex.begin(), file_vertex.end(), 0U);
  file_vertex.back() = 0;
  return file_vertex;
}

TEST(Topology, changed_faces_that_do_not_exist_are_refused) {
  auto a = sphere(5), b = sphere(5, 1, {1.5, 0, 0});
  Exact_detector detector(all_exact);
  add_all(detector, {&a, &b});
  const std::uint32_t beyond[] = {static_cast<std::uint32_t>(a.number_of_faces())};
  EXPECT_THROW(detector.rebuild(0, Changed_faces{beyond}), Bad_argument);
  EXPECT_THROW(detector.rebuild(7, Changed_faces{}), Bad_argument);
  EXPECT_EQ(expect_exhaustive(detector.detect(), {&a, &b}), 1U);

  // The same for an object whose doubled vertices count as one.
  Exact_detector joining(all_exact);
  joining.add(std::as_const(a), {.file_vertex = last_joined_to_first(a)});
  const auto contacts = joining.detect().face_pairs;
  EXPECT_THROW(joining.rebuild(0, Changed_faces{beyond}), Bad_argument);
  EXPECT_EQ(joining.detect().face_pairs, contacts);
}

TEST(Topology, changes_before_the_next_query_add_up) {
  auto a = sphere(25);
  const auto b = sphere(25, 1, {1.9, 0, 0});
  Exact_detector detector(all_exact);
  add_all(detector, {&a, &b});
  detector.detect();
  for (int round = 0; round < 3; ++round) {
    std::set<std::uint32_t> changed;
    const Halfedge_index h(static_cast<std::uint32_t>(round * 700));
    list_faces_around(a, h, changed);
    split(a, h);
    if (round == 1)
      detector.rebuild(0);
    else
      detector.rebuild(0, Changed_faces{std::vector<std::uint32_t>(changed.begin(), changed.end())});
  }
  EXPECT_EQ(expect_exhaustive(detector.detect(), {&a, &b}), 1U);
  const Numbered_mesh now(a);
  EXPECT_EQ(detector.tree(0).validate(now.faces, now.coordinates()), "");
}

TEST(Topology, faces_that_are_listed_as_changed_may_be_gone_before_the_next_query) {
  auto a = sphere(25);
  const auto b = sphere(25, 1, {1.9, 0, 0});
  Exact_detector detector(all_exact);
  add_all(detector, {&a, &b});
  detector.detect();
  const auto last = static_cast<std::uint32_t>(a.number_of_faces()) - 1;
  detector.rebuild(0, Changed_faces{std::vector{last - 1, last}});
  for (const std::uint32_t face : {5, 50}) Euler::make_hole(a.halfedge(Surface_mesh::Face_index(face)), a);
  a.collect_garbage();
  detector.rebuild(0);
  EXPECT_EQ(expect_exhaustive(detector.detect(), {&a, &b}), 1U);
  const Numbered_mesh now(a);
  EXPECT_EQ(detector.tree(0).validate(now.faces, now.coordinates()), "");
}

TEST(Topology, doubled_vertices_are_apart_after_known_faces_have_changed) {
  auto a = sphere(5);
  Exact_detector detector(all_exact);
  detector.add(std::as_const(a), {.file_vertex = last_joined_to_first(a)});
  detector.detect();
  std::set<std::uint32_t> changed;
  list_faces_around(a, Halfedge_index(0), changed);
  Euler::flip_edge(Halfedge_index(0), a);
  detector.rebuild(0, Changed_faces{std::vector<std::uint32_t>(changed.begin(), changed.end())});
  expect_exhaustive(detector.detect(), {&a});
  const Numbered_mesh now(a);
  EXPECT_EQ(detector.tree(0).validate(now.faces, now.coordinates()), "");
}

TEST(Topology, an_object_that_becomes_open_or_closed_is_known_as_such_after_rebuild) {
  auto outer = sphere(5);
  const auto inner = sphere(3, 0.3);
  Exact_detector detector(all_exact);
  add_all(detector, {&outer, &inner});
  EXPECT_TRUE(detector.contains(0, 1));
  Euler::make_hole(outer.halfedge(Surface_mesh::Face_index(5)), outer);
  outer.collect_garbage();
  detector.rebuild(0);
  EXPECT_FALSE(detector.contains(0, 1));
  for (const auto h : outer.halfedges())
    if (outer.is_border(h)) {
      Euler::fill_hole(h, outer);
      break;
    }
  detector.rebuild(0);
  EXPECT_TRUE(detector.contains(0, 1));
}

TEST(Topology, another_number_of_vertices_or_faces_is_refused_until_rebuild) {
  const std::vector<std::function<void(Surface_mesh&)>> changes{
      split_some,
      collapse_some,
      add_a_piece,
      [](Surface_mesh& mesh) { mesh.add_vertex(Point(0, 0, 0)); },
      [](Surface_mesh& mesh) {
        mesh.add_face(Surface_mesh::Vertex_index(0), mesh.add_vertex(Point(2, 0, 0)), mesh.add_vertex(Point(0, 2, 0)));
      },
      [](Surface_mesh& mesh) {
        Euler::make_hole(mesh.halfedge(Surface_mesh::Face_index(100)), mesh);
        mesh.collect_garbage();
      }};
  for (const auto& change : changes) {
    auto a = sphere(5), b = sphere(5, 1, {1.5, 0, 0}), c = sphere(5, 1, {0, 1.5, 0});
    // Faces can be added at a vertex of a border.
    Euler::make_hole(a.halfedge(Surface_mesh::Vertex_index(0)), a);
    a.collect_garbage();
    Exact_detector detector(all_exact);
    add_all(detector, {&a, &b, &c});
    detector.detect();
    change(a);
    for (const auto& ask : std::vector<std::function<void()>>{
             [&] { detector.detect(); }, [&] { detector.detect(0, 1); }, [&] { detector.detect(0, 0); },
             [&] { detector.closest(0, 1); }, [&] { detector.contains(1, 0); }}) {
      try {
        ask();
        ADD_FAILURE() << "answered for faces that have changed";
      } catch (const Bad_mesh& error) {
        EXPECT_NE(std::string(error.what()).find("rebuild()"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("object 0"), std::string::npos) << error.what();
      }
    }
    expect_contacts(detector.detect(1, 2), 1, 2, exhaustive_face_pairs(b, c));
    detector.rebuild(0);
    expect_exhaustive(detector.detect(), {&a, &b, &c});
  }
}

TEST(Topology, a_rebuild_that_is_refused_leaves_the_object_as_it_was) {
  auto a = sphere(5), b = sphere(5, 1, {1.5, 0, 0});
  Exact_detector detector(all_exact);
  add_all(detector, {&a, &b});
  detector.detect();
  std::vector<Surface_mesh::Vertex_index> corners;
  for (const auto& p : {Point(9, 0, 0), Point(9, 1, 0), Point(9, 1, 1), Point(9, 0, 1)})
    corners.push_back(a.add_vertex(p));
  const auto quadrilateral = a.add_face(corners);
  EXPECT_THROW(detector.rebuild(0), Bad_mesh);
  EXPECT_THROW(detector.detect(), Bad_mesh);
  Euler::remove_face(a.halfedge(quadrilateral), a);
  EXPECT_THROW(detector.rebuild(0), Bad_mesh);  // removed elements
  a.collect_garbage();
  EXPECT_EQ(expect_exhaustive(detector.detect(), {&a, &b}), 1U);
  EXPECT_THROW(detector.rebuild(2), Bad_argument);
}

TEST(Topology, given_positions_of_another_number_are_forgotten_by_a_rebuild) {
  auto a = sphere(5), b = sphere(5, 1, {1.5, 0, 0});
  Exact_detector detector(all_exact);
  add_all(detector, {&a, &b});
  Positions far = positions_of(a);
  far.array() += 100;
  detector.update(0, far);
  EXPECT_FALSE(detector.detect().collides());
  split_some(a);
  detector.rebuild(0);
  EXPECT_EQ(expect_exhaustive(detector.detect(), {&a, &b}), 1U);
  EXPECT_THROW(detector.update(0, far), Bad_mesh);
  Positions near = positions_of(a);
  near.array() += 0.1;
  detector.update(0, near);
  expect_contacts(detector.detect(), 0, 1, exhaustive_face_pairs(posed(a, near), b));
}

TEST(Topology, removed_elements_that_have_not_been_collected_are_refused_by_name) {
  auto a = potato(6), b = potato(6, 2);
  Exact_detector detector({.mode = Mode::exact});
  add_all(detector, {&a, &b});
  detector.detect();
  Euler::make_hole(a.halfedge(Surface_mesh::Face_index(3)), a);
  try {
    detector.detect();
    FAIL() << "a removed face went unnoticed";
  } catch (const Bad_mesh& error) {
    EXPECT_NE(std::string(error.what()).find("collect_garbage"), std::string::npos) << error.what();
  }
  a.collect_garbage();
  detector.rebuild(0);
  expect_exhaustive(detector.detect(), {&a, &b});
}

TEST(Topology, a_mesh_that_is_cleared_and_filled_again_carries_its_maps_after_rebuild) {
  for (const Mode mode : {Mode::exact, Mode::particles}) {
    auto a = sphere(3), b = sphere(5, 1, {1.5, 0, 0});
    Exact_detector detector({.mode = mode, .particles = 12});
    detector.add(a);
    detector.add(b);
    detector.detect();
    a.clear();  // and with it the maps
    CGAL::copy_face_graph(sphere(20), a);
    detector.rebuild(0);
    EXPECT_TRUE(detector.detect().collides());
    const auto regions = a.property_map<Surface_mesh::Vertex_index, Region_index>("v:region").first;
    std::set<Region_index> seen;
    for (const auto v : a.vertices()) {
      EXPECT_EQ(regions[v], detector.maps(0).region()[v]);
      seen.insert(regions[v]);
    }
    EXPECT_GE(seen.size(), 12U);
  }
}

TEST(Topology, given_positions_are_not_taken_for_those_of_other_vertices) {
  Surface_mesh a = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}}, {{0, 1, 2}, {3, 4, 5}});
  const Surface_mesh b = mesh_of({{9, 0, -1}, {9, 0, 1}, {9.5, 1, 0}}, {{0, 1, 2}});
  Exact_detector detector({.mode = Mode::exact});
  detector.add(std::as_const(a));
  detector.add(b);
  Positions lifted = positions_of(a);
  lifted.col(2).array() += 5;
  detector.update(0, lifted);
  EXPECT_FALSE(detector.detect().collides());
  // One triangle goes, another comes: as many vertices and faces as before.
  Euler::remove_face(a.halfedge(Surface_mesh::Face_index(0)), a);
  a.collect_garbage();
  append(a, mesh_of({{8, 0, 0}, {10, 0, 0}, {9, 1, 0}}, {{0, 1, 2}}));
  detector.rebuild(0);
  EXPECT_EQ(expect_exhaustive(detector.detect(), {&a, &b}), 1U);
}

TEST(Topology, a_coordinate_that_is_not_finite_is_named_and_the_next_frame_is_right) {
  for (const std::size_t vertex : {std::size_t{3}, std::size_t{100}, std::size_t{146}})  // the last is of no face
    for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      auto a = sphere(6), b = sphere(6);
      a.add_vertex(Point(0, 0, 0));
      shift(b, 1.5);
      ASSERT_EQ(a.number_of_vertices(), 147U);
      Detector<> detector(all_exact);
      detector.add(std::as_const(a));
      detector.add(std::as_const(b));
      detector.detect();
      split(a, Halfedge_index(0));
      auto& point = a.point(Surface_mesh::Vertex_index(static_cast<std::uint32_t>(vertex)));
      const Point before = point;
      point = Point(before.x(), value, before.z());
      std::set<std::uint32_t> changed;
      list_faces_around(a, Halfedge_index(0), changed);
      detector.rebuild(0, Changed_faces{std::vector<std::uint32_t>(changed.begin(), changed.end())});
      const auto message = message_of<Bad_mesh>([&] { detector.detect(); });
      EXPECT_NE(message.find("vertex " + std::to_string(vertex) + " of object 0"), std::string::npos) << message;
      point = before;
      EXPECT_EQ(expect_exhaustive(detector.detect(), {&a, &b}), 1U);
    }
}

TEST(Topology, what_is_near_at_rest_is_known_after_a_frame_that_was_not_finite) {
  auto sheet = cloth(16, 16);
  const auto lonely = sheet.add_vertex(Point(0, 0, 0));
  Detector<> detector({.mode = Mode::exact, .exact = {.self_collision = true, .self_tolerance = 0.05}});
  detector.add(std::as_const(sheet));
  detector.detect();
  Halfedge_index h(0);
  while (sheet.is_border(sheet.edge(h))) h = Halfedge_index(h + 2);
  std::set<std::uint32_t> changed;
  list_faces_around(sheet, h, changed);
  split(sheet, h);
  detector.rebuild(0, Changed_faces{std::vector<std::uint32_t>(changed.begin(), changed.end())});
  sheet.point(lonely) = Point(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  EXPECT_THROW(detector.detect(), Bad_mesh);
  sheet.point(lonely) = Point(0, 0, 0);
  EXPECT_TRUE(detector.detect().face_pairs.empty());
}

}  // namespace
}  // namespace lodestone
