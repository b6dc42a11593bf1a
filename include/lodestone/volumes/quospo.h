// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

#include "lodestone/volumes/aabb.h"
#include "lodestone/volumes/leaf_faces.h"

namespace lodestone {

/// One of a finite set of rotations: a quaternion w + x i + y j + z k with integer components and a fixed w.
///
/// A frame of three perpendicular lines is mapped to itself by 24 rotations. So every such frame can be reached from
/// the coordinate axes by a rotation with |x|, |y|, |z| <= (sqrt(2) - 1) w. For w = 16 these round to integers from -7
/// to 7, and every frame is within about 6 degrees of the rotation that it rounds to.
struct Quantised_turn {
  std::int16_t w = 16;  ///< the real component
  std::int16_t x = 0;   ///< of i
  std::int16_t y = 0;   ///< of j
  std::int16_t z = 0;   ///< of k

  /// Whether all components are the same.
  friend bool operator==(const Quantised_turn&, const Quantised_turn&) = default;

  /// The length of each direction: w^2 + x^2 + y^2 + z^2.
  constexpr double length() const { return 1.0 * w * w + 1.0 * x * x + 1.0 * y * y + 1.0 * z * z; }
  /// Three perpendicular directions with integer components, computed without rounding.
  constexpr std::array<std::array<double, 3>, 3> directions() const {
    const double ww = w * w, xx = x * x, yy = y * y, zz = z * z;
    const double wx = 2 * w * x, wy = 2 * w * y, wz = 2 * w * z, xy = 2 * x * y, xz = 2 * x * z, yz = 2 * y * z;
    return {{{ww + xx - yy - zz, xy - wz, xz + wy},
             {xy + wz, ww - xx + yy - zz, yz - wx},
             {xz - wy, yz + wx, ww - xx - yy + zz}}};
  }
};

/// Quantised orientation slabs with primary orientations, after \cite he1999: the points p with
///
///     low[i] <= p_i <= high[i]   and   turned_low[i] <= d_i . p <= turned_high[i]   for i = 0, 1, 2,
///
/// d_i = turn.directions()[i], in exact arithmetic: slabs along the coordinate axes, and slabs along the directions of
/// one frame out of a fixed set, the nearest to the principal axes. Model of Bounding_volume.
///
/// From He comes the idea of combining the tight fit of oriented boxes with the fast test of slabs along known
/// directions. This library's own are the set of frames with integer components, how a frame is chosen, and the bounds
/// of one volume along the directions of another.
struct Quospo {
  static constexpr std::string_view name = "quospo";  ///< in tables and messages

  double low[3];          ///< of the slabs along the coordinate axes
  double high[3];         ///< of the same slabs
  double turned_low[3];   ///< of the slabs along the turned directions
  double turned_high[3];  ///< of the same slabs
  Quantised_turn turn;    ///< of the coordinate axes to the turned directions

  /// The turned slabs are wider than necessary by less than 2^-48 of the largest coordinate times the length of a
  /// direction; where they could overflow, they are unbounded.
  void enclose(const Leaf_faces& faces);
  /// The slabs along the coordinate axes are as narrow as possible. The frame is that of a, that of b or the one
  /// nearest to the principal axes of both, whichever gives the smallest surface area. O(1).
  void enclose(const Quospo& a, const Quospo& b);
  /// Sum of the three side lengths of `bounds()`.
  double extent() const { return (high[0] - low[0]) + (high[1] - low[1]) + (high[2] - low[2]); }
  /// Of the polytope, up to rounding; for experiments.
  double volume() const;
  /// The slabs along the coordinate axes.
  Aabb bounds() const { return {{low[0], low[1], low[2], 0}, {high[0], high[1], high[2], 0}}; }

  /// Whether turns and slabs are the same.
  friend bool operator==(const Quospo& a, const Quospo& b) {
    bool equal = a.turn == b.turn;
    for (int i = 0; i < 3; ++i) {
      equal &= (a.low[i] == b.low[i]) & (a.high[i] == b.high[i]);
      equal &= (a.turned_low[i] == b.turned_low[i]) & (a.turned_high[i] == b.turned_high[i]);
    }
    return equal;
  }
};

/// `near` along the directions of two different frames.
bool near_when_turned(const Quospo& a, const Quospo& b, double margin);

/// Whether two come within `margin` >= 0 of each other along the coordinate axes and the directions of both frames.
///
/// `false` proves them farther apart. As for `K_dop`, rounding to nearest is monotonic, and the margin times the length
/// of a direction is rounded up.
inline bool near(const Quospo& a, const Quospo& b, double margin) {
  bool apart = false;
  for (int i = 0; i < 3; ++i) apart |= (a.low[i] > b.high[i] + margin) | (b.low[i] > a.high[i] + margin);
  if (apart) return false;
  if (!(a.turn == b.turn)) return near_when_turned(a, b, margin);
  const double gap = margin > 0 ? 1.000000000000001 * a.turn.length() * margin + std::numeric_limits<double>::min() : 0;
  for (int i = 0; i < 3; ++i)
    apart |= (a.turned_low[i] > b.turned_high[i] + gap) | (b.turned_low[i] > a.turned_high[i] + gap);
  return !apart;
}

}  // namespace lodestone
