// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "io/gltf/gltf_scene.h"
#include "lodestone/io/motion/motion.h"

namespace lodestone {

struct Gltf_motion {
  Motion motion = {};
  double frames_per_second = 0;
};

/// As `read_gltf_motion`, for a file that has already been read.
Gltf_motion motion_of(std::shared_ptr<const Gltf_scene> scene, const Gltf_motion_options& options);

}  // namespace lodestone
