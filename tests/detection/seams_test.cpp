// SPDX-License-Identifier: GPL-3.0-or-later
// Files whose triangles share no vertices, as flat-shaded exports have them.
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <utility>

#include "detection/detector_scenes.h"
#include "lodestone/detector.h"
#include "lodestone/mesh/seams.h"

namespace lodestone {
namespace {

/// The same faces with shared vertices, in the order in which the faces name them.
Surface_mesh sharing(const Surface_mesh& apart) {
  const Mesh_numbering<Surface_mesh> numbering(apart);
  const Positions positions = read_positions(numbering, apart.points());
  const auto seams = close_seams(numbering.corners(), std::vector<bool>(num_vertices(apart), true), positions);
  std::vector<Point> points;
  for (const auto v : seams->vertices) points.push_back(apart.point(Surface_mesh::Vertex_index(v)));
  return mesh_of(points, seams->corners);
}

class Seams_in_mode : public testing::TestWithParam<Mode> {};

TEST_P(Seams_in_mode, frames_are_those_of_the_surface_that_shares_its_vertices) {
  const Owned_meshes spheres = two_spheres(2.2);
  Owned_meshes apart{flat_shaded(spheres[0]), flat_shaded(spheres[1])}, whole{sharing(apart[0]), sharing(apart[1])};
  const Detector_options options{.mode = GetParam(), .particles = 16};
  Detector expected(options), closed(options);
  add_all(expected, whole), add_all(closed, apart);
  std::size_t contacts = 0;
  for (int frame = 0; frame < 12; ++frame) {
    const Frame& found = closed.detect();
    // The scattered particles of the predecessor start elsewhere.
    if (GetParam() == Mode::particles) {
      EXPECT_EQ(found.face_pairs, expected.detect().face_pairs) << frame;
    }
    expect_true(found, apart);
    contacts += found.face_pairs.size();
    shift(whole[1], -0.04), shift(apart[1], -0.04);
    expected.update(), closed.update();
  }
  EXPECT_GT(contacts, 0U);
  EXPECT_EQ(closed.object(0).joined_vertices(), num_vertices(apart[0]) - num_vertices(whole[0]));
  EXPECT_EQ(expected.object(0).joined_vertices(), 0U);
}

TEST_P(Seams_in_mode, particles_cross_a_seam_unless_it_is_left_open) {
  for (const bool close : {true, false}) {
    Owned_meshes scene = two_spheres(2.2);
    for (auto& mesh : scene) mesh = flat_shaded(mesh);
    const std::size_t meetings = GetParam() == Mode::particles ? 0 : Detector_options().meetings;
    Detector detector({.mode = GetParam(), .particles = 4, .meetings = meetings, .close_seams = close});
    add_all(detector, scene);
    const auto start = [&] {
      detector.detect();
      return detector.object(0).particles().at;
    }();
    for (int frame = 0; frame < 10; ++frame) {
      shift(scene[1], 0, 0.1);
      detector.update();
      detector.detect();
    }
    std::size_t far = 0;
    for (std::size_t p = 0; p < start.size(); ++p)
      far += detector.object(0).particles().at[p] / 3 != start[p] / 3 ? 1 : 0;  // another triangle
    EXPECT_EQ(far > 0, close);
  }
}

TEST_P(Seams_in_mode, a_seam_that_opens_gives_no_false_contact) {
  Owned_meshes scene = two_spheres(1.8);
  for (auto& mesh : scene) mesh = flat_shaded(mesh);
  Detector detector({.mode = GetParam(), .particles = 32, .contacts = Contact_query::all});
  add_all(detector, scene);
  for (int frame = 0; frame < 5; ++frame) {
    expect_true(detector.detect(), scene);
    for (const auto f : faces(scene[0])) {  // every triangle drifts outwards by itself
      const auto h = halfedge(f, scene[0]);
      const Eigen::Vector3d drift = 0.1 * coordinates(scene[0].point(target(h, scene[0]))).normalized();
      for (const auto v : vertices_around_face(h, scene[0])) {
        const Eigen::Vector3d p = coordinates(scene[0].point(v)) + drift;
        scene[0].point(v) = {p.x(), p.y(), p.z()};
      }
    }
    detector.update();
  }
}

INSTANTIATE_TEST_SUITE_P(modes, Seams_in_mode, testing::Values(Mode::particles, Mode::senin),
                         [](const auto& mode) { return std::string(name_of(mode.param)); });

TEST(Seams_of_an_object, stay_open_for_a_strategy_that_needs_the_mesh) {
  Owned_meshes scene = two_spheres(1.8);
  for (auto& mesh : scene) mesh = flat_shaded(mesh);
  Detector<By_vertex_number> detector({.mode = Mode::particles, .particles = 8});
  add_all(detector, scene);
  expect_true(detector.detect(), scene);
  EXPECT_EQ(detector.object(0).joined_vertices(), 0U);
}

TEST(Seams_of_an_object, have_the_factors_of_the_vertices_that_stand_for_others) {
  Surface_mesh apart = flat_shaded(sphere(6)), whole = sharing(apart);
  const auto detector_with_heights = [](Surface_mesh& mesh) {
    const auto heights = mesh.add_property_map<Surface_mesh::Vertex_index, double>("v:height", 0).first;
    for (const auto v : mesh.vertices()) heights[v] = mesh.point(v).z();
    Detector<Lbg> detector({.mode = Mode::particles, .particles = 8}, Lbg{.extra_factors = factors(mesh, heights, 5)});
    detector.add(mesh);
    detector.detect();
    return detector;
  };
  const auto closed = detector_with_heights(apart), expected = detector_with_heights(whole);
  EXPECT_GT(closed.object(0).joined_vertices(), 0U);
  std::map<Point, Region_index> regions;
  for (const auto v : whole.vertices()) regions[whole.point(v)] = expected.regions(0)[v];
  for (const auto v : apart.vertices()) EXPECT_EQ(closed.regions(0)[v], regions.at(apart.point(v)));
  Surface_mesh smaller = sphere(3);
  Detector<Lbg> of_another({.mode = Mode::particles}, Lbg{.extra_factors = Feature_vectors::Zero(7, 1)});
  of_another.add(smaller);
  EXPECT_THROW(of_another.detect(), Bad_argument);
}

TEST(Seams_of_an_object, scattered_particles_test_the_faces_on_all_sides_of_a_seam) {
  Owned_meshes scene{flat_shaded(sphere(4)), flat_shaded(sphere(4, 1, {1.5, 0.1, 0}))};
  // A particle at every vertex, and every pair of them a candidate: nothing is missed.
  Detector detector({.mode = Mode::senin,
                     .particles = num_vertices(scene[0]),
                     .collision_distance = 1000,
                     .contacts = Contact_query::all,
                     .senin = {.rings = 1}});
  add_all(detector, scene);
  EXPECT_EQ(detector.detect().face_pairs, exhaustive_face_pairs(scene[0], scene[1]));
}

TEST(Seams_of_an_object, every_vertex_has_the_region_of_those_that_it_is_joined_to) {
  auto mesh = flat_shaded(sphere(6)), other = sphere(6, 1, {5, 0, 0});
  Detector detector({.mode = Mode::particles, .particles = 8});
  detector.add(mesh), detector.add(other);
  detector.detect();
  std::map<Point, Region_index> region_at;
  for (const auto v : vertices(mesh)) {
    const auto region = get(detector.maps(0).region(), v);
    EXPECT_EQ(region_at.try_emplace(mesh.point(v), region).first->second, region);
  }
}

TEST(Seams_of_an_object, are_closed_as_in_a_fresh_detector_after_a_frame_that_failed) {
  const Detector_options options{.mode = Mode::particles, .particles = 16};
  Owned_meshes scene = two_spheres(1.8);
  for (auto& mesh : scene) mesh = flat_shaded(mesh);
  Detector detector(options), fresh(options);
  add_all(detector, scene), add_all(fresh, scene);
  auto& last = scene[1].point(Surface_mesh::Vertex_index(7));
  const Point before = std::exchange(last, Point(std::numeric_limits<double>::quiet_NaN(), 0, 0));
  EXPECT_THROW(detector.detect(), Bad_mesh);
  last = before;
  expect_equal(detector.detect(), fresh.detect());
  for (const Object_id object : {0U, 1U})
    EXPECT_EQ(detector.object(object).joined_vertices(), fresh.object(object).joined_vertices());
}

TEST(Seams_of_an_object, are_refused_to_stay_open_in_mode_exact) {
  EXPECT_THROW(Detector({.close_seams = false}), Bad_argument);
}

}  // namespace
}  // namespace lodestone
