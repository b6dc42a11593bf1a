// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "lodestone/io/motion/motion.h"

namespace lodestone {

/// Makes a motion of other files fail in frames in which joined vertices are apart: the faces of the mesh would follow
/// the first of them, and the others would be lost.
/// @param joined  vertices of the mesh
/// @param mesh    its file, for messages
/// @return the motion, which throws Bad_motion from `pose` in such a frame
Motion keep_joined(Motion motion, const Joined_vertices& joined, const std::filesystem::path& mesh);

}  // namespace lodestone
