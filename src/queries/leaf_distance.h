// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "lodestone/volumes/aabb.h"
#include "lodestone/volumes/leaf_faces.h"

namespace lodestone {

/// The squared distance of a point from the nearest face of a leaf, in units of the square of a radius: as computed,
/// not rounded to any side. O(faces), vectorised.
/// @param leaf    its list of vertices is padded with a vector of other vertices of the mesh
/// @param box     encloses the leaf
/// @param point   finite
/// @param radius  > 0
/// @return infinity if all faces are proven to be farther away than the radius
double relative_squared_distance(const Leaf_faces& leaf, const Aabb& box, const Eigen::Vector3d& point, double radius);

}  // namespace lodestone
