// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/missed_frames.h"

#include <fmt/format.h>

namespace lodestone {

namespace {

/// Whether particles search as far, and read as much, as in the experiment `modes`.
bool searches_as_measured(const Detector_options& options) {
  const Detector_options measured;
  const bool opens_enough = options.meetings == 0 ||
                            (options.meetings >= measured.meetings && options.opening_reach >= measured.opening_reach &&
                             options.opening_budget >= measured.opening_budget);
  return opens_enough && options.collision_distance >= measured.collision_distance &&
         options.candidates == measured.candidates && options.distance_measure == measured.distance_measure &&
         options.growth <= measured.growth && (options.particles == 0 || options.particles >= 12);
}

}  // namespace

bool may_miss(const Detector_options& options) { return !finds_all(options.mode); }

std::optional<Missed_frames> expected_misses(const Detector_options& options) {
  // One minus the recall of the best and the worst seed in the table of experiments/predecessor/README.md.
  if (options.mode == Mode::senin) return Missed_frames{.least = 0, .most = 1, .experiment = "predecessor"};
  if (options.mode != Mode::particles || !searches_as_measured(options)) return std::nullopt;
  // One minus the recall in the tables of experiments/modes/README.md: fifteen scenes, 12 to 128 particles per object,
  // with meetings and without.
  return Missed_frames{.least = 0, .most = options.meetings > 0 ? 0 : 0.27, .experiment = "modes"};
}

std::optional<std::string> missing_note(const Detector_options& options) {
  if (!may_miss(options)) return std::nullopt;
  const auto missed = expected_misses(options);
  if (!missed)
    return fmt::format(
        "Mode {} may miss collisions, and with these options more than by default: no experiment has measured how "
        "many. Mode exact never misses any.",
        name_of(options.mode));
  const std::string range =
      missed->most > 0 ? fmt::format("{:.0f} to {:.0f} %", 100 * missed->least, 100 * missed->most) : "none";
  return fmt::format(
      "Mode {} may miss collisions: in the scenes of the experiment {} it missed {} of the colliding frames. Mode "
      "exact never misses any.",
      name_of(options.mode), missed->experiment, range);
}

}  // namespace lodestone
