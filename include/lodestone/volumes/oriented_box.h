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
/// in exact arithmetic. The axes are not exactly orthonormal, but their dot products differ from those of an
/// orthonormal basis by at most 3e-15: all that `enclose` makes are. Model of Bounding_volume.
///
/// Gottschalk and others take the axes from the convex hull of the faces, integrated over its area; here they come from
/// the vertices, which is what a refit has time for.
struct Oriented_box {
  static constexpr std::string_view name = "oriented_box";

  double centre[3];
  double half[3];     ///< half widths
  double axes[3][3];  ///< by axis, then x, y, z

  /// The principal axes of the vertices, or those of space where these give a smaller surface. Every width is more than
  /// it need be by some 2^-46 of the largest. Where one would be beyond 1e307, all are infinite.
  void enclose(const Leaf_faces& faces);
  /// Of boxes with the axes of a, those of b and the principal axes of both (two solid boxes of equal mass) the one of
  /// the smallest surface. O(1).
  void enclose(const Oriented_box& a, const Oriented_box& b);
  /// Sum of the three widths.
  double extent() const { return 2 * ((half[0] + half[1]) + half[2]); }
  /// Product of the three widths.
  double volume() const { return 2 * half[0] * (2 * half[1]) * (2 * half[2]); }
  Aabb bounds() const;

  friend bool operator==(const Oriented_box& a, const Oriented_box& b) {
    bool equal = true;
    for (int i = 0; i < 3; ++i) {
      equal &= (a.centre[i] == b.centre[i]) & (a.half[i] == b.half[i]);
      for (int k = 0; k < 3; ++k) equal &= a.axes[i][k] == b.axes[i][k];
    }
    return equal;
  }
};

/// Whether none of 15 axes separates the two by more than `margin` >= 0 (by more than 0): the three of a, the three of
/// b and the cross product of each two.
///
/// `false` proves them farther apart. True boxes that have a gap of more than 2e-13 of their size and distance along
/// one of the axes, and the margin, are told apart.
bool near(const Oriented_box& a, const Oriented_box& b, double margin);

}  // namespace lodestone
