// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "io/formats/game_model.h"
#include "lodestone/io/motion/motion.h"

namespace lodestone {

/// As `read_game_motion`, for a file that has already been read.
Motion motion_of(std::shared_ptr<const Game_model> model);

}  // namespace lodestone
