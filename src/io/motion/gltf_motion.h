// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "io/gltf/gltf_scene.h"
#include "lodestone/io/motion/motion.h"

namespace lodestone {

/// Keys farther apart are not frames: the curves between them make the motion.
inline constexpr double fewest_keys_per_second = 5;

/// As `read_gltf_motion`, for a file that has already been read.
Motion motion_of(std::shared_ptr<const Gltf_scene> scene, const Gltf_motion_options& options);

}  // namespace lodestone
