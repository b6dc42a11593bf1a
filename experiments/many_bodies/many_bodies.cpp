// SPDX-License-Identifier: GPL-3.0-or-later
// How the time of a frame grows with the number of bodies, where each body meets as many others in every scene.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "lodestone/io/results/text_table.h"
#include "lodestone/mesh/errors.h"
#include "many_bodies/crowd.h"
#include "shared/experiment.h"
#include "shared/fit.h"
#include "shared/measured_run.h"

namespace lodestone {

namespace {

struct Crowd_size {
  std::size_t bodies = 0;
  std::size_t frames = 0;  ///< fewer where they take longer
};

constexpr Crowd_size published_sizes[] = {{20, 60}, {100, 40}, {500, 24}, {2000, 12}};

std::vector<Setting> crowd_settings() {
  return {{"particles, 12", {.mode = Mode::particles, .particles = 12}},
          {"particles, no meetings, 12", {.mode = Mode::particles, .particles = 12, .meetings = 0}},
          {"exact", {.mode = Mode::exact}}};
}

/// @throws Bad_argument  a number of bodies that no scene has
std::vector<Crowd_size> chosen_sizes(const std::vector<std::string>& only) {
  std::vector<Crowd_size> all(std::begin(published_sizes), std::end(published_sizes));
  if (only.empty()) return all;
  std::vector<Crowd_size> chosen;
  for (const auto& number : only) {
    const auto found = std::ranges::find(all, number, [](const auto& size) { return std::to_string(size.bodies); });
    if (found == all.end())
      throw Bad_argument(fmt::format("--only: there are scenes of 20, 100, 500 and 2000 bodies, not of {}", number));
    if (std::ranges::find(chosen, found->bodies, &Crowd_size::bodies) != chosen.end())
      throw Bad_argument(fmt::format("--only: {} is given twice", number));
    chosen.push_back(*found);
  }
  return chosen;
}

/// The settings on one scene.
struct Crowd_figures {
  Crowd_size size;
  std::size_t triangles = 0;
  std::vector<Measurement> measurements = {};  ///< `exact` is the last

  /// With how many others a body collides, in the mean over bodies and frames.
  double meets() const {
    const auto collisions = static_cast<double>(measurements.front().score.positives());
    return 2 * collisions / static_cast<double>(size.bodies * size.frames);
  }
};

Crowd_figures measure_crowd(Crowd_size size, std::span<const Setting> settings,
                            const std::function<void(std::size_t, std::size_t)>& progress) {
  Scene scene = crowd(size.bodies, size.frames);
  Crowd_figures figures{.size = size};
  for (const auto& object : scene.objects) figures.triangles += object.mesh.number_of_faces();
  figures.measurements = measure({&scene, 1}, settings, progress, {.truth = Truth_source::exact_mode}).measurements;
  return figures;
}

Text_table table_of_crowds(std::span<const Crowd_figures> crowds) {
  Text_table table(
      {"bodies", "triangles", "meets per body", "mode", "recall", "median (us)", "mean (us)", "exact / this (median)"});
  for (const auto& figures : crowds) {
    const double exact = median_microseconds_without_build(figures.measurements.back());
    for (const auto& m : figures.measurements) {
      const double median = median_microseconds_without_build(m);
      table.add({std::to_string(figures.size.bodies), std::to_string(figures.triangles),
                 fmt::format("{:.2f}", figures.meets()), m.setting.name,
                 m.setting.options.mode == Mode::exact ? "-" : fmt::format("{:.3f}", m.score.recall()),
                 fmt::format("{:.1f}", median), fmt::format("{:.1f}", mean_microseconds_without_build(m)),
                 fmt::format("{:.2f}", exact / median)});
    }
  }
  return table;
}

/// Per setting: the exponent of the median time against the number of bodies. Needs two sizes.
std::vector<double> exponents_of_bodies(std::span<const Crowd_figures> crowds, std::size_t settings) {
  std::vector<double> exponents, bodies;
  for (const auto& figures : crowds) bodies.push_back(static_cast<double>(figures.size.bodies));
  for (std::size_t s = 0; s < settings; ++s) {
    std::vector<double> medians;
    for (const auto& figures : crowds) medians.push_back(median_microseconds_without_build(figures.measurements[s]));
    exponents.push_back(fitted_exponent(bodies, medians));
  }
  return exponents;
}

nlohmann::ordered_json json_of_crowds(std::span<const Crowd_figures> crowds) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const auto& figures : crowds)
    for (const auto& m : figures.measurements) {
      auto row = to_json(m);
      row["bodies"] = figures.size.bodies;
      row["triangles"] = figures.triangles;
      row["meets_per_body"] = figures.meets();
      rows.push_back(std::move(row));
    }
  return rows;
}

}  // namespace

std::string run_many_bodies(const Experiment_context& context) {
  const auto sizes = chosen_sizes(context.only);
  const auto settings = crowd_settings();
  constexpr std::size_t steps = 1000;  // per scene
  std::vector<Crowd_figures> crowds;
  for (std::size_t s = 0; s < sizes.size(); ++s)
    crowds.push_back(measure_crowd(sizes[s], settings, [&](std::size_t done, std::size_t of) {
      context.progress(s * steps + done * steps / of, sizes.size() * steps);
    }));

  nlohmann::ordered_json json{{"rows", json_of_crowds(crowds)}};
  std::string report =
      "Each setting answers yes or no in every frame, on one core. The mode exact is the truth, and has no recall of "
      "its own. A body collides with `meets per body` others, in the mean over bodies and frames.\n\n" +
      table_of_crowds(crowds).text();
  if (crowds.size() > 1) {
    const auto exponents = exponents_of_bodies(crowds, settings.size());
    std::vector<std::string> texts;
    for (std::size_t s = 0; s < settings.size(); ++s) {
      json["exponents"][settings[s].name] = exponents[s];
      texts.push_back(fmt::format("{:.2f} ({})", exponents[s], settings[s].name));
    }
    report += fmt::format("\nExponent of the median time against the number of bodies: {}.\n", fmt::join(texts, ", "));
  }
  write_json(context.out, "many_bodies", json);
  return report;
}

}  // namespace lodestone
