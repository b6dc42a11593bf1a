// SPDX-License-Identifier: GPL-3.0-or-later
// Positions that a caller computes, and that fail or are not where they seem to be.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <ostream>
#include <span>
#include <stdexcept>
#include <string>

#include "lodestone/bounds/displacement_bound.h"
#include "lodestone/detector.h"
#include "lodestone/find_first_impact.h"
#include "lodestone/io/shapes/shapes.h"
#include "lodestone/mesh/computed_points.h"
#include "lodestone/queries/exhaustive.h"

namespace lodestone {
namespace {

using Vertex_index = Surface_mesh::Vertex_index;
constexpr std::size_t endless = std::numeric_limits<std::size_t>::max();
constexpr double step = 1.99;  ///< along x, at which two spheres of radius 1 meet in few faces

/// Computed points that fail once so many more have been computed.
struct Failing_points {
  const Surface_mesh* mesh;
  std::size_t* left;
  std::uint32_t count = std::numeric_limits<std::uint32_t>::max();
  bool writes_first = false;  ///< something else, before it computes what is right
  std::uint64_t number = 1;

  std::uint32_t vertex_count() const { return std::min(count, static_cast<std::uint32_t>(mesh->number_of_vertices())); }
  std::uint64_t pose_number() const { return number; }
  Eigen::Vector3d operator()(std::uint32_t vertex) const {
    if (vertex >= vertex_count()) ADD_FAILURE() << "vertex " << vertex << " of " << vertex_count();
    if (*left == 0) throw std::runtime_error("no more positions");
    if (*left != endless) --*left;
    return coordinates(mesh->point(Vertex_index(vertex)));
  }
  void pose(std::span<const std::uint32_t> vertices, std::span<double> to) const {
    const auto at = [&](std::uint32_t v) { return Eigen::Map<Eigen::Vector3d>(to.data() + 3 * std::size_t{v}); };
    if (writes_first)
      for (const auto v : vertices) at(v).setZero();
    for (const auto v : vertices) at(v) = (*this)(v);
  }
  void pose_all(std::span<double> to) const {
    for (std::uint32_t v = 0; v < vertex_count(); ++v)
      Eigen::Map<Eigen::Vector3d>(to.data() + 3 * std::size_t{v}) = (*this)(v);
  }
};

Surface_mesh shifted(Surface_mesh mesh, double x, double y) {
  for (const auto v : mesh.vertices())
    mesh.point(v) = Point(mesh.point(v).x() + x, mesh.point(v).y() + y, mesh.point(v).z());
  return mesh;
}

/// Whether a frame fails where so many positions can be computed, and no more.
bool fails(Detector<>& detector, std::size_t& left, std::size_t reads) {
  left = reads;
  bool failed = false;
  try {
    detector.detect();
  } catch (const std::runtime_error&) {
    failed = true;
  }
  left = endless;
  return failed;
}

struct Failing_case {
  const char* name;
  bool placed, held, writes_first;
};
void PrintTo(const Failing_case& failing, std::ostream* out) { *out << failing.name; }

class Certified_after_a_failure : public testing::TestWithParam<Failing_case> {};

TEST_P(Certified_after_a_failure, finds_what_there_is) {
  const auto& [name, placed, held, writes_first] = GetParam();
  const Surface_mesh still = icosphere(16), meeting = shifted(still, step, 0.01);
  const Surface_mesh& moving = placed ? still : meeting;
  const auto truth = exhaustive_face_pairs(still, meeting);
  ASSERT_FALSE(truth.empty());
  std::size_t failures = 0;
  for (std::size_t reads = 0; reads < 600; reads += 3) {
    SCOPED_TRACE(reads);
    std::size_t left = endless;
    Failing_points points{.mesh = &moving, .left = &left, .writes_first = writes_first};
    Displacement_promise of_still, of_moving;
    Detector detector({.mode = Mode::certified});
    detector.add(still);
    detector.add(moving, point_map(moving, points));
    detector.promise(0, of_still);
    detector.promise(1, of_moving);
    if (placed) detector.place(1, Eigen::Isometry3d(Eigen::Translation3d(step, 0.01, 0)));
    detector.detect();
    ++points.number;
    std::optional<Held_positions> hold;
    if (held) hold.emplace(detector.hold_positions());
    failures += fails(detector, left, reads) ? 1 : 0;
    EXPECT_EQ(detector.detect().face_pairs, truth);
  }
  EXPECT_GT(failures, 20U);
}

INSTANTIATE_TEST_SUITE_P(All, Certified_after_a_failure,
                         testing::Values(Failing_case{"placed", true, false, false},
                                         Failing_case{"placed_and_held", true, true, false},
                                         Failing_case{"overwritten_first", false, false, true},
                                         Failing_case{"overwritten_first_and_held", false, true, true}),
                         [](const auto& instance) { return instance.param.name; });

TEST(Computed_points, that_fail_leave_the_next_frame_right_in_the_modes_that_read_without_bounds) {
  const Surface_mesh still = icosphere(16), moving = shifted(still, step, 0.01);
  const auto truth = exhaustive_face_pairs(still, moving);
  for (const auto mode : {Mode::exact, Mode::particles}) {
    std::size_t left = endless, failures = 0;
    Failing_points points{.mesh = &moving, .left = &left};
    Detector detector({.mode = mode});
    detector.add(still);
    detector.add(moving, point_map(moving, points));
    detector.detect();
    for (std::size_t reads = 0; reads < 2000; reads += 50) {
      ++points.number;
      failures += fails(detector, left, reads) ? 1 : 0;
      EXPECT_EQ(detector.detect().face_pairs, truth) << name_of(mode) << ' ' << reads;
    }
    EXPECT_GT(failures, 0U) << name_of(mode);
  }
}

TEST(Computed_points, that_fail_leave_it_to_the_next_frame_to_tell_what_was_built) {
  const Surface_mesh still = icosphere(16), moving = shifted(still, step, 0.01);
  for (const auto mode : {Mode::exact, Mode::certified, Mode::particles, Mode::senin}) {
    SCOPED_TRACE(name_of(mode));
    std::size_t failures = 0, failures_in_a_frame = 0;
    for (std::size_t reads = 0;; reads += 40) {
      std::size_t left = endless;
      Failing_points points{.mesh = &moving, .left = &left};
      Detector detector({.mode = mode});
      detector.add(still);
      detector.add(moving, point_map(moving, points));
      if (!fails(detector, left, reads)) break;
      ++failures;
      const Frame& frame = detector.detect();
      EXPECT_EQ(frame.statistics.builds, 2U) << reads;
      EXPECT_GT(frame.statistics.seconds.build, 0) << reads;
      failures_in_a_frame += frame.number > 1 ? 1 : 0;  // others failed while objects were built
      EXPECT_EQ(detector.detect().statistics.builds, 0U) << reads;
    }
    EXPECT_GT(failures, 0U);
    if (mode == Mode::particles || mode == Mode::senin) {
      EXPECT_GT(failures_in_a_frame, 0U);
    }
  }
}

TEST(Computed_points, that_have_become_fewer_than_the_vertices_are_an_error_in_every_mode) {
  const Surface_mesh still = icosphere(6);
  for (const auto mode : {Mode::exact, Mode::certified, Mode::particles, Mode::senin}) {
    SCOPED_TRACE(name_of(mode));
    std::size_t left = endless;
    Failing_points points{.mesh = &still, .left = &left};
    Detector detector({.mode = mode});
    detector.add(still);
    detector.add(still, point_map(still, points), {.name = "cloth"});
    detector.detect();
    ++points.number;
    points.count = 100;
    try {
      detector.detect();
      ADD_FAILURE() << "no error";
    } catch (const Bad_argument& error) {
      const std::string what = error.what();
      EXPECT_NE(what.find("cloth"), std::string::npos) << what;
      EXPECT_NE(what.find("fewer computed points than vertices"), std::string::npos) << what;
    }
    points.count = std::numeric_limits<std::uint32_t>::max();
    EXPECT_NO_THROW(detector.detect());
  }
}

/// CGAL's map of a mesh, moved: what it shows of its memory is not where the vertices are.
struct Moved_points : Surface_mesh::Property_map<Vertex_index, Point> {
  double x = 0;

