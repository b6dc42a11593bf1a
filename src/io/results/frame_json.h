// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "lodestone/detection/detector_options.h"
#include "lodestone/detection/frame.h"

/// Parts of a line of `frames.jsonl` that the program and Python write alike.
namespace lodestone {

/// The names of a pair's objects, and whether they collide or are near.
nlohmann::ordered_json verdict_json(const std::string& name_a, const std::string& name_b, const Pair_result& pair,
                                    const Detector_options& options);

/// What a frame took. Only counts, since times differ from run to run.
/// @param independent  leave out those of mode `certified` that depend on earlier frames
nlohmann::ordered_json statistics_json(const Frame_statistics& statistics, Mode mode, bool independent = false);

}  // namespace lodestone
