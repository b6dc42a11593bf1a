// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "lodestone/detection/frame.h"
#include "lodestone/mesh/pairs.h"

namespace lodestone {

/// What exhaustive checking says of one pair of objects, and what the run answered.
struct Pair_score {
  Object_pair pair;
  bool truth = false;
  bool seen = false;
};

struct Pair_distance {
  Object_pair pair;
  double distance = 0;  ///< in units of the coordinates
};

/// When two objects meet first on the way to the next frame.
struct Pair_impact_time {
  Object_pair pair;
  double time = 0;  ///< 0: in the frame, 1: in the next one
};

/// What the summary of a run needs to know of one frame.
struct Frame_tally {
  std::size_t frame = 0;
  std::vector<Pair_result> pairs = {};  ///< without their indices in lists of the frame; only the length of a parting
  Frame_statistics statistics = {};
  std::vector<Pair_score> scores = {};         ///< with --truth
  std::vector<Pair_distance> distances = {};   ///< with --closest
  std::vector<Pair_impact_time> impacts = {};  ///< with --impacts
  bool contradicted = false;                   ///< something was reported that is not true
  bool missed = false;                         ///< something true was not reported
};

/// On one line, for a shard. Doubles keep their value.
nlohmann::ordered_json to_json(const Frame_tally& tally);
/// @throws nlohmann::json::exception  it is not what `to_json` gives
Frame_tally frame_tally_of(const nlohmann::ordered_json& json);

}  // namespace lodestone
