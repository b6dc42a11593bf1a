// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "program/measurement.h"
#include "shared/face_pair_count.h"
#include "shared/interval.h"

namespace lodestone {

/// The figures of one setting on one scene.
struct Mode_figures {
  std::string scene;
  std::size_t triangles = 0;  ///< of all objects
  std::size_t vertices = 0;   ///< of all objects
  Measurement measurement;
  bool is_truth = false;  ///< the answers of other settings are compared with its own, so it has no recall
  Face_pair_count face_pairs;
  double exact_median = 0;  ///< of the mode `exact` on this scene, in microseconds
};

/// The mean recall over the plays, with Wilson's interval; none if nothing collides, or the setting is the truth.
std::optional<Interval> recall_interval(const Mode_figures& figures);

/// A row per scene and setting.
std::string table_of_scenes(std::span<const Mode_figures> rows);
/// A row per setting: mean and least recall, of frames and of face pairs, over the scenes in which something collides;
/// and precision.
std::string table_of_settings(std::span<const Mode_figures> rows);

nlohmann::ordered_json to_json(const Mode_figures& figures);

}  // namespace lodestone
