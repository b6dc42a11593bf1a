// SPDX-License-Identifier: GPL-3.0-or-later
// An object that is loaded is as the one that was saved, and what does not fit is refused.
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <string>

#include "detection/detector_scenes.h"
#include "lodestone/volumes/all.h"
#include "support/exact_truth.h"
#include "support/face_soup.h"

namespace lodestone {
namespace {

using Bytes = std::vector<std::byte>;

/// What is expected of the objects of one detector is found with those of another, which has loaded them.
struct Twins {
  Detector_options options;
  Owned_meshes meshes;
  Owned_meshes copies = meshes;
  Detector<> expected{options}, loaded{options};

  Twins(const Detector_options& o, Owned_meshes m) : options(o), meshes(std::move(m)) {
    lodestone::add_all(expected, meshes);
    lodestone::add_all(loaded, copies);
    for (Object_id id = 0; id < meshes.size(); ++id) loaded.load(id, expected.save(id));
  }

  /// @return contacts of all frames
  std::size_t expect_same_frames(int frames, const std::function<void(Owned_meshes&)>& move) {
    std::size_t contacts = 0;
    for (int frame = 0; frame < frames; ++frame) {
      const Frame& one = expected.detect();
      const Frame& other = loaded.detect();
      EXPECT_EQ(other.statistics.builds, 0U);
      EXPECT_EQ(one.statistics.vertices_read, other.statistics.vertices_read) << frame;
      expect_same_frame(one, other);
      contacts += other.face_pairs.size();
      move(meshes), move(copies);
      expected.update(), loaded.update();
    }
    return contacts;
  }
};

void come_nearer(Owned_meshes& meshes) { shift(meshes[1], -0.05); }
void swell(Owned_meshes& meshes) {
  deform(meshes[0], [](const Point& p) { return Point(1.08 * p.x(), 1.02 * p.y(), p.z()); });
}

struct Saved_case {
  std::string name;
  Detector_options options;
  friend void PrintTo(const Saved_case& saved, std::ostream* out) { *out << saved.name; }
};

class Saved_object : public testing::TestWithParam<Saved_case> {};

TEST_P(Saved_object, gives_the_same_frames) {
  Twins twins(GetParam().options, two_spheres(2.2));
  EXPECT_GT(twins.expect_same_frames(12, come_nearer), 0U);
  for (const auto v : twins.meshes[0].vertices())
    for (const char* name : {"v:region", "v:particle"}) {
      const auto map = [&](const Surface_mesh& mesh) {
        return mesh.property_map<Surface_mesh::Vertex_index, Region_index>(name).first;
      };
      ASSERT_EQ(map(twins.meshes[0])[v], map(twins.copies[0])[v]);
    }
}

TEST_P(Saved_object, gives_the_same_frames_when_surfaces_grow) {
  Twins twins(GetParam().options, two_spheres(2.2));
  EXPECT_GT(twins.expect_same_frames(12, swell), 0U);
}

TEST_P(Saved_object, of_triangles_that_share_no_vertices_gives_the_same_frames) {
  const Owned_meshes spheres = two_spheres(2.2, 6);
  Twins twins(GetParam().options, {flat_shaded(spheres[0]), flat_shaded(spheres[1])});
  EXPECT_GT(twins.expect_same_frames(12, come_nearer), 0U);
}

TEST_P(Saved_object, is_saved_as_the_same_bytes_again) {
  Twins twins(GetParam().options, two_spheres(2.2));
  const Bytes saved = twins.expected.save(0);
  EXPECT_EQ(saved, twins.expected.save(0));
  EXPECT_EQ(saved, twins.loaded.save(0));
}

TEST_P(Saved_object, may_have_moved_meanwhile) {
  auto meshes = two_spheres(2.2);
  Detector first(GetParam().options), second(GetParam().options);
  add_all(first, meshes);
  const Bytes a = first.save(0), b = first.save(1);
  shift(meshes[1], -0.6);
  add_all(second, meshes);
  second.load(0, a), second.load(1, b);
  const Frame& frame = second.detect();
  EXPECT_EQ(expect_true(frame, meshes), 1U);
  EXPECT_EQ(frame.statistics.builds, 0U);
}

TEST_P(Saved_object, is_refused_where_the_mesh_or_the_mode_is_another) {
  auto meshes = two_spheres(1.8, 6);
  Detector detector(GetParam().options);
  add_all(detector, meshes);
  const Bytes saved = detector.save(0);
  Surface_mesh larger = sphere(7), flipped = meshes[0];
  CGAL::Euler::flip_edge(Surface_mesh::Halfedge_index(0), flipped);
  const auto refusal_of = [&](Surface_mesh& mesh, const Detector_options& options) -> std::string {
    Detector other(options);
    other.add(mesh, {.name = "ball"}), other.add(meshes[1]);
    try {
      other.load(0, saved);
    } catch (const Bad_saved_object& error) {
      EXPECT_EQ(expect_true(other.detect(), {mesh, meshes[1]}), 1U) << "the object stays as it was";
      return error.what();
    }
    return "none";
  };
  const Detector_options& options = GetParam().options;
  EXPECT_EQ(refusal_of(larger, options),
            "the object was saved with 146 vertices and 288 faces, but object 0 (ball) has 198 vertices and 392 faces");
  EXPECT_EQ(refusal_of(flipped, options),
            "object 0 (ball) has other faces, or other joined vertices, than the object that was saved");
  Detector_options other{.particles = 12};
  if (options.mode == Mode::exact) other.mode = Mode::particles;
  const std::string mode_of_the_other = options.mode == Mode::exact ? "particles" : "exact with volumes of kind aabb";
  EXPECT_NE(refusal_of(meshes[0], other).find("but object 0 (ball) is in mode " + mode_of_the_other),
            std::string::npos);
  EXPECT_EQ(refusal_of(meshes[0], options), "none");
}

INSTANTIATE_TEST_SUITE_P(Modes, Saved_object,
                         testing::Values(Saved_case{"exact", {.mode = Mode::exact}},
                                         Saved_case{"exact_with_regions", {.mode = Mode::exact, .particles = 12}},
                                         Saved_case{"particles", {.mode = Mode::particles, .particles = 12}},
                                         Saved_case{"by_rule", {.mode = Mode::particles}},
                                         Saved_case{"without_meetings",
                                                    {.mode = Mode::particles, .particles = 32, .meetings = 0}},
                                         Saved_case{"senin", {.mode = Mode::senin, .particles = 32}}),
                         [](const auto& test) { return test.param.name; });

TEST(Saved_objects, without_meetings_are_none_of_a_detector_with_meetings) {
  auto meshes = two_spheres(1.8, 6);
  Detector published({.mode = Mode::particles, .meetings = 0}), meeting({.mode = Mode::particles});
  add_all(published, meshes), add_all(meeting, meshes);
  EXPECT_THROW(meeting.load(0, published.save(0)), Bad_saved_object);
  EXPECT_THROW(published.load(0, meeting.save(0)), Bad_saved_object);
}

TEST(Saved_objects, know_the_kind_of_their_volumes) {
  auto meshes = two_spheres(1.8, 6);
  Detector<> boxes;
  Volume_detector<Bounding_sphere> spheres, others;
  add_all(boxes, meshes), add_all(spheres, meshes), add_all(others, meshes);
  EXPECT_THROW(spheres.load(0, boxes.save(0)), Bad_saved_object);
  others.load(0, spheres.save(0)), others.load(1, spheres.save(1));
  expect_same_frame(spheres.detect(), others.detect());
}

TEST(Saved_objects, do_not_depend_on_threads) {
  auto meshes = two_spheres(1.8, 40);
  for (const auto mode : {Mode::exact, Mode::particles}) {
    Detector<> one({.mode = mode}), three({.mode = mode, .threads = 3});
    add_all(one, meshes), add_all(three, meshes);
    EXPECT_EQ(one.save(0), three.save(0));
  }
}

TEST(Saved_objects, serve_meshes_of_another_type_with_the_same_numbers) {
  auto meshes = two_spheres(1.8, 6);
  CGAL::Polyhedron_3<Kernel> polyhedron;
  CGAL::copy_face_graph(meshes[0], polyhedron);
  Detector<> first, second;
  first.add(polyhedron), first.add(meshes[1]);
  second.add(polyhedron), second.add(meshes[1]);
  second.load(0, first.save(0));
  expect_same_frame(first.detect(), second.detect());
}

TEST(Saved_objects, hold_the_positions_at_rest_that_a_tolerance_within_an_object_needs) {
  Surface_mesh mesh = grid(12, 12);
  const Detector_options tolerant{.exact = {.self_collision = true, .self_tolerance = 0.4}};
  Detector<> first(tolerant), second(tolerant), without;
  first.add(mesh), second.add(mesh), without.add(mesh);
  const Bytes saved = first.save(0);
  deform(mesh, [](const Point& p) { return p.x() > 5 ? Point(11 - p.x(), p.y(), 0.3) : p; });
  second.load(0, saved);
  const auto contacts = first.detect().face_pairs;
  EXPECT_GT(contacts.size(), 20U);
  EXPECT_EQ(second.detect().face_pairs, contacts);
  EXPECT_THROW(second.load(0, without.save(0)), Bad_saved_object);
  EXPECT_EQ(second.detect().face_pairs, contacts);
}

/// Loads a sphere that a detector has saved, cuts a face in three so that it reaches into another sphere, and tells the
/// detector that has loaded.
void expect_right_after_a_change(const Detector_options& options) {
  auto a = sphere(25);
  const auto b = sphere(25, 1, {1.9, 0, 0});
  Exact_detector first, second(options);
  first.add(a), second.add(a), second.add(b);
  second.load(0, first.save(0));
  const auto centre = CGAL::Euler::add_center_vertex(Surface_mesh::Halfedge_index(0), a);
  a.point(a.target(centre)) = {1.2, 0, 0};
  const std::uint32_t changed[] = {a.face(Surface_mesh::Halfedge_index(0))};
  second.rebuild(0, Changed_faces{changed});
  EXPECT_EQ(expect_exhaustive(second.detect(), {&a, &b}), 1U);
}

TEST(Saved_objects, are_followed_by_their_own_leaves) {
  const auto a = sphere(25), b = sphere(25, 1, {1.7, 0, 0});
  Detector<> saved(Detector_options{.mode = Mode::particles, .particles = 3});
  Detector<> loaded(Detector_options{.mode = Mode::particles, .particles = 30});
  saved.add(a), saved.add(b), loaded.add(a), loaded.add(b);
  EXPECT_EQ(expect_exhaustive(loaded.detect(), {&a, &b}), 1U);
  for (const Object_id object : {0, 1}) loaded.load(object, saved.save(object));
  EXPECT_EQ(expect_exhaustive(loaded.detect(), {&a, &b}), 1U);
}

TEST(Saved_objects, may_have_only_faces_that_are_points) {
  Surface_mesh point;
  const auto a = point.add_vertex({0, 0, 0}), b = point.add_vertex({0, 0, 0}), c = point.add_vertex({0, 0, 0});
  point.add_face(a, b, c);
  for (const auto mode : {Mode::exact, Mode::particles, Mode::senin}) {
    const Detector_options options{.mode = mode};
    Owned_meshes meshes{point, flat_shaded(point), sphere(6)};
    std::vector<std::uint32_t> one_vertex{0, 0, 0};
    Detector<> first(options), second(options);
    for (auto* detector : {&first, &second})
      detector->add(meshes[0], {.file_vertex = one_vertex}), detector->add(meshes[1]), detector->add(meshes[2]);
    for (const Object_id id : {0, 1}) {
      const Bytes saved = first.save(id);
      second.load(id, saved);
      EXPECT_EQ(second.save(id), saved);
    }
    for (const Object_id id : {0, 1}) {
      shift(meshes[id], 1);
      first.update(id), second.update(id);
    }
    expect_same_frame(first.detect(), second.detect());
  }
}

/// A few faces of a few vertices on a small lattice: some name a vertex twice, and some vertices have no face.
Face_soup careless_soup(std::mt19937_64& random) {
  const std::size_t vertices = 3 + random() % 4, faces = 1 + random() % 4, size = 1 + random() % 3;
  Face_soup soup;
  soup.coordinates.resize(3 * vertices);
  for (double& x : soup.coordinates) x = static_cast<double>(random() % size);
  soup.faces.resize(faces);
  for (auto& face : soup.faces)
    for (auto& corner : face) corner = static_cast<std::uint32_t>(random() % vertices);
  return soup;
}

TEST(Saved_objects, may_name_a_vertex_twice_and_have_vertices_without_a_face) {
  std::mt19937_64 random(1);
  std::size_t saved_objects = 0;
  for (std::size_t count = 0; count < 400; ++count) {
    const Face_soup soup = careless_soup(random);
    const Indexed_mesh mesh(soup.coordinates, soup.faces);
    const Detector_options options{.mode = Mode::particles, .particles = 1 + count % 4, .meetings = count % 3};
    Detector<> first(options), second(options);
    first.add(mesh), second.add(mesh);
    Bytes saved;
    try {
      saved = first.save(0);
    } catch (const Bad_mesh&) {
      continue;  // all vertices at one place, or edges that are too short
    }
    second.load(0, saved);
    EXPECT_EQ(second.save(0), saved);
    ++saved_objects;
  }
  EXPECT_GT(saved_objects, 200U);
}

TEST(Saved_objects, can_change_afterwards) {
  expect_right_after_a_change({});
  expect_right_after_a_change({.tree = {.leaf_faces = 16}});
}

TEST(Saved_objects, know_how_loose_their_trees_were) {
  auto a = sphere(25);
  const auto b = sphere(25, 1, {1.9, 0, 0});
  Exact_detector first, second;
  first.add(a), second.add(a), second.add(b);
  const Bytes saved = first.save(0);
  crumple(a, 0.5, 1);
  second.load(0, saved);
  const Frame& frame = second.detect();
  EXPECT_EQ(frame.statistics.repartitions, 1U);
  EXPECT_EQ(expect_exhaustive(frame, {&a, &b}), 1U);
}

TEST(Saved_objects, keep_the_placement_and_the_given_positions_of_the_object_that_loads) {
  auto a = sphere(12), b = sphere(12, 1, {5, 0, 0});
  Exact_detector first, second;
  first.add(a), second.add(a), second.add(b);
  const Bytes saved = first.save(0);
  second.place(0, Eigen::Isometry3d(Eigen::Translation3d(3.2, 0, 0)));
  second.load(0, saved);
  EXPECT_EQ(second.detect().pairs.size(), 1U);
  second.place(0, Eigen::Isometry3d::Identity());
  EXPECT_TRUE(second.detect().pairs.empty());
  auto moved = a;
  shift(moved, 3.2);
  second.update(0, Numbered_mesh(moved).positions);
  second.load(0, saved);
  EXPECT_EQ(second.detect().pairs.size(), 1U);
}

TEST(Saved_objects, are_refused_by_a_strategy_that_cannot_divide_closed_seams) {
  Surface_mesh mesh = flat_shaded(sphere(6));
  const Detector_options options{.mode = Mode::particles};
  Detector<Lbg> first(options);
  Detector<By_vertex_number> second(options);
  first.add(mesh), second.add(mesh);
  EXPECT_THROW(second.load(0, first.save(0)), Bad_saved_object);
}

TEST(Saved_objects, without_closed_seams_open_those_of_the_object_that_loads) {
  Owned_meshes meshes{flat_shaded(sphere(6)), flat_shaded(sphere(6, 1, {1.8, 0, 0}))};
  const Detector_options options{.mode = Mode::particles};
  Detector<By_vertex_number> first(options);
  Detector<Lbg> second(options);
  add_all(first, meshes), add_all(second, meshes);
  first.detect(), second.detect();
  for (const Object_id id : {0, 1}) {
    const Bytes saved = first.save(id);
    first.load(id, saved), second.load(id, saved);
    EXPECT_EQ(second.save(id), saved);
  }
  expect_same_frame(first.detect(), second.detect());
}

}  // namespace
}  // namespace lodestone
