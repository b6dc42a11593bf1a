// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "lodestone/volumes/leaf_faces.h"

namespace lodestone {

/// Eigenvectors of a symmetric matrix as rows, in ascending order of eigenvalues. For any matrix, a^T a differs from 1,
/// and a^T b from 0, by at most 3e-15 in exact arithmetic. The identity if an entry is not finite.
Eigen::Matrix3d principal_axes(const Eigen::Matrix3d& moments);

/// The same for the second moments of a leaf's vertices about their mean, for coordinates of any magnitude.
Eigen::Matrix3d principal_axes(const Leaf_faces& faces);

}  // namespace lodestone
