// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/volumes/spherical_shell.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "volumes/ball_kernel.h"
#include "volumes/rounded_up.h"
#include "volumes/shell_centre.h"
#include "volumes/shell_makers.h"
#include "volumes/shell_range.h"

namespace lodestone {
namespace {

using Vector = Eigen::Map<const Eigen::Vector3d>;

/// Squared radius of the smallest ball around a triangle, from its squared edge lengths; at most 2^-47 of it too small.
///
/// Without an acute angle opposite to the longest edge, it is the ball of that edge. Else it is the circumscribed one:
/// then w = x + y - z with z >= y >= x is from 0 to x, so that 4 x y - w^2 >= 3 x y loses no digits. Where w is so
/// small that its sign is wrong, the two agree up to rounding.
double squared_radius(double a, double b, double c) {
  const double x = std::min({a, b, c}), z = std::max({a, b, c});
  const double y = std::max(std::min(a, b), std::min(std::max(a, b), c));
  const double w = x + y - z;
  if (w <= 0) return z / 4;
  const double xy = x * y, divisor = 4 * xy - w * w;
  return divisor > 1e-290 ? z * (xy / divisor) : z / 3;  // never more than a third
}

/// Least squared distance of the faces from the centre, rounded, by the bound in the documentation of `enclose`.
/// @param squared  distances of the vertices
/// @param least    of these
double least_squared_distance(const Leaf_faces& faces, const kernel::Leaf_points& points, const double* squared,
                              double least) {
  const auto edge = [&](std::size_t p, std::size_t q) {
    const double x = points.x[p] - points.x[q], y = points.y[p] - points.y[q], z = points.z[p] - points.z[q];
    return x * x + y * y + z * z;
  };
  for (const auto& [a, b, c] : faces.corners) {
    const double of_corners = std::min({squared[a], squared[b], squared[c]});
    const double ab = edge(a, b), bc = edge(b, c), ca = edge(c, a);
    // The squared radius is at most a third of the longest edge squared: mostly that tells enough.
    if (of_corners - 0.334 * std::max({ab, bc, ca}) >= least) continue;
    least = std::min(least, of_corners - (1 + 0x1p-46) * squared_radius(ab, bc, ca));
  }
  return least;
}

/// A shell about a centre, fitted to faces.
Spherical_shell shell_about(const Eigen::Vector3d& centre, const Leaf_faces& faces, const kernel::Leaf_points& points,
                            const Bounding_sphere& ball) {
  Spherical_shell shell = plain_shell(ball);
  const Eigen::Vector3d axis = (Vector(ball.centre) - centre).normalized();
  std::copy_n(centre.data(), 3, shell.centre);
  alignas(64) double squared[kernel::Leaf_points::capacity];
  const auto directions = kernel::directions(points, shell.centre, axis.data(), squared);
  shell.outer = above(std::sqrt(directions.most_squared_distance));

  // Squared distances of corners are rounded five times, the differences once, of at most `outer` squared; u = 2^-53.
  const double least = least_squared_distance(faces, points, squared, directions.least_squared_distance) -
                       0x1p-49 * (shell.outer * shell.outer);
  if (least > 0) shell.inner = std::sqrt(least) * (1 - 0x1p-50);

  // The scalar product is wrong by at most 5 u of the lengths, the cosine by 9 u, and the axis is too long by 3 u.
  if (directions.least_squared_distance > 1e-200) set_cone(shell, axis.data(), directions.least_cosine - 0x1p-48);
  return shell;
}

/// Whether B is outside the outer sphere of A or within the inner one.
bool sphere_separates(const Spherical_shell& a, const Spherical_shell& b, double margin) {
  const auto [low, high] = squared_distances(b, a.centre);
  const double outside = a.outer + margin, inside = a.inner - margin;
  // The sum, its square and the product are each rounded once.
  return low > outside * outside * (1 + 0x1p-50) || (inside > 0 && high < inside * inside * (1 - 0x1p-50));
}

/// Whether the ball of B is beyond a plane that touches the cone of A. Each product, the difference and the length of
/// the axis are wrong by a few u of the distance from the apex, all in all by less than 64 u.
bool cone_separates(const Spherical_shell& a, const Bounding_sphere& b, double margin) {
  if (!(a.cosine > 0)) return false;
  const Eigen::Vector3d to_ball = Vector(b.centre) - Vector(a.centre);
  const double along = to_ball.dot(Vector(a.axis)), across = to_ball.cross(Vector(a.axis)).norm();
  const double sine = std::sqrt((1 - a.cosine) * (1 + a.cosine));
  const double distance = across * a.cosine - along * sine;
  return distance > (b.radius + margin) * (1 + 0x1p-50) + 0x1p-47 * (to_ball.norm() + a.outer);
}

}  // namespace

void Spherical_shell::enclose(const Leaf_faces& faces) {
  Bounding_sphere around;
  around.enclose(faces);
  *this = plain_shell(around);
  if (!has_room_for_shell(around)) return;
  kernel::Leaf_points points;
  kernel::gather(faces, points);
  const auto fitted = shell_centre(faces, points, around);
  if (!fitted.allFinite()) return;
  const auto shell = shell_about(fitted, faces, points, around);
  if (shell.has_shell() && shell.volume() < around.volume()) *this = shell;
}

double Spherical_shell::volume() const {
  const double cubes = (outer - inner) * (outer * outer + outer * inner + inner * inner);
  return std::min(ball.volume(), 2 * std::numbers::pi / 3 * (1 - cosine) * cubes);
}

bool shells_near(const Spherical_shell& a, const Spherical_shell& b, double margin) {
  return !(a.has_shell() && (sphere_separates(a, b, margin) || cone_separates(a, b.ball, margin))) &&
         !(b.has_shell() && (sphere_separates(b, a, margin) || cone_separates(b, a.ball, margin)));
}

}  // namespace lodestone
