// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "lodestone/volumes/bounding_sphere.h"
#include "lodestone/volumes/leaf_faces.h"
#include "volumes/ball_kernel.h"

namespace lodestone {

/// Centre of the sphere that fits the vertices of a leaf best. If it would be farther than 2^10 radii of the ball
/// around them, it is a point at that distance behind the faces, so that neighbours in a flat surface have theirs on
/// the same side.
/// @param points  the vertices of `faces`
/// @param ball    around them; its radius is not 0, and `has_room_for_shell`
Eigen::Vector3d shell_centre(const Leaf_faces& faces, const kernel::Leaf_points& points, const Bounding_sphere& ball);

}  // namespace lodestone
