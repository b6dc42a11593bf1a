// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/bounds/bounded_surface.h"
#include "lodestone/queries/node_boxes.h"
#include "lodestone/tree/tree_surface.h"

namespace lodestone {

/// Where a point is with respect to a closed surface. A point inside an even number of shells, nested or overlapping,
/// is outside.
enum class Point_side {
  outside,     ///< inside an even number of shells
  inside,      ///< inside an odd number of shells
  on_surface,  ///< in a face
};

/// On which side of a closed surface a point is: on the surface if a face contains it, else inside if a ray from the
/// point along z, up or down, crosses an odd number of faces. Exact. O(log F + leaves that the ray meets).
/// @param surface  closed, see `Object_surface::closed`; with boxes. If it is not closed, `inside` has no meaning;
///                 `on_surface` is right
/// @param point    finite
/// @throws Bad_argument  the point is not finite
Point_side point_side(const Layout_view& surface, const Point& point);

/// The same for a surface that is bounded: only leaves whose boxes the ray meets are posed. Where a position is found
/// outside its bound, the surface is posed as a whole; a bound that is broken elsewhere goes unnoticed.
/// @throws Bad_argument  the point is not finite
/// @throws Bad_mesh      a coordinate that is read is not finite
Point_side point_side(Bounded_surface& surface, const Point& point);

/// Whether a point lies inside a surface, not on it: see `point_side`.
bool encloses(const Layout_view& surface, const Point& point);

/// Whether every component of `inner` lies inside `outer`. Exact. False if `outer` is not closed: it has no inside. A
/// hollow in `outer`, bounded by a component of its surface, counts as outside.
/// Asks about one point per component of `inner`: as long as so many calls of `point_side`.
/// @param outer, inner                two surfaces that do not intersect
/// @param outer_layout, inner_layout  of the two, with boxes
bool encloses(const Object_surface& outer, const Layout_view& outer_layout, const Object_surface& inner,
              const Layout_view& inner_layout);

/// The same for surfaces that are bounded. Of `inner` one position per component is computed, unless the boxes around
/// the two are apart, and compared with the boxes in use. Broken bounds are handled as by `point_side`.
/// @throws Bad_mesh  a coordinate that is read is not finite
bool encloses(Bounded_surface& outer, Bounded_surface& inner);

/// The same for trees of any volumes: `Node_boxes` are fitted where they are no boxes.
template <Bounding_volume Volume>
Point_side point_side(const Basic_tree_surface<Volume>& surface, const Point& point) {
  return point_side(Node_boxes(surface.view()).layout(), point);
}

/// The same for trees of any volumes.
template <Bounding_volume Volume>
bool encloses(const Basic_tree_surface<Volume>& surface, const Point& point) {
  return encloses(Node_boxes(surface.view()).layout(), point);
}

/// The same for trees of any volumes.
template <Bounding_volume Volume>
bool encloses(const Basic_tree_surface<Volume>& outer, const Basic_tree_surface<Volume>& inner) {
  return encloses(outer, Node_boxes(outer.view()).layout(), inner, Node_boxes(inner.view()).layout());
}

}  // namespace lodestone
