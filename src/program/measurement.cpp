// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/measurement.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "lodestone/io/files/atomic_file.h"

namespace lodestone {

double mean(std::span<const double> values) {
  if (values.empty()) return 0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return values.size() % 2 == 1 ? *middle : std::midpoint(*std::max_element(values.begin(), middle), *middle);
}

double median_microseconds(const Measurement& measurement, double Stage_times::*stage) {
  std::vector<double> values;
  for (const auto& frame : measurement.frames) values.push_back(1e6 * (frame.seconds.*stage));
  return median(std::move(values));
}

double median_microseconds_without_build(const Measurement& measurement) {
  std::vector<double> values;
  for (const auto& frame : measurement.frames) values.push_back(1e6 * frame.seconds.without_build());
  return median(std::move(values));
}

double mean_microseconds_without_build(const Measurement& measurement) {
  double sum = 0;
  for (const auto& frame : measurement.frames) sum += 1e6 * frame.seconds.without_build();
  return measurement.frames.empty() ? 0 : sum / static_cast<double>(measurement.frames.size());
}

double mean_count(const Measurement& measurement, std::size_t Frame_statistics::*count) {
  double sum = 0;
  for (const auto& frame : measurement.frames) sum += static_cast<double>(frame.*count);
  return measurement.frames.empty() ? 0 : sum / static_cast<double>(measurement.frames.size());
}

nlohmann::ordered_json to_json(const Measurement& m) {
  const auto& options = m.setting.options;
  const auto stage = [&](double Stage_times::*s) { return median_microseconds(m, s); };
  return {
      {"setting", m.setting.name},
      {"strategy", m.setting.strategy.name},
      {"mode", name_of(options.mode)},
      {"particles", options.particles},
      {"meetings", options.mode == Mode::particles ? options.meetings : 0},
      {"collision_distance", options.collision_distance},
      {"frames", m.score.frames()},
      {"positive", m.score.positives()},
      {"recall", m.score.recall()},
      {"precision", m.score.precision()},
      {"accuracy", m.score.accuracy()},
      {"accuracy_per_scene", m.accuracies},
      {"collisions", m.score.collisions()},
      {"never_seen", m.score.never_seen()},
      {"mean_delay_frames", m.score.mean_delay()},
      {"mean_iterations", mean_count(m, &Frame_statistics::iterations)},
      {"mean_moves", mean_count(m, &Frame_statistics::moves)},
      {"mean_candidates", mean_count(m, &Frame_statistics::candidates)},
      {"mean_leaf_tests", mean_count(m, &Frame_statistics::leaf_tests)},
      {"mean_meetings", mean_count(m, &Frame_statistics::meetings)},
      {"mean_vertices_read", mean_count(m, &Frame_statistics::vertices_read)},
      {"mean_nodes_bounded", mean_count(m, &Frame_statistics::nodes_bounded)},
      {"mean_leaves_posed", mean_count(m, &Frame_statistics::leaves_posed)},
      {"mean_violations", mean_count(m, &Frame_statistics::violations)},
      {"mean_exact_tests", mean_count(m, &Frame_statistics::exact_tests)},
      {"mean_repartitions", mean_count(m, &Frame_statistics::repartitions)},
      {"particles_at_end", m.particles},
      {"build_seconds", m.build_seconds},
      {"median_microseconds",
       {{"repartition", stage(&Stage_times::repartition)},
        {"refit", stage(&Stage_times::refit)},
        {"broad_phase", stage(&Stage_times::broad_phase)},
        {"relaxation", stage(&Stage_times::relaxation)},
        {"candidates", stage(&Stage_times::candidates)},
        {"confirmation", stage(&Stage_times::confirmation)},
        {"without_build", median_microseconds_without_build(m)}}},
      {"mean_microseconds_without_build", mean_microseconds_without_build(m)},
  };
}

void write_json(const std::filesystem::path& folder, std::string_view name, const nlohmann::ordered_json& json) {
  write_whole(folder / (std::string(name) + ".json"), json.dump(2) + "\n");
}

}  // namespace lodestone
