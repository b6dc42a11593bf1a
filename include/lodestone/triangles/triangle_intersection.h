// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <boost/container/static_vector.hpp>
#include <span>

#include "lodestone/mesh/concepts.h"
#include "lodestone/triangles/crossing.h"

namespace lodestone {

/// The corners of a triangle, in the order of its face.
using Triangle = std::array<Point, 3>;

/// The triangle of a face.
/// @param corners   its three corners, such as vertex indices
/// @param position  maps a corner to coordinates that are indexed by []
template <class Face_corners, class Position>
Triangle face_triangle(const Face_corners& corners, const Position& position) {
  const auto point = [&](auto corner) {
    const auto& p = position(corner);
    return Point(p[0], p[1], p[2]);
  };
  return {point(corners[0]), point(corners[1]), point(corners[2])};
}

/// Pointers to x, y and z of each corner of a triangle.
using Triangle_corners = std::array<const double*, 3>;

/// The triangle with these corners.
inline Triangle triangle_of(const Triangle_corners& corners) {
  return face_triangle(corners, [](const double* corner) { return corner; });
}

/// Whether two triangles have a point in common; touching counts. Exact for any finite coordinates.
///
/// CGAL's `do_intersect` under an exact-predicates kernel requires triangles with an area. A triangle with collinear
/// corners is therefore tested as the segment or point that it is.
bool triangles_intersect(const Triangle& a, const Triangle& b);
/// The same, given a guess that may be wrong. If it is right, five orientation tests are enough and one corner is not
/// read.
bool triangles_intersect_given(const Triangle_corners& a, const Triangle_corners& b, Crossing likely);

/// Whether a segment, or the point that both of its ends are, and a triangle have a point in common. Exact, as
/// `triangles_intersect`, and faster where the segment passes through the triangle.
bool segment_intersects(const Point& p, const Point& q, const Triangle& triangle);

/// Corners of the intersection of two triangles: one point, the two ends of a segment, or the corners of the polygon in
/// which two coplanar triangles overlap (at most 6), as one goes round it. Of all ways to list them it is the first in
/// lexicographic order, so the order of the triangles and of their corners makes no difference.
using Intersection_points = boost::container::static_vector<Point, 6>;

/// The intersection of two triangles. Each coordinate is the nearest double to that of the exact intersection. Empty if
/// they have no point in common.
///
/// Two triangles that cross cost about as much as twice the test whether they do. If they touch or are coplanar, it is
/// mostly up to 20 times as much; 100 times if they are coplanar on a slope, where predicates need exact numbers.
/// Rational numbers are needed where rounding is in doubt, some microseconds for each point, and if a triangle has no
/// area, up to 0.1 ms.
Intersection_points triangle_intersection(const Triangle& a, const Triangle& b);

/// Two triangles that are asked about together.
struct Triangle_pair {
  Triangle a;  ///< the first
  Triangle b;  ///< the second
};

/// The intersection of each pair: faster than one after the other.
/// @param intersections  one per pair, to be written
void triangle_intersections(std::span<const Triangle_pair> pairs, std::span<Intersection_points> intersections);

}  // namespace lodestone
