// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "lodestone/io/scenes/scene_file.h"
#include "program/measurement.h"

namespace lodestone {

/// How many of the face pairs that intersect a setting reports.
struct Face_pair_count {
  std::size_t found = 0;
  std::size_t all = 0;  ///< that the mode `exact` finds
};

/// Plays a scene with settings that are asked for all contacts. Counts the intersecting face pairs of different objects
/// in all frames together. Nothing is timed.
/// @param progress  called after each frame with the frames done and those of the scene; may throw to stop
/// @return one count per setting
std::vector<Face_pair_count> count_face_pairs(Scene& scene, std::span<const Setting> settings,
                                              const std::function<void(std::size_t done, std::size_t of)>& progress);

}  // namespace lodestone
