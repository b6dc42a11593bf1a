// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detector.h"

#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "detection/detector_scenes.h"
#include "lodestone/bounds/box_promise.h"
#include "lodestone/bounds/stretch_bound.h"
#include "lodestone/find_first_impact.h"
#include "lodestone/io/shapes/shapes.h"
#include "support/message_of.h"
#include "support/special_numbers.h"

namespace lodestone {
namespace {

TEST(Detector, options_out_of_range_are_refused) {
  for (const double bad : {0.0, -1.0, infinity, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(Detector<>({.mode = Mode::particles, .collision_distance = bad}), Bad_argument) << bad;
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(Detector<>({.mode = Mode::particles, .growth = bad}), Bad_argument) << bad;
}

TEST(Detector, options_of_the_rule_of_particles_and_of_the_scattering_are_refused_before_they_are_used) {
  for (const auto mode : {Mode::exact, Mode::certified, Mode::particles, Mode::senin}) {
    EXPECT_THROW(Detector<>({.mode = mode, .particles = 3, .particle_count = {.most_parts = 0}}), Bad_argument);
    EXPECT_THROW(Detector<>({.mode = mode, .senin = {.side = Eigen::Vector3d(0, 0, 0)}}), Bad_argument);
  }
}

TEST(Detector, a_question_that_another_mode_answers_is_named) {
  auto scene = two_spheres(2);
  Detector<> particles({.mode = Mode::particles}), exact;
  add_all(particles, scene), add_all(exact, scene);
  const Ray ray{{0, 0, 0}, {1, 0, 0}};
  const std::vector<Positions> ends(2);
  const std::vector<std::pair<std::string, std::function<void()>>> questions{
      {"closest", [&] { particles.closest(0, 1); }},
      {"detect of a pair", [&] { particles.detect(0, 1); }},
      {"hold_positions", [&] { std::ignore = particles.hold_positions(); }},
      {"first_impact", [&] { particles.first_impact(ends); }},
      {"first_hit", [&] { particles.first_hit(0, ray); }},
      {"first_hits", [&] { particles.first_hits(std::span(&ray, 1)); }},
      {"closest_points", [&] { particles.closest_points(0, {}); }}};
  for (const auto& [name, ask] : questions)
    EXPECT_EQ(message_of<Bad_argument>(ask), name + " needs the mode exact or certified");
  EXPECT_EQ(message_of<Bad_argument>([&] { exact.object(0); }), "object needs a mode with particles");
}

TEST(Detector, positions_at_the_end_of_a_motion_are_told_from_those_of_now) {
  auto scene = two_spheres(2);
  Detector<> detector;
  add_all(detector, scene);
  Positions end = Positions::Zero(static_cast<Eigen::Index>(scene[1].number_of_vertices()), 3);
  end(7, 2) = infinity;
  const std::string expected = "vertex 7 of object 1 at the end has a coordinate that is not finite";
  EXPECT_EQ(message_of<Bad_mesh>([&] { detector.first_impact(0, Positions::Zero(end.rows(), 3), 1, end); }), expected);
  EXPECT_EQ(message_of<Bad_mesh>([&] { detector.first_self_impact(1, end); }), expected);
  const std::vector<Positions> ends{{}, end};
  EXPECT_EQ(message_of<Bad_mesh>([&] { detector.first_impacts(ends); }), expected);
  EXPECT_EQ(
      message_of<Bad_mesh>([&] { detector.first_self_impact(0, end.topRows(3)); }),
      "object 0 has " + std::to_string(scene[0].number_of_vertices()) + " vertices, but got 3 positions at the end");
}

TEST(Detector, a_ray_or_point_that_is_refused_is_told_among_many) {
  for (const auto mode : {Mode::exact, Mode::certified}) {
    auto scene = two_spheres(2);
    Detector<> detector({.mode = mode, .threads = 2});
    add_all(detector, scene);
    const Stretch_promise rigid(1.0);
    if (mode == Mode::certified) detector.promise(0, rigid);
    std::vector<Ray> rays(300, Ray{{0, 0, 0}, {1, 0, 0}});
    rays[270].origin[1] = infinity, rays[280].direction = {0, 0, 0};
    std::vector<Point> points(300, Point(0, 0, 3));
    points[271] = Point(infinity, 0, 0);
    for (const Object_id object : {0, 1}) {
      EXPECT_TRUE(
          message_of<Bad_argument>([&] { detector.first_hits(object, rays); }).starts_with("ray 270: the origin"));
      EXPECT_TRUE(message_of<Bad_argument>([&] {
                    detector.closest_points(object, points);
                  }).starts_with("point 271: the point"));
      EXPECT_TRUE(
          message_of<Bad_argument>([&] { detector.point_sides(object, points); }).starts_with("point 271: the point"));
    }
    EXPECT_TRUE(message_of<Bad_argument>([&] { detector.first_hits(rays); }).starts_with("ray 270: the origin"));
    EXPECT_TRUE(message_of<Bad_argument>([&] {
                  first_hits(detector.ray_tree(1), rays, Workers::alone());
                }).starts_with("ray 270: "));
    EXPECT_TRUE(message_of<Bad_argument>([&] { detector.first_hit(rays[280]); }).starts_with("the direction of a ray"));
  }
}

TEST(Detector, a_mesh_added_twice_is_refused) {
  auto mesh = sphere(3);
  Detector<> detector({.mode = Mode::particles});
  detector.add(mesh);
  EXPECT_THROW(detector.add(mesh), Bad_argument);
  EXPECT_THROW(detector.add(std::as_const(mesh)), Bad_argument);
  EXPECT_EQ(detector.size(), 1U);
}

TEST(Detector, an_unknown_object_is_refused) {
  Detector<> detector({.mode = Mode::particles});
  EXPECT_THROW(detector.update(0), Bad_argument);
  auto mesh = sphere(3);
  detector.add(mesh);
  EXPECT_NO_THROW(detector.update(0));
  EXPECT_THROW(detector.update(1), Bad_argument);
}

TEST(Detector, a_mesh_without_faces_or_with_a_quadrilateral_is_refused) {
  Detector<> detector({.mode = Mode::particles});
  Surface_mesh empty, quadrilateral;
  EXPECT_THROW(detector.add(empty), Bad_mesh);
  std::vector<Surface_mesh::Vertex_index> corners;
  for (const auto& p : {Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(0, 1, 0)})
    corners.push_back(quadrilateral.add_vertex(p));
  quadrilateral.add_face(corners);
  EXPECT_THROW(detector.add(quadrilateral), Bad_mesh);
  EXPECT_EQ(detector.size(), 0U);
}

TEST(Detector, a_coordinate_that_is_not_finite_is_refused_by_the_first_frame) {
  for (const auto mode : modes) {
    auto scene = two_spheres(2);
    scene[1].point(Surface_mesh::Vertex_index(7)) = Point(0, std::numeric_limits<double>::quiet_NaN(), 0);
    Detector<> detector({.mode = mode, .particles = 8});
    add_all(detector, scene);
    EXPECT_THROW(detector.detect(), Bad_mesh);
  }
}

TEST(Detector, a_coordinate_that_is_not_finite_is_refused_in_any_frame_that_reads_it) {
  for (const auto mode : modes)
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity}) {
      auto scene = two_spheres(1.8);
      Detector<> detector({.mode = mode, .particles = 8, .contacts = Contact_query::all});
      add_all(detector, scene);
      detector.detect();
      deform(scene[1], [&](const Point& p) { return Point(p.x(), bad, p.z()); });
      EXPECT_THROW(
          {
            detector.update();
            detector.detect();
          },
          Bad_mesh);
    }
}

TEST(Detector, a_corner_of_a_candidate_region_that_is_not_finite_is_refused) {
  auto scene = two_spheres(1.8);
  Detector<> detector({.mode = Mode::particles,
                       .particles = 1,
                       .meetings = 0,
                       .collision_distance = 50,
                       .contacts = Contact_query::all});
  add_all(detector, scene);
  detector.detect();
  // Far from the particle, but in its region.
  std::uint32_t lost = 0;
  const auto& at = detector.object(1).particles();
  for (const auto v : scene[1].vertices()) {
    const auto& p = scene[1].point(v);
    if ((Eigen::Vector3d(p.x(), p.y(), p.z()) - at.positions[0]).norm() > 1.5) lost = v;
  }
  scene[1].point(Surface_mesh::Vertex_index(lost)) = Point(0, std::numeric_limits<double>::quiet_NaN(), 0);
  EXPECT_THROW(detector.detect(), Bad_mesh);
}

TEST(Detector, a_bad_mesh_in_a_frame_is_named_by_id_and_name) {
  for (const auto mode : {Mode::particles, Mode::senin, Mode::exact})
    for (const std::string name : {"", "cloth"}) {
      const std::string title = name.empty() ? "object 1" : "object 1 (cloth)";
      auto scene = two_spheres(1.8);
      Detector<> detector({.mode = mode, .particles = 8});
      detector.add(scene[0]);
      detector.add(scene[1], {.name = name});
      detector.detect();
      const auto next_frame = [&] {
        detector.update();
        detector.detect();
      };
      const Surface_mesh original = scene[1];
      deform(scene[1], [](const Point& p) { return Point(p.x(), infinity, p.z()); });
      EXPECT_TRUE(message_of<Bad_mesh>(next_frame).find(title) != std::string::npos)
          << message_of<Bad_mesh>(next_frame);
      for (const auto v : scene[1].vertices()) scene[1].point(v) = original.point(v);
      scene[1].add_vertex(Point(0, 0, 0));
      const std::string message = message_of<Bad_mesh>(next_frame);
      EXPECT_TRUE(message.find(title) != std::string::npos && message.find("rebuild()") != std::string::npos)
          << message;
    }
}

template <class Mesh>
concept Addable = requires(Detector<>& detector, Mesh&& mesh) {
  detector.add(std::forward<Mesh>(mesh));
};

TEST(Detector, a_mesh_that_ends_with_the_call_cannot_be_added) {
  static_assert(Addable<Surface_mesh&> && Addable<const Surface_mesh&>);
  static_assert(!Addable<Surface_mesh> && !Addable<const Surface_mesh>);
}

/// The points of a mesh, whose first one calls the detector while it is told to.
struct Calling_points {
  using key_type = Surface_mesh::Vertex_index;
  using value_type = Point;
  using reference = Point;
  using category = boost::readable_property_map_tag;

