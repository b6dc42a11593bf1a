// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/queries/node_boxes.h"
#include "lodestone/tree/tree_surface.h"

namespace lodestone {

/// Whether a point lies inside a surface: whether the ray from the point along +z crosses an odd number of faces.
/// Exact. O(log F + leaves that the ray meets).
/// @param surface  closed, see `Object_surface::closed`; with boxes
/// @param point    not on the surface
bool encloses(const Layout_view& surface, const Point& point);

/// Whether every component of `inner` lies inside `outer`. Exact. False if `outer` is not closed: it has no inside. A
/// hollow in `outer`, bounded by a component of its surface, counts as outside.
/// @param outer, inner                two surfaces that do not intersect
/// @param outer_layout, inner_layout  of the two, with boxes
bool encloses(const Object_surface& outer, const Layout_view& outer_layout, const Object_surface& inner,
              const Layout_view& inner_layout);

template <Bounding_volume Volume>
bool encloses(const Basic_tree_surface<Volume>& surface, const Point& point) {
  return encloses(Node_boxes(surface.view()).layout(), point);
}

template <Bounding_volume Volume>
bool encloses(const Basic_tree_surface<Volume>& outer, const Basic_tree_surface<Volume>& inner) {
  return encloses(outer, Node_boxes(outer.view()).layout(), inner, Node_boxes(inner.view()).layout());
}

}  // namespace lodestone
