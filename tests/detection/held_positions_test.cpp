// SPDX-License-Identifier: GPL-3.0-or-later
// While positions are held, an object is read once, and every answer is the one that it would be anyway.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "detection/certified_scene.h"
#include "lodestone/bounds/box_promise.h"
#include "support/exact_truth.h"

namespace lodestone {
namespace {

/// Where the vertices of a mesh are; counts how often somebody asks.
struct Counted_points {
  using key_type = Surface_mesh::Vertex_index;
  using value_type = Point;
  using reference = Point;
  using category = boost::readable_property_map_tag;

  const Surface_mesh* mesh;
  std::size_t* reads;

  friend Point get(const Counted_points& points, key_type vertex) {
    ++*points.reads;
    return points.mesh->point(vertex);
  }
};

/// Two bodies in mode `exact`, of which the positions of the second are counted.
struct Counted_scene {
  Surface_mesh a = potato(6), b = potato(6, 2);
  std::size_t reads = 0;
  Detector<> detector{{.mode = Mode::exact}};

  Counted_scene() {
    detector.add(std::as_const(a));
    detector.add(b, Counted_points{&b, &reads});
  }
};

Eigen::Isometry3d along_x(double by) { return Eigen::Isometry3d(Eigen::Translation3d(by, 0, 0)); }

/// Rays from all around to the middle: enough for a Ray_tree of a small mesh.
std::vector<Ray> many_rays() {
  std::vector<Ray> rays;
  for (int i = 0; i < 200; ++i) {
    const double turn = 0.1 * i;
    const Eigen::Vector3d from(3 * std::cos(turn), 3 * std::sin(turn), 0.01 * i - 1);
    rays.push_back({.origin = from, .direction = -from});
  }
  return rays;
}

void expect_same_hit(const std::optional<Ray_hit>& one, const std::optional<Ray_hit>& other) {
  ASSERT_EQ(one.has_value(), other.has_value());
  if (!one) return;
  EXPECT_EQ(one->face, other->face);
  EXPECT_EQ(one->t, other->t);
}

/// What two detectors of the same scene answer about objects a and b.
template <class One, class Other>
void expect_same_answers(One& one, Other& other, Object_id a, Object_id b) {
  EXPECT_EQ(one.detect().face_pairs, other.detect().face_pairs);
  EXPECT_EQ(one.detect(a, b).face_pairs, other.detect(a, b).face_pairs);
  const Closest_faces nearest = one.closest(a, b), other_nearest = other.closest(a, b);
  EXPECT_EQ(nearest.points.distance, other_nearest.points.distance);
  EXPECT_EQ(nearest.faces, other_nearest.faces);
  for (const double distance : {0.0, 0.3, 2.0}) EXPECT_EQ(one.within(a, b, distance), other.within(a, b, distance));
  EXPECT_EQ(one.contains(a, b), other.contains(a, b));
  const auto parting = one.parting(a, b), other_parting = other.parting(a, b);
  ASSERT_EQ(parting.has_value(), other_parting.has_value());
  if (parting) {
    EXPECT_EQ(parting->translation, other_parting->translation);
  }
  const Point outside(2, 0.1, 0.3);
  EXPECT_EQ(one.closest_point(b, outside).distance, other.closest_point(b, outside).distance);
  EXPECT_EQ(one.point_side(b, {0.1, 0, 0}), other.point_side(b, {0.1, 0, 0}));
  // Many rays one by one: the tree that is made for them while positions are held, and none.
  const auto rays = many_rays();
  for (const Ray& ray : rays) {
    expect_same_hit(one.first_hit(b, ray), other.first_hit(b, ray));
    const auto all = one.all_hits(b, ray), other_all = other.all_hits(b, ray);
    ASSERT_EQ(all.size(), other_all.size());
    for (std::size_t i = 0; i < all.size(); ++i) expect_same_hit(all[i], other_all[i]);
  }
  // The same at once, by the tree that is kept.
  const auto hits = one.first_hits(b, rays);
  for (std::size_t i = 0; i < rays.size(); ++i) expect_same_hit(hits[i], other.first_hit(b, rays[i]));
}

TEST(Held_positions, only_the_first_query_of_an_object_reads_them) {
  auto a = potato(6), b = potato(6, 2);
  shift(b, 1.2);
  for (const Mode mode : {Mode::exact, Mode::certified}) {
    std::size_t reads_of_a = 0, reads_of_b = 0;
    Detector<> held({.mode = mode}), free({.mode = mode});
    held.add(a, Counted_points{&a, &reads_of_a});
    held.add(b, Counted_points{&b, &reads_of_b});
    add_all(free, {&a, &b});
    held.detect();
    for (int frame = 0; frame < 4; ++frame) {
      shift(b, frame < 2 ? 0.5 : -0.8);
      reads_of_a = reads_of_b = 0;
      const auto hold = held.hold_positions();
      expect_same_answers(held, free, 0, 1);
      expect_same_answers(held, free, 1, 0);
      EXPECT_EQ(reads_of_a, num_vertices(a));
      EXPECT_EQ(reads_of_b, num_vertices(b));
      EXPECT_EQ(held.detect().statistics.vertices_read, 0U);
    }
    reads_of_a = reads_of_b = 0;
    held.closest(0, 1);
    held.closest(0, 1);
    EXPECT_EQ(reads_of_a, 2 * num_vertices(a));
  }
}

TEST(Held_positions, an_object_with_bounds_is_read_where_it_is_looked_at) {
  Certified_scene scene, same;
  Detector<> held({.mode = Mode::certified}), free({.mode = Mode::certified});
  scene.add_to(held);
  same.add_to(free);
  for (int frame = 0; frame < 3; ++frame) {
    for (auto* moved : {&scene, &same}) bend(moved->upper_points, 0.3 * frame, {0.2, 0, 0});
    const auto hold = held.hold_positions();
    expect_same_answers(held, free, 0, 1);
    expect_same_answers(held, free, 1, 3);
  }
}

TEST(Held_positions, changes_through_the_detector_are_noticed) {
  auto a = potato(6), b = potato(6, 2), moved = b;
  shift(moved, 1.4);
  const auto c = sphere(4, 0.3);
  const Box_promise promise([](Region_index, const Aabb& rest) { return rest; });
  for (const Mode mode : {Mode::exact, Mode::certified}) {
    Detector<> held({.mode = mode}), free({.mode = mode});
    for (auto* detector : {&held, &free}) add_all(*detector, {&a, &b});
    const auto hold = held.hold_positions();
    const auto change_both = [&](const auto& change) {
      expect_same_answers(held, free, 0, 1);
      for (auto* detector : {&held, &free}) change(*detector);
      expect_same_answers(held, free, 0, 1);
    };
    change_both([&](auto& detector) { detector.place(1, along_x(0.7)); });
    change_both([&](auto& detector) { detector.update(1, positions_of(moved)); });
    change_both([&](auto& detector) { detector.place(1, Eigen::Isometry3d::Identity()); });
    change_both([&](auto& detector) { detector.update(1); });
    change_both([&](auto& detector) { detector.load(1, detector.save(1)); });
    change_both([&](auto& detector) { detector.add(c); });
    change_both([&](auto& detector) { detector.remove(2); });
    if (mode == Mode::certified) change_both([&](auto& detector) { detector.promise(1, promise); });
  }
}

TEST(Held_positions, a_promise_counts_for_an_object_that_has_not_been_posed) {
  const auto a = potato(6), far = sphere(4, 1, {1000, 0, 0});
  auto b = potato(6, 2);
  const Box_promise somewhere([](Region_index, const Aabb&) {
    return Aabb{.low = {-20, -20, -20}, .high = {20, 20, 20}};
  });
  Detector<> detector({.mode = Mode::certified});
  shift(b, 9);
  add_all(detector, {&a, &b, &far});
  detector.promise(1, somewhere);
  EXPECT_FALSE(detector.detect().collides());
  shift(b, -9);
  const auto hold = detector.hold_positions();
  EXPECT_FALSE(detector.within(1, 2, 1));  // looks at no more than what is promised of the whole
  detector.promise(1, somewhere);
  expect_contacts(detector.detect(0, 1), 0, 1, exhaustive_face_pairs(a, b));
}

TEST(Held_positions, an_update_reads_a_moved_mesh) {
  Counted_scene scene;
  const auto hold = scene.detector.hold_positions();
  EXPECT_TRUE(scene.detector.detect().collides());
  shift(scene.b, 9);
  scene.detector.update(1);
  EXPECT_FALSE(scene.detector.detect().collides());
}

TEST(Held_positions, changed_faces_are_noticed) {
  const auto a = potato(6);
  auto b = potato(6, 2);
  for (const bool listed : {false, true}) {
    Detector<> detector({.mode = Mode::exact});
    detector.add(a);
    detector.add(std::as_const(b));
    const auto hold = detector.hold_positions();
    expect_contacts(detector.detect(), 0, 1, exhaustive_face_pairs(a, b));
    const auto edge = *edges(b).begin();
    CGAL::Euler::flip_edge(halfedge(edge, b), b);
    const std::uint32_t faces[] = {static_cast<std::uint32_t>(face(halfedge(edge, b), b)),
                                   static_cast<std::uint32_t>(face(opposite(halfedge(edge, b), b), b))};
    if (listed)
      detector.rebuild(1, Changed_faces{faces});
    else
      detector.rebuild(1);
    expect_contacts(detector.detect(), 0, 1, exhaustive_face_pairs(a, b));
  }
}

TEST(Held_positions, a_mesh_may_move_its_memory) {
  const auto a = potato(6);
  auto b = potato(6, 2);
  Detector<> held({.mode = Mode::exact}), free({.mode = Mode::exact});
  for (auto* detector : {&held, &free}) {
    detector->add(a);
    detector->add(std::as_const(b));
  }
  const auto hold = held.hold_positions();
  expect_same_answers(held, free, 0, 1);
  b.reserve(100'000, 300'000, 200'000);
  expect_same_answers(held, free, 0, 1);
}

TEST(Held_positions, a_mesh_with_other_numbers_is_refused) {
  const auto a = potato(6);
  auto b = potato(6, 2);
  Detector<> detector({.mode = Mode::exact});
  detector.add(a);
  detector.add(std::as_const(b));
  const auto hold = detector.hold_positions();
  detector.detect();
  b.add_vertex(Point(0, 0, 0));
  EXPECT_THROW(detector.detect(), Bad_mesh);
  EXPECT_THROW(detector.closest(0, 1), Bad_mesh);
}

TEST(Held_positions, an_error_is_thrown_again) {
  const auto a = potato(6);
  auto b = potato(6, 2);
  Detector<> detector({.mode = Mode::exact});
  detector.add(a);
  detector.add(std::as_const(b));
  const auto good = b.point(Surface_mesh::Vertex_index(3));
  b.point(Surface_mesh::Vertex_index(3)) = Point(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  {
    const auto hold = detector.hold_positions();
    EXPECT_THROW(detector.detect(), Bad_mesh);
    EXPECT_THROW(detector.closest(0, 1), Bad_mesh);
  }
  b.point(Surface_mesh::Vertex_index(3)) = good;
  const auto hold = detector.hold_positions();
  expect_contacts(detector.detect(), 0, 1, exhaustive_face_pairs(a, b));
}

TEST(Held_positions, a_broken_bound_hides_nothing_from_later_queries) {
  const auto a = potato(6), b = potato(6, 2);
  const auto between = [](double low, double high) {
    return Box_promise([=](Region_index, const Aabb&) { return Aabb{.low = {low, -9, -9}, .high = {high, 9, 9}}; });
  };
  const Box_promise left = between(-3, -2), right = between(2, 3);  // together nowhere
  const Ray ray{.origin = {-9, 0.1, 0.1}, .direction = {1, 0, 0}};
  for (const bool is_held : {false, true}) {
    Detector<> detector({.mode = Mode::certified}), exact({.mode = Mode::exact});
    for (auto* either : {&detector, &exact}) add_all(*either, {&a, &b});
    detector.promise(0, left);
    detector.promise(0, right);
    detector.detect();
    std::optional<Held_positions> held;
    if (is_held) held.emplace(detector.hold_positions());
    EXPECT_EQ(detector.first_hit(ray)->object, exact.first_hit(ray)->object);
    EXPECT_EQ(detector.first_hit(ray)->hit.t, exact.first_hit(ray)->hit.t);
    expect_contacts(detector.detect(), 0, 1, exhaustive_face_pairs(a, b));
  }
  Detector<> strict({.mode = Mode::certified, .exact = {.throw_if_broken = true}});
  add_all(strict, {&a, &b});
  strict.promise(0, left);
  strict.promise(0, right);
  EXPECT_THROW(strict.detect(), Broken_bound);
  EXPECT_THROW(strict.detect(), Broken_bound);
  EXPECT_THROW(strict.first_hit(ray), Broken_bound);
}

TEST(Held_positions, promises_may_overlap_and_follow_each_other) {
  Counted_scene scene;
  auto& detector = scene.detector;
  const auto reads_of = [&](const auto& ask) {
    scene.reads = 0;
    ask();
    return scene.reads / num_vertices(scene.b);
  };
  const auto detect = [&] { detector.detect(); };
  std::optional<Held_positions> first, second;
  first.emplace(detector.hold_positions());
  detect();
  second.emplace(detector.hold_positions());
  EXPECT_EQ(reads_of(detect), 0U);
  first.reset();
  EXPECT_EQ(reads_of(detect), 0U);
  second.reset();
  EXPECT_EQ(reads_of(detect), 1U);
  first.emplace(detector.hold_positions());
  EXPECT_EQ(reads_of(detect), 1U);
  EXPECT_EQ(reads_of(detect), 0U);
}

TEST(Held_positions, may_outlive_the_detector) {
  auto detector = std::make_unique<Detector<>>(Detector_options{.mode = Mode::exact});
  const auto hold = detector->hold_positions();
  detector.reset();
}

TEST(Held_positions, mode_particles_has_none) {
  Detector<> detector({.mode = Mode::particles});
  EXPECT_THROW((void)detector.hold_positions(), Bad_argument);
}

}  // namespace
}  // namespace lodestone
