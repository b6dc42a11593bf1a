// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <boost/container/static_vector.hpp>

#include "lodestone/mesh/concepts.h"
#include "lodestone/triangles/crossing.h"

namespace lodestone {

using Triangle = std::array<Point, 3>;

/// The triangle of a face.
/// @param corners   three numbers
/// @param position  coordinates of a corner by its number, indexed by []
template <class Face_corners, class Position>
Triangle face_triangle(const Face_corners& corners, const Position& position) {
  const auto point = [&](auto corner) {
    const auto& p = position(corner);
    return Point(p[0], p[1], p[2]);
  };
  return {point(corners[0]), point(corners[1]), point(corners[2])};
}

/// Where x, y and z of each corner of a triangle are.
using Triangle_corners = std::array<const double*, 3>;

inline Triangle triangle_of(const Triangle_corners& corners) {
  return face_triangle(corners, [](const double* corner) { return corner; });
}

/// Whether two triangles have a point in common; touching counts. Exact for any finite coordinates.
///
/// CGAL's `do_intersect` under an exact-predicates kernel asks for triangles with an area. One whose corners are
/// collinear is taken as what it is, a segment or a point.
bool triangles_intersect(const Triangle& a, const Triangle& b);
/// The same with a guess, which may be wrong: where it is right, five orientations are enough, and one corner is not
/// read.
bool triangles_intersect_given(const Triangle_corners& a, const Triangle_corners& b, Crossing likely);

/// Corners of the intersection of two triangles: one point, the two ends of a segment, or the corners of the polygon in
/// which two coplanar triangles overlap (at most 6).
using Intersection_points = boost::container::static_vector<Point, 6>;

/// Where two triangles meet. Computed with exact constructions and rounded to double once, at the end; empty if they
/// have no point in common.
Intersection_points triangle_intersection(const Triangle& a, const Triangle& b);

}  // namespace lodestone
