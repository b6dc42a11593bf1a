// SPDX-License-Identifier: GPL-3.0-or-later
// What the caller breaks between two frames is named in every mode, and leaves nothing behind once it is mended.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "detection/detector_scenes.h"
#include "lodestone/mesh/indexed_mesh.h"
#include "support/exact_truth.h"
#include "support/face_soup.h"
#include "support/message_of.h"
#include "support/special_numbers.h"

namespace lodestone {
namespace {

/// All modes, and the published method.
std::vector<Detector_options> broken_mesh_modes() {
  std::vector<Detector_options> all;
  for (const auto mode : {Mode::exact, Mode::certified, Mode::particles, Mode::senin})
    all.push_back({.mode = mode, .particles = 8, .contacts = Contact_query::all});
  all.push_back({.mode = Mode::particles, .particles = 8, .meetings = 0, .contacts = Contact_query::all});
  return all;
}

/// Two bodies that sink into each other, and a detector that follows them.
struct Sinking_bodies {
  explicit Sinking_bodies(const Detector_options& options) : a(potato(6)), b(potato(6, 2)), detector(options) {
    shift(b, 1.9);
    detector.add(std::as_const(a));
    detector.add(std::as_const(b), {.name = "broken"});
  }
  Frame next_frame() {
    shift(b, -0.1, 0.03);
    return frame();
  }
  Frame frame() {
    detector.update();
    return detector.detect();
  }

  Surface_mesh a, b;
  Detector<> detector;
};

testing::Message title_of(const Detector_options& options) {
  return testing::Message() << name_of(options.mode) << ", meetings: " << options.meetings;
}

/// The error of a frame, twice, names the body and says this.
void expect_refused(Sinking_bodies& bodies, const std::string& part) {
  for (int time = 0; time < 2; ++time) {
    const auto message = message_of<Bad_mesh>([&] { bodies.frame(); });
    EXPECT_NE(message.find("object 1 (broken)"), std::string::npos) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

TEST(Broken_mesh, whose_coordinates_are_not_finite_is_refused_and_leaves_nothing_behind_once_they_are) {
  for (const auto& options : broken_mesh_modes())
    for (const double bad : {not_a_number, infinity, -infinity})
      for (const int good_frames : {0, 1, 3}) {
        SCOPED_TRACE(title_of(options) << ", " << bad << " after " << good_frames << " frames");
        Sinking_bodies broken(options), whole(options);
        for (int frame = 0; frame < good_frames; ++frame) expect_equal(broken.next_frame(), whole.next_frame());
        const Positions before = positions_of(broken.b);
        deform(broken.b, [bad](const Point& p) { return Point(p.x(), bad, p.z()); });
        expect_refused(broken, "not finite");
        place(broken.b, before);
        for (int frame = 0; frame < 3; ++frame)
          EXPECT_EQ(broken.next_frame().face_pairs, whole.next_frame().face_pairs) << frame;
      }
}

TEST(Broken_mesh, of_other_numbers_is_refused_in_any_mode_until_rebuild) {
  const std::vector<std::function<void(Surface_mesh&)>> changes{
      [](Surface_mesh& mesh) { mesh.add_vertex(Point(0, 0, 0)); },
      [](Surface_mesh& mesh) { append(mesh, single_triangle()); },
      [](Surface_mesh& mesh) {
        CGAL::Euler::remove_face(mesh.halfedge(*mesh.faces().begin()), mesh);
        mesh.collect_garbage();
      }};
  for (const auto& options : broken_mesh_modes())
    for (const auto& change : changes) {
      SCOPED_TRACE(title_of(options));
      Sinking_bodies bodies(options);
      bodies.next_frame();
      change(bodies.b);
      expect_refused(bodies, "call rebuild()");
      bodies.detector.rebuild(1);
      const Frame frame = bodies.next_frame();
      if (finds_all(options.mode)) {
        expect_exhaustive(frame, {&bodies.a, &bodies.b});
      }
    }
}

TEST(Broken_mesh, without_faces_is_refused_by_frame_and_rebuild_in_any_mode) {
  for (const auto& options : broken_mesh_modes()) {
    SCOPED_TRACE(title_of(options));
    Sinking_bodies bodies(options);
    bodies.next_frame();
    bodies.b.clear();
    expect_refused(bodies, "call rebuild()");
    EXPECT_THROW(bodies.detector.rebuild(1), Bad_mesh);
    expect_refused(bodies, "call rebuild()");
  }
}

/// Squares of distances overflow: nothing else is asked of such a frame than that it ends.
TEST(Broken_mesh, a_vertex_beyond_the_limits_of_a_mode_ends_the_frame_and_is_forgotten_once_it_is_back) {
  for (const auto& options : broken_mesh_modes())
    for (const double far : {1e151, 1e200, 1.7e308, -1.7e308}) {
      SCOPED_TRACE(title_of(options) << ", " << far);
      Sinking_bodies broken(options), whole(options);
      for (int frame = 0; frame < 2; ++frame) expect_equal(broken.next_frame(), whole.next_frame());
      const Positions before = positions_of(broken.b);
      for (const auto v : {Surface_mesh::Vertex_index(0), Surface_mesh::Vertex_index(40)})
        broken.b.point(v) = Point(far, far, -far);
      try {
        const Frame frame = broken.frame();
        if (finds_all(options.mode)) {
          expect_exhaustive(frame, {&broken.a, &broken.b});
        }
      } catch (const Bad_mesh& error) {
        EXPECT_FALSE(finds_all(options.mode)) << error.what();
      }
      place(broken.b, before);
      const Frame found = broken.next_frame(), expected = whole.next_frame();
      if (finds_all(options.mode)) {
        EXPECT_EQ(found.face_pairs, expected.face_pairs);
      }
    }
}

TEST(Broken_mesh, other_faces_of_the_same_numbers_are_seen_after_rebuild) {
  for (const auto& options : broken_mesh_modes()) {
    SCOPED_TRACE(title_of(options));
    const auto a = potato(6);
    auto b = potato(6, 2);
    shift(b, 1.2);
    Face_soup soup(b);
    const Indexed_mesh mesh(soup.coordinates, soup.faces);
    Detector<> detector(options);
    detector.add(a);
    detector.add(mesh);
    const auto before = detector.detect().face_pairs;
    for (auto& face : soup.faces) face = {face[2], face[0], face[2]};  // a segment
    detector.update();
    EXPECT_EQ(detector.detect().face_pairs.empty(), before.empty());
    detector.rebuild(1);
    for (const auto& pair : detector.detect().face_pairs)
      EXPECT_TRUE(triangles_intersect(triangle_of(a, pair.a), soup.triangle(pair.b)));
  }
}

}  // namespace
}  // namespace lodestone
