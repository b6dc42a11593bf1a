// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "lodestone/io/scenes/scene_file.h"

namespace lodestone {

/// Lets motions that have times run by one clock. If their rates or the times of their first frames differ, by more
/// than rounding, those whose reader chose the rate are sampled again. The frames of others stay as they are. The new
/// rate and start are those of the others, if these agree. Else the rate is the one that all have, or 30 frames per
/// second, and the start is time 0.
void share_clock(std::span<Scene_object> objects);

}  // namespace lodestone
