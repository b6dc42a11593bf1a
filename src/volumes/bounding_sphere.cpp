// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/volumes/bounding_sphere.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "lodestone/mesh/errors.h"
#include "volumes/ball_kernel.h"
#include "volumes/infinity.h"
#include "volumes/rounded_up.h"
#include "volumes/scale.h"
#include "volumes/support.h"

namespace lodestone {
namespace {

constexpr double most = std::numeric_limits<double>::max();

struct Fit {
  Eigen::Vector3d centre;
  double squared_radius;  ///< squared distance of the farthest vertex, up to rounding
};

/// A ball with at most 1.01 times the smallest radius.
Fit fit(const kernel::Leaf_points& points) {
  constexpr double enough = 1.02;  // < 1.01^2
  constexpr int most_passes = 32;  // more than six are rarely needed
  const auto at = [&](std::size_t index) { return Eigen::Vector3d(points.x[index], points.y[index], points.z[index]); };
  Support support(at(kernel::farthest(points, at(0).data()).index));
  auto farthest = kernel::farthest(points, support.centre().data());
  for (int pass = 0; pass < most_passes && farthest.squared_distance > enough * support.squared_radius(); ++pass) {
    if (!support.add(at(farthest.index))) break;
    farthest = kernel::farthest(points, support.centre().data());
  }
  return {support.centre(), farthest.squared_distance};
}

/// The ball in scaled units, for coordinates whose squared differences overflow or underflow.
void enclose_scaled(kernel::Leaf_points& points, Bounding_sphere& ball) {
  double* const coordinates[]{points.x, points.y, points.z};
  double low[3], high[3], largest_difference = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [lowest, highest] = std::minmax_element(coordinates[axis], coordinates[axis] + points.size);
    low[axis] = *lowest;
    high[axis] = *highest;
    largest_difference = std::max(largest_difference, *highest - *lowest);
  }
  ball = {.centre = {low[0], low[1], low[2]}, .radius = 0};
  if (largest_difference == 0) return;

  const Scale scale(largest_difference);
  kernel::Leaf_points scaled;
  scaled.size = points.size;
  double* const scaled_coordinates[]{scaled.x, scaled.y, scaled.z};
  const auto relate_to = [&](const double* origin) {
    for (int axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < points.size; ++i)
        scaled_coordinates[axis][i] = scale.difference(coordinates[axis][i], origin[axis]);
  };
  relate_to(low);
  const Eigen::Vector3d centre = fit(scaled).centre;
  for (int axis = 0; axis < 3; ++axis)
    ball.centre[axis] = std::clamp(scale.moved(low[axis], centre[axis]), low[axis], high[axis]);
  relate_to(ball.centre);
  const double origin[3]{};
  ball.radius = scale.length_above(above(std::sqrt(kernel::farthest(scaled, origin).squared_distance)));
}

bool all_finite(const kernel::Leaf_points& points) {
  bool finite = true;
  for (std::size_t i = 0; i < points.size; ++i) {
    finite &= std::isfinite(points.x[i]);
    finite &= std::isfinite(points.y[i]);
    finite &= std::isfinite(points.z[i]);
  }
  return finite;
}

/// @param distance  of the centres, or an upper bound of it
bool encloses(const Bounding_sphere& a, const Bounding_sphere& b, double distance) {
  return (distance == 0 ? b.radius : above(distance + b.radius)) <= a.radius;
}

}  // namespace

void Bounding_sphere::enclose(const Leaf_faces& faces) {
  kernel::Leaf_points points;
  if (faces.vertices.size() > points.capacity)
    throw Bad_argument("a leaf has at most 384 vertices, found " + std::to_string(faces.vertices.size()));
  kernel::gather(faces, points);
  const Fit ball = fit(points);
  if (is_ordinary(ball.squared_radius)) {
    // `above` covers six roundings: five of the squared radius and one of the root.
    *this = {.centre = {ball.centre.x(), ball.centre.y(), ball.centre.z()},
             .radius = above(std::sqrt(ball.squared_radius))};
  } else if (all_finite(points)) {
    enclose_scaled(points, *this);
  } else {
    *this = {.centre = {}, .radius = infinity};
  }
}

void Bounding_sphere::enclose(const Bounding_sphere& a, const Bounding_sphere& b) {
  const double distance = distance_above(a.centre, b.centre);
  if (encloses(a, b, distance)) return void(*this = a);
  if (encloses(b, a, distance)) return void(*this = b);

  // Any centre between the two gives a valid ball: the radius is computed from it. Where the radii differ by more than
  // the distance, though rounding kept either ball from enclosing the other, the part would lie beyond them.
  const double part = distance <= most ? std::clamp(((b.radius - a.radius) / distance + 1) / 2, 0.0, 1.0) : 0.5;
  Bounding_sphere both;
  for (int axis = 0; axis < 3; ++axis) both.centre[axis] = (1 - part) * a.centre[axis] + part * b.centre[axis];
  both.radius = above(
      std::max(distance_above(both.centre, a.centre) + a.radius, distance_above(both.centre, b.centre) + b.radius));
  *this = both;
}

double Bounding_sphere::volume() const { return 4 * std::numbers::pi / 3 * radius * radius * radius; }

Aabb Bounding_sphere::bounds() const {
  Aabb box;
  box.low[3] = box.high[3] = 0;
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::nextafter(centre[axis] - radius, -infinity);
    box.high[axis] = std::nextafter(centre[axis] + radius, infinity);
  }
  return box;
}

bool near_scaled(const Bounding_sphere& a, const Bounding_sphere& b, double margin) {
  double difference[3], largest = std::max({a.radius, b.radius, margin});
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(a.centre[axis]) || !std::isfinite(b.centre[axis])) return true;
    largest = std::max(largest, std::abs(a.centre[axis] - b.centre[axis]));
  }
  if (largest == 0) return true;
  const Scale scale(largest);
  for (int axis = 0; axis < 3; ++axis) difference[axis] = scale.difference(a.centre[axis], b.centre[axis]);
  const double squared_distance =
      difference[0] * difference[0] + difference[1] * difference[1] + difference[2] * difference[2];
  const double reach = scale.length(a.radius) + scale.length(b.radius) + scale.length(margin);
  // The factor covers the roundings, as in `near`, and the loss of differences below 2^-1000 of the largest.
  return !(squared_distance > reach * reach * (1 + 0x1p-48));
}

}  // namespace lodestone
