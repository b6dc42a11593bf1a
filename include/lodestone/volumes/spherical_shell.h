// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "lodestone/volumes/aabb.h"
#include "lodestone/volumes/bounding_sphere.h"
#include "lodestone/volumes/leaf_faces.h"

namespace lodestone {

/// What lies between two spheres about one centre and within a cone whose apex is there, the volume of
/// \cite krishnan1998; here also within a ball, for which spheres are tried first. A curved surface fills little more
/// than it, and a flat one little more than one about a far centre. Model of Bounding_volume.
///
/// These are the points p of `ball` with inner <= |p - centre| <= outer and, where . is the scalar product,
/// (p - centre) . axis >= cosine |p - centre| |axis|, as real numbers. It is not convex.
///
/// Without a shell that is smaller than the ball it is the ball alone: inner = 0 and cosine = -1, and the two spheres
/// and the cone leave out nothing of the ball.
struct Spherical_shell {
  static constexpr std::string_view name = "spherical_shell";

  Bounding_sphere ball;
  double centre[3];
  double inner;    ///< radius, >= 0
  double outer;    ///< radius
  double axis[3];  ///< of length 1, up to rounding; 0: there is no cone
  double cosine;   ///< of half the cone's opening angle: > 0, so that the cone is convex; -1: there is no cone

  /// The centre is that of the sphere that fits best to the vertices in the sense of \cite taubin1991, at most 2^10
  /// radii of the ball away; the axis points towards the ball's centre. The cone and the outer sphere are convex and
  /// have what the vertices need. Faces bulge inwards: a point p of a face, with weights w_i >= 0 of its corners v_i,
  /// has |p - c|^2 = sum w_i |v_i - c|^2 - s where s = sum_(i < j) w_i w_j |v_i - v_j|^2. With the centre o and the
  /// radius m of the smallest ball around the face in place of c, m^2 >= |p - o|^2 + s. So p is no nearer to c than
  /// the root of the least |v_i - c|^2 minus m^2, and `inner` is the least of these. O(V + F).
  /// @throws Bad_argument  more vertices than a leaf can have
  void enclose(const Leaf_faces& faces);

  /// The ball of the two balls, and if it is smaller a shell about one of the two centres or about a point between
  /// them, with what the bounds below leave of the two.
  void enclose(const Spherical_shell& a, const Spherical_shell& b);

  bool has_shell() const { return inner > 0 || cosine > 0; }

  /// Diameter of the ball.
  double extent() const { return ball.extent(); }
  /// A bound above that of the set: of the ball or of what is between the spheres in the cone, whichever is less.
  double volume() const;
  /// Of the ball.
  Aabb bounds() const { return ball.bounds(); }

  friend bool operator==(const Spherical_shell&, const Spherical_shell&) = default;
};

/// As `near`, for two whose balls are near.
bool shells_near(const Spherical_shell& a, const Spherical_shell& b, double margin);

/// Whether two shells may come within `margin` >= 0 of each other; with 0: whether they may have a point in common. No
/// exact test, for it may be true of shells that are apart; but `false` proves them farther apart than the margin.
///
/// It is false in four cases only. Here A is a or b and B the other one; A has spheres of radii r and R about c and a
/// cone along the unit vector n with the half angle t; B is within a ball about k of radius m. All are computed with
/// an allowance for every rounding, which the source states.
///
/// - The two balls are farther apart than the margin, and so are their subsets.
/// - Every point of B is farther than R + margin from c: then it is farther than the margin from the ball of radius R
///   about c, which encloses A.
/// - Every point of B is nearer than r - margin to c: then it is farther than the margin from all that is not within r
///   of c, as A is not.
/// - k is farther than m + margin from a half space that encloses the cone of A. Let e be the unit vector normal to n
///   in the plane of n and k - c, on the side of k. The half space is that of the x with (x - c) . h <= 0 for the unit
///   vector h = e cos t - n sin t. It encloses the cone: an x at the angle f <= t from n has (x - c) . h <= |x - c|
///   (sin f cos t - cos f sin t) = -|x - c| sin(t - f), and t <= 90 degrees. The distance of k from it is (k - c) . h.
///
/// How far points p of B are from c follows in two ways, of which the better one counts. By the ball, |p - c| is within
/// m of |k - c|. By the spheres of B, of radii r' and R' about c': |p - c|^2 = |p - c'|^2 + 2 (p - c') . (c' - c) +
/// |c' - c|^2, and the same for k in place of p; their difference is |p - c|^2 - |k - c|^2 = |p - c'|^2 - |k - c'|^2 +
/// 2 (p - k) . (c' - c), where the last term is at most 2 m |c' - c|, and |p - c'| is from r' to R'. With c = c', this
/// is from r' to R' again.
inline bool near(const Spherical_shell& a, const Spherical_shell& b, double margin) {
  if (!near(a.ball, b.ball, margin)) return false;
  if (!a.has_shell() && !b.has_shell()) return true;
  return shells_near(a, b, margin);
}

}  // namespace lodestone
