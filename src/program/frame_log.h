// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lodestone/detection/detector_options.h"
#include "lodestone/detection/frame.h"
#include "lodestone/io/scenes/scene_file.h"
#include "lodestone/queries/closest_faces.h"
#include "lodestone/queries/impact_search.h"

namespace lodestone {

/// The truth about one object pair in one frame.
struct Pair_truth {
  Object_pair pair = {};
  std::vector<Face_pair> faces;  ///< all intersecting face pairs, sorted
};

/// Where one object pair is closest in one frame.
struct Pair_closest {
  Object_pair pair = {};
  Closest_faces found = {};
};

/// What a frame says about a pair; null: it does not list the pair.
const Pair_result* listed(const Frame& frame, Object_pair pair);

/// JSON and a line break. Invalid UTF-8, which file names may contain, becomes U+FFFD.
/// @param indent  columns per level; negative: on one line
std::string json_text(const nlohmann::ordered_json& json, int indent = -1);

/// What is known about one frame. What was not asked for is missing.
struct Frame_findings {
  const Frame& frame;  ///< what the detector found
  /// Of all pairs. Adds the key `truth` to each pair, and adds pairs that collide but were not reported.
  const std::optional<std::vector<Pair_truth>>& truth;
  /// Of all pairs. Adds the key `closest`, a list of its own, since `pairs` omits those far apart.
  const std::optional<std::vector<Pair_closest>>& closest;
  /// Of the pairs that meet before the next frame. Adds the key `impacts`.
  const std::optional<std::vector<Object_impact>>& impacts;
};

/// One line of `frames.jsonl`, line break included.
///
/// @param frame  frame of the scene, from 0
/// @param objects  of the scene; faces are listed by their index in the file, once per triangle that they were cut into
/// @param options  of the detector that gave the result; they determine which keys are written
/// @param independent  leave out the statistics of mode `certified` that depend on earlier frames
std::string frame_line(std::size_t frame, const std::vector<Scene_object>& objects, const Frame_findings& findings,
                       const Detector_options& options, bool independent);

}  // namespace lodestone
