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
/// If the angle opposite to the longest edge is not acute, it is the ball whose diameter is that edge. Otherwise it is
/// the circumscribed ball: then w = x + y - z with z >= y >= x is from 0 to x, so 4 x y - w^2 >= 3 x y has no
/// cancellation. Where w is so small that its sign is wrong, both balls agree up to rounding.
double squared_radius(double a, double b, double c) {
  const double x = std::min({a, b, c}), z = std::max({a, b, c});
  const double y = std::max(std::min(a, b), std::min(std::max(a, b), c));
  const double w = x + y - z;
  if (w <= 0) return z / 4;
  const double xy = x * y, divisor = 4 * xy - w * w;
  return divisor > 1e-290 ? z * (xy / divisor) : z / 3;  // at most a third
}

/// Lower bound of the squared distances of the faces from the centre, rounded; derived in the documentation of
/// `enclose`.
/// @param squared  squared distances of the vertices
/// @param least    the smallest of these
double least_squared_distance(const Leaf_faces& faces, const kernel::Leaf_points& points, const double* squared,
                              double least) {
  const auto edge = [&](std::size_t p, std::size_t q) {
    const double x = points.x[p] - points.x[q], y = points.y[p] - points.y[q], z = points.z[p] - points.z[q];
    return x * x + y * y + z * z;
  };
  for (const auto& [a, b, c] : faces.corners) {
    const double of_corners = std::min({squared[a], squared[b], squared[c]});
    const double ab = edge(a, b), bc = edge(b, c), ca = edge(c, a);
    // The squared radius is at most a third of the longest edge squared, which usually suffices.
    if (of_corners - 0.334 * std::max({ab, bc, ca}) >= least) continue;
    least = std::min(least, of_corners - (1 + 0x1p-46) * squared_radius(ab, bc, ca));
  }
  return least;
}

/// Fits a shell about a given centre to faces.
Spherical_shell shell_about(const Eigen::Vector3d& centre, const Leaf_faces& faces, const kernel::Leaf_points& points,
                            const Bounding_sphere& ball) {
  Spherical_shell shell = plain_shell(ball);
  const Eigen::Vector3d axis = (Vector(ball.centre) - centre).normalized();
  std::copy_n(centre.data(), 3, shell.centre);
  alignas(64) double squared[kernel::Leaf_points::capacity];
  const auto directions = kernel::directions(points, shell.centre, axis.data(), squared);
  shell.outer = above(std::sqrt(directions.most_squared_distance));

  // Squared distances of corners have five roundings, the differences one, each at most u = 2^-53 of `outer` squared.
  const double least = least_squared_distance(faces, points, squared, directions.least_squared_distance) -
                       0x1p-49 * (shell.outer * shell.outer);
  if (least > 0) shell.inner = std::sqrt(least) * (1 - 0x1p-50);

  // Errors: at most 5 u of the lengths for the scalar product, 9 u for the cosine, 3 u for the length of the axis.
  if (directions.least_squared_distance > 1e-200) set_cone(shell, axis.data(), directions.least_cosine - 0x1p-48);
  return shell;
}

/// Whether B is outside the outer sphere of A or inside the inner one, by more than the margin.
bool sphere_separates(const Spherical_shell& a, const Spherical_shell& b, double margin) {
  const auto [low, high] = squared_distances(b, a.centre);
  const double outside = a.outer + margin, inside = a.inner - margin;
  // The slack covers three roundings: of the sum, its square and the product.
  return low > outside * outside * (1 + 0x1p-50) || (inside > 0 && high < inside * inside * (1 - 0x1p-50));
}

/// Whether the ball of B is beyond a plane that touches the cone of A. The errors of the products, the difference and
/// the length of the axis are a few u each of the distance from the apex, less than 64 u in all.
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
