// SPDX-License-Identifier: GPL-3.0-or-later
// Trees of every bounding volume over every partition, beside the particles of the paper.
#include "shared/experiment.h"
#include "shared/measured_run.h"
#include "shared/race_figures.h"
#include "volumes/volume_report.h"

namespace lodestone {

namespace {

/// Some thirty contestants take part, so each has less time than in the experiment `peers`.
constexpr Race_options race_options{.triangles = 12'000'000, .passes = 4, .seconds = 1.5};

}  // namespace

std::string run_volumes(const Experiment_context& context) {
  const auto names = race_scenes(context);
  std::vector<Volume_scene> measured;
  constexpr std::size_t steps = 1000;  // per scene
  for (std::size_t s = 0; s < names.size(); ++s) {
    auto scene = read_scene(context.scenes / (names[s] + ".json"));
    context.progress(s * steps, names.size() * steps);
    measured.push_back(measure_volumes(scene, race_options, [&](double share) {
      context.progress(s * steps + static_cast<std::size_t>(share * steps), names.size() * steps);
    }));
  }
  write_json(context.out, "volumes", volume_json(measured));
  return volume_report(measured);
}

}  // namespace lodestone
