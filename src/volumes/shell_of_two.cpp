// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "volumes/rounded_up.h"
#include "volumes/shell_makers.h"
#include "volumes/shell_range.h"

namespace lodestone {
namespace {

using Vector = Eigen::Map<const Eigen::Vector3d>;

/// Upper bound of an angle of at most 90 degrees. Sine and cosine are consistent up to a few u = 2^-53.
struct Angle {
  double sine = 1;
  double cosine = 0;
};

/// @param sine  not below the exact one
Angle with_sine(double sine) { return sine < 1 ? Angle{sine, std::sqrt((1 - sine) * (1 + sine))} : Angle{}; }

/// @param cosine  not above the exact one
Angle with_cosine(double cosine) {
  return cosine > 0 ? Angle{std::sqrt((1 - cosine) * (1 + cosine)), cosine} : Angle{};
}

/// Sum of two angles; 90 degrees if it may be more. The roundings of products, difference and operands are less than 16
/// u in all.
Angle operator+(const Angle& a, const Angle& b) { return with_cosine(a.cosine * b.cosine - a.sine * b.sine - 0x1p-49); }

/// Angle between a vector and an axis of length 1, up to a few u; 90 degrees if it is more. The roundings of products
/// and sums are less than 32 u in all.
Angle between(const Eigen::Vector3d& axis, const Eigen::Vector3d& vector) {
  if (!(axis.dot(vector) > 0)) return {};
  return with_sine(axis.cross(vector).norm() / vector.norm() + 0x1p-48);
}

/// The largest angle at a centre between an axis and the points of a shell. It is bounded by the shell's ball or by its
/// cone, whichever is tighter. The cone has its apex c' elsewhere: the directions from the two apexes to a point p
/// differ by the angle at p in the triangle of p and the apexes. The sine of this angle is at most the distance of the
/// apexes divided by the distance of p from either apex. The angle is acute if one of these distances exceeds that of
/// the apexes.
/// @param least_distance  smallest distance of a point of the shell from the centre
Angle angle_of(const Spherical_shell& shell, const Eigen::Vector3d& centre, const Eigen::Vector3d& axis,
               double least_distance) {
  const Eigen::Vector3d to_ball = Vector(shell.ball.centre) - centre;
  const Angle by_ball = between(axis, to_ball) + with_sine(above(shell.ball.radius / to_ball.norm()));
  if (!(shell.cosine > 0)) return by_ball;
  const double step = distance_above(centre.data(), shell.centre);
  const Angle shift = step == 0 ? Angle{0, 1} : with_sine(above(step / std::max(least_distance, shell.inner)));
  const Angle by_cone = between(axis, Vector(shell.axis)) + with_cosine(shell.cosine) + shift;
  return by_cone.cosine > by_ball.cosine ? by_cone : by_ball;
}

/// Two spheres about a centre with two shells between them; without a cone.
struct Spheres {
  Eigen::Vector3d centre;
  Squared_range a, b;
  double inner, outer;
};

Spheres spheres_about(const Eigen::Vector3d& centre, const Spherical_shell& a, const Spherical_shell& b) {
  const auto of_a = squared_distances(a, centre.data()), of_b = squared_distances(b, centre.data());
  return {.centre = centre,
          .a = of_a,
          .b = of_b,
          .inner = std::sqrt(std::min(of_a.low, of_b.low)) * (1 - 0x1p-50),
          .outer = above(std::sqrt(std::max(of_a.high, of_b.high)))};
}

/// The thinnest spheres about the centre of a, the centre of b or a point between these.
Spheres thinnest_spheres(const Spherical_shell& a, const Spherical_shell& b) {
  if (!a.has_shell()) return spheres_about(Vector(b.centre), a, b);
  if (!b.has_shell()) return spheres_about(Vector(a.centre), a, b);
  const double part = b.ball.radius / (a.ball.radius + b.ball.radius);
  const Spheres choices[]{spheres_about(Vector(a.centre) + part * (Vector(b.centre) - Vector(a.centre)), a, b),
                          spheres_about(Vector(a.centre), a, b), spheres_about(Vector(b.centre), a, b)};
  return *std::ranges::min_element(choices, {}, [](const Spheres& s) { return s.outer - s.inner; });
}

void enclose_with_cone(Spherical_shell& shell, const Spheres& spheres, const Spherical_shell& a,
                       const Spherical_shell& b) {
  const Eigen::Vector3d axis = (Vector(shell.ball.centre) - spheres.centre).normalized();
  const Angle of_a = angle_of(a, spheres.centre, axis, std::sqrt(spheres.a.low));
  const Angle of_b = angle_of(b, spheres.centre, axis, std::sqrt(spheres.b.low));
  // The slack covers the length of the axis, which can exceed 1 by a few u.
  set_cone(shell, axis.data(), std::min(of_a.cosine, of_b.cosine) - 0x1p-49);
}

}  // namespace

void Spherical_shell::enclose(const Spherical_shell& a, const Spherical_shell& b) {
  Bounding_sphere around;
  around.enclose(a.ball, b.ball);
  Spherical_shell both = plain_shell(around);
  if (has_room_for_shell(around) && (a.has_shell() || b.has_shell())) {
    const Spheres spheres = thinnest_spheres(a, b);
    Spherical_shell shell = both;
    std::copy_n(spheres.centre.data(), 3, shell.centre);
    shell.inner = spheres.inner;
    shell.outer = spheres.outer;
    enclose_with_cone(shell, spheres, a, b);
    if (shell.has_shell() && shell.volume() < around.volume()) both = shell;
  }
  *this = both;
}

}  // namespace lodestone
