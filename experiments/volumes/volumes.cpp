// SPDX-License-Identifier: GPL-3.0-or-later
// Trees of every bounding volume over every partition, beside the particles of the paper.
#include "shared/experiment.h"
#include "shared/measured_run.h"
#include "shared/race_figures.h"
#include "volumes/volume_report.h"

namespace lodestone {

namespace {

/// Some thirty contestants take part, so each gets less time than in the experiment `peers`.
constexpr Race_options race_options{.triangles = 12'000'000, .passes = 4, .seconds = 1.5};

}  // namespace

std::string run_volumes(const Experiment_context& context) {
  std::vector<Volume_scene> measured;
  for_each_scene(context, [&](Scene& scene, const Scene_progress& progress) {
    measured.push_back(measure_volumes(scene, race_options, progress));
  });
  write_json(context.out, "volumes", volume_json(measured));
  return volume_report(measured);
}

}  // namespace lodestone
