// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/triangles/triangle_intersection.h"

/// Containment in a closed mesh: a vertical ray from a point inside crosses its faces an odd number of times.
namespace lodestone {

/// Whether the vertical ray from p towards +z crosses a triangle, with ties broken such that the parity of crossings is
/// right. Exact for any finite coordinates. The orientation of the triangle does not matter.
///
/// Every decision is made for the point q = p + (e, e^2, 0), where e > 0 is too small to change any decision that is
/// not a tie: the simulation of simplicity of \cite edelsbrunner1990. For any finite set of triangles there is such an
/// e, so all answers together are those for one and the same point q. The ray from q meets no edge and no vertical
/// triangle, because no line through two projected corners passes through (p.x + e, p.y + e^2) for all small e. If p is
/// not on the surface, q is on the same side of it as p. If every edge is in an even number of faces, the parity of
/// crossings is constant off the surface: a ray that moves across an edge loses or gains an even number of crossings.
///
/// Hence the number of faces of a closed mesh (`is_closed`) that the ray crosses is odd exactly if p is inside. If p is
/// on the triangle, either answer may be given.
bool crosses_upward_ray(const Triangle& t, const Point& p);

}  // namespace lodestone
