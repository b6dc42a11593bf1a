// SPDX-License-Identifier: GPL-3.0-or-later
// A sphere inflates to three times its size, without repartitioning and with several growth limits.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <limits>

#include "lodestone/io/results/text_table.h"
#include "shared/experiment.h"
#include "shared/measured_run.h"

namespace lodestone {

std::string run_growth(const Experiment_context& context) {
  std::vector<Scene> scenes;
  scenes.push_back(read_scene(context.scenes / "inflate.json"));
  std::vector<Setting> settings;
  for (const std::size_t particles : {0, 12, 32})
    for (const double growth : {1.0, 1.25, 1.5, 2.0, std::numeric_limits<double>::infinity()})
      settings.push_back({fmt::format("{} A*", growth),
                          {.mode = Mode::particles, .particles = particles, .meetings = 0, .growth = growth}});
  const auto run = measure(scenes, settings, context.progress);

  Text_table table({"particles wanted", "limit", "repartitions", "particles at the end", "recall", "accuracy",
                    "delay (frames)", "median (us)", "mean (us)"});
  nlohmann::ordered_json json;
  for (const auto& m : run.measurements) {
    double repartitions = 0;
    for (const auto& frame : m.frames) repartitions += static_cast<double>(frame.repartitions);
    const auto wanted = m.setting.options.particles;
    table.add({wanted == 0 ? "by rule" : std::to_string(wanted),
               std::isinf(m.setting.options.growth) ? "never" : m.setting.name, fmt::format("{}", repartitions),
               fmt::format("{}", fmt::join(m.particles, ", ")), fmt::format("{:.3f}", m.score.recall()),
               fmt::format("{:.3f}", m.score.accuracy()), fmt::format("{:.1f}", m.score.mean_delay()),
               fmt::format("{:.1f}", median_microseconds_without_build(m)),
               fmt::format("{:.1f}", mean_microseconds_without_build(m))});
    json.push_back(to_json(m));
  }
  write_json(context.out, "growth", json);
  return "A sphere grows to three times its size within 150 frames and touches a second one; 300 frames, three "
         "objects.\n\n" +
         table.text();
}

}  // namespace lodestone
