// SPDX-License-Identifier: GPL-3.0-or-later
// Rays among several objects: what they meet first is what they meet first of one mesh that is made of all of them.
#include <gtest/gtest.h>

#include <deque>
#include <numeric>
#include <random>

#include "detection/certified_scene.h"

namespace lodestone {
namespace {

/// Meshes as objects, and all of them as one mesh.
class Scene_of_rays {
 public:
  void add(const Surface_mesh& mesh) {
    first_faces_.push_back(static_cast<std::uint32_t>(whole_.number_of_faces()));
    whole_ += mesh;
    meshes_.push_back(mesh);
  }
  void add_to(Detector<>& detector) const {
    for (const auto& mesh : meshes_) detector.add(mesh);
  }

  /// Compares the answers of a detector that has only these objects.
  /// @return how many rays meet something
  std::size_t expect_first_of_whole(Detector<>& detector, std::span<const Ray> rays) const {
    Exact_detector truth;
    truth.add(whole_);
    const auto found = detector.first_hits(rays);
    EXPECT_EQ(found.size(), rays.size());
    std::size_t hits = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const auto expected = truth.first_hit(0, rays[i]);
      const auto alone = detector.first_hit(rays[i]);
      for (const auto& hit : {found[i], alone}) {
        EXPECT_EQ(hit.has_value(), expected.has_value()) << "ray " << i;
        if (!hit || !expected) continue;
        EXPECT_EQ(first_faces_.at(hit->object) + hit->hit.face, expected->face) << "ray " << i;
        EXPECT_EQ(hit->hit.t, expected->t);
        EXPECT_EQ(hit->hit.point, expected->point);
      }
      hits += expected ? 1 : 0;
    }
    return hits;
  }

 private:
  std::deque<Surface_mesh> meshes_;
  Surface_mesh whole_;
  std::vector<std::uint32_t> first_faces_;  ///< of each mesh, in the whole
};

std::vector<Ray> rays_through(double size, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> number(-size, size);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    rays.push_back({.origin = {number(random), number(random), number(random)},
                    .direction = {number(random), number(random), number(random)}});
    if (i % 5 == 0) rays.back().direction[static_cast<Eigen::Index>(i % 3)] = 0;
    if (i % 7 == 0) rays.back().length = 0.5;
  }
  return rays;
}

TEST(Object_hits, are_those_of_one_mesh_of_all_objects) {
  Scene_of_rays scene;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> number(-3, 3);
  for (std::uint64_t i = 0; i < 12; ++i) {
    auto mesh = potato(2 + static_cast<int>(i % 5), i);
    const Kernel::Vector_3 shift(number(random), number(random), number(random));
    deform(mesh, [&](const Point& p) { return p + shift; });
    scene.add(mesh);
  }
  for (const Mode mode : {Mode::exact, Mode::certified})
    for (const std::size_t threads : {1, 3}) {
      Detector<> detector({.mode = mode, .threads = threads});
      scene.add_to(detector);
      EXPECT_GT(scene.expect_first_of_whole(detector, rays_through(4, 400, 1)), 100U);
      EXPECT_GT(scene.expect_first_of_whole(detector, rays_through(4, 400, 2)), 100U) << "by trees for rays";
    }
}

TEST(Object_hits, at_the_same_place_are_of_the_lowest_object) {
  Scene_of_rays scene;
  const auto round = potato(3, 5);
  auto shifted = round;  // by so little that doubles hardly tell which face comes first
  deform(shifted, [](const Point& p) { return Point(p.x() + 1e-12, p.y(), p.z()); });
  for (const auto& mesh : {shifted, round, shifted, round, sphere(4)}) scene.add(mesh);
  Exact_detector detector;
  scene.add_to(detector);
  auto rays = rays_through(1.2, 300, 4);
  for (const auto v : vertices(round)) {  // through corners, which belong to several faces of each
    const Point& p = round.point(v);
    rays.push_back({.origin = {4, 0, 0}, .direction = {p.x() - 4, p.y(), p.z()}});
  }
  EXPECT_GT(scene.expect_first_of_whole(detector, rays), 150U);
}

/// A triangle across the x axis, at a place.
Surface_mesh tile(double x, double size) {
  Surface_mesh mesh;
  mesh.add_face(mesh.add_vertex({x, -size, -size}), mesh.add_vertex({x, 2 * size, -size}),
                mesh.add_vertex({x, -size, 2 * size}));
  return mesh;
}

TEST(Object_hits, are_in_exact_order_where_t_is_not) {
  // A t that is below the least double, below the least normal one, or beyond the largest.
  struct Case {
    double place, direction;
  };
  for (const auto& [place, direction] : {Case{1e-200, 1e200}, Case{1e-150, 1e160}, Case{1e200, 1e-200}, Case{1, 1}}) {
    SCOPED_TRACE(place);
    Scene_of_rays scene;
    for (const double factor : {4.0, 2.0, 3.0, 2.0}) scene.add(tile(factor * place, place));
    scene.add(tile(std::nextafter(2 * place, 0), place));
    Exact_detector detector;
    scene.add_to(detector);
    const Ray ray{.direction = {direction, 0, 0}};
    EXPECT_EQ(scene.expect_first_of_whole(detector, {&ray, 1}), 1U);
    EXPECT_EQ(detector.first_hit(ray)->object, 4U);
  }
}

