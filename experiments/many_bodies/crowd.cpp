// SPDX-License-Identifier: GPL-3.0-or-later
#include "many_bodies/crowd.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "lodestone/io/shapes/shapes.h"
#include "lodestone/mesh/errors.h"
#include "shared/made_object.h"

namespace lodestone {

namespace {

constexpr double reach = 1.5, others_within_reach = 1.3;  // of a body
constexpr double frames_per_path = 240;

/// The probability that two points of the unit cube, placed at random, are nearer than `t` <= 1: the integral of the
/// density of their distance (cube line picking).
double share_within(double t) {
  const double t3 = t * t * t;
  return t3 * (4 * std::numbers::pi / 3 - t * (1.5 * std::numbers::pi - t * (1.6 - t / 6)));
}

/// Draws that are the same with any standard library.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}

  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  Eigen::Vector3d in_cube(double half) {
    const double x = between(-half, half), y = between(-half, half), z = between(-half, half);
    return {x, y, z};
  }
  /// All directions are equally likely.
  Eigen::Vector3d direction() {
    const double z = between(-1, 1), angle = between(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }

 private:
  std::mt19937_64 random_;
};

struct Body_shape {
  const char* name;
  Surface_mesh mesh;
  double smallest, largest;  ///< factors of scale
};

std::vector<Body_shape> body_shapes() {
  std::vector<Body_shape> shapes;
  for (const auto& [frequency, segments, sides] :
       std::to_array<std::array<std::size_t, 3>>({{8, 100, 8}, {11, 140, 10}, {13, 160, 12}, {15, 200, 12}})) {
    shapes.push_back({"sphere", icosphere(frequency), 0.6, 1});
    shapes.push_back({"knot", torus_knot({.segments = segments, .sides = sides}), 0.5, 0.65});
  }
  return shapes;
}

Surface_mesh placed(Surface_mesh mesh, const Eigen::Matrix3d& linear) {
  for (auto& point : mesh.points()) {
    const Eigen::Vector3d p = linear * Eigen::Vector3d(point.x(), point.y(), point.z());
    point = Point(p.x(), p.y(), p.z());
  }
  return mesh;
}

/// Back into the cube, as a ray of light off a mirror.
double reflected(double x, double half) { return x > half ? 2 * half - x : x < -half ? -2 * half - x : x; }

Kernel::Vector_3 vector(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// Three places near each other. Each of them alone is anywhere in the cube with equal probability.
Travel path(Draw& draw, double half) {
  constexpr double stroll = 1;  // per way point and coordinate, at most
  const Eigen::Vector3d home = draw.in_cube(half);
  Travel travel{.way_points = {}, .path = Path::closed};
  for (const double start : {0.0, 1.0, 2.0}) {
    const Eigen::Vector3d place = (home + draw.in_cube(stroll)).unaryExpr([&](double x) { return reflected(x, half); });
    travel.way_points.push_back({.frame = start * frames_per_path / 3, .at = vector(place)});
  }
  travel.way_points.push_back({.frame = frames_per_path, .at = travel.way_points.front().at});
  return travel;
}

Scene_object body(std::size_t number, const Body_shape& shape, Draw& draw, double half) {
  const double scale = draw.between(shape.smallest, shape.largest);
  const Eigen::Vector3d axis = draw.direction();
  const Eigen::AngleAxisd turn(draw.between(0, 2 * std::numbers::pi), axis);
  const Wobble wobble{.amplitude = draw.between(0.04, 0.06),
                      .waves = 1,
                      .period = std::round(draw.between(60, 80)),
                      .phase = draw.between(0, 1)};
  const Spin spin{.axis = vector(draw.direction()), .degrees_per_frame = 0.8};
  return made_object(fmt::format("{}_{}", shape.name, number), placed(shape.mesh, scale * turn.toRotationMatrix()),
                     {wobble, spin, path(draw, half)});
}

}  // namespace

double side_of_crowd(std::size_t bodies) {
  if (bodies < 3) throw Bad_argument(fmt::format("a crowd has at least 3 bodies, not {}", bodies));
  const double wanted = others_within_reach / static_cast<double>(bodies - 1);
  double few = 0, many = 1;  // reach / side; the share grows with it
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = (few + many) / 2;
    (share_within(middle) < wanted ? few : many) = middle;
  }
  return reach / many;
}

Scene crowd(std::size_t bodies, std::size_t frames) {
  const double half = side_of_crowd(bodies) / 2;
  const auto shapes = body_shapes();
  Draw draw(bodies);
  Scene scene;
  scene.name = fmt::format("{} bodies", bodies);
  scene.frames = frames;
  for (std::size_t b = 0; b < bodies; ++b) scene.objects.push_back(body(b, shapes[b % shapes.size()], draw, half));
  return scene;
}

}  // namespace lodestone
