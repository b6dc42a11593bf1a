// SPDX-License-Identifier: GPL-3.0-or-later
// The collision distance as the mean over adjacent vertices, and read literally as the mean over all vertex pairs.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lodestone/io/results/text_table.h"
#include "shared/experiment.h"
#include "shared/measured_run.h"

namespace lodestone {

std::string run_collision_distance(const Experiment_context& context) {
  std::vector<Scene> scenes;
  scenes.push_back(read_scene(context.scenes / "teapot_sphere_1.json"));
  std::vector<Setting> settings;
  for (const std::size_t particles : {12, 32}) {
    for (const double distance : {0.5, 1.0, 2.0, 4.0, 8.0})
      settings.push_back(
          {fmt::format("{} x mean edge", distance),
           {.mode = Mode::particles, .particles = particles, .meetings = 0, .collision_distance = distance}});
    settings.push_back({"mean of all vertex pairs",
                        {.mode = Mode::particles,
                         .particles = particles,
                         .meetings = 0,
                         .distance_measure = Distance_measure::all_vertices}});
    settings.push_back(
        {"1 x mean edge, closest pair only",
         {.mode = Mode::particles, .particles = particles, .meetings = 0, .candidates = Candidate_choice::closest}});
  }
  const auto run = measure(scenes, settings, context.progress);

  Text_table table({"particles", "collision distance", "recall", "accuracy", "candidates per frame", "of all pairs",
                    "exact tests", "candidates + confirmation (us)"});
  nlohmann::ordered_json json;
  for (const auto& m : run.measurements) {
    const double candidates = mean_count(m, &Frame_statistics::candidates);
    const auto pairs = static_cast<double>(m.particles[0] * m.particles[1]);
    table.add({std::to_string(m.setting.options.particles), m.setting.name, fmt::format("{:.3f}", m.score.recall()),
               fmt::format("{:.3f}", m.score.accuracy()), fmt::format("{:.1f}", candidates),
               fmt::format("{:.1f} %", 100 * candidates / pairs),
               fmt::format("{:.0f}", mean_count(m, &Frame_statistics::exact_tests)),
               fmt::format("{:.1f}", median_microseconds(m, &Stage_times::candidates) +
                                         median_microseconds(m, &Stage_times::confirmation))});
    json.push_back(to_json(m));
  }
  write_json(context.out, "collision_distance", json);
  return "teapot_sphere_1, 300 frames.\n\n" + table.text();
}

}  // namespace lodestone
