// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "lodestone/queries/contact_search.h"
#include "lodestone/queries/containment.h"
#include "lodestone/queries/node_boxes.h"
#include "lodestone/tree/tree_surface.h"

namespace lodestone {

/// A translation that parts two objects a and b: once a is moved by it, or b by its opposite, the two surfaces do not
/// intersect, and neither lies inside the other.
struct Parting {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< of a, in units of the coordinates
  double length = 0;                                      ///< of the translation
};

/// A short translation that parts two objects; mostly not the shortest there is.
///
/// Moved along a direction by more than its clearance (`triangles/clearance.h`), each point of a lies ahead of every
/// point of b that it is in line with. So no point is common. Neither object is inside the other, since each line out
/// of a closed surface meets it: the line backwards from a point of b meets no point of a, and that forwards from a
/// point of a meets no point of b. This holds for open surfaces as well.
///
/// The clearance is the largest of those of all face pairs. It is computed along directions that suggest themselves:
/// - the normals of the contact patches, beyond 64 only those that are not nearly along one before, and their sum;
/// - the way between the centres of the boxes;
/// - for surfaces that do not intersect, the way between the closest faces;
/// - the axes and the diagonals between them.
///
/// From the best of them the search goes on to the normal of the plane in which the two touch last, then to directions
/// beside it, as long as this helps. Of directions with the same length the first wins.
///
/// The translation also parts them if every moved coordinate is rounded to a double. It is longer than the clearance by
/// some 10^-13 of the size of the objects, and 10^-15 of their distance from the origin; more where they graze each
/// other along the translation. The answer depends neither on the trees nor on their volumes.
///
/// Costs some dozens of searches over the two trees, and two for each normal, most of which end early, besides the
/// search for all contacts.
/// @param surface_a, surface_b  that intersect, or one of which lies inside the other
/// @param a, b                  of the two, with boxes
/// @param contacts              all face pairs that intersect, sorted
/// @param workers               search along several directions at once; the answer does not depend on their number
Parting parting(const Object_surface& surface_a, const Layout_view& a, const Object_surface& surface_b,
                const Layout_view& b, std::span<const Face_pair> contacts, Workers& workers = Workers::alone());

/// The same for two objects whose surfaces intersect, or one of which lies inside the other.
/// @return none for any others
template <Bounding_volume Volume>
std::optional<Parting> parting(const Basic_tree_surface<Volume>& a, const Basic_tree_surface<Volume>& b,
                               Workers& workers = Workers::alone()) {
  std::vector<Face_pair> contacts;
  Basic_contact_search<Volume>(workers).between(a, b, {}, contacts);
  const Node_boxes boxes_a(a.view()), boxes_b(b.view());
  const Layout_view &view_a = boxes_a.layout(), &view_b = boxes_b.layout();
  if (contacts.empty() && !encloses(a, view_a, b, view_b) && !encloses(b, view_b, a, view_a)) return std::nullopt;
  return parting(a, view_a, b, view_b, contacts, workers);
}

}  // namespace lodestone
