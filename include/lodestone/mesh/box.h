// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>

namespace lodestone {

/// Axis-aligned box. Minima and maxima of coordinates are exact, so two boxes that do not overlap prove that their
/// contents are apart.
using Box = Eigen::AlignedBox3d;

}  // namespace lodestone
