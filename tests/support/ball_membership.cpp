// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/ball_membership.h"

namespace lodestone {

bool inside(const Bounding_sphere& ball, const Exact_point& p) {
  if (std::isinf(ball.radius)) return true;
  const Rational radius = ball.radius;
  return radius >= 0 && squared_distance(p, exact_point(ball.centre)) <= radius * radius;
}

bool inside(const Spherical_shell& shell, const Exact_point& p) {
  if (!inside(shell.ball, p)) return false;
  const Exact_vector v = p - exact_point(shell.centre), axis = exact_point(shell.axis) - Exact_point(0, 0, 0);
  const Rational squared = v.squared_length(), along = v * axis;
  if (squared < Rational(shell.inner) * shell.inner) return false;
  if (!std::isinf(shell.outer) && squared > Rational(shell.outer) * shell.outer) return false;
  // Both sides of the inequality are squared where both are of one sign.
  const Rational limit = Rational(shell.cosine) * shell.cosine * squared * axis.squared_length();
  if (shell.cosine < 0) return along >= 0 || along * along <= limit;
  return along >= 0 && along * along >= limit;
}

}  // namespace lodestone
