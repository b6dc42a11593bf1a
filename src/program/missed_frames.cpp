// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/missed_frames.h"

#include <fmt/format.h>

namespace lodestone {

std::optional<Missed_frames> expected_misses(const Detector_options& options) {
  switch (options.mode) {
    case Mode::particles:
      // One minus the recall in the tables of experiments/modes/README.md: fifteen scenes, 12 to 128 particles per
      // object, with meetings and without.
      return Missed_frames{.least = 0, .most = options.meetings > 0 ? 0 : 0.27, .experiment = "modes"};
    case Mode::senin:
      // One minus the recall of the best and the worst seed in the table of experiments/predecessor/README.md.
      return Missed_frames{.least = 0, .most = 1, .experiment = "predecessor"};
    case Mode::exact:
    case Mode::certified:
      break;
  }
  return std::nullopt;
}

std::optional<std::string> missing_note(const Detector_options& options) {
  const auto missed = expected_misses(options);
  if (!missed) return std::nullopt;
  const std::string range =
      missed->most > 0 ? fmt::format("{:.0f} to {:.0f} %", 100 * missed->least, 100 * missed->most) : "none";
  return fmt::format(
      "Mode {} may miss collisions: in the scenes of the experiment {} it missed {} of the colliding frames. Mode exact "
      "never misses any.",
      name_of(options.mode), missed->experiment, range);
}

}  // namespace lodestone
