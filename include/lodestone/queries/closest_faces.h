// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/bounds/bounded_surface.h"
#include "lodestone/mesh/pairs.h"
#include "lodestone/queries/node_boxes.h"
#include "lodestone/triangles/triangle_distance.h"

namespace lodestone {

/// The closest faces of two objects, one of each.
struct Closest_faces {
  Face_pair faces = {};        ///< one of each object
  Closest_points points = {};  ///< with their distance, in units of the coordinates; 0 if and only if they intersect
};

/// The closest faces of two trees. The distance is that of `closest_points`, with its relative error of 2^-30; no other
/// pair is nearer by more than this error. Among several pairs that intersect, the lowest is returned. Among several at
/// the same distance, the choice is deterministic.
///
/// Branch and bound over node pairs, those with the nearest boxes first. O(log F) node pairs are opened, and a few leaf
/// pairs are compared, where the surfaces are nearest at one point; more where they run side by side. All F^2 pairs of
/// faces may be compared where these are long slivers side by side, such as two nested cones.
/// @param a, b  with boxes
Closest_faces closest_faces(const Layout_view& a, const Layout_view& b);

/// The same for surfaces that are bounded: leaves are posed only where boxes do not prove them farther apart than the
/// closest faces so far. Where a position is found outside its bound, its surface is posed as a whole; a bound that is
/// broken elsewhere goes unnoticed.
/// @throws Bad_mesh  a coordinate that is read is not finite
Closest_faces closest_faces(Bounded_surface& a, Bounded_surface& b);

/// The same for trees of any volumes: `Node_boxes` are fitted where they are no boxes.
template <Bounding_volume Volume>
Closest_faces closest_faces(const Basic_tree_view<Volume>& a, const Basic_tree_view<Volume>& b) {
  return closest_faces(Node_boxes(a).layout(), Node_boxes(b).layout());
}

}  // namespace lodestone
