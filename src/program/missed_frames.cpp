// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/missed_frames.h"

#include <fmt/format.h>

#include <algorithm>

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
         options.growth <= measured.growth;
}

/// Whether there are as many particles, in regions of the same kind.
bool divides_as_measured(const Detector_options& options, const Particle_setting& setting) {
  const Detector_options measured;
  const Lbg_options lbg;
  const bool is_same_lbg = setting.strategy == "lbg" && setting.lbg.split == lbg.split &&
                           setting.lbg.tolerance == lbg.tolerance && setting.lbg.split_rule == lbg.split_rule &&
                           setting.lbg.sample == lbg.sample &&
                           setting.lbg.features.normal_weight == lbg.features.normal_weight;
  const std::size_t particles = options.particles == 0 ? options.least_particles : options.particles;
  const std::size_t fewest = setting.fewest_particles == 0 ? particles : std::min(particles, setting.fewest_particles);
  return is_same_lbg && options.partition.keep_islands == measured.partition.keep_islands &&
         options.close_seams == measured.close_seams && fewest >= measured.least_particles;
}

}  // namespace

bool may_miss(const Detector_options& options) { return !finds_all(options.mode); }

std::optional<Missed_frames> expected_misses(const Detector_options& options, const Particle_setting& setting) {
  // One minus the recall of the best and the worst seed in the table of experiments/predecessor/README.md.
  if (options.mode == Mode::senin) return Missed_frames{.least = 0, .most = 1, .experiment = "predecessor"};
  if (options.mode != Mode::particles) return std::nullopt;
  if (!searches_as_measured(options) || !divides_as_measured(options, setting)) return std::nullopt;
  // One minus the recall in the tables of experiments/modes/README.md: fifteen scenes, 12 to 128 particles per object,
  // with meetings and without.
  return Missed_frames{.least = 0, .most = options.meetings > 0 ? 0 : 0.27, .experiment = "modes"};
}

std::optional<std::string> missing_note(const Detector_options& options, const Particle_setting& setting) {
  if (!may_miss(options)) return std::nullopt;
  const auto missed = expected_misses(options, setting);
  if (!missed)
    return fmt::format(
        "Mode {} may miss collisions. The experiment modes has not measured how many with these options. Mode exact "
        "never misses any.",
        name_of(options.mode));
  const std::string range =
      missed->most > 0 ? fmt::format("{:.0f} to {:.0f} %", 100 * missed->least, 100 * missed->most) : "none";
  return fmt::format(
      "Mode {} may miss collisions: in the scenes of the experiment {} it missed {} of the colliding frames. Mode "
      "exact never misses any.",
      name_of(options.mode), missed->experiment, range);
}

}  // namespace lodestone