  const Surface_mesh* mesh;
  const std::function<void()>* call;

  friend Point get(const Calling_points& points, key_type vertex) {
    if (vertex.idx() == 0) (*points.call)();
    return points.mesh->point(vertex);
  }
};

TEST(Detector, is_not_called_by_functions_that_it_calls) {
  for (const Mode mode : {Mode::exact, Mode::certified, Mode::particles}) {
    Detector<> detector({.mode = mode, .contacts = Contact_query::all});
    const Surface_mesh a = icosphere(4);
    Surface_mesh b = icosphere(3);
    shift(b, 1.5);
    std::function<void()> call = [] {};
    detector.add(a);
    detector.add(b, Calling_points{&b, &call});
    const std::vector<Face_pair> before = detector.detect().face_pairs;
    EXPECT_FALSE(before.empty());
    const std::vector<std::function<void()>> calls{
        [&] { detector.detect(); },  [&] { detector.update(0); }, [&] { detector.add(a); },
        [&] { detector.remove(0); }, [&] { detector.save(0); },   [&] { detector.rebuild(0); },
        [&] { detector.place(0, Eigen::Isometry3d::Identity()); }};
    for (const auto& inner : calls) {
      call = inner;
      // Particles read single vertices, in which the calling one need not be; an object that is built is read whole.
      detector.rebuild(1);
      EXPECT_THROW(detector.detect(), Bad_argument) << name_of(mode);
      call = [] {};
      EXPECT_EQ(detector.detect().face_pairs, before) << name_of(mode);
    }
  }
}

TEST(Detector, is_not_called_by_a_promise) {
  Detector<> detector({.mode = Mode::certified, .contacts = Contact_query::all});
  const Surface_mesh a = icosphere(6);
  Surface_mesh b = icosphere(5);
  shift(b, 1.5);
  bool calls = false;
  const Box_promise promise([&](Region_index, const Aabb& rest) {
    if (calls) detector.detect();
    return rest;
  });
  detector.add(a), detector.add(b);
  detector.promise(1, promise);
  const std::vector<Face_pair> before = detector.detect().face_pairs;
  EXPECT_FALSE(before.empty());
  calls = true;
  EXPECT_THROW(detector.detect(), Bad_argument);
  calls = false;
  EXPECT_EQ(detector.detect().face_pairs, before);
}

TEST(Detector, points_of_a_surface_mesh_with_fewer_vertices_are_refused) {
  const Surface_mesh a = icosphere(4), b = icosphere(3), small = icosphere(2);
  for (const Mode mode : {Mode::exact, Mode::certified, Mode::particles, Mode::senin}) {
    Detector<> detector({.mode = mode});
    detector.add(a, small.points());
    detector.add(b);
    EXPECT_NE(message_of<Bad_mesh>([&] { detector.detect(); }).find("fewer points"), std::string::npos)
        << name_of(mode);
  }
  EXPECT_THROW(find_first_impact(a, small.points(), b, b.points()), Bad_mesh);
  EXPECT_THROW(find_first_impact(a, a.points(), b, small.points()), Bad_mesh);
  EXPECT_NO_THROW(find_first_impact(a, a.points(), b, b.points()));
}

template <class Number>
using Point_of = CGAL::Point_3<CGAL::Simple_cartesian<Number>>;

TEST(Detector, coordinates_that_a_double_cannot_hold_are_no_points) {
  static_assert(Point_like<Point_of<double>> && Point_like<Point_of<float>> && Point_like<Point_of<int>>);
  static_assert(!Point_like<Point_of<long double>> && !Point_like<Point_of<std::int64_t>>);
}

}  // namespace
}  // namespace lodestone
