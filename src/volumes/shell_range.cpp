// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/shell_range.h"

#include <cmath>
#include <limits>

namespace lodestone {
namespace {

double squared_distance(const double* p, const double* q) {
  const double x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
  return x * x + y * y + z * z;
}

}  // namespace

Squared_range squared_distances(const Spherical_shell& shell, const double* from) {
  const double radius = shell.ball.radius, outer = shell.outer, inner = shell.inner;
  const double to_ball = squared_distance(shell.ball.centre, from);
  const double in_shell = squared_distance(shell.ball.centre, shell.centre);
  const double change = 2 * radius * std::sqrt(squared_distance(shell.centre, from));
  const double distance = std::sqrt(to_ball);
  const double nearest = distance - radius, farthest = distance + radius;

  // With u = 2^-53: each term is rounded at most six times, each sum three times, and no intermediate result exceeds
  // twice the sum of all terms. The total error is less than 32 u of that sum. Underflow is far below 2^-1000.
  const double error = 0x1p-48 * (outer * outer + to_ball + in_shell + change + radius * radius) + 0x1p-1000;

  // Comparisons with NaN are false, and keep the trivial bounds.
  Squared_range range{0, std::numeric_limits<double>::infinity()};
  const double low_by_spheres = inner * inner + (to_ball - in_shell) - change - error;
  const double low_by_ball = nearest > 0 ? nearest * nearest - error : 0;
  if (low_by_spheres > range.low) range.low = low_by_spheres;
  if (low_by_ball > range.low) range.low = low_by_ball;
  const double high_by_spheres = outer * outer + (to_ball - in_shell) + change + error;
  const double high_by_ball = farthest * farthest + error;
  if (high_by_spheres < range.high) range.high = high_by_spheres;
  if (high_by_ball < range.high) range.high = high_by_ball;
  return range;
}

}  // namespace lodestone
