// SPDX-License-Identifier: GPL-3.0-or-later
// Mode certified gives the answers of mode exact, and reads little where little is near.
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "lodestone/bounds/box_promise.h"
#include "lodestone/bounds/displacement_bound.h"
#include "lodestone/bounds/lipschitz_bound.h"
#include "lodestone/bounds/stretch_bound.h"
#include "lodestone/detector.h"
#include "lodestone/mesh/computed_points.h"
#include "lodestone/mesh/skinned_points.h"
#include "lodestone/volumes/bounding_sphere.h"
#include "support/exact_truth.h"
#include "support/face_soup.h"
#include "support/message_of.h"

namespace lodestone {
namespace {

Surface_mesh long_body(int parts, std::uint64_t seed) {
  auto mesh = potato(parts, seed);
  deform(mesh, [](const Point& p) { return Point(2 * p.x(), 0.6 * p.y(), 0.6 * p.z()); });
  return mesh;
}

/// A limb along x whose ends follow two joints.
Skinned_points limb(const Surface_mesh& mesh) {
  const auto rest = Face_soup(mesh).coordinates;
  std::vector<std::uint32_t> joints;
  std::vector<double> weights;
  for (std::size_t v = 0; v < rest.size() / 3; ++v) {
    const double second = std::clamp(rest[3 * v] + 0.5, 0.0, 1.0);
    joints.insert(joints.end(), {0, 1});
    weights.insert(weights.end(), {1 - second, second});
  }
  return {rest, Joint_influences::of(2, joints, weights), 2};
}

void bend(Skinned_points& points, double angle, const Eigen::Vector3d& at) {
  const Eigen::Translation3d there(at);
  points.set_joints(std::vector<Eigen::Affine3d>{
      Eigen::Affine3d(there), there * Eigen::Affine3d(Eigen::AngleAxisd(angle, Eigen::Vector3d(0, 0.6, 0.8)))});
}

Morphed_points swelling(const Surface_mesh& mesh) {
  Morph_target larger;
  larger.offsets = Face_soup(mesh).coordinates;
  return Morphed_points(Face_soup(mesh).coordinates, std::vector{larger});
}

/// Two limbs, a body that swells, and one that moves without saying how.
struct Scene {
  Surface_mesh upper = long_body(9, 1), lower = long_body(8, 2), round = potato(6, 3), plain = potato(7, 4);
  Skinned_points upper_points = limb(upper), lower_points = limb(lower);
  Morphed_points round_points = swelling(round);

