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
  std::vector<double> any_read = {}, all_read = {};        ///< per frame: positions read
  std::vector<double> any_seconds = {}, all_seconds = {};  ///< per frame
  std::size_t wrong_answers = 0, wrong_sets = 0;           ///< frames that differ from mode `exact`
  std::size_t violations = 0;
};

struct Promise_figures {
  std::string scene;
  std::size_t triangles = 0, vertices = 0;
  std::size_t frames = 0, colliding = 0;
  Promise_row exact = {.promise = "none: exact"};
  std::vector<Promise_row> rows = {};
};

/// Plays a scene with the mode `exact`, and with the mode `certified` and a promise of each kind that is true and
/// tight:
/// - displacement: in each frame the largest distance by which a vertex of the object has moved since the last;
/// - stretch: in each frame the largest ratio of the length of an edge to that in frame 0;
/// - Lipschitz: the constant of the object's deformations, whose positions are then computed when they are read.
///
/// The promises are found outside the measured time. So is posing, but for the Lipschitz bound.
Promise_figures race_promises(Scene& scene, const std::function<void(double share)>& progress);

}  // namespace lodestone
