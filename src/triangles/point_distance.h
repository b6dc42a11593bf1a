// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Quotient.h>

#include <array>
#include <cstdint>
#include <limits>

#include "lodestone/triangles/triangle_intersection.h"

/// How far a point is from triangles, for finding the nearest: in floating point as far as that proves anything, and
/// exactly.
namespace lodestone {

/// Not reduced: greatest common divisors take longer than all the rest.
using Exact_squared = CGAL::Quotient<Kernel::Exact_kernel_rt::FT>;

/// A point, and a power of two by which all lengths are multiplied, so that products of a few of them neither overflow
/// nor lose digits that count.
struct Query_point {
  /// @param around  two corners of a box with finite coordinates around all that will be measured
  Query_point(const Point& point, const double* low, const double* high);

  Point point;
  double scale;
};

/// What a nearest point of a triangle lies on, if floating point proves it: a corner, or the inside of an edge. Two
/// faces with the same such part are at exactly the same distance.
struct Nearest_part {
  static constexpr std::uint32_t unknown = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t first = unknown, second = unknown;  ///< corners, ascending; twice the same: a corner

  bool is_known() const { return first != unknown; }
  friend bool operator==(const Nearest_part&, const Nearest_part&) = default;
};

/// Bounds on the squared scaled distance, and where about the nearest point is.
struct Distance_estimate {
  double low = 0, high = std::numeric_limits<double>::infinity();
  double squared = 0;                  ///< as computed, between the two
  std::array<double, 2> weights = {};  ///< of the second and the third corner
  Nearest_part part;
};

/// @param vertices  names of the corners
Distance_estimate estimate_distance(const Query_point& query, const Triangle_corners& corners,
                                    const std::array<std::uint32_t, 3>& vertices);

/// The squared distance, not scaled. The triangle may be a segment or a point.
Exact_squared exact_squared_distance(const Point& point, const Triangle& triangle);

}  // namespace lodestone