  void add_to(Detector<>& detector) {
    detector.add(upper, point_map(upper, upper_points), {.name = "upper"});
    detector.add(lower, point_map(lower, lower_points));
    detector.add(round, point_map(round, round_points));
    detector.add(std::as_const(plain));
  }
  void pose(int frame) {
    const double t = frame;
    bend(upper_points, 0.3 * t, {0, 0, 1.4 * std::cos(0.5 * t)});
    bend(lower_points, -0.4 * t, {0.5 * std::sin(t), 0, 0});
    round_points.set_weights(std::vector{0.5 * std::sin(0.7 * t)});
    shift(plain, 0, std::sin(1.3 * t), 0.6 * std::cos(0.9 * t));
  }
};

Detector_options in_mode(Mode mode, Detector_options options) {
  options.mode = mode;
  options.exact.tree.leaf_faces = 24;
  return options;
}

Pair_result result_or_none(const Frame& frame, Object_id a, Object_id b) {
  const auto* result = result_of(frame, a, b);
  return result == nullptr ? Pair_result{} : *result;
}

/// The two frames list the same contacts, and the same of all that depends on them.
void expect_same_answers(const Frame& found, const Frame& truth, Object_id objects) {
  for (Object_id a = 0; a < objects; ++a)
    for (Object_id b = a; b < objects; ++b) {
      SCOPED_TRACE(testing::Message() << a << ", " << b);
      const Pair_result one = result_or_none(found, a, b), other = result_or_none(truth, a, b);
      EXPECT_EQ(one.collides, other.collides);
      EXPECT_EQ(one.near, other.near);
      EXPECT_EQ(one.capped, other.capped);
      EXPECT_EQ(one.containment, other.containment);
      EXPECT_EQ(one.patches, other.patches);
      EXPECT_EQ(one.parting.has_value(), other.parting.has_value());
      if (one.parting && other.parting) {
        EXPECT_EQ(one.parting->translation, other.parting->translation);
      }
    }
  EXPECT_EQ(found.face_pairs, truth.face_pairs);
  EXPECT_EQ(found.contact_points, truth.contact_points);
  EXPECT_EQ(found.contact_normals.size(), truth.contact_normals.size());
}

std::vector<Detector_options> questions() {
  return {{},
          {.contacts = Contact_query::yes_no},
          {.exact = {.tolerance = 0.1}},
          {.contact_points = true, .contact_normals = true, .exact = {.patches = true}},
          {.exact = {.self_collision = true, .containment = true, .parting = true}},
          {.particles = 4, .exact = {.tolerance = 0.05, .threads = 0}}};
}

TEST(Certified, gives_the_answers_of_mode_exact) {
  std::size_t colliding = 0, apart = 0;
  for (const Detector_options& options : questions()) {
    Scene scene;
    Detector certified(in_mode(Mode::certified, options)), exact(in_mode(Mode::exact, options));
    scene.add_to(certified);
    scene.add_to(exact);
    for (int frame = 0; frame < 12; ++frame) {
      SCOPED_TRACE(frame);
      scene.pose(frame);
      const Frame& found = certified.detect();
      expect_same_answers(found, exact.detect(), 4);
      EXPECT_EQ(found.statistics.violations, 0U);
      for (Object_id a = 0; a < 4; ++a)
        for (Object_id b = a + 1; b < 4; ++b) ++(result_or_none(found, a, b).collides ? colliding : apart);
    }
  }
  EXPECT_GT(colliding, 50U);
  EXPECT_GT(apart, 50U);
}

TEST(Certified, a_first_contact_is_a_contact) {
  Scene scene;
  Detector certified(in_mode(Mode::certified, {.contacts = Contact_query::first})), exact(in_mode(Mode::exact, {}));
  scene.add_to(certified);
  scene.add_to(exact);
  for (int frame = 0; frame < 12; ++frame) {
    scene.pose(frame);
    const Frame& found = certified.detect();
    const Frame& truth = exact.detect();
    for (const auto& pair : truth.pairs) {
      const auto one = contacts_of(found, pair.a, pair.b);
      EXPECT_EQ(one.size(), pair.collides ? 1U : 0U);
      for (const auto& contact : one) EXPECT_TRUE(std::ranges::count(truth.contacts(pair), contact));
    }
  }
}

TEST(Certified, a_capped_list_holds_contacts) {
  Scene scene;
  Detector certified(in_mode(Mode::certified, {.most_contacts = 3})), exact(in_mode(Mode::exact, {}));
  scene.add_to(certified);
  scene.add_to(exact);
  scene.pose(3);
  const Frame& found = certified.detect();
  const Frame& truth = exact.detect();
  EXPECT_TRUE(found.capped());
  for (const auto& pair : truth.pairs) {
    const auto some = contacts_of(found, pair.a, pair.b);
    EXPECT_EQ(some.size(), std::min<std::size_t>(3, pair.contacts));
    for (const auto& contact : some) EXPECT_TRUE(std::ranges::count(truth.contacts(pair), contact));
  }
}

TEST(Certified, single_questions_have_the_answers_of_mode_exact) {
  Scene scene;
  Detector certified(in_mode(Mode::certified, {})), exact(in_mode(Mode::exact, {}));
  scene.add_to(certified);
  scene.add_to(exact);
  bool stopped = false;
  for (int frame = 0; frame < 10; ++frame) {
    SCOPED_TRACE(frame);
    scene.pose(frame);
    for (Object_id a = 0; a < 4; ++a)
      for (Object_id b = 0; b < 4; ++b) {
        if (a == b) continue;
        const auto nearest = certified.closest(a, b), true_nearest = exact.closest(a, b);
        EXPECT_EQ(nearest.faces, true_nearest.faces);
        EXPECT_EQ(nearest.points.distance, true_nearest.points.distance);
        EXPECT_EQ(certified.contains(a, b), exact.contains(a, b));
        std::set<Face_pair> shown, truly;
        const auto shows = [](std::set<Face_pair>& set) {
          return [&set](Face_pair pair) {
            EXPECT_TRUE(set.insert(pair).second);
            return Visit::go_on;
          };
        };
        certified.visit(a, b, shows(shown));
        exact.visit(a, b, shows(truly));
        EXPECT_EQ(shown, truly);
        int calls = 0;
        const auto end = certified.visit(a, b, [&](Face_pair) { return ++calls, Visit::stop; });
        EXPECT_EQ(calls, truly.empty() ? 0 : 1);
        EXPECT_EQ(end == Visit::stop, !truly.empty());
        stopped |= end == Visit::stop;
        expect_same_answers(certified.detect(a, b), exact.detect(a, b), 4);
        EXPECT_EQ(certified.parting(a, b).has_value(), exact.parting(a, b).has_value());
      }
  }
  EXPECT_TRUE(stopped);
}

TEST(Certified, rays_and_points_have_the_answers_of_mode_exact) {
  Scene scene;
  Detector certified(in_mode(Mode::certified, {})), exact(in_mode(Mode::exact, {}));
  scene.add_to(certified);
  scene.add_to(exact);
  std::size_t hits = 0, inside = 0;
  const auto same = [](const Ray_hit& a, const Ray_hit& b) { return a.face == b.face && a.t == b.t; };
  for (int frame = 0; frame < 6; ++frame) {
    scene.pose(frame);
    for (Object_id object = 0; object < 4; ++object)
      for (int i = 0; i < 12; ++i) {
        const Ray ray{.origin = {3 * std::cos(i), 3 * std::sin(i), 0.3 * i},
                      .direction = {-std::cos(i), -std::sin(i) + 0.05 * i, -0.12 * i}};
        const auto hit = certified.first_hit(object, ray), true_hit = exact.first_hit(object, ray);
        ASSERT_EQ(hit.has_value(), true_hit.has_value());
        if (!hit) continue;
        ++hits;
        EXPECT_TRUE(same(*hit, *true_hit));
        EXPECT_TRUE(std::ranges::equal(certified.all_hits(object, ray), exact.all_hits(object, ray), same));
        const Point beyond(hit->point.x() - 0.1 * std::cos(i), hit->point.y() - 0.1 * std::sin(i), hit->point.z());
        const Point_side side = certified.point_side(object, beyond);
        EXPECT_EQ(side, exact.point_side(object, beyond));
        inside += side == Point_side::inside ? 1 : 0;
        EXPECT_EQ(certified.closest_point(object, beyond).face, exact.closest_point(object, beyond).face);
        EXPECT_EQ(certified.closest_point(object, beyond).distance, exact.closest_point(object, beyond).distance);
      }
  }
  EXPECT_GT(hits, 100U);
  EXPECT_GT(inside, 30U);
}

TEST(Certified, a_ray_poses_only_what_it_passes) {
  Surface_mesh mesh = long_body(40, 1);
  Skinned_points points = limb(mesh);
  Detector detector({.mode = Mode::certified});
  detector.add(mesh, point_map(mesh, points));
  detector.detect();
  bend(points, 0.4, {0, 0, 0});
  EXPECT_TRUE(detector.first_hit(0, {.origin = {0.3, 9, 0.1}, .direction = {0, -1, 0}}).has_value());
  EXPECT_GT(detector.bounded(0)->vertices_posed(), 0U);
  EXPECT_LT(detector.bounded(0)->vertices_posed(), mesh.number_of_vertices() / 8);
  EXPECT_FALSE(detector.first_hit(0, {.origin = {0, 9, 0}, .direction = {0, 1, 0}}).has_value());
  EXPECT_THROW(detector.first_hit(0, {.direction = {0, 0, 0}}), Bad_argument);
  EXPECT_THROW(detector.first_hit(1, {}), Bad_argument);
  EXPECT_THROW(Detector<>({.mode = Mode::particles}).point_side(0, Point(0, 0, 0)), Bad_argument);
}

TEST(Certified, placed_given_and_rebuilt_objects_have_the_answers_of_mode_exact) {
  Scene scene;
  Detector certified(in_mode(Mode::certified, {.exact = {.self_collision = true}})),
      exact(in_mode(Mode::exact, {.exact = {.self_collision = true}}));
  scene.add_to(certified);
  scene.add_to(exact);
  Positions given(static_cast<Eigen::Index>(scene.lower.number_of_vertices()), 3);
  for (const auto v : scene.lower.vertices())
    given.row(static_cast<Eigen::Index>(v.idx())) << scene.lower.point(v).x(), 1.1, scene.lower.point(v).z();
  for (int frame = 0; frame < 16; ++frame) {
    SCOPED_TRACE(frame);
    if (frame < 12) scene.pose(frame);  // afterwards only the detectors are told
    for (Detector<>* detector : {&certified, &exact}) {
      if (frame % 3 == 1)
        detector->place(0, Eigen::Isometry3d(Eigen::Translation3d(0.2, 0.1 * frame, 0) *
                                             Eigen::AngleAxisd(0.3 * frame, Eigen::Vector3d(0.6, 0.8, 0))));
      if (frame == 8) detector->place(0, Eigen::Isometry3d::Identity());
      if (frame % 4 == 2) detector->update(1, given);
      if (frame % 4 == 3) detector->update(1);
      if (frame == 6) detector->rebuild(0);
      if (frame == 14) detector->remove(2);
    }
    expect_same_answers(certified.detect(), exact.detect(), 4);
  }
}

TEST(Certified, saved_objects_have_the_answers_of_mode_exact) {
  Scene scene;
  Detector saving(in_mode(Mode::certified, {})), certified(in_mode(Mode::certified, {})),
      exact(in_mode(Mode::exact, {}));
  for (Detector<>* detector : {&saving, &certified, &exact}) scene.add_to(*detector);
  scene.pose(0);
  saving.detect();
  scene.pose(1);  // what is saved is not of the last frame
  for (Object_id object = 0; object < 4; ++object) certified.load(object, saving.save(object));
  for (int frame = 2; frame < 8; ++frame) {
    scene.pose(frame);
    const Frame& found = certified.detect();
    expect_same_answers(found, exact.detect(), 4);
    EXPECT_EQ(found.statistics.builds, 0U);
    EXPECT_EQ(found.statistics.nodes_bounded > 0, frame > 2);  // the first frame reads everything
  }
}

TEST(Certified, polyhedra_whose_vertices_have_no_ids_are_bounded_too) {
  Scene scene;
  CGAL::Polyhedron_3<Kernel> upper, lower;
  CGAL::copy_face_graph(scene.upper, upper);
  CGAL::copy_face_graph(scene.lower, lower);
  const auto points_of = [](const auto& polyhedron) {
    Surface_mesh mesh;  // its vertices are in the order of the polyhedron
    CGAL::copy_face_graph(polyhedron, mesh);
    return limb(mesh);
  };
  auto upper_points = points_of(upper), lower_points = points_of(lower);
  Detector certified(in_mode(Mode::certified, {})), exact(in_mode(Mode::exact, {}));
  for (Detector<>* detector : {&certified, &exact}) {
    detector->add(upper, point_map(upper, upper_points));
    detector->add(lower, point_map(lower, lower_points));
  }
  std::size_t colliding = 0, bounded = 0;
  for (int frame = 0; frame < 8; ++frame) {
    bend(upper_points, 0.3 * frame, {0, 0, 1.5 * std::cos(0.5 * frame)});
    bend(lower_points, -0.4 * frame, {0, 0, 0});
    const Frame& found = certified.detect();
    expect_same_answers(found, exact.detect(), 2);
    colliding += found.collides() ? 1 : 0;
    bounded += found.statistics.nodes_bounded;
  }
  EXPECT_GT(colliding, 1U);
  EXPECT_GT(bounded, 10U);
}

TEST(Certified, reads_little_where_little_is_near) {
  Surface_mesh a = long_body(40, 1), b = long_body(40, 1);
  Skinned_points a_points = limb(a), b_points = limb(b);
  Detector detector({.mode = Mode::certified});
  detector.add(a, point_map(a, a_points));
  detector.add(b, point_map(b, b_points));
  detector.detect();
  bend(a_points, 0.1, {0, 0, 0});
  bend(b_points, 0.1, {0, 0, 20});
  const Frame& apart = detector.detect();
  EXPECT_EQ(apart.statistics.vertices_read, 0U);
  EXPECT_EQ(apart.statistics.nodes_bounded, 2U);
  double x = 12;
  for (bool met = false; !met; x -= 0.02) {
    bend(b_points, 0.1, {x, 0, 0});
    met = detector.detect().collides();
    ASSERT_GT(x, 3);
  }
  const Frame& again = detector.detect();  // nothing has moved: nothing is read
  EXPECT_TRUE(again.collides());
  EXPECT_EQ(again.statistics.vertices_read, 0U);
  bend(b_points, 0.1, {x + 0.019, 0, 0});
  const Frame_statistics touching = detector.detect().statistics;
  EXPECT_GT(touching.leaves_posed, 0U);
  EXPECT_LT(touching.vertices_read, a.number_of_vertices() / 4);
  std::array<std::size_t, 3> leaves{};
  const Bounded_surface& of_b = *detector.bounded(1);
  for (std::uint32_t leaf = 0; leaf < of_b.layout().leaf_count(); ++leaf)
    ++leaves[static_cast<std::size_t>(of_b.leaf_state(leaf))];
  EXPECT_GT(leaves[static_cast<std::size_t>(Bounded_surface::Leaf_state::far)], of_b.layout().leaf_count() / 2);
  EXPECT_EQ(leaves[static_cast<std::size_t>(Bounded_surface::Leaf_state::posed)], of_b.leaves_posed());
}

/// How far any vertex is from where it was.
double largest_move(const Surface_mesh& now, const Surface_mesh& before) {
  double largest = 0;
  for (const auto v : now.vertices())
    largest = std::max(largest, std::sqrt(CGAL::squared_distance(now.point(v), before.point(v))));
  return largest * (1 + 1e-12);
}

/// Two bodies that crumple and drift towards each other, in meshes.
struct Drifting {
  Surface_mesh a = long_body(20, 1), b = long_body(18, 2), a_before = a, b_before = b;

