// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>

#include "lodestone/mesh/box.h"

/// How far to move something along a direction until it has passed something else.
///
/// Two points are in line if a line along the direction passes through both. A set a has passed a set b if each point
/// of a lies strictly ahead of each point of b that it is in line with. The clearance of a from b is the supremum of
/// t with y - x = t direction, over the points x of a and y of b. Moved by more than this along the direction, a has
/// passed b.
namespace lodestone {

/// The direction of a motion, and how far coordinates may be off.
struct Way {
  /// @param unit_vector       the direction
  /// @param difference_slack  `slack`
  Way(const Eigen::Vector3d& unit_vector, double difference_slack)
      : direction(unit_vector), inverse(unit_vector.cwiseInverse()), slack(difference_slack) {}

  Eigen::Vector3d direction;  ///< a unit vector, up to rounding
  Eigen::Vector3d inverse;    ///< of each of its components, rounded
  double slack;               ///< each difference of two coordinates may be off by so much
};

/// An upper bound on a clearance.
struct Clearance {
  /// In units of the coordinates; minus infinity: no two points are in line.
  double length = -std::numeric_limits<double>::infinity();
  /// Normal of the plane in which a touches b last, in the direction of the way; of any length.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

/// A triangle with the box around it.
struct Boxed_triangle {
  std::array<Eigen::Vector3d, 3> corners;  ///< their positions
  Box box;                                 ///< around the corners
};

/// An upper bound on the clearance of box a from box b: the exact one, but for slack and rounding. It does not decrease
/// if a box grows.
/// @param way  its slack must be at least 2^-48 times the largest coordinate
double clearance(const Box& a, const Box& b, const Way& way);

/// An upper bound on the clearance of triangle a from triangle b: the exact one, but for slack and rounding. It is no
/// larger than that of their boxes. Some thousand floating-point operations; most pairs that are not in line, or whose
/// clearance is too small, take fewer.
/// @param way    its slack must be at least 2^-48 times the largest coordinate
/// @param least  where the clearance is smaller than this, the result may be minus infinity
Clearance clearance(const Boxed_triangle& a, const Boxed_triangle& b, const Way& way,
                    double least = -std::numeric_limits<double>::infinity());

}  // namespace lodestone
