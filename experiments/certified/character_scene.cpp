// SPDX-License-Identifier: GPL-3.0-or-later
#include "certified/character_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "lodestone/detector.h"
#include "lodestone/io/shapes/shapes.h"
#include "lodestone/mesh/box.h"
#include "lodestone/mesh/computed_points.h"

namespace lodestone {

namespace {

constexpr double deepest = 0.006;  ///< of the size
constexpr double waves = 5;        ///< of depth, over the animation

Box box_of(const Skinned_points& points) {
  std::vector<double> coordinates(3 * std::size_t{points.vertex_count()});
  points.pose_all(coordinates);
  Box box;
  for (std::size_t i = 0; i < coordinates.size(); i += 3)
    box.extend(Eigen::Vector3d(coordinates[i], coordinates[i + 1], coordinates[i + 2]));
  return box;
}

/// Finds how far the second of two characters can come along -x until it meets the first.
class Approach {
 public:
  Approach(const Character& first, const Character& second)
      : first_points_(first.points), second_points_(second.points) {
    detector_.add(first.mesh, point_map(first.mesh, first_points_));
    detector_.add(second.mesh, point_map(second.mesh, second_points_));
  }

  /// The x of the second at their first contact. Each step is as long as the two are apart, so it skips no contact.
  double meeting(const Skin_pose& first, const Skin_pose& second) {
    first.give_to(first_points_);
    second.give_to(second_points_);
    const Box a = box_of(first_points_), b = box_of(second_points_);
    const double size = a.diagonal().norm();
    double x = a.max().x() - b.min().x() + 0.01 * size;
    for (int step = 0; step < 10'000; ++step) {
      second.placed(Eigen::Affine3d(Eigen::Translation3d(x, 0, 0))).give_to(second_points_);
      const double apart = detector_.closest(0, 1).points.distance;
      if (apart < 1e-6 * size) return x;
      x -= apart;
    }
    return x;
  }

 private:
  Skinned_points first_points_, second_points_;
  Detector<> detector_;
};

/// A knot whose ends along z follow one joint each.
Character knot(const std::string& name, const Torus_knot_options& options) {
  Surface_mesh mesh = torus_knot(options);
  std::vector<double> rest, weights;
  std::vector<std::uint32_t> joints;
  for (const Point& p : mesh.points()) {
    rest.insert(rest.end(), {p.x(), p.y(), p.z()});
    const double share = std::clamp(0.5 + p.x() / 3, 0.0, 1.0);
    joints.insert(joints.end(), {0, 1});
    weights.insert(weights.end(), {1 - share, share});
  }
  return {.name = name, .mesh = std::move(mesh), .points = {rest, Joint_influences::of(2, joints, weights), 2}};
}

Skin_pose bent(double angle, const Eigen::Vector3d& axis, const Eigen::Affine3d& placement) {
  return {.joints = {placement * Eigen::AngleAxisd(-angle, axis), placement * Eigen::AngleAxisd(angle, axis)},
          .weights = {}};
}

}  // namespace

Character_scene touching(std::string name, const Character& first, const Character& second, double aside) {
  Character_scene scene{.name = std::move(name), .characters = {first, second}};
  Approach approach(first, second);
  const std::size_t frames = std::min(first.animation.size(), second.animation.size());
  const double size = box_of(first.points).diagonal().norm();
  const Eigen::Affine3d facing = Eigen::Translation3d(0, aside, 0) *
                                 Eigen::Affine3d(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ()));
  for (std::size_t frame = 0; frame < frames; ++frame) {
    const Skin_pose& a = first.animation[frame];
    const Skin_pose b = second.animation[(frame + frames / 2) % frames].placed(facing);
    const double wave =
        std::sin(2 * std::numbers::pi * waves * (static_cast<double>(frame) + 0.5) / static_cast<double>(frames));
    const double x = approach.meeting(a, b) + deepest * size * wave;
    scene.frames.push_back({a, b.placed(Eigen::Affine3d(Eigen::Translation3d(x, 0, 0)))});
  }
  return scene;
}

Character_scene knots_through_each_other() {
  Character_scene scene{
      .name = "knots",
      .characters = {knot("trefoil", {.p = 2, .q = 3, .segments = 120, .sides = 10}),
                     knot("cinquefoil", {.p = 2, .q = 5, .tube = 0.15, .segments = 120, .sides = 10})},
      .everything_is_near = true};
  constexpr std::size_t frames = 91;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    const double turn = 2 * std::numbers::pi * static_cast<double>(frame) / frames;
    const Eigen::Affine3d across = Eigen::Translation3d(0.2 * std::sin(turn), 0.1, 0.1 * std::cos(turn)) *
                                   Eigen::Affine3d(Eigen::AngleAxisd(0.4 * std::sin(turn), Eigen::Vector3d::UnitY()));
    scene.frames.push_back({bent(0.2 * std::sin(turn), Eigen::Vector3d::UnitY(), Eigen::Affine3d::Identity()),
                            bent(0.2 * std::cos(turn), Eigen::Vector3d::UnitZ(), across)});
  }
  return scene;
}

Character_scene with_triangles(const Character_scene& scene, std::size_t triangles) {
  const auto fine = [&](const Character& character) { return subdivided(character, parts_for(character, triangles)); };
  return {.name = scene.name,
          .characters = {fine(scene.characters[0]), fine(scene.characters[1])},
          .frames = scene.frames,
          .everything_is_near = scene.everything_is_near};
}

}  // namespace lodestone
