// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "first_answer/contestant.h"
#include "first_answer/once_scene.h"

namespace lodestone {

/// Seconds of one question.
struct Once_times {
  double first = 0;  ///< from two meshes to the first answer: reading and building included; the median of all rounds
  double frame = 0;  ///< one more frame: following the meshes and answering; the median

  double of_frames(std::size_t frames) const { return first + static_cast<double>(frames - 1) * frame; }
};

/// Figures of one contestant on one scene.
struct Once_figures {
  const Once_contestant* contestant = nullptr;
  std::optional<Once_times> any = {}, all = {};  ///< none: not reported, not asked, or given up in the first round
  std::size_t peak_bytes = 0;                    ///< more resident memory than before, at most, for the first yes or no
  bool left_out = false;                         ///< was too slow in a smaller scene
  bool gave_up = false;
  bool right = true;  ///< all answers were, the first and those of later frames
};

/// From which frame on a session is faster in all than one call per frame. None: never.
std::optional<std::size_t> pays_from(const Once_times& session, const Once_times& calls);

/// Asks all contestants, which take turns, round by round. Times of making the scene and of comparing answers do not
/// count.
/// @param left_out     per contestant: whether to leave it out
/// @param most_rounds  fewer for a contestant that has used a second for a question
std::vector<Once_figures> measure_first_answers(Once_scene& scene, std::span<const Once_contestant> contestants,
                                                const std::vector<bool>& left_out, std::size_t most_rounds = 60);

}  // namespace lodestone
