// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/race_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lodestone/mesh/errors.h"
#include "shared/measured_run.h"

namespace lodestone {

namespace {

constexpr std::array default_scenes{"teapot_sphere_1",  "spheres_5k",       "spheres_50k",
                                    "spheres_500k",     "spheres_2m",       "torus_knots_20k",
                                    "torus_knots_200k", "cloth_sphere_80k", "bodies_20_5k"};

}  // namespace

std::vector<std::string> race_scenes(const Experiment_context& context) {
  std::vector<std::string> names = context.only;
  if (names.empty()) names.assign(default_scenes.begin(), default_scenes.end());
  for (const auto& name : names)
    if (!exists(context.scenes / (name + ".json")))
      throw Bad_scene(fmt::format("{}: there is no such scene", (context.scenes / (name + ".json")).string()));
  return names;
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
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank - 1);
  std::ranges::nth_element(values, place);
  return *place;
}

std::string milliseconds(double seconds) {
  if (!std::isfinite(seconds)) return "-";
  const double ms = 1e3 * seconds;
  return fmt::format("{:.{}f}", ms, ms < 1 ? 4 : ms < 10 ? 3 : ms < 100 ? 2 : ms < 1000 ? 1 : 0);
}

}  // namespace lodestone