  Moved_points(const Surface_mesh& mesh, double by) : Property_map(mesh.points()), x(by) {}
  friend Point get(const Moved_points& points, Vertex_index v) {
    const Point& p = points[v];
    return {p.x() + points.x, p.y(), p.z()};
  }
};

TEST(Point_maps, that_are_derived_from_those_of_a_mesh_are_asked_where_vertices_are) {
  const Surface_mesh a = icosphere(4), b = icosphere(4);
  for (const double x : {0.0, step, 50.0}) {
    const Moved_points points(b, x);
    const auto truth =
        exhaustive_face_pairs(a, b, CGAL::parameters::default_values(), CGAL::parameters::vertex_point_map(points));
    EXPECT_EQ(truth.empty(), x == 50) << x;
    for (const auto mode : {Mode::exact, Mode::certified, Mode::particles}) {
      Detector detector({.mode = mode});
      detector.add(a);
      detector.add(b, points);
      EXPECT_EQ(detector.detect().face_pairs, truth) << name_of(mode) << ' ' << x;
    }
  }
  const Surface_mesh far = shifted(b, 5, 0);
  const auto impact = find_first_impact(a, a.points(), far, Moved_points(far, -5));
  ASSERT_TRUE(impact);
  EXPECT_NEAR(impact->time, 0.6, 0.05);
}

/// Promises nothing, of too few nodes.
struct Bound_of_few_nodes {
  std::size_t nodes;
  std::size_t node_count() const { return nodes; }
  Aabb box(std::uint32_t) const { return {.low = {-9, -9, -9}, .high = {9, 9, 9}}; }
};
struct Promise_of_few_nodes {
  Bound_of_few_nodes bound(const Bounded_object& object) const { return {object.layout.node_count() - 1}; }
};

TEST(Promises, whose_bound_has_too_few_nodes_are_dropped) {
  const Surface_mesh a = icosphere(12), b = shifted(a, step, 0.01);
  const Promise_of_few_nodes promise;
  Detector detector({.mode = Mode::certified});
  detector.add(a);
  detector.add(b, {.name = "cloth"});
  detector.promise(1, promise);
  try {
    detector.detect();
    ADD_FAILURE() << "no error";
  } catch (const Bad_argument& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("(cloth) is dropped"), std::string::npos) << what;
    EXPECT_NE(what.find("fewer nodes"), std::string::npos) << what;
  }
  EXPECT_EQ(detector.detect().face_pairs, exhaustive_face_pairs(a, b));
}

}  // namespace
}  // namespace lodestone
