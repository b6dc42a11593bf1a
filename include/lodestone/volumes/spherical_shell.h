// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "lodestone/volumes/aabb.h"
#include "lodestone/volumes/bounding_sphere.h"
#include "lodestone/volumes/leaf_faces.h"

namespace lodestone {

/// Spherical shell: the region between two concentric spheres and inside a cone whose apex is their centre, the volume
/// of \cite krishnan1998; here it is also inside a ball, which is tested first. It is tight around a curved surface,
/// and, with a distant centre, around a flat one. Model of Bounding_volume.
///
/// It consists of the points p of `ball` with inner <= |p - centre| <= outer and
/// (p - centre) . axis >= cosine |p - centre| |axis|, in exact arithmetic; . is the scalar product. It is not convex.
///
/// If no shell is smaller than the ball, it is the ball alone: inner = 0 and cosine = -1, and the spheres and the cone
/// exclude nothing of the ball.
struct Spherical_shell {
  static constexpr std::string_view name = "spherical_shell";  ///< in tables and messages

  Bounding_sphere ball;  ///< everything lies in it
  double centre[3];      ///< of the two spheres, and apex of the cone
  double inner;          ///< radius, >= 0
  double outer;          ///< radius
  double axis[3];        ///< unit vector, up to rounding; 0: there is no cone
  double cosine;         ///< of half the cone's opening angle: > 0, so that the cone is convex; -1: there is no cone

  /// The centre c is that of the sphere that fits the vertices best in the sense of \cite taubin1991, at most 2^10
  /// radii of the ball away; the axis points towards the ball's centre.
  ///
  /// The cone and the outer sphere are convex, so they enclose the faces if they enclose the vertices. The inner sphere
  /// is not, since faces can be nearer to c than their corners. For a point p of a face, with weights w_i >= 0 of its
  /// corners v_i, |p - c|^2 = sum w_i |v_i - c|^2 - s with s = sum_(i < j) w_i w_j |v_i - v_j|^2. The same identity for
  /// the centre o and the radius m of the smallest ball around the face gives m^2 >= |p - o|^2 + s, so s <= m^2. Hence
  /// |p - c|^2 is at least the smallest |v_i - c|^2 minus m^2, and `inner` is the root of the smallest such bound over
  /// all faces. O(V + F).
  /// @throws Bad_argument  more vertices than a leaf can have
  void enclose(const Leaf_faces& faces);

  /// The ball around the two balls. If that is smaller: a shell about one of the two centres or a point between them,
  /// from the bounds that `near` states.
  void enclose(const Spherical_shell& a, const Spherical_shell& b);

  /// Whether spheres or cone exclude anything of the ball.
  bool has_shell() const { return inner > 0 || cosine > 0; }

  /// Diameter of the ball.
  double extent() const { return ball.extent(); }
  /// Upper bound: the volume of the ball or of the part of the cone between the spheres, whichever is smaller.
  double volume() const;
  /// Of the ball.
  Aabb bounds() const { return ball.bounds(); }

  /// Whether all numbers are the same.
  friend bool operator==(const Spherical_shell&, const Spherical_shell&) = default;
};

/// As `near`, for two shells whose balls are near.
bool shells_near(const Spherical_shell& a, const Spherical_shell& b, double margin);

/// Whether two shells may come within `margin` >= 0 of each other; with 0: whether they may have a point in common. The
/// test is conservative: it can be true for shells that are apart, but `false` proves them farther apart than the
/// margin.
///
/// It is false in four cases only. Here A is a or b and B the other one; A has spheres of radii r and R about c and a
/// cone along the unit vector n with half-angle t; B is inside a ball about k of radius m. Every rounding is allowed
/// for, as stated in the source.
///
/// - The two balls are farther apart than the margin, and so are their subsets.
/// - Every point of B is farther than R + margin from c. Then B is farther than the margin from the ball of radius R
///   about c, which encloses A.
/// - Every point of B is nearer than r - margin to c. Then B is farther than the margin from all points at distance r
///   or more from c, and so from A.
/// - k is farther than m + margin from a half-space that encloses the cone of A. Let e be the unit vector normal to n
///   in the plane of n and k - c, on the side of k. The half-space consists of the x with (x - c) . h <= 0 for the unit
///   vector h = e cos t - n sin t. It encloses the cone: an x at the angle f <= t from n has (x - c) . h <= |x - c|
///   (sin f cos t - cos f sin t) = -|x - c| sin(t - f), and t <= 90 degrees. The distance of k from it is (k - c) . h.
///
/// There are two bounds on the distance of a point p of B from c, and the tighter one is used.
///
/// - From the ball: |p - c| differs from |k - c| by at most m.
/// - From the spheres of B, with radii r' and R' about c': |p - c|^2 = |p - c'|^2 + 2 (p - c') . (c' - c) + |c' - c|^2,
///   and the same holds for k. Subtracting gives
///   |p - c|^2 - |k - c|^2 = |p - c'|^2 - |k - c'|^2 + 2 (p - k) . (c' - c).
///   The last term is at most 2 m |c' - c|, and |p - c'| is from r' to R'. For c = c' the bound is again r' to R'.
inline bool near(const Spherical_shell& a, const Spherical_shell& b, double margin) {
  if (!near(a.ball, b.ball, margin)) return false;
  if (!a.has_shell() && !b.has_shell()) return true;
  return shells_near(a, b, margin);
}

}  // namespace lodestone
