// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/mesh/pairs.h"
#include "lodestone/queries/node_boxes.h"
#include "lodestone/triangles/triangle_distance.h"

namespace lodestone {

/// Two faces, one of each object, that no others are nearer than.
struct Closest_faces {
  Face_pair faces = {};
  Closest_points points = {};  ///< with their distance, in units of the coordinates; 0 if and only if they intersect
};

/// The closest faces of two trees. Distances are those of `closest_points`, and no pair is nearer by more than their
/// error, one part in 2^30. Of several pairs that intersect the lowest; of several that are equally far apart always
/// the same.
///
/// Branch and bound over pairs of nodes, the nearest boxes first: O(log F) openings and a few leaves where one place is
/// clearly nearest, more where the surfaces run side by side.
/// @param a, b  with boxes
Closest_faces closest_faces(const Layout_view& a, const Layout_view& b);

template <Bounding_volume Volume>
Closest_faces closest_faces(const Basic_tree_view<Volume>& a, const Basic_tree_view<Volume>& b) {
  return closest_faces(Node_boxes(a).layout(), Node_boxes(b).layout());
}

}  // namespace lodestone
