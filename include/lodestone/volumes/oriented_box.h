// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "lodestone/volumes/aabb.h"
#include "lodestone/volumes/leaf_faces.h"

namespace lodestone {

/// Oriented box, \cite gottschalk1996: the points p with
///
///     |axes[i] . (p - centre)| <= half[i]   for i = 0, 1, 2
///
/// in exact arithmetic. The axes are not exactly orthonormal: their dot products differ from those of an orthonormal
/// basis by at most 3e-15, which `enclose` guarantees. Model of Bounding_volume.
///
/// Gottschalk et al. derive the axes from the convex hull of the faces, integrated over its area. Here they are derived
/// from the vertices, which is cheap enough for a refit.
struct Oriented_box {
  static constexpr std::string_view name = "oriented_box";  ///< in tables and messages

  double centre[3];   ///< in units of the coordinates
  double half[3];     ///< half-widths
  double axes[3][3];  ///< by axis, then x, y, z

  /// Uses the principal axes of the vertices, or the coordinate axes if these give a smaller surface area. Every width
  /// is larger than necessary by about 2^-46 of the largest. If a width would exceed 1e307, all are infinite.
  void enclose(const Leaf_faces& faces);
  /// Tries the axes of a, the axes of b and the principal axes of both (as two solid boxes of equal mass), and keeps
  /// the box with the smallest surface area. O(1).
  void enclose(const Oriented_box& a, const Oriented_box& b);
  /// Sum of the three widths.
  double extent() const { return 2 * ((half[0] + half[1]) + half[2]); }
  /// Product of the three widths.
  double volume() const { return 2 * half[0] * (2 * half[1]) * (2 * half[2]); }
  /// The axis-aligned box around it, with its sides rounded outwards.
  Aabb bounds() const;

  /// Whether centres, half-widths and axes are the same.
  friend bool operator==(const Oriented_box& a, const Oriented_box& b) {
    bool equal = true;
    for (int i = 0; i < 3; ++i) {
      equal &= (a.centre[i] == b.centre[i]) & (a.half[i] == b.half[i]);
      for (int k = 0; k < 3; ++k) equal &= a.axes[i][k] == b.axes[i][k];
    }
    return equal;
  }
};

/// Separating axis test: whether none of 15 axes separates the two by more than `margin` >= 0. These are the three axes
/// of a, the three of b, and the cross product of each pair.
///
/// `false` proves them farther apart. Boxes whose gap along one of these axes exceeds the margin by more than 2e-13 of
/// their size and distance are found to be apart.
bool near(const Oriented_box& a, const Oriented_box& b, double margin);

}  // namespace lodestone
