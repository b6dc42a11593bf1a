// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/volumes/spherical_shell.h"

namespace lodestone {

/// A shell that is a ball alone.
inline Spherical_shell plain_shell(const Bounding_sphere& ball) {
  return {.ball = ball,
          .centre = {ball.centre[0], ball.centre[1], ball.centre[2]},
          .inner = 0,
          .outer = ball.radius,
          .axis = {0, 0, 0},
          .cosine = -1};
}

/// Whether a shell is tried around what a ball encloses: fourth powers of lengths, up to 2^10 radii or down to 2^-60
/// of them, are then in the range of doubles.
inline bool has_room_for_shell(const Bounding_sphere& ball) {
  return ball.radius >= 0x1p-120 && ball.radius <= 0x1p120;
}

/// Gives a shell the cone of a cosine that is not too large, or none if it would not be convex.
inline void set_cone(Spherical_shell& shell, const double* axis, double cosine) {
  const bool convex = cosine > 0;
  for (int i = 0; i < 3; ++i) shell.axis[i] = convex ? axis[i] : 0;
  shell.cosine = convex ? cosine : -1;
}

}  // namespace lodestone