  Drifting() { place_b(gap_at_first); }
  /// Where b's leftmost vertex is that far beyond a's rightmost.
  void place_b(double gap) {
    double right = -1e9, left = 1e9;
    for (const auto v : a.vertices()) right = std::max(right, a.point(v).x());
    for (const auto v : b.vertices()) left = std::min(left, b.point(v).x());
    shift(b, right + gap - left);
  }
  static constexpr double gap_at_first = 1;
  void step(int frame) {
    a_before = a, b_before = b;
    crumple(a, 0.004, static_cast<std::uint64_t>(frame));
    crumple(b, 0.004, static_cast<std::uint64_t>(frame) + 100);
    shift(b, frame < 30 ? -0.05 : 0.05, 0.01 * std::sin(frame));
  }
};

TEST(Certified, meshes_with_a_displacement_have_the_answers_of_mode_exact) {
  Drifting bodies;
  Displacement_promise of_a, of_b;
  Detector certified(in_mode(Mode::certified, {})), exact(in_mode(Mode::exact, {}));
  for (Detector<>* detector : {&certified, &exact}) {
    detector->add(std::as_const(bodies.a));
    detector->add(std::as_const(bodies.b));
  }
  certified.promise(0, of_a);
  certified.promise(1, of_b);
  std::size_t read = 0, colliding = 0;
  for (int frame = 0; frame < 60; ++frame) {
    const Frame& found = certified.detect();
    expect_same_answers(found, exact.detect(), 2);
    EXPECT_EQ(found.statistics.violations, 0U);
    if (frame > 0) read += found.statistics.vertices_read;
    colliding += found.collides() ? 1 : 0;
    bodies.step(frame);
    of_a.move(largest_move(bodies.a, bodies.a_before));
    of_b.move(largest_move(bodies.b, bodies.b_before));
  }
  EXPECT_GT(colliding, 5U);
  EXPECT_LT(colliding, 55U);
  EXPECT_LT(read, 59 * (bodies.a.number_of_vertices() + bodies.b.number_of_vertices()) / 3);
}

TEST(Certified, several_promises_hold_together_and_may_come_late) {
  Drifting bodies;
  const Surface_mesh rest_a = bodies.a, rest_b = bodies.b;
  Displacement_promise of_a;
  Stretch_promise stretch_of_a(50), stretch_of_b(50);  // crumpling makes short edges much longer
  Lipschitz_promise of_b(100);
  const Box_promise somewhere([](Region_index, const Aabb& rest) {
    Aabb box = rest;
    for (int axis = 0; axis < 3; ++axis) box.low[axis] -= 20, box.high[axis] += 20;
    return box;
  });
  Detector certified(in_mode(Mode::certified, {.particles = 5})), exact(in_mode(Mode::exact, {.particles = 5}));
  for (Detector<>* detector : {&certified, &exact}) {
    detector->add(std::as_const(bodies.a));
    detector->add(std::as_const(bodies.b));
  }
  for (int frame = 0; frame < 50; ++frame) {
    if (frame == 0) certified.promise(0, stretch_of_a), certified.promise(1, stretch_of_b);
    if (frame == 3) certified.promise(0, of_a), certified.promise(1, of_b), certified.promise(1, somewhere);
    const Frame& found = certified.detect();
    expect_same_answers(found, exact.detect(), 2);
    EXPECT_EQ(found.statistics.violations, 0U) << frame;
    bodies.step(frame);
    of_a.move(largest_move(bodies.a, bodies.a_before));
  }
}

TEST(Certified, a_displacement_that_is_larger_than_promised_is_noticed_where_it_is_read) {
  Drifting bodies;
  Displacement_promise of_a;
  Detector certified(in_mode(Mode::certified, {})), exact(in_mode(Mode::exact, {}));
  for (Detector<>* detector : {&certified, &exact}) {
    detector->add(std::as_const(bodies.a));
    detector->add(std::as_const(bodies.b));
  }
  certified.promise(0, of_a);
  bodies.place_b(-1);
  certified.detect();
  std::size_t violations = 0;
  for (int frame = 0; frame < 5; ++frame) {
    crumple(bodies.a, 0.01, static_cast<std::uint64_t>(frame));  // nothing is promised: it may not move
    const Frame& found = certified.detect();
    expect_same_answers(found, exact.detect(), 2);
    violations += found.statistics.violations;
  }
  EXPECT_GT(violations, 0U);
}

TEST(Certified, a_body_inside_another_is_found_though_its_bound_sticks_out) {
  const Surface_mesh outer = potato(9), inner = sphere(5, 0.1);
  const Box_promise loose([](Region_index, const Aabb& rest) {
    Aabb box = rest;
    for (int axis = 0; axis < 3; ++axis) box.low[axis] -= 20, box.high[axis] += 20;
    return box;
  });
  Detector certified(in_mode(Mode::certified, {.exact = {.containment = true}}));
  certified.add(outer);
  certified.add(inner);
  certified.promise(1, loose);
  EXPECT_EQ(certified.detect().pairs.at(0).containment, Containment::b_in_a);
  EXPECT_EQ(certified.detect().pairs.at(0).containment, Containment::b_in_a);  // the first frame reads everything
  EXPECT_TRUE(certified.contains(0, 1));
  EXPECT_FALSE(certified.contains(1, 0));
}

TEST(Certified, promises_need_the_mode_certified) {
  const Surface_mesh mesh = potato(5);
  const Displacement_promise promise;
  Detector exact, particles({.mode = Mode::particles}), certified({.mode = Mode::certified});
  for (Detector<>* detector : {&exact, &particles, &certified}) detector->add(mesh);
  EXPECT_THROW(exact.promise(0, promise), Bad_argument);
  EXPECT_THROW(particles.promise(0, promise), Bad_argument);
  EXPECT_THROW(certified.promise(1, promise), Bad_argument);
  EXPECT_NO_THROW(certified.promise(0, promise));
}

/// Points that promise a box which ends too early along x.
struct Liar {
  Skinned_points points;
  double end = -0.5;

