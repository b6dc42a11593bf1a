// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "lodestone/bounds/bounded_surface.h"
#include "lodestone/mesh/concepts.h"
#include "lodestone/queries/node_boxes.h"

namespace lodestone {

/// The face of a surface that is nearest to a point.
struct Closest_point {
  std::uint32_t face = 0;  ///< its index
  Point point = {};        ///< nearest point of the face, up to rounding
  double distance = 0;  ///< relative error below 2^-30 if it is a normal number; 0 if and only if the face contains the
                        ///< query; infinity if it exceeds the largest double
};

/// The point of a surface that is nearest to a point. Which face is nearest is decided exactly; of several at the same
/// distance, such as those around a vertex, the one with the lowest index is returned.
///
/// Branch and bound, the nearer box first. O(log F) nodes are opened, and the faces of a few leaves compared, unless
/// the point is nearly as far from all of the surface. Exact numbers are needed where two faces are at nearly the same
/// distance, except where this is that of a vertex or an edge that both share: some microseconds per face.
/// @param surface  with boxes
/// @throws Bad_argument  the point is not finite
Closest_point closest_point(const Layout_view& surface, const Point& point);

/// The same for a surface that is bounded: only leaves whose boxes do not prove them farther are posed. Where a
/// position is found outside its bound, the surface is posed as a whole; a bound that is broken elsewhere goes
/// unnoticed.
/// @throws Bad_argument  the point is not finite
/// @throws Bad_mesh      a coordinate that is read is not finite
Closest_point closest_point(Bounded_surface& surface, const Point& point);

/// The same for trees of any volumes: `Node_boxes` are fitted where they are no boxes.
template <Bounding_volume Volume>
Closest_point closest_point(const Basic_tree_view<Volume>& surface, const Point& point) {
  return closest_point(Node_boxes(surface).layout(), point);
}

}  // namespace lodestone
