// SPDX-License-Identifier: GPL-3.0-or-later
// What every model of Motion_bound guarantees: boxes that hold each vertex where it is computed to be, in any pose.
#include "lodestone/bounds/motion_bound.h"

#include <cmath>
#include <future>

#include "bounds/given_object.h"
#include "detection/certified_scene.h"
#include "lodestone/bounds/box_promise.h"
#include "lodestone/bounds/displacement_bound.h"
#include "lodestone/bounds/lipschitz_bound.h"
#include "lodestone/bounds/own_bound.h"
#include "lodestone/bounds/placed_bound.h"
#include "lodestone/bounds/stretch_bound.h"
#include "lodestone/io/motion/computed_motion.h"
#include "lodestone/io/motion/deformation.h"
#include "support/special_numbers.h"

namespace lodestone {
namespace {

/// A body writes the positions of a pose to its object, as they are computed, and promises something about them. An
/// affine map takes the rest to the pose, so that bodies of all models but the last are alike; pose 0 is the rest.
struct Affine_body {
  Given_object& object;
  void pose(const Eigen::Affine3d& map, unsigned /*number*/) {
    object.pose([&](const Eigen::Vector3d& p) { return Eigen::Vector3d(map * p); });
  }
};
/// Morph targets, one for each number of a 3 x 4 matrix.
Morphed_points affine_targets(const Given_object& object) {
  std::vector<Morph_target> targets(12);
  for (std::uint32_t v = 0; v < object.vertex_count(); ++v)
    for (std::size_t i = 0; i < 36; ++i)
      targets[i / 3].offsets.push_back(i % 3 != i / 12 ? 0 : i / 3 % 4 < 3 ? object.at_rest(v)[i / 3 % 4] : 1);
  return Morphed_points(object.rest.coordinates, targets);
}
void morph(auto& points, const Eigen::Affine3d& map) {
  const Eigen::Matrix<double, 3, 4, Eigen::RowMajor> weights = map.affine() - Eigen::Matrix<double, 3, 4>::Identity();
  points.set_weights({weights.data(), 12});
}
struct Linear_body : Affine_body {
  Morphed_points points = affine_targets(object);
  void pose(const Eigen::Affine3d& map, unsigned /*number*/) {
    morph(points, map);
    points.pose_all(object.now);
  }
  auto bound(const Bounded_object& of) const { return own_bound(points, of); }
};
/// Three joints turn before the map is applied. It is also applied by morphing, where there is any.
template <bool morphed>
struct Skin_body : Affine_body {
  Skinned_points points = skinned(morphed ? affine_targets(object) : Morphed_points(object.rest.coordinates));
  static Skinned_points skinned(Morphed_points shape) {
    std::vector<std::uint32_t> joints;
    std::vector<double> weights;
    for (std::uint32_t i = 0; i < 3 * shape.vertex_count(); joints.push_back(i++ % 3))
      weights.push_back(1 + std::sin(i));
    return {std::move(shape), Joint_influences::of(3, joints, weights), 3};
  }
  void pose(const Eigen::Affine3d& map, unsigned number) {
    std::vector<Eigen::Affine3d> joints;
    for (const double angle : {0.0, 0.3, -0.4})
      joints.push_back(map * Eigen::AngleAxisd(number == 0 ? 0 : angle, Eigen::Vector3d(0.6, 0, 0.8)));
    points.set_joints(joints);
    if (morphed) morph(points, map);
    points.pose_all(object.now);
  }
  auto bound(const Bounded_object& of) const { return own_bound(points, of); }
};
template <class Promise, auto set>
struct Distance_body : Affine_body {
  Promise promise{1};
  void pose(const Eigen::Affine3d& map, unsigned number) {
    Affine_body::pose(map, number);
    const auto& rest = object.rest.coordinates;
    const double farthest = std::max(std::abs(std::ranges::min(rest)), std::ranges::max(rest));
    const Eigen::Matrix<double, 3, 4> rounding = 0x1p-49 * map.affine();
    (promise.*set)((1 + 1e-13) * Eigen::JacobiSVD<Eigen::Matrix3d>(map.linear()).singularValues()[0],
                   rounding.leftCols<3>().lpNorm<1>() * farthest + rounding.col(3).lpNorm<1>() + 0x1p-1070);
  }
  auto bound(const Bounded_object& of) const { return promise.bound(of); }
};
/// Tells octants apart, unless all is one region. In a frame, vertices are turned after they have moved.
template <bool in_frame>
struct Displacement_body : Affine_body {
  Displacement_promise promise{object.labels.empty() ? std::size_t{1} : 8};
  std::vector<double> unturned = {};
  bool turned = false;
  void pose(const Eigen::Affine3d& map, unsigned number) {
    const auto before = turned ? unturned : object.now;
    Affine_body::pose(map, number);
    unturned = object.now;
    std::vector<double> moved(promise.region_count(), 0);
    for (std::uint32_t v = 0; v < object.vertex_count(); ++v) {
      double& most = moved[object.labels.empty() ? 0 : object.labels[v]];
      const double by = (object.at(unturned, v) - object.at(before, v)).lpNorm<1>() * (1 + 0x1p-50);
      most = std::min(std::max(most, by), std::numeric_limits<double>::max());
    }
    turned = in_frame && number > 0;
    if (!in_frame) return promise.move(moved);
    std::mt19937_64 random(number);
    const auto frame = turned ? random_frame(random, 10) : Eigen::Isometry3d::Identity();
    for (std::uint32_t v = 0; v < object.vertex_count(); ++v) object.put(v, frame * object.at(unturned, v));
    promise.move(moved, frame);
  }
  auto bound(const Bounded_object& of) const { return promise.bound(of); }
};
struct Boxes_body : Affine_body {
  Eigen::Affine3d now = Eigen::Affine3d::Identity();
  Box_promise promise{[this](auto, const Aabb& rest) { return placed_box(now.linear(), now.translation(), rest); }};
  void pose(const Eigen::Affine3d& map, unsigned number) {
    now = map;
    Affine_body::pose(map, number);
  }
  auto bound(const Bounded_object& of) const { return promise.bound(of); }
};
/// Deformed_points as a placed Computed_motion. Not affine: it grows, goes far away, and overflows in frame 4000.
struct Motion_body : Affine_body {
  std::unique_ptr<Computed_motion> motion = [this] {
    std::vector<Point> rest;
    std::vector<std::uint32_t> all;
    for (std::uint32_t v = 0; v < object.vertex_count(); all.push_back(v++)) rest.push_back(object.rest.point(v));
    const Travel far{.way_points = {{0, {0, 0, 0}}, {40, {1e9, 3, 0}}, {999, {1e9, 3, 0}}, {4000, {1.7e308, 0, 0}}},
                     .path = Path::linear};
    const std::vector<Deformation> moves{Twist{}, Inflate{.factor = 50, .frames = 30}, Spin{}, far, far};
    return placed(deform(rest, moves).computed(all), {1, 0.25, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0});
  }();
  void pose(const Eigen::Affine3d& /*map*/, unsigned number) {
    motion->set_frame(4 * number);
    motion->pose_all(object.now);
  }
  auto bound(const Bounded_object& of) const { return motion->bound(of); }
};

/// How many coordinates lie outside the box of a node that has them. An axis must be finite, or open on both sides.
std::size_t lost(const std::vector<Aabb>& boxes, const Given_object& object) {
  std::size_t count = 0;
  for (std::uint32_t node = 0; node < boxes.size(); ++node)
    for (auto leaf = object.layout.node(node).leaf; leaf < object.layout.node(node).end_leaf; ++leaf)
      for (const std::size_t v : object.layout.vertices(leaf))
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double x = object.now[3 * v + axis], low = boxes[node].low[axis], high = boxes[node].high[axis];
          const bool inside = std::isfinite(low) && low <= x && x <= high && std::isfinite(high);
          count += inside || (low == -infinity && high == infinity) ? 0 : 1;
        }
  return count;
}
std::vector<Aabb> boxes_of(const auto& bound) {
  std::vector<Aabb> boxes;
  for (std::uint32_t node = 0; node < bound.node_count(); ++node) boxes.push_back(bound.box(node));
  return boxes;
}

/// Points, of which one is alone in a leaf; a straight line, on which boxes have nothing to spare; a closed surface.
std::vector<Face_soup> rest_bodies() {
  Face_soup points(potato(2)), line(grid(41, 2)), round(potato(4));
  for (auto& [a, b, c] : points.faces) b = c = a;
  points.faces.pop_back();
  deform(line, [](const Point& p) { return Point(p.x(), 0, 0); });
  return {points, line, round, placed(round, 1, 0x1p30), placed(round, 0x1p-600), placed(round, 0x1p40)};
}
std::vector<Eigen::Affine3d> affine_poses() {
  std::mt19937_64 random(5);
  std::vector<Eigen::Affine3d> poses{Eigen::Affine3d::Identity(), Eigen::Affine3d(Eigen::Translation3d(0.25, 0, 0))};
  for (const double far : {1.0, 1e9, 1e15}) poses.emplace_back(random_frame(random, far));
  for (const double x : {2.0, -1.0, 0x1p40, 0x1p-40, 0x1p-600, 0.0}) poses.emplace_back(Eigen::Scaling(x));
  for (const double x : {0.0, 7.0, 1e-3, 1e3})
    poses.emplace_back(random_frame(random, 3) * Eigen::Scaling(x, 0.5, -2.0) * random_frame(random, 9));
  return poses;
}

template <class Body>
struct Motion_bound_contract : testing::Test {};
using Bodies = testing::Types<Linear_body, Skin_body<false>, Skin_body<true>,
                              Distance_body<Lipschitz_promise, &Lipschitz_promise::set_constant>,
                              Distance_body<Stretch_promise, &Stretch_promise::set_stretch>, Displacement_body<false>,
                              Displacement_body<true>, Boxes_body, Motion_body>;
TYPED_TEST_SUITE(Motion_bound_contract, Bodies);

TYPED_TEST(Motion_bound_contract, boxes_hold_every_vertex_in_every_pose_and_change_only_with_it) {
  double least = infinity;
  for (const auto& soup : rest_bodies())
    for (const std::size_t leaf_faces : {2, 12}) {
      Given_object object(soup, leaf_faces, octants(soup));
      TypeParam body{object};
      auto bound = body.bound(object.bounded());
      ASSERT_EQ(bound.node_count(), object.layout.node_count());
      for (unsigned number = 0; number < affine_poses().size(); ++number) {
        SCOPED_TRACE(testing::Message() << soup.coordinates[0] << ", " << leaf_faces << " faces, pose " << number);
        body.pose(affine_poses()[number], number);
        const auto boxes = boxes_of(bound);
        ASSERT_EQ(lost(boxes, object), 0U);
        auto others = std::async(std::launch::async, [&] { return boxes_of(bound); });
        EXPECT_TRUE(boxes_of(bound) == boxes && others.get() == boxes);
        if (number == 0) least = std::min(least, boxes[0].extent() / object.fitted_node(0).extent());
        for (auto leaf = number % 3; leaf < object.layout.leaf_count(); leaf += 3)
          if constexpr (Watching_bound<decltype(bound)>) {  // may have smaller boxes afterwards
            EXPECT_TRUE(bound.note_read(leaf, object.fitted(leaf), object.now));
          }
        ASSERT_EQ(lost(boxes_of(bound), object), 0U);
      }
    }
  EXPECT_LT(least, 9);  // at rest, of the tightest body: a box around everything would tell nothing
}

TYPED_TEST(Motion_bound_contract, an_axis_that_overflows_is_open_and_positions_that_do_are_refused) {
  Given_object object(potato(4), 6, octants(potato(4)));
  TypeParam body{object};
  auto bound = body.bound(object.bounded());
  body.pose(Eigen::Translation3d(1e308, 1e308, 1e308) * Eigen::Scaling(1e308), 1000);
  EXPECT_EQ(lost(boxes_of(bound), object), 0U);
  EXPECT_EQ(bound.box(0).high[0], infinity);
  EXPECT_THROW(object.surface(bound)->settle(), Bad_mesh);
}

/// A vertex leaves its boxes where two bodies overlap, so it is read and noticed. A wrong box where nothing is read
/// goes unnoticed.
TYPED_TEST(Motion_bound_contract, a_vertex_outside_is_noticed_where_it_is_read_and_answers_are_those_of_mode_exact) {
  Surface_mesh a = potato(20, 1), b = potato(12, 2);
  shift(b, 3.1);
  Given_object object(a);
  TypeParam body{object};
  Detector exact(in_mode(Mode::exact, {})), certified(in_mode(Mode::certified, {}));
  for (auto* detector : {&exact, &certified}) detector->add(std::as_const(a)), detector->add(std::as_const(b));
  certified.promise(0, body);
  const auto expect_violations = [&](bool broken) {
    const double* x = object.now.data();
    for (const auto v : a.vertices()) a.point(v) = Point(x[3 * v], x[3 * v + 1], x[3 * v + 2]);
    const Frame &found = certified.detect(), &truth = exact.detect();
    expect_same_answers(found, truth, 2);
    EXPECT_EQ(found.statistics.violations > 0, broken);
    return truth.face_pairs;
  };
  std::vector<Face_pair> pairs;
  for (const unsigned number : {0U, 1U, 0U}) {
    body.pose(affine_poses()[number], number);
    pairs = expect_violations(false);
  }
  ASSERT_FALSE(pairs.empty());
  const std::uint32_t vertex = object.rest.faces[pairs[0].a][0];
  object.put(vertex, object.positions(vertex) + Eigen::Vector3d(0, 0, 100));
  expect_violations(true);
  body.pose(Eigen::Affine3d::Identity(), 0);
  expect_violations(false);
}

}  // namespace
}  // namespace lodestone
