// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/formats/mesh_soup.h"

namespace lodestone {

/// Cuts each face of n > 3 corners into n - 2 triangles, which use all its corners and are oriented as it is.
///
/// A quad is cut along the diagonal whose two triangles agree best in direction. A larger face is projected along the
/// coordinate axis that is nearest to its normal, and gets its constrained Delaunay triangulation in that plane. So
/// concave faces keep their outline, and faces that are not planar are legal. A face that has no area, touches itself
/// or crosses itself in the projection becomes a fan around its first corner. O(n log n) per face.
Mesh_soup triangulated(Polygon_soup soup);

}  // namespace lodestone
