// SPDX-License-Identifier: GPL-3.0-or-later
// Mode exact gives the same frames on every mesh type as on Surface_mesh, and these equal exhaustive checking.
#include <cmath>

#include "contract/mesh_types.h"
#include "lodestone/find_collisions.h"
#include "lodestone/io/shapes/shapes.h"
#include "support/exact_truth.h"

namespace lodestone {
namespace {

/// Moves all vertices; through CGAL's point map OpenMesh would get floats.
template <class Mesh>
void place(Mesh& mesh, const Positions& positions) {
  [[maybe_unused]] auto points = get(CGAL::vertex_point, mesh);
  Eigen::Index row = 0;
  for (const auto v : vertices(mesh)) {
    const Eigen::RowVector3d p = positions.row(row++);
    if constexpr (std::is_same_v<Mesh, Open_mesh>)
      mesh.set_point(v, Double_traits::Point(p.x(), p.y(), p.z()));
    else
      put(points, v, Point(p.x(), p.y(), p.z()));
  }
}

/// Two surfaces that meet; the second has several poses.
struct Two_surfaces {
  std::string name;
  Surface_mesh a, b;
  std::vector<Positions> poses = {};
};

Two_surfaces moving(std::string name, Surface_mesh a, Surface_mesh b, const Eigen::RowVector3d& step, int frames = 4) {
  Two_surfaces surfaces{.name = std::move(name), .a = std::move(a), .b = std::move(b)};
  for (int frame = 0; frame < frames; ++frame)
    surfaces.poses.push_back(positions_of(surfaces.b).rowwise() + frame * step);
  return surfaces;
}

/// Three triangles on one edge, each with separate corners, and one of them twice.
Surface_mesh pages() {
  return mesh_of({{0, 0, 0},
                  {0, 0, 1},
                  {1, 0, 0},
                  {0, 0, 0},
                  {0, 0, 1},
                  {-1, 1, 0},
                  {0, 0, 0},
                  {0, 0, 1},
                  {-1, -1, 0},
                  {0, 0, 0},
                  {0, 0, 1},
                  {-1, -1, 0}},
                 {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}});
}

/// A grid with two rows of vertices on one line and two coinciding vertices.
Surface_mesh grid_without_area_in_places() {
  auto mesh = grid(6, 6);
  deform(mesh, [](const Point& p) { return Point(p.x() - 2.5, (p.y() == 2 ? 3 : p.y()) - 3, 0.25 * p.x()); });
  mesh.point(Surface_mesh::Vertex_index(8)) = mesh.point(Surface_mesh::Vertex_index(7));
  return mesh;
}

std::vector<Two_surfaces> surfaces() {
  std::vector<Two_surfaces> all;
  all.push_back(moving("closed", potato(5), potato(4, 2), {0.9, 0.1, 0}));
  all.push_back(moving("open", cloth(9, 7), potato(4, 2), {0.3, 0.2, 0.4}));
  auto pieces = sphere(3, 0.4, {1, 0, 0});
  append(pieces, sphere(2, 0.5, {-1, 0, 0.1}));
  append(pieces, grid(3, 3));
  all.push_back(moving("several components", pieces, potato(4), {0.2, 0.3, 0.1}));
  all.push_back(moving("single triangle", single_triangle(), sphere(3), {0.5, 0.1, 0.1}));
  auto touching = single_triangle();
  deform(touching, [](const Point& p) { return Point(1 + p.z(), p.x(), p.y()); });
  all.push_back(moving("two triangles touching in a point", single_triangle(), touching, {0, 0, 0.25}));
  all.push_back(moving("without area", grid_without_area_in_places(), potato(3), {0.4, 0.3, 0.1}));
  all.push_back(
      moving("both without area", grid_without_area_in_places(), grid_without_area_in_places(), {1, 0, 0.25}));
  all.push_back(moving("an edge of many faces", pages(), pages(), {0.25, 0, 0.5}));
  auto twice = cube(2);
  append(twice, cube(2));
  all.push_back(moving("duplicate vertices and faces", twice, cube(3), {0.5, 0.5, 0.25}));
  return all;
}

template <class Mesh>
struct Exact_contract : ::testing::Test {};
TYPED_TEST_SUITE(Exact_contract, Mesh_types);

/// Plays all poses on a mesh type and on Surface_mesh; returns the number of face pairs found.
template <class Mesh>
std::size_t expect_equal_frames(Two_surfaces surfaces, Detector_options options) {
  options.mode = Mode::exact;
  auto a = converted<Mesh>(surfaces.a), b = converted<Mesh>(surfaces.b);
  Detector<> detector(options);
  Exact_detector expected(options);
  detector.add(a), detector.add(b);
  expected.add(surfaces.a), expected.add(surfaces.b);
  std::size_t contacts = 0;
  for (const auto& positions : surfaces.poses) {
    place(b, positions);
    place(surfaces.b, positions);
    const Frame& frame = detector.detect();
    expect_same_frame(frame, expected.detect());
    if (options.exact.tolerance == 0) expect_exhaustive(frame, {&surfaces.a, &surfaces.b});
    contacts += frame.face_pairs.size();
    const auto closest = detector.closest(0, 1);
    EXPECT_EQ(closest.faces, expected.closest(0, 1).faces);
    EXPECT_EQ(closest.points.distance == 0, !exhaustive_face_pairs(surfaces.a, surfaces.b).empty());
    EXPECT_EQ(detector.contains(0, 1), expected.contains(0, 1));
  }
  return contacts;
}

TYPED_TEST(Exact_contract, frames_equal_those_on_a_surface_mesh_and_exhaustive_checking) {
  for (const auto& tested : surfaces()) {
    SCOPED_TRACE(tested.name);
    EXPECT_GT(expect_equal_frames<TypeParam>(tested, {}), 0U);
  }
}

TYPED_TEST(Exact_contract, frames_with_all_options_equal_those_on_a_surface_mesh) {
  for (const auto& tested : surfaces()) {
    SCOPED_TRACE(tested.name);
    EXPECT_GT(expect_equal_frames<TypeParam>(tested,
                                             {.contact_points = true,
                                              .contact_normals = true,
                                              .exact = {.tolerance = 0.1, .self_collision = true, .containment = true},
                                              .threads = 2,
                                              .tree = {.leaf_faces = 4}}),
              0U);
  }
}

TYPED_TEST(Exact_contract, frames_equal_exhaustive_checking_in_any_unit_and_far_from_the_origin) {
  for (auto tested : surfaces()) {
    SCOPED_TRACE(tested.name);
    const auto poses = tested.poses;
    const auto a = positions_of(tested.a), b = positions_of(tested.b);
    std::vector<std::size_t> found;
    for (const double unit : {1.0, 0x1p-300, 0x1p300}) {
      place(tested.a, unit * a), place(tested.b, unit * b);
      for (std::size_t i = 0; i < poses.size(); ++i) tested.poses[i] = unit * poses[i];
      found.push_back(expect_equal_frames<TypeParam>(tested, {}));
    }
    EXPECT_EQ(found[1], found[0]);
    EXPECT_EQ(found[2], found[0]);
    const auto far = [](const Positions& positions) -> Positions { return positions.array() + 0x1p20; };
    place(tested.a, far(a)), place(tested.b, far(b));
    for (std::size_t i = 0; i < poses.size(); ++i) tested.poses[i] = far(poses[i]);
    EXPECT_GT(expect_equal_frames<TypeParam>(tested, {}), 0U);
  }
}

TYPED_TEST(Exact_contract, frames_equal_exhaustive_checking_up_to_the_largest_numbers) {
  auto a = potato(3), b = potato(3, 2);
  scale(a, 0.9e308), scale(b, 0.9e308);  // from -1.7e308 to 1.7e308: extents overflow
  EXPECT_GT(expect_equal_frames<TypeParam>(moving("huge", a, b, {0, 0.3e308, 0.3e308}, 3), {}), 0U);
}

TYPED_TEST(Exact_contract, self_collisions_equal_those_on_a_surface_mesh) {
  auto source = cloth(10, 10);
  crumple(source, 0.05, 1);
  auto mesh = converted<TypeParam>(source);
  const Detector_options options{.mode = Mode::exact, .exact = {.self_collision = true}};
  Detector<> detector(options);
  Exact_detector expected(options);
  detector.add(mesh), expected.add(source);
  const Frame& frame = detector.detect();
  EXPECT_GT(frame.face_pairs.size(), 50U);
  expect_same_frame(frame, expected.detect());
}

TYPED_TEST(Exact_contract, given_positions_are_in_the_order_of_the_mesh_s_vertices) {
  const auto source = potato(5);
  auto other = potato(5, 2);
  const auto a = converted<TypeParam>(source), b = converted<TypeParam>(other);
  Detector<> detector({.mode = Mode::exact});
  detector.add(a), detector.add(b);
  shift(other, 1.4, 0.2);
  detector.update(1, positions_of(other));
  EXPECT_EQ(expect_exhaustive(detector.detect(), {&source, &other}), 1U);
  const Positions short_by_one = positions_of(other).topRows(positions_of(other).rows() - 1);
  EXPECT_THROW(detector.update(1, short_by_one), Bad_mesh);
}

TYPED_TEST(Exact_contract, regions_are_in_the_maps_of_the_mesh_and_do_not_depend_on_the_unit) {
  std::vector<Region_index> expected;
  for (const double unit : {1.0, 0x1p-300, 0x1p300, 0x1p1022}) {
    auto mesh = converted<TypeParam>(sphere(6, unit));
    Detector<> detector({.mode = Mode::exact, .particles = 12});
    detector.add(mesh);
    detector.detect();
    std::vector<Region_index> labels;
    std::vector<std::size_t> vertices_of(12, 0), particles_of(12, 0);
    for (const auto v : vertices(mesh)) {
      labels.push_back(get(detector.maps<TypeParam>(0).region(), v));
      ++vertices_of.at(labels.back());
      const auto particle = get(detector.maps<TypeParam>(0).particle(), v);
      if (particle == no_particle) continue;
      EXPECT_EQ(particle, labels.back());
      ++particles_of.at(particle);
    }
    for (const auto count : vertices_of) EXPECT_GT(count, 0U);
    for (const auto count : particles_of) EXPECT_EQ(count, 1U);
    if (expected.empty()) expected = labels;
    EXPECT_EQ(labels, expected) << unit;
  }
}

TYPED_TEST(Exact_contract, a_non_finite_coordinate_is_refused_only_in_its_frame) {
  auto source = sphere(4);
  const auto other = sphere(4, 1, {1.5, 0, 0});
  auto a = converted<TypeParam>(source);
  const auto b = converted<TypeParam>(other);
  Detector<> detector({.mode = Mode::exact});
  detector.add(a), detector.add(b);
  const Positions good = positions_of(source);
  for (int round = 0; round < 2; ++round) {
    Positions bad = good;
    bad(9, 2) = std::numeric_limits<double>::quiet_NaN();
    place(a, bad);
    EXPECT_THROW(detector.detect(), Bad_mesh);
    place(a, good);
    EXPECT_EQ(expect_exhaustive(detector.detect(), {&source, &other}), 1U);
  }
}

TYPED_TEST(Exact_contract, one_call_gives_the_contacts_that_a_detector_gives) {
  const Detector_options options{.contact_points = true, .contact_normals = true};
  std::size_t contacts = 0;
  for (auto tested : surfaces()) {
    SCOPED_TRACE(tested.name);
    const auto a = converted<TypeParam>(tested.a);
    auto b = converted<TypeParam>(tested.b);
    for (const auto& positions : tested.poses) {
      place(b, positions);
      place(tested.b, positions);
      Exact_detector detector(options);
      detector.add(tested.a), detector.add(tested.b);
      const Frame& expected = detector.detect();
      const auto found = find_collisions(a, b, options);
      EXPECT_EQ(found.faces, exhaustive_face_pairs(tested.a, tested.b));
      EXPECT_EQ(found.points, expected.contact_points);
      ASSERT_EQ(found.normals.size(), expected.contact_normals.size());
      for (std::size_t i = 0; i < found.normals.size(); ++i)
        EXPECT_EQ(found.normals[i].normal, expected.contact_normals[i].normal);
      EXPECT_EQ(found.statistics.builds, 0U);
      EXPECT_EQ(find_collisions(a, tested.b, {.contacts = Contact_query::yes_no}).collides, expected.collides());
      contacts += found.faces.size();
    }
    Exact_detector detector(self_collision);
    detector.add(tested.a);
    EXPECT_EQ(find_self_collisions(a).faces, detector.detect().face_pairs);
  }
  EXPECT_GT(contacts, 0U);
}

TYPED_TEST(Exact_contract, one_call_takes_points_beside_the_meshes) {
  const auto mesh = converted<TypeParam>(as_float(sphere(8)));
  const auto other = as_float(sphere(6, 1, {4, 0, 0}));
  const auto near = CGAL::parameters::vertex_point_map(moved_points(mesh, 0.5, 0.25, 0)),
             far = CGAL::parameters::vertex_point_map(moved_points(mesh, 4.5, 0.25, 0));
  const auto own = CGAL::parameters::default_values();
  const auto of_one = exhaustive_face_pairs(mesh, mesh, own, near), of_two = exhaustive_face_pairs(mesh, other, far);
  EXPECT_GT(of_one.size(), 5U);
  EXPECT_GT(of_two.size(), 5U);
  // Containment needs a detector; without it the call builds nothing.
  for (const bool with_detector : {false, true}) {
    const Detector_options options{.exact = {.containment = with_detector}};
    EXPECT_EQ(find_collisions(mesh, mesh, options, own, near).faces, of_one);
    EXPECT_EQ(find_collisions(mesh, other, options, far).faces, of_two);
    EXPECT_FALSE(find_collisions(mesh, other, options, near).collides);
    EXPECT_THROW(find_collisions(mesh, mesh, options), Bad_argument);
  }
}

TYPED_TEST(Exact_contract, one_call_takes_points_beside_the_mesh) {
  const auto mesh = converted<TypeParam>(as_float(sphere(8)));
  const auto folded = moved_points(mesh, 0, 0, 0);  // the lower half lies on the upper one, but for a shear
  for (const auto v : vertices(mesh)) {
    const auto p = coordinates(get(folded, v));
    put(folded, v, Point(p.x() + 0.2 * p.z(), p.y(), std::abs(p.z())));
  }
  Exact_detector detector(self_collision);
  detector.add(mesh, folded);
  const auto found = find_self_collisions(mesh, {}, {}, CGAL::parameters::vertex_point_map(folded));
  EXPECT_GT(found.faces.size(), 5U);
  EXPECT_EQ(found.faces, detector.detect().face_pairs);
  EXPECT_TRUE(find_self_collisions(mesh).faces.empty());
}

TYPED_TEST(Exact_contract, one_call_refuses_coordinates_that_are_not_finite_and_empty_meshes) {
  const auto source = sphere(4);
  const auto good = converted<TypeParam>(source);
  auto bad = converted<TypeParam>(source);
  Positions positions = positions_of(source);
  positions(9, 2) = std::numeric_limits<double>::quiet_NaN();
  place(bad, positions);
  const TypeParam empty;
  for (const TypeParam* mesh : {&std::as_const(bad), &empty}) {
    EXPECT_THROW(find_collisions(good, *mesh), Bad_mesh);
    EXPECT_THROW(find_collisions(*mesh, good), Bad_mesh);
    EXPECT_THROW(find_self_collisions(*mesh), Bad_mesh);
  }
}

TYPED_TEST(Exact_contract, empty_meshes_are_refused) {
  TypeParam empty;
  Detector<> detector({.mode = Mode::exact});
  EXPECT_THROW(detector.add(empty), Bad_mesh);
  EXPECT_THROW(detector.add(std::as_const(empty)), Bad_mesh);
}

TEST(Exact_detector, follows_100_000_vertices) {
  auto a = icosphere(100), b = icosphere(100);
  ASSERT_GT(num_vertices(a), 100'000U);
  Exact_detector detector({.mode = Mode::exact});
  add_all(detector, {&a, &b});
  for (const double x : {1.7, 0.25}) {
    shift(b, x, 0.01, 0.02);
    deform(a, [](const Point& p) { return Point(p.x() + 0.03 * std::sin(5 * p.y()), p.y(), p.z()); });
    const Frame& frame = detector.detect();
    EXPECT_EQ(expect_exhaustive(frame, {&a, &b}), 1U);
    EXPECT_GT(frame.face_pairs.size(), 100U);
  }
}

TEST(Open_mesh_with_removed_elements, is_refused_until_its_garbage_is_collected) {
  auto mesh = converted<Open_mesh>(icosphere(3));
  const auto other = icosphere(2);
  mesh.request_face_status(), mesh.request_edge_status(), mesh.request_vertex_status();
  mesh.delete_face(*mesh.faces_begin(), true);
  Detector<> detector;
  EXPECT_THROW(detector.add(mesh), Bad_mesh);
  EXPECT_THROW(find_collisions(mesh, other), Bad_mesh);
  EXPECT_THROW(find_self_collisions(mesh), Bad_mesh);
  mesh.garbage_collection();
  EXPECT_NO_THROW(detector.add(mesh));
  detector.add(other);
  EXPECT_EQ(detector.detect().face_pairs, find_collisions(mesh, other).faces);

  // Also if the other mesh is far away, and if it was a vertex without faces.
  Open_mesh far = converted<Open_mesh>(other);
  far.request_face_status(), far.request_edge_status(), far.request_vertex_status();
  for (const auto v : far.vertices()) far.point(v)[0] += 9;
  EXPECT_FALSE(find_collisions(far, other).collides);
  const auto alone = far.add_vertex({9, 0, 0});
  EXPECT_FALSE(find_collisions(far, other).collides);
  far.delete_vertex(alone);
  EXPECT_THROW(find_collisions(far, other), Bad_mesh);
  far.garbage_collection();
  EXPECT_FALSE(find_collisions(far, other).collides);
  far.delete_face(*far.faces_begin(), true);
  EXPECT_THROW(find_collisions(far, other), Bad_mesh);

  // Also if they are removed between two frames.
  std::size_t removed = 0;
  for (const Mode mode : {Mode::exact, Mode::certified, Mode::particles}) {
    auto open = converted<Open_mesh>(icosphere(3));
    open.request_face_status(), open.request_edge_status(), open.request_vertex_status();
    Detector<> kept({.mode = mode});
    kept.add(open);
    kept.add(other);
    kept.detect();
    open.delete_face(Open_mesh::FaceHandle(static_cast<int>(removed)), true);
    removed = removed == 0 ? open.n_faces() / 2 : open.n_faces() - 1;  // for the next mode
    EXPECT_THROW(kept.detect(), Bad_mesh);
    open.garbage_collection();
    kept.rebuild(0);
    EXPECT_EQ(kept.detect().collides(), find_collisions(open, other).collides);
  }
}

}  // namespace
}  // namespace lodestone