TEST(Object_hits, at_the_same_place_are_of_the_lowest_object_whichever_is_asked_first) {
  // Of two objects the one whose middle is lower is asked first.
  for (const auto& [size, other_size] : {std::pair{3.0, 1.0}, {1.0, 3.0}}) {
    Scene_of_rays scene;
    scene.add(tile(2, size));
    scene.add(tile(2, other_size));
    Exact_detector detector;
    scene.add_to(detector);
    const Ray ray{.direction = {1, 0, 0}};
    EXPECT_EQ(scene.expect_first_of_whole(detector, {&ray, 1}), 1U);
    EXPECT_EQ(detector.first_hit(ray)->object, 0U);
  }
}

TEST(Object_hits, follow_the_objects) {
  Surface_mesh near = tile(1, 1), far = tile(2, 1);
  Exact_detector detector;
  detector.add(near), detector.add(far);
  const Ray ray{.direction = {1, 0, 0}};
  EXPECT_EQ(detector.first_hit(ray)->object, 0U);
  deform(far, [](const Point& p) { return Point(p.x() - 1.5, p.y(), p.z()); });
  EXPECT_EQ(detector.first_hit(ray)->object, 1U);
  EXPECT_EQ(detector.first_hit(ray)->hit.t, 0.5);
  detector.place(0, Eigen::Isometry3d(Eigen::Translation3d(-0.75, 0, 0)));
  EXPECT_EQ(detector.first_hit(ray)->object, 0U);
  detector.ignore(0, 1);  // is about collisions
  EXPECT_EQ(detector.first_hit(ray)->hit.t, 0.25);
  detector.remove(0);
  EXPECT_EQ(detector.first_hit(ray)->object, 1U);
  detector.remove(1);
  EXPECT_FALSE(detector.first_hit(ray).has_value());
}

TEST(Object_hits, among_some_objects_are_theirs) {
  std::deque<Surface_mesh> tiles;
  Exact_detector detector;
  for (int i = 1; i <= 5; ++i) detector.add(tiles.emplace_back(tile(i, 1)));
  const Ray ray{.direction = {1, 0, 0}}, back{.direction = {-1, 0, 0}};
  const auto first_among = [&](const std::vector<Object_id>& objects) { return detector.first_hit(objects, ray); };
  EXPECT_EQ(first_among({4, 2, 3, 2})->object, 2U);
  EXPECT_EQ(first_among({3})->hit.t, 4);
  EXPECT_FALSE(first_among({}).has_value());
  const std::vector<Object_id> last{4, 3};
  const auto hits = detector.first_hits(last, std::vector{back, ray});
  ASSERT_EQ(hits.size(), 2U);
  EXPECT_FALSE(hits[0].has_value());
  EXPECT_EQ(hits[1]->object, 3U);
  EXPECT_TRUE(detector.first_hits(last, {}).empty());
  EXPECT_TRUE(detector.first_hits(std::span<const Ray>()).empty());
}

TEST(Object_hits, of_objects_with_bounds_pose_only_what_may_be_first) {
  Surface_mesh near = long_body(30, 1), far = long_body(30, 2);
  deform(far, [](const Point& p) { return Point(p.x(), p.y() - 5, p.z()); });
  Skinned_points near_points = limb(near), far_points = limb(far);
  Detector<> certified({.mode = Mode::certified}), exact({.mode = Mode::exact});
  for (auto* detector : {&certified, &exact})
    detector->add(near, point_map(near, near_points)), detector->add(far, point_map(far, far_points));
  certified.detect();
  for (const double angle : {0.2, 0.4}) {
    bend(near_points, angle, {0, 0, 0});
    bend(far_points, -angle, {0, 0, 0});
    const Ray ray{.origin = {-1.2, 9, 0.1}, .direction = {0, -1, 0}};
    const auto hit = certified.first_hit(ray), truth = exact.first_hit(ray);
    ASSERT_TRUE(hit && truth);
    EXPECT_EQ(hit->object, 0U);
    EXPECT_EQ(hit->hit.face, truth->hit.face);
    EXPECT_EQ(hit->hit.t, truth->hit.t);
    EXPECT_GT(certified.bounded(0)->vertices_posed(), 0U);
    EXPECT_LT(certified.bounded(0)->vertices_posed(), near.number_of_vertices() / 8);
    EXPECT_EQ(certified.bounded(1)->vertices_posed(), 0U) << "lies behind";
  }
}

TEST(Object_hits, need_objects_a_mode_with_trees_and_rays) {
  const auto mesh = sphere(4);
  Exact_detector detector;
  detector.add(mesh);
  const std::vector<Object_id> none{1};
  EXPECT_THROW(detector.first_hit(none, {}), Bad_argument);
  EXPECT_THROW(detector.first_hit(Ray{.direction = {0, 0, 0}}), Bad_argument);
  EXPECT_THROW(detector.first_hit(Ray{.length = -1}), Bad_argument);
  detector.remove(0);
  const std::vector<Object_id> removed{0};
  EXPECT_THROW(detector.first_hit(removed, {}), Bad_argument);
  Detector<> particles({.mode = Mode::particles});
  particles.add(mesh);
  EXPECT_THROW(particles.first_hit(Ray{}), Bad_argument);
}

}  // namespace
}  // namespace lodestone
