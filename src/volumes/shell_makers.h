// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/volumes/spherical_shell.h"

namespace lodestone {

/// A shell that is only a ball.
inline Spherical_shell plain_shell(const Bounding_sphere& ball) {
  return {.ball = ball,
          .centre = {ball.centre[0], ball.centre[1], ball.centre[2]},
          .inner = 0,
          .outer = ball.radius,
          .axis = {0, 0, 0},
          .cosine = -1};
}

/// Whether a shell can be fitted inside a ball: fourth powers of lengths from 2^-60 to 2^10 radii must be in the range
/// of doubles.
inline bool has_room_for_shell(const Bounding_sphere& ball) {
  return ball.radius >= 0x1p-120 && ball.radius <= 0x1p120;
}

/// Sets the cone of a shell, or no cone if it would not be convex.
/// @param cosine  lower bound of the cosine of the half-angle
inline void set_cone(Spherical_shell& shell, const double* axis, double cosine) {
  const bool convex = cosine > 0;
  for (int i = 0; i < 3; ++i) shell.axis[i] = convex ? axis[i] : 0;
  shell.cosine = convex ? cosine : -1;
}

}  // namespace lodestone
