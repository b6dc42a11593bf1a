// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "lodestone/detection/detector_options.h"

namespace lodestone {

/// The colliding frames that a mode missed in a published experiment.
struct Missed_frames {
  double least = 0;        ///< share of the colliding frames, where it missed the fewest
  double most = 0;         ///< where it missed the most
  const char* experiment;  ///< which measured it: a folder of experiments/
};

/// Whether a mode may miss collisions: all but `exact` and `certified`.
bool may_miss(const Detector_options& options);

/// How many colliding frames a run with these options may be expected to miss; none for a mode that misses nothing, and
/// for options that leave out more than those of the experiments.
std::optional<Missed_frames> expected_misses(const Detector_options& options);

/// What a user must know of the answers of a mode, in plain sentences; none for the mode `exact`.
std::optional<std::string> missing_note(const Detector_options& options);

}  // namespace lodestone
