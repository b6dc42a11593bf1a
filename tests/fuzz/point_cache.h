// SPDX-License-Identifier: GPL-3.0-or-later
// Point caches, alone and with a mesh.
#pragma once

#include <string>

#include "fuzz/read_input.h"
#include "fuzz/scratch_folder.h"
#include "lodestone/io/motion/animation.h"

namespace lodestone::fuzz {

/// Reads the input as a point cache of the extension's format: alone, and as the motion of a mesh of four vertices.
inline void read_as_cache(Input input, const std::string& extension) {
  static const auto mesh = scratch().write("mesh.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
  const auto file = scratch().write("input" + extension, input);
  for (const auto& options : {Animation_options{}, Animation_options{.mesh = mesh}})
    accepts([&] {
      const auto animation = read_animation(file, options);
      check_motion(animation.motion, animation.vertices);
    });
}

}  // namespace lodestone::fuzz
