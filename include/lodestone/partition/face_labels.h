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
/// A vertex gets the label with the largest area among its faces. Ties go to the label of more of its faces, then to
/// the lowest label. A label that no vertex gets in this way takes one corner of its faces from a label that keeps
/// another vertex. It takes the corner around which it has the largest area; of several, the lowest vertex index. A
/// label is lost only if every corner of its faces is the last vertex of another label. A vertex whose faces have no
/// label takes the label of the nearest vertex that has one, counted in edges. The label is 0 if no such vertex can be
/// reached, and for vertices without edges. Cost O(V + F log F).
///
/// @param face_labels  F, `no_region` for none
/// @return V labels, in general with gaps between them
/// @throws Bad_argument  the number of labels is not that of the faces
std::vector<Region_index> vertex_labels(const Numbered_surface& surface, std::span<const Region_index> face_labels);

}  // namespace lodestone
