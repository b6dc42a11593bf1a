// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "lodestone/detection/detector_options.h"
#include "lodestone/partition/lbg.h"

namespace lodestone {

/// The colliding frames that a mode missed in a published experiment.
struct Missed_frames {
  double least = 0;        ///< share of the colliding frames, where it missed the fewest
  double most = 0;         ///< where it missed the most
  const char* experiment;  ///< which measured it: a folder of experiments/
};

/// What the answers of particles depend on besides the options of the detector.
struct Particle_setting {
  std::string_view strategy = "lbg";  ///< name, which must outlive this; empty: one of the caller's own
  Lbg_options lbg = {};               ///< its settings
  std::size_t fewest_particles = 0;   ///< the least number that an object asks for on its own; 0: none does
};

/// Whether a mode may miss collisions: all but `exact` and `certified`.
bool may_miss(const Detector_options& options);

/// How many colliding frames a run may be expected to miss; none for a mode that misses nothing, for options that leave
/// out more than those of the experiments, and for other partitions.
std::optional<Missed_frames> expected_misses(const Detector_options& options, const Particle_setting& setting);

/// What a user must know of the answers of a mode, in plain sentences; none for the mode `exact`.
std::optional<std::string> missing_note(const Detector_options& options, const Particle_setting& setting);

}  // namespace lodestone
