// SPDX-License-Identifier: GPL-3.0-or-later
// What a frame costs in each mode, and what it misses.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lodestone/io/results/text_table.h"
#include "shared/experiment.h"
#include "shared/measured_run.h"

namespace lodestone {

namespace {

struct Chosen_scene {
  const char* name;
  Truth_source truth = Truth_source::exhaustive;
};

constexpr Chosen_scene chosen_scenes[] = {{"teapot_sphere_1"},
                                          {"torus_knots"},
                                          {"cloth_sphere"},
                                          {"bodies_20"},
                                          {"spheres_5k"},
                                          {"spheres_50k", Truth_source::exact_mode},
                                          {"torus_knots_20k", Truth_source::exact_mode},
                                          {"cloth_sphere_80k", Truth_source::exact_mode},
                                          {"bodies_20_5k", Truth_source::exact_mode},
                                          {"torus_knots_200k", Truth_source::exact_mode},
                                          {"spheres_500k", Truth_source::exact_mode},
                                          {"spheres_2m", Truth_source::exact_mode}};

std::vector<Setting> mode_settings() {
  std::vector<Setting> settings;
  for (const std::size_t particles : {12, 32, 64, 128})
    settings.push_back(
        {fmt::format("particles, {}", particles), {.mode = Mode::particles, .particles = particles, .growth = 1.25}});
  settings.push_back({"exact", {.mode = Mode::exact}});
  return settings;
}

}  // namespace

std::string run_modes(const Experiment_context& context) {
  const auto settings = mode_settings();
  Text_table table(
      {"scene", "triangles", "mode", "recall", "delay (frames)", "median (us)", "mean (us)", "exact / this (median)"});
  nlohmann::ordered_json json;
  std::size_t played = 0;
  for (const auto& chosen : chosen_scenes) {
    std::vector<Scene> scenes;
    scenes.push_back(read_scene(context.scenes / fmt::format("{}.json", chosen.name)));
    std::size_t triangles = 0;
    for (const auto& object : scenes[0].objects) triangles += object.mesh.number_of_faces();
    const auto run = measure(
        scenes, settings, [&](std::size_t, std::size_t) { context.progress(played, std::size(chosen_scenes)); },
        {.truth = chosen.truth});
    const double exact = median_microseconds_without_build(run.measurements.back());
    for (const auto& m : run.measurements) {
      const double median = median_microseconds_without_build(m);
      const bool judged = chosen.truth == Truth_source::exhaustive || m.setting.options.mode != Mode::exact;
      table.add({chosen.name, std::to_string(triangles), m.setting.name,
                 judged ? fmt::format("{:.3f}", m.score.recall()) : "-",
                 judged ? fmt::format("{:.1f}", m.score.mean_delay()) : "-", fmt::format("{:.1f}", median),
                 fmt::format("{:.1f}", mean_microseconds_without_build(m)), fmt::format("{:.2f}", exact / median)});
      auto entry = to_json(m);
      entry["scene"] = chosen.name;
      entry["triangles"] = triangles;
      json.push_back(std::move(entry));
    }
    context.progress(++played, std::size(chosen_scenes));
  }
  write_json(context.out, "modes", json);
  return "Each setting answers yes or no in every frame, on one core, with a growth limit of 1.25 A*. In large scenes "
         "the mode exact is the truth, and has no recall of its own.\n\n" +
         table.text();
}

}  // namespace lodestone
