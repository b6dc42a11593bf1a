// SPDX-License-Identifier: GPL-3.0-or-later
// The two situations in which the paper says that its predecessor fails. Both methods play the same frames.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lodestone/io/results/text_table.h"
#include "shared/experiment.h"
#include "shared/measured_run.h"

namespace lodestone {

namespace {

constexpr int seeds = 5;

/// Per number of particles: the regions, with meetings too, then the predecessor with each of its seeds.
std::vector<Setting> all_methods() {
  std::vector<Setting> settings;
  for (const std::size_t particles : {4, 12, 32}) {
    settings.push_back(
        {fmt::format("regions, {}", particles), {.mode = Mode::particles, .particles = particles, .meetings = 0}});
    settings.push_back({fmt::format("meetings, {}", particles), {.mode = Mode::particles, .particles = particles}});
    for (std::uint64_t seed = 1; seed <= seeds; ++seed)
      settings.push_back({fmt::format("scattered, {}, seed {}", particles, seed),
                          {.mode = Mode::senin, .particles = particles, .senin = {.seed = seed}}});
  }
  return settings;
}

/// One row for the regions, one with meetings, one for the predecessor over all its seeds.
void add_rows(Text_table& table, const std::string& scene, std::span<const Measurement> group) {
  const auto add = [&](const char* method, std::span<const Measurement> runs) {
    Score score;
    double lowest = 1, highest = 0, microseconds = 0;
    for (const auto& m : runs) {
      score.add(m.score);
      lowest = std::min(lowest, m.score.recall());
      highest = std::max(highest, m.score.recall());
      microseconds += median_microseconds_without_build(m) / static_cast<double>(runs.size());
    }
    table.add({scene, method, std::to_string(runs[0].setting.options.particles), fmt::format("{:.3f}", score.recall()),
               fmt::format("{:.3f}", lowest), fmt::format("{:.3f}", highest), fmt::format("{:.3f}", score.precision()),
               fmt::format("{} of {}", score.never_seen(), score.collisions()),
               fmt::format("{:.1f}", score.mean_delay()), fmt::format("{:.1f}", microseconds)});
  };
  add("regions", group.first(1));
  add("regions, meetings", group.subspan(1, 1));
  add("scattered", group.subspan(2));
}

}  // namespace

std::string run_predecessor(const Experiment_context& context) {
  const std::vector<std::string> names{"wrong_side", "third_object", "inflate"};
  const auto settings = all_methods();
  Text_table table({"scene", "method", "particles", "recall", "lowest seed", "highest seed", "precision", "never seen",
                    "delay (frames)", "us per frame"});
  nlohmann::ordered_json json;
  for (std::size_t n = 0; n < names.size(); ++n) {
    std::vector<Scene> scenes;
    scenes.push_back(read_scene(context.scenes / (names[n] + ".json")));
    const auto run = measure(scenes, settings, [&](std::size_t done, std::size_t of) {
      context.progress(n * of + done, names.size() * of);
    });
    constexpr std::size_t group = 2 + seeds;
    for (std::size_t first = 0; first < run.measurements.size(); first += group)
      add_rows(table, names[n], std::span(run.measurements).subspan(first, group));
    for (const auto& m : run.measurements) json[names[n]].push_back(to_json(m));
  }
  write_json(context.out, "predecessor", json);
  return fmt::format("`scattered` is the predecessor; its rows sum up {} seeds.\n\n", seeds) + table.text();
}

}  // namespace lodestone
