// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "lodestone/volumes/aabb.h"
#include "lodestone/volumes/leaf_faces.h"

namespace lodestone {

/// Ball, the volume of \cite hubbard1996, \cite palmer1995 and \cite quinlan1994: the points p with
/// |p - centre| <= radius, in exact arithmetic; all points if the radius is infinite. Model of Bounding_volume.
///
/// The radius is never below that of the smallest ball around the faces it was fitted to, and at most one per cent
/// above it (Bounding_sphere::enclose). A ball is rotation-invariant, so rotating a leaf does not change how tight it
/// is. The test of two balls is the cheapest of all volumes.
struct alignas(32) Bounding_sphere {
  static constexpr std::string_view name = "bounding_sphere";  ///< in tables and messages

  double centre[3];  ///< in units of the coordinates
  double radius;     ///< >= 0, or infinite

  /// Smallest ball around a few of the vertices, as in \cite gaertner1999: the farthest vertex is added to these until
  /// it is at most one per cent outside their ball. No ball around all vertices is smaller than that around a few,
  /// which bounds the radius from below. Usually three to six passes over the V vertices of the leaf, each O(V).
  /// @throws Bad_argument  more vertices than a leaf can have
  void enclose(const Leaf_faces& faces);

  /// Smallest ball around both, up to rounding; one of the two if it encloses the other.
  void enclose(const Bounding_sphere& a, const Bounding_sphere& b);

  /// Diameter.
  double extent() const { return 2 * radius; }
  /// Of the ball, up to rounding.
  double volume() const;
  /// The box around the ball, with its sides rounded outwards.
  Aabb bounds() const;

  /// Whether centres and radii are the same.
  friend bool operator==(const Bounding_sphere&, const Bounding_sphere&) = default;
};

/// As `near`, for coordinates of any magnitude. Slow.
bool near_scaled(const Bounding_sphere& a, const Bounding_sphere& b, double margin);

/// Whether two balls come within `margin` >= 0 of each other; with 0: whether they have a point in common. `false`
/// proves them farther apart.
///
/// Let u = 2^-53. The computed squared distance of the centres has at most five successive roundings, so it is at most
/// (1 + u)^5 times the exact one. The computed square of the sum of radii and margin, times a factor, has at most six,
/// so it is at least (1 - u)^6 times the exact one. The factor 1 + 32 u covers both. Underflow of a term is negligible
/// against a squared distance of 1e-280. Fused instructions only remove roundings.
inline bool near(const Bounding_sphere& a, const Bounding_sphere& b, double margin) {
  const double x = a.centre[0] - b.centre[0], y = a.centre[1] - b.centre[1], z = a.centre[2] - b.centre[2];
  const double squared_distance = x * x + y * y + z * z;
  const double reach = a.radius + b.radius + margin;
  if (squared_distance >= 1e-280 && squared_distance <= 1e280)
    return !(squared_distance > reach * reach * (1 + 0x1p-48));
  return near_scaled(a, b, margin);
}

}  // namespace lodestone