  std::uint32_t vertex_count() const { return points.vertex_count(); }
  std::uint64_t pose_number() const { return points.pose_number(); }
  Eigen::Vector3d operator()(std::uint32_t vertex) const { return points(vertex); }
  void pose(std::span<const std::uint32_t> vertices, std::span<double> to) const { points.pose(vertices, to); }
  void pose_all(std::span<double> to) const { points.pose_all(to); }

  struct Lie {
    Skin_bound truth;
    const double* end;
    std::size_t node_count() const { return truth.node_count(); }
    Aabb box(std::uint32_t node) const {
      Aabb box = truth.box(node);
      box.high[0] = std::min(box.high[0], *end);
      box.low[0] = std::min(box.low[0], box.high[0]);
      return box;
    }
  };
  Lie bound(const Bounded_object& object) const { return {{points, object.layout}, &end}; }
};

TEST(Certified, a_broken_bound_is_counted_and_answered_by_an_exact_pass) {
  Surface_mesh a = long_body(12, 1), b = potato(8, 2), c = potato(8, 3);
  Liar a_points{limb(a)};
  Detector certified(in_mode(Mode::certified, {})), exact(in_mode(Mode::exact, {}));
  for (Detector<>* detector : {&certified, &exact}) {
    detector->add(a, point_map(a, a_points));
    detector->add(std::as_const(b));
    detector->add(std::as_const(c));
  }
  deform(b, [](const Point& p) { return Point(p.x() + 2.4, p.y(), p.z()); });  // beyond the box that is promised
  deform(c, [](const Point& p) { return Point(p.x() - 1.5, p.y(), p.z()); });
  for (int frame = 0; frame < 4; ++frame) {
    bend(a_points.points, 0.1 * frame, {0, 0, 0});
    const Frame& found = certified.detect();
    expect_same_answers(found, exact.detect(), 3);
    EXPECT_EQ(found.pairs.size(), exact.detect().pairs.size());
    EXPECT_EQ(found.statistics.violations > 0, frame > 0) << frame;  // the first frame builds: nothing relies on bounds
  }
  a_points.end = 100;  // the truth
  bend(a_points.points, 0.7, {0, 0, 0});
  EXPECT_EQ(certified.detect().statistics.violations, 0U);
  expect_same_answers(certified.detect(), exact.detect(), 3);
}

TEST(Certified, a_broken_bound_is_an_error_on_request) {
  Surface_mesh a = long_body(12, 1), c = potato(8, 3);
  Liar a_points{limb(a)};
  Detector detector({.mode = Mode::certified, .exact = {.throw_if_broken = true}});
  detector.add(a, point_map(a, a_points), {.name = "a liar"});
  detector.add(std::as_const(c));
  deform(c, [](const Point& p) { return Point(p.x() - 1, p.y(), p.z()); });
  detector.detect();
  bend(a_points.points, 0.2, {0, 0, 0});
  const auto message = message_of<Broken_bound>([&] { detector.detect(); });
  EXPECT_NE(message.find("object 0 (a liar)"), std::string::npos) << message;
  bend(a_points.points, 0.3, {0, 0, 0});
  EXPECT_THROW(detector.visit(0, 1, [](Face_pair) { return Visit::go_on; }), Broken_bound);
  a_points.end = 100;
  bend(a_points.points, 0.2, {0, 0, 0});
  EXPECT_TRUE(detector.detect().collides());
}

TEST(Certified, names_the_object_of_a_vertex_that_is_not_finite) {
  Scene scene;
  Detector detector(in_mode(Mode::certified, {}));
  scene.add_to(detector);
  scene.pose(0);
  detector.detect();
  auto motions = std::vector<Eigen::Affine3d>(2, Eigen::Affine3d(Eigen::Scaling(1.7e308)));
  motions[1] = Eigen::Translation3d(1.7e308, 0, 0) * motions[1];
  scene.upper_points.set_joints(motions);
  for (int twice = 0; twice < 2; ++twice) {
    const auto message = message_of<Bad_mesh>([&] { detector.detect(); });
    EXPECT_NE(message.find("of object 0 (upper)"), std::string::npos) << message;
  }
  scene.pose(1);
  EXPECT_NO_THROW(detector.detect());
}

TEST(Certified, is_no_mode_of_other_volumes_and_takes_no_options_of_particles) {
  EXPECT_THROW((Volume_detector<Bounding_sphere>({.mode = Mode::certified})), Bad_argument);
  EXPECT_THROW(Detector({.mode = Mode::certified, .growth = 2}), Bad_argument);
  Scene scene;
  Detector exact;
  scene.add_to(exact);
  exact.detect();
  EXPECT_EQ(exact.bounded(0), nullptr);
}

}  // namespace
}  // namespace lodestone
