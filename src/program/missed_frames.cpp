// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/missed_frames.h"

#include <fmt/format.h>

namespace lodestone {

std::optional<Missed_frames> expected_misses(Mode mode) {
  switch (mode) {
    case Mode::particles:
      // One minus the recall in the table of experiments/modes/README.md: twelve scenes, 12 to 128 particles per
      // object.
      return Missed_frames{.least = 0, .most = 0.24, .experiment = "modes"};
    case Mode::senin:
      // One minus the recall of the best and the worst seed in the table of experiments/predecessor/README.md.
      return Missed_frames{.least = 0, .most = 1, .experiment = "predecessor"};
    case Mode::exact:
      break;
  }
  return std::nullopt;
}

std::optional<std::string> missing_note(Mode mode) {
  const auto missed = expected_misses(mode);
  if (!missed) return std::nullopt;
  return fmt::format(
      "Mode {} may miss collisions: in the scenes of the experiment {} it missed {:.0f} to {:.0f} % of the colliding "
      "frames. Mode exact misses none.",
      name_of(mode), missed->experiment, 100 * missed->least, 100 * missed->most);
}

}  // namespace lodestone
