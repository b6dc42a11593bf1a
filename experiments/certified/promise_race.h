// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lodestone/io/scenes/scene_file.h"

namespace lodestone {

/// What one kind of promise saves on one scene: for yes or no, and for all pairs.
struct Promise_row {
  std::string promise;
  bool is_computed = false;                                ///< positions are computed, not in memory
  std::vector<double> any_read = {}, all_read = {};        ///< per frame: positions read
  std::vector<double> any_seconds = {}, all_seconds = {};  ///< per frame
  std::size_t wrong_answers = 0, wrong_sets = 0;           ///< frames that differ from mode `exact`
  std::size_t violations = 0;
};

struct Promise_figures {
  std::string scene;
  std::size_t triangles = 0, vertices = 0;
  std::size_t frames = 0, colliding = 0;
  Promise_row exact = {};            ///< reads positions in memory
  Promise_row posed_and_exact = {};  ///< computes all positions first
  std::vector<Promise_row> rows = {};
};
/// What a row is compared with: the mode `exact` on the same kind of positions.
const Promise_row& exact_beside(const Promise_row& row, const Promise_figures& figures);

/// Plays a scene with the mode `exact` on positions in memory and on computed ones, and with the mode `certified` and a
/// promise of each kind that is true and tight:
/// - displacement: in each frame the largest distance by which a vertex of the object has moved since the last;
/// - stretch: in each frame the largest ratio of the length of an edge to that in frame 0;
/// - Lipschitz: the constant of the object's deformations, whose positions are then computed when they are read.
///
/// The promises are found outside the measured time. So is posing, but where positions are computed: then `exact`
/// computes all of them in each frame.
Promise_figures race_promises(Scene& scene, const std::function<void(double share)>& progress);

}  // namespace lodestone
