// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "lodestone/io/scenes/scene_file.h"

namespace lodestone {

/// Tells scenes apart that shards must not mix: of the frames, names and faces, of which objects meet, of how many
/// particles they have and where these start, and of the positions in the first and the last frame. Leaves the objects
/// as they are in the first frame.
std::string hash_of(Scene& scene);

}  // namespace lodestone
