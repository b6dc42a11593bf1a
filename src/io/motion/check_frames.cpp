// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/motion/check_frames.h"

#include <fmt/format.h>

#include "lodestone/mesh/errors.h"

namespace lodestone {

void check_frames(const std::string& name, std::size_t frames, const Mesh_file_options& limits) {
  if (frames > limits.max_frames)
    throw Bad_motion(fmt::format("{}: {} frames, where at most {} are allowed", name, frames, limits.max_frames));
}

}  // namespace lodestone
