// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/triangles/triangle_intersection.h"

/// What lies inside a closed mesh: a vertical ray leaves it an odd number of times.
namespace lodestone {

/// Whether the vertical ray from p towards +z crosses a triangle, with ties broken so that parity is right. Exact for
/// any finite coordinates. The triangle's orientation does not matter.
///
/// Every decision is made for the point q = p + (e, e^2, 0), with an e > 0 too small to change any that is no tie: the
/// simulation of simplicity of \cite edelsbrunner1990. Over any finite set of triangles there is such an e, so all
/// answers together are those for one and the same point q. Its ray meets no edge and no vertical triangle, for no line
/// through two projected corners passes through (p.x + e, p.y + e^2) for all small e. If p is not on the surface, q is
/// on the same side of it as p. And if every edge is in an even number of faces, the parity of crossings is
/// constant off the surface: a ray that is moved across an edge loses or gains an even number of them.
///
/// Hence the number of faces crossed, over a closed mesh (`is_closed`), is odd exactly if p is inside. For a p on the
/// triangle the answer is one of the two.
bool crosses_upward_ray(const Triangle& t, const Point& p);

/// Whether a point is inside a closed mesh, by all of its faces: O(F). What lies inside an even number of shells,
/// nested or overlapping, is outside. On the surface either answer is given.
/// @param positions  3 V coordinates, all finite
bool point_inside(const Point& p, std::span<const Corners> corners, std::span<const double> positions);

}  // namespace lodestone
