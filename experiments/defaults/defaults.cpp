// SPDX-License-Identifier: GPL-3.0-or-later
// Particles with other options than the defaults, one at a time: what is found, and what does a frame take?
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "lodestone/io/results/text_table.h"
#include "shared/experiment.h"
#include "shared/face_pair_count.h"
#include "shared/measured_run.h"
#include "shared/race_figures.h"

namespace lodestone {

namespace {

const std::vector<std::string> scenes_of_defaults{
    "teapot_sphere_1", "torus_knots",     "cloth_sphere",     "bodies_20",    "spheres_5k",       "inflate",
    "spheres_50k",     "torus_knots_20k", "cloth_sphere_80k", "bodies_20_5k", "torus_knots_200k",
};

/// Particles per object where another option is varied.
constexpr std::size_t base_particles = 12;
/// Plays with partitions made in the poses of different frames.
constexpr std::size_t plays_of_defaults = 3;

Any_strategy with_normal_weight(double weight) {
  return make_strategy(Lbg::name, {.lbg = {.features = {.normal_weight = weight}}});
}

/// The first setting is the one with which the others are compared.
std::vector<Setting> settings_of_defaults() {
  const Detector_options base{.mode = Mode::particles, .particles = base_particles};
  std::vector<Setting> settings{{"12 particles", base}};
  const auto vary = [&](const std::string& name, auto change) { change(settings.emplace_back(name, base).options); };
  vary("automatic", [](Detector_options& options) { options.particles = 0; });
  for (const std::size_t particles : {32, 64, 128})
    vary(fmt::format("{} particles", particles), [&](Detector_options& options) { options.particles = particles; });
  for (const double weight : {0.0, 0.5}) {
    settings.push_back({fmt::format("normals x {}", weight), base, with_normal_weight(weight)});
    settings.push_back({fmt::format("normals x {}, 32 particles", weight), base, with_normal_weight(weight)});
    settings.back().options.particles = 32;
  }
  for (const double growth : {1.0, 1.5})
    vary(fmt::format("growth {}", growth), [&](Detector_options& options) { options.growth = growth; });
  for (const std::size_t particles : {12, 32, 128})
    vary(fmt::format("no openings, {} particles", particles), [&](Detector_options& options) {
      options.particles = particles;
      options.opening_budget = 0;
    });
  vary("published", [](Detector_options& options) { options.meetings = 0; });
  settings.push_back({"published, normals x 0", settings.back().options, with_normal_weight(0)});
  return settings;
}

/// The figures of one setting on one scene.
struct Default_row {
  std::string scene;
  Measurement measurement;
  Face_pair_count face_pairs;
  double base_median = 0, base_mean = 0, base_read = 0;  ///< of the first setting; times in microseconds

