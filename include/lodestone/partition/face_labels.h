// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "lodestone/partition/partition.h"

namespace lodestone {

/// Label of a face or vertex that has none.
inline constexpr Region_index no_region = std::numeric_limits<Region_index>::max();

/// Labels of vertices, from labels of faces.
///
/// A vertex gets the label that most of the area of its faces has; ties go to the label of more of its faces, then to
/// the lowest. A label that no vertex gets this way takes one corner of its faces from a label that keeps another: the
/// corner it has most of, the lowest number of several. It is lost only when every corner of its faces is the last
/// vertex of its label. Vertices whose faces have no label take that of the nearest vertex that has one, along the
/// fewest edges; 0 where none can be reached, and for vertices without edges. Cost O(V + F log F).
///
/// @param face_labels  F, `no_region` for none
/// @return V labels, in general with gaps between the numbers
/// @throws Bad_argument  a number of labels other than that of the faces
std::vector<Region_index> vertex_labels(const Numbered_surface& surface, std::span<const Region_index> face_labels);

}  // namespace lodestone
