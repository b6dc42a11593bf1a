// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

/// The corners of the intersection of two triangles, as `triangle_intersection` returns them.
///
/// Which corners there are is decided by exact predicates alone. A corner of a triangle is a corner of the intersection
/// wherever the other triangle contains it. All others are crossings: of two edges, or of an edge and a face. Their
/// coordinates are computed in double-double; where an error bound does not prove which double is the nearest, in exact
/// numbers.
///
/// @param a,b  triangles that have an area
Intersection_points shared_corners(const Triangle& a, const Triangle& b);

/// Puts the corners of a segment or polygon in the order that `Intersection_points` promises.
void put_in_order(Intersection_points& corners);

}  // namespace lodestone