  double median() const { return median_microseconds_without_build(measurement); }
  double mean() const { return mean_microseconds_without_build(measurement); }
  double read() const { return mean_count(measurement, &Frame_statistics::vertices_read); }
  double face_pair_recall() const {
    return face_pairs.all > 0 ? static_cast<double>(face_pairs.found) / static_cast<double>(face_pairs.all) : 1;
  }
  /// Of all plays together.
  double repartitions() const {
    return mean_count(measurement, &Frame_statistics::repartitions) * static_cast<double>(measurement.frames.size());
  }
};

std::string particles_of(const Measurement& measurement) {
  const auto [fewest, most] = std::ranges::minmax(measurement.particles);
  return fewest == most ? std::to_string(most) : fmt::format("{}..{}", fewest, most);
}

std::string table_of_scenes(std::span<const Default_row> rows) {
  Text_table table({"scene", "setting", "particles", "recall", "face pairs", "median (us)", "mean (us)", "median / 12",
                    "mean / 12", "repartitions", "positions read"});
  for (const auto& row : rows)
    table.add({row.scene, row.measurement.setting.name, particles_of(row.measurement),
               fmt::format("{:.4f}", row.measurement.score.recall()), fmt::format("{:.4f}", row.face_pair_recall()),
               fmt::format("{:.1f}", row.median()), fmt::format("{:.1f}", row.mean()),
               fmt::format("{:.2f}", row.median() / row.base_median), fmt::format("{:.2f}", row.mean() / row.base_mean),
               fmt::format("{:.0f}", row.repartitions()), fmt::format("{:.0f}", row.read())});
  return table.text();
}

/// Means and least values of the recall; geometric means of times and reads in multiples of those of the first setting.
std::string table_of_settings(std::span<const Default_row> rows, std::span<const Setting> settings) {
  Text_table table({"setting", "mean recall", "least recall", "missed", "false", "face pairs", "median / 12",
                    "mean / 12", "read / 12"});
  for (const auto& setting : settings) {
    Score score;
    double scenes = 0, recalls = 0, least = 1, face_pairs = 0, medians = 0, means = 0, reads = 0;
    for (const auto& row : rows) {
      if (row.measurement.setting.name != setting.name) continue;
      const double recall = row.measurement.score.recall();
      score.add(row.measurement.score);
      ++scenes, recalls += recall, least = std::min(least, recall);
      face_pairs += row.face_pair_recall();
      reads += std::log(row.read() / row.base_read);
      medians += std::log(row.median() / row.base_median);
      means += std::log(row.mean() / row.base_mean);
    }
    table.add({setting.name, fmt::format("{:.4f}", recalls / scenes), fmt::format("{:.4f}", least),
               fmt::format("{} of {}", score.false_negatives(), score.positives()),
               std::to_string(score.false_positives()), fmt::format("{:.4f}", face_pairs / scenes),
               fmt::format("{:.2f}", std::exp(medians / scenes)), fmt::format("{:.2f}", std::exp(means / scenes)),
               fmt::format("{:.2f}", std::exp(reads / scenes))});
  }
  return table.text();
}

nlohmann::ordered_json to_json(const Default_row& row) {
  auto json = to_json(row.measurement);
  json["scene"] = row.scene;
  json["face_pairs"] = row.face_pairs.all;
  json["face_pairs_found"] = row.face_pairs.found;
  return json;
}

}  // namespace

std::string run_defaults(const Experiment_context& context) {
  Experiment_context chosen = context;
  if (chosen.only.empty()) chosen.only = scenes_of_defaults;
  const auto settings = settings_of_defaults();
  std::vector<Default_row> rows;
  for_each_scene(chosen, [&](Scene& scene, const Scene_progress& progress) {
    const auto run = measure(
        {&scene, 1}, settings,
        [&](std::size_t done, std::size_t of) { progress(static_cast<double>(done) / static_cast<double>(of)); },
        {.truth = Truth_source::exact_mode, .plays = plays_of_defaults});
    const auto face_pairs = count_face_pairs(scene, settings, [&](std::size_t, std::size_t) { progress(1); });
    const auto& base = run.measurements.front();
    for (std::size_t s = 0; s < settings.size(); ++s)
      rows.push_back({.scene = scene.name,
                      .measurement = run.measurements[s],
                      .face_pairs = face_pairs[s],
                      .base_median = median_microseconds_without_build(base),
                      .base_mean = mean_microseconds_without_build(base),
                      .base_read = mean_count(base, &Frame_statistics::vertices_read)});
  });
  nlohmann::ordered_json json;
  for (const auto& row : rows) json.push_back(to_json(row));
  write_json(context.out, "defaults", json);
  return fmt::format(
             "Each setting differs from the first in what its name says. All take turns in each frame, in {} plays "
             "with partitions made in the poses of different frames. Times and positions read, in multiples of the "
             "first setting, are geometric means over the scenes. `face pairs` is the share of the intersecting face "
             "pairs that a setting reports in another play, when asked for all contacts.\n\n",
             plays_of_defaults) +
         table_of_settings(rows, settings) + "\nPer scene:\n\n" + table_of_scenes(rows);
}

}  // namespace lodestone
