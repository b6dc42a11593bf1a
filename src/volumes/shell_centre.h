// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "lodestone/volumes/bounding_sphere.h"
#include "lodestone/volumes/leaf_faces.h"
#include "volumes/ball_kernel.h"

namespace lodestone {

/// Centre of the sphere that fits best to the vertices of a leaf, or a point 2^10 radii of the ball around them away if
/// it is farther: then on the back of the faces, so that neighbours in a flat surface have theirs on the same side.
/// @param points  the vertices of `faces`
/// @param ball    around them; its radius is ordinary and not 0
Eigen::Vector3d shell_centre(const Leaf_faces& faces, const kernel::Leaf_points& points, const Bounding_sphere& ball);

}  // namespace lodestone
