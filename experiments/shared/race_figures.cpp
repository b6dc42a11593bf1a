// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/race_figures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "io/files/small_text.h"
#include "lodestone/mesh/errors.h"
#include "shared/measured_run.h"

namespace lodestone {

namespace {

constexpr std::array default_scenes{"teapot_sphere_1",  "spheres_5k",       "spheres_50k",
                                    "spheres_500k",     "spheres_2m",       "torus_knots_20k",
                                    "torus_knots_200k", "cloth_sphere_80k", "bodies_20_5k"};

/// The scene files of a folder without their extension, sorted.
std::vector<std::string> names_of_scenes(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code unreadable;
  for (const auto& entry : std::filesystem::directory_iterator(folder, unreadable))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

}  // namespace

std::vector<std::string> scene_names(const Experiment_context& context) {
  std::vector<std::string> names = context.only;
  if (names.empty()) names.assign(default_scenes.begin(), default_scenes.end());
  for (const auto& name : names)
    if (const auto file = context.scenes / (name + ".json"); !exists(file)) {
      const auto there = names_of_scenes(context.scenes);
      throw Bad_scene(fmt::format(
          "{}: there is no such scene; {}", printable(file.string()),
          there.empty() ? "the folder has no scene files" : fmt::format("the scenes are {}", fmt::join(there, ", "))));
    }
  return names;
}

void for_each_scene(const Experiment_context& context,
                    const std::function<void(Scene& scene, const Scene_progress& progress)>& visit) {
  const auto names = scene_names(context);
  constexpr std::size_t steps = 1000;  // per scene
  for (std::size_t s = 0; s < names.size(); ++s) {
    const Scene_progress progress = [&](double share) {
      context.progress(s * steps + static_cast<std::size_t>(share * steps), names.size() * steps);
    };
    Scene scene = read_scene(context.scenes / (names[s] + ".json"));
    progress(0);
    visit(scene, progress);
  }
}

std::string scene_heading(const Scene_figures& scene) {
  return fmt::format(
      "## {}\n\n{} objects, {} triangles and {} vertices together. {} of {} frames. The bounding boxes of {} "
      "object pairs overlap, {} of these intersect, in {} face pairs.\n\n",
      scene.name, scene.objects, scene.triangles, scene.vertices, scene.sampled.size(), scene.frames, scene.asked,
      scene.colliding, scene.contacts);
}

nlohmann::ordered_json scene_figures_json(const Scene_figures& scene) {
  return {{"scene", scene.name},        {"objects", scene.objects},     {"triangles", scene.triangles},
          {"vertices", scene.vertices}, {"frames", scene.frames},       {"sampled_frames", scene.sampled},
          {"asked", scene.asked},       {"colliding", scene.colliding}, {"face_pairs", scene.contacts},
          {"batches", scene.batches}};
}

std::vector<double> values(const Entry_figures& figures, double Frame_seconds::*figure) {
  std::vector<double> all;
  all.reserve(figures.frames.size());
  for (const auto& frame : figures.frames) all.push_back(frame.*figure);
  return all;
}

double median_of(const Entry_figures& figures, double Frame_seconds::*figure) {
  return median(values(figures, figure));
}

double percentile_95(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto rank = static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(values.size())));
  const auto percentile = values.begin() + static_cast<std::ptrdiff_t>(rank - 1);
  std::ranges::nth_element(values, percentile);
  return *percentile;
}

std::string milliseconds(double seconds) {
  if (!std::isfinite(seconds)) return "-";
  const double ms = 1e3 * seconds;
  return fmt::format("{:.{}f}", ms, ms < 1 ? 4 : ms < 10 ? 3 : ms < 100 ? 2 : ms < 1000 ? 1 : 0);
}

}  // namespace lodestone
