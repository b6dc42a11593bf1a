// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "lodestone/io/scenes/scene_file.h"

namespace lodestone {

/// Lets motions that have times run by one clock. If their rates or the times of their first frames differ, by more than
/// rounding, those whose reader chose the rate are sampled again from time 0 on. The frames of others stay as they are. The new rate is the one that the others were given, if that
/// is one; else the one that all have; else 30 frames per second.
void share_clock(std::span<Scene_object> objects);

}  // namespace lodestone
