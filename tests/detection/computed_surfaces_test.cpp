// SPDX-License-Identifier: GPL-3.0-or-later
// Objects whose positions are computed when they are read: as if all had been written to the mesh.
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <gtest/gtest.h>

#include <set>

#include "lodestone/io/motion/deformed_points.h"
#include "lodestone/mesh/computed_points.h"
#include "lodestone/mesh/skinned_points.h"
#include "support/exact_truth.h"

namespace lodestone {
namespace {

std::vector<double> coordinates_of(const Surface_mesh& mesh) {
  std::vector<double> coordinates;
  for (const auto v : mesh.vertices())
    for (int axis = 0; axis < 3; ++axis) coordinates.push_back(mesh.point(v)[axis]);
  return coordinates;
}

/// A capsule that bends at its middle: two joints, whose influence blends along x. One morph target makes it thicker.
Skinned_points arm(const Surface_mesh& mesh) {
  const auto rest = coordinates_of(mesh);
  std::vector<std::uint32_t> joints;
  std::vector<double> weights;
  Morph_target thicker;
  for (std::size_t v = 0; v < rest.size() / 3; ++v) {
    const double second = std::clamp(rest[3 * v] + 0.5, 0.0, 1.0);
    joints.insert(joints.end(), {0, 1});
    weights.insert(weights.end(), {1 - second, second});
    thicker.offsets.insert(thicker.offsets.end(), {0, rest[3 * v + 1], rest[3 * v + 2]});
  }
  return {Morphed_points(rest, std::vector{thicker}), Joint_influences::of(2, joints, weights), 2};
}

void pose_arm(Skinned_points& arm, int frame) {
  const Eigen::Affine3d bent(Eigen::AngleAxisd(0.15 * frame, Eigen::Vector3d(0, 0.6, 0.8)));
  arm.set_joints(std::vector<Eigen::Affine3d>{Eigen::Affine3d::Identity(), bent});
  arm.set_weights(std::vector<double>{0.05 * frame});
}

template <Computed_points Points>
void write_to(Surface_mesh& mesh, const Points& points) {
  for (const auto v : mesh.vertices()) {
    const Eigen::Vector3d at = points(v);
    mesh.point(v) = Point(at.x(), at.y(), at.z());
  }
}

class Computed_surfaces : public testing::TestWithParam<Mode> {};

TEST_P(Computed_surfaces, have_the_frames_of_surfaces_that_are_written_to_the_mesh) {
  const auto a = sphere(10), b = sphere(9);
  auto points_a = arm(a);
  std::vector<Point> rest_b;
  for (const auto v : b.vertices()) rest_b.push_back(b.point(v) + Kernel::Vector_3(1.7, 0, 0));
  Deformed_points points_b(rest_b, {Wobble{.amplitude = 0.1}, Spin{.degrees_per_frame = 7}});
  CGAL::Polyhedron_3<Kernel> polyhedron_b;
  CGAL::copy_face_graph(b, polyhedron_b);

  const Detector_options options{.mode = GetParam(), .exact = {.self_collision = GetParam() == Mode::exact}};
  Detector computed(options), with_polyhedron(options), plain(options);
  computed.add(a, point_map(a, points_a));
  computed.add(b, point_map(b, points_b));
  with_polyhedron.add(a, point_map(a, points_a));
  with_polyhedron.add(polyhedron_b, point_map(polyhedron_b, points_b));
  auto written_a = a, written_b = b;
  plain.add(std::as_const(written_a));
  plain.add(std::as_const(written_b));
  int collisions = 0;
  for (int frame = 0; frame < 8; ++frame) {
    pose_arm(points_a, frame);
    points_b.set_frame(frame);
    write_to(written_a, points_a);
    write_to(written_b, points_b);
    const Frame& expected = plain.detect();
    collisions += expected.pairs.empty() ? 0 : 1;
    expect_same_frame(computed.detect(), expected);
    const Frame& other = with_polyhedron.detect();
    EXPECT_EQ(other.face_pairs.empty(), expected.face_pairs.empty());
    if (GetParam() == Mode::exact) expect_exhaustive(expected, {&written_a, &written_b});
  }
  EXPECT_GT(collisions, 3);
}

TEST_P(Computed_surfaces, have_the_regions_of_the_same_mesh) {
  Surface_mesh mesh = sphere(12), same = mesh;
  const auto points = CGAL::get_const_property_map(CGAL::vertex_point, std::as_const(mesh));
  Detector detector({.mode = GetParam(), .particles = 5});
  detector.add(std::as_const(mesh), points);
  detector.add(same);
  EXPECT_THROW(detector.regions(0), Bad_argument);
  EXPECT_THROW(detector.regions(2), Bad_argument);
  detector.detect();
  const auto regions = detector.regions(0);
  EXPECT_EQ(regions, detector.regions(1));
  EXPECT_EQ(std::set(regions.begin(), regions.end()), (std::set<Region_index>{0, 1, 2, 3, 4}));
  for (const auto v : same.vertices()) EXPECT_EQ(get(detector.maps(1).region(), v), regions[v]);
}

/// A type of mesh without indices of its own: the point map has made some, which end with the old vertices.
TEST(Computed_surface, of_a_mesh_without_indices_follows_vertices_that_are_added) {
  using Polyhedron = CGAL::Polyhedron_3<Kernel>;
  for (const Mode mode : {Mode::exact, Mode::certified, Mode::particles}) {
    Polyhedron mesh;
    CGAL::copy_face_graph(icosphere(3), mesh);
    const auto still = [&] {
      std::vector<double> rest;
      for (const auto v : vertices(mesh))
        for (int axis = 0; axis < 3; ++axis) rest.push_back(v->point()[axis]);
      const std::size_t count = rest.size() / 3;
      return Skinned_points(rest,
                            Joint_influences::of(1, std::vector<std::uint32_t>(count, 0), std::vector(count, 1.0)), 1);
    };
    Skinned_points points = still();
    Surface_mesh ball = icosphere(2);
    shift(ball, 3);
    Detector detector({.mode = mode});
    detector.add(std::as_const(mesh), point_map(mesh, points));
    detector.add(std::as_const(ball));
    EXPECT_FALSE(detector.detect().collides());
    const auto centre = CGAL::Euler::add_center_vertex(halfedge(*faces(mesh).first, mesh), mesh);
    target(centre, mesh)->point() = Point(2.5, 0, 0);
    points = still();
    detector.rebuild(0);
    EXPECT_TRUE(detector.detect().collides());
    if (mode != Mode::particles) {
      EXPECT_EQ(detector.closest_point(0, Point(2.5, 0, 0)).distance, 0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(modes, Computed_surfaces, testing::Values(Mode::exact, Mode::particles),
                         [](const auto& mode) { return mode.param == Mode::exact ? "exact" : "particles"; });

}  // namespace
}  // namespace lodestone
