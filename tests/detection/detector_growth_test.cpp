// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

#include "detection/detector_scenes.h"

namespace lodestone {
namespace {

constexpr std::size_t endless = std::numeric_limits<std::size_t>::max();

/// Where the vertices of a mesh are, until they have been read so many times.
struct Failing_points {
  using key_type = Surface_mesh::Vertex_index;
  using value_type = Point;
  using reference = Point;
  using category = boost::readable_property_map_tag;

  const Surface_mesh* mesh;
  std::size_t* reads_left;

  friend Point get(const Failing_points& points, key_type vertex) {
    if (*points.reads_left == 0) throw std::runtime_error("no more reads");
    --*points.reads_left;
    return points.mesh->point(vertex);
  }
};

/// A ball out of which a spike has grown, in a detector that does not know yet.
struct Grown_spike {
  Surface_mesh ball = sphere(12);
  std::size_t reads_left = endless;
  Detector<> detector{{.mode = Mode::particles, .particles = 16, .growth = 1.05}};

  Grown_spike() {
    detector.add(std::as_const(ball), Failing_points{&ball, &reads_left});
    detector.detect();
    deform(ball, [](const Point& p) { return p.z() > 0.99 ? Point(p.x(), p.y(), 3) : p; });
  }
  /// @return whether it could be done
  bool update(std::size_t reads) {
    reads_left = reads;
    try {
      detector.update(0);
    } catch (const std::runtime_error&) {
      reads_left = endless;
      return false;
    }
    reads_left = endless;
    return true;
  }
};

TEST(Detector, an_object_that_moves_without_growing_is_not_repartitioned) {
  Owned_meshes scene{potato(10), potato(10, 2)};
  shift(scene[1], 3);
  Detector<> detector({.mode = Mode::particles, .particles = 24});
  add_all(detector, scene);
  std::size_t repartitions = 0;
  for (int frame = 0; frame < 40; ++frame) {
    repartitions += detector.detect().statistics.repartitions;
    const double c = std::cos(0.1), s = std::sin(0.1);
    deform(scene[0], [&](const Point& p) { return Point(c * p.x() - s * p.y() + 0.1, s * p.x() + c * p.y(), p.z()); });
    shift(scene[1], 0.1, 0.013, -0.07);
    detector.update();
  }
  EXPECT_EQ(repartitions, 0U);
}

TEST(Detector, an_object_that_shrinks_is_not_repartitioned) {
  auto scene = two_spheres(2.5);
  Detector<> detector({.mode = Mode::particles, .particles = 24});
  add_all(detector, scene);
  for (int frame = 0; frame < 10; ++frame) {
    EXPECT_EQ(detector.detect().statistics.repartitions, 0U);
    scale(scene[0], 0.9);
    detector.update();
  }
}

TEST(Detector, an_inflating_object_is_repartitioned_with_its_particles_counted_afresh) {
  auto scene = two_spheres(9);
  Detector<> detector({.mode = Mode::particles, .least_particles = 1, .contacts = Contact_query::all});
  add_all(detector, scene);
  detector.detect();
  EXPECT_EQ(detector.object(0).particles().at.size(), 2U);  // two objects of one size
  scale(scene[0], 3);
  detector.update();
  EXPECT_EQ(detector.detect().statistics.repartitions, 1U);
  EXPECT_EQ(detector.object(0).particles().at.size(), 62U);  // floor(2 / (1 - cos(asin(1 / 4))))
  EXPECT_EQ(detector.object(1).particles().at.size(), 2U);
  EXPECT_EQ(detector.detect().statistics.repartitions, 0U);
}

TEST(Detector, an_object_that_inflates_slowly_stays_detectable) {
  auto scene = two_spheres(3);
  Detector<> detector({.mode = Mode::particles, .particles = 32, .contacts = Contact_query::all});
  add_all(detector, scene);
  std::size_t repartitions = 0, positive = 0, found = 0;
  for (int frame = 0; frame < 60; ++frame) {
    const Frame& result = detector.detect();
    repartitions += result.statistics.repartitions;
    found += expect_true(result, scene);
    positive += exhaustive_face_pairs(scene[0], scene[1]).empty() ? 0 : 1;
    scale(scene[0], std::pow(3.0, 1 / 60.0));
    detector.update();
  }
  EXPECT_GT(repartitions, 5U);
  EXPECT_GT(positive, 5U);
  EXPECT_GT(10 * found, 8 * positive);
}

TEST(Detector, an_object_that_starts_without_extent_is_repartitioned_when_it_unfolds) {
  auto scene = two_spheres(5);
  deform(scene[0], [](const Point&) { return Point(0, 0, 0); });
  Detector<> detector({.mode = Mode::particles, .particles = 12});
  add_all(detector, scene);
  EXPECT_NO_THROW(detector.detect());
  const auto round = sphere(12);
  for (const auto v : round.vertices()) scene[0].point(v) = round.point(v);
  detector.update();
  EXPECT_EQ(detector.detect().statistics.repartitions, 1U);
}

TEST(Detector, particles_are_counted_beside_objects_without_extent) {
  Owned_meshes scene{sphere(8), single_triangle(), sphere(8, 2, {5, 0, 0})};
  deform(scene[1], [](const Point&) { return Point(0, 0, 1); });
  Detector<> detector({.mode = Mode::particles, .contacts = Contact_query::all});
  add_all(detector, scene);
  expect_true(detector.detect(), scene);
  for (const Object_id object : {0U, 1U, 2U}) EXPECT_GE(detector.object(object).particles().at.size(), 1U);
}

TEST(Detector, an_update_that_fails_finds_again_what_has_grown) {
  std::size_t calls = 1;  // until the region with the spike has its turn
  for (Grown_spike spike; spike.update(endless) && spike.detector.detect().statistics.repartitions == 0; ++calls)
    ASSERT_LT(calls, 16U);
  ASSERT_GT(calls, 1U) << "or all would be found at once";
  std::size_t failures = 0;
  for (std::size_t reads = 0; reads < 2000; reads += 20) {
    SCOPED_TRACE(reads);
    Grown_spike spike;
    for (std::size_t call = 1; call < calls; ++call) {
      spike.update(endless);
      spike.detector.detect();
    }
    if (!spike.update(reads)) {
      ++failures;
      EXPECT_TRUE(spike.update(endless));
    }
    EXPECT_EQ(spike.detector.detect().statistics.repartitions, 1U);
  }
  EXPECT_GT(failures, 10U);
  EXPECT_LT(failures, 100U);
}

TEST(Detector, repartitions_never_if_told_so) {
  auto scene = two_spheres(9);
  Detector<> detector({.mode = Mode::particles, .particles = 12, .growth = std::numeric_limits<double>::infinity()});
  add_all(detector, scene);
  detector.detect();
  scale(scene[0], 3);
  detector.update();
  EXPECT_EQ(detector.detect().statistics.repartitions, 0U);
}

TEST(Detector, an_object_whose_regions_share_their_anchor_is_found_when_it_has_grown) {
  const auto shape = tetrahedron();
  for (const double factor : {1.1, 2.0})
    for (const auto tip : shape.vertices()) {
      Owned_meshes scene{shape, shape};
      shift(scene[1], 9);
      Detector<> detector({.mode = Mode::particles});
      add_all(detector, scene);
      EXPECT_FALSE(detector.detect().collides());
      scale(scene[0], factor);
      for (const auto v : shape.vertices())
        scene[1].point(v) =
            scene[0].point(tip) + 0.02 * (shape.point(v) - CGAL::midpoint(shape.point(tip), shape.point(v)));
      if (factor < 2) detector.update();
      EXPECT_FALSE(exhaustive_face_pairs(scene[0], scene[1]).empty());
      EXPECT_TRUE(detector.detect().collides()) << factor << " " << tip;
    }
}

/// Two halves along x, or an error.
struct Refusing {
  static constexpr std::string_view name = "refusing";
  const bool* refuses;
  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t) const {
    if (*refuses) throw Bad_argument("not now");
    Labelling result;
    for (const double x : input.positions.col(0)) result.labels.push_back(x < 0 ? 0 : 1);
    return result;
  }
};

TEST(Detector, an_object_that_a_strategy_does_not_divide_again_keeps_its_regions) {
  for (const std::size_t meetings : {0, 8}) {
    auto scene = two_spheres(9);
    bool refuses = false;
    Detector<Refusing> detector({.mode = Mode::particles, .particles = 2, .meetings = meetings}, {&refuses});
    add_all(detector, scene);
    detector.detect();
    const auto regions = detector.regions(0);
    const double distance = detector.object(0).particles().collision_distance;
    scale(scene[0], 2);
    refuses = true;
    EXPECT_THROW(detector.update(), Bad_argument);
    EXPECT_EQ(detector.regions(0), regions);
    EXPECT_EQ(detector.object(0).particles().collision_distance, distance);
    const Frame& frame = detector.detect();
    EXPECT_EQ(frame.statistics.builds + frame.statistics.repartitions, 0U);
    refuses = false;
    detector.update();
    EXPECT_EQ(detector.detect().statistics.repartitions, 1U);
    EXPECT_NE(detector.object(0).particles().collision_distance, distance);
  }
}

TEST(Detector, a_frame_that_fails_does_not_change_when_an_object_is_repartitioned) {
  std::size_t repartitions = 0;
  auto scene = two_spheres(9);
  const Detector_options options{.mode = Mode::particles, .particles = 16};
  Detector<> plain(options), disturbed(options);
  for (auto* detector : {&plain, &disturbed})
    for (const auto& mesh : scene) detector->add(mesh);
  plain.detect(), disturbed.detect();
  for (int step = 0; step < 12; ++step) {
    scale(scene[0], 1.03);
    const std::size_t expected = plain.detect().statistics.repartitions;
    EXPECT_EQ(disturbed.detect().statistics.repartitions, expected) << step;
    repartitions += expected;
    const auto good = scene[0];
    deform(scene[0], [](const Point& p) { return Point(p.x(), p.y(), std::nan("")); });
    EXPECT_THROW(disturbed.detect(), Bad_mesh);
    for (const auto v : good.vertices()) scene[0].point(v) = good.point(v);
    plain.update(), disturbed.update();
  }
  EXPECT_GT(repartitions, 0U);
}

TEST(Detector, particles_are_counted_beside_the_smallest_object_with_an_extent) {
  auto scene = two_spheres(20);
  scene.push_back(single_triangle());
  deform(scene[2], [](const Point&) { return Point(0, 0, 50); });
  scale(scene[0], 3);
  Detector<> detector({.mode = Mode::particles, .least_particles = 1});
  add_all(detector, scene);
  detector.detect();
  EXPECT_EQ(detector.object(0).particles().at.size(), shadow_particle_count(3, 1));
  scale(scene[0], 2);
  detector.rebuild(1);
  detector.update();
  detector.detect();
  EXPECT_EQ(detector.object(0).particles().at.size(), shadow_particle_count(6, 1));
}

}  // namespace
}  // namespace lodestone
