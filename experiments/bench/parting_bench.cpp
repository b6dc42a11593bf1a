// SPDX-License-Identifier: GPL-3.0-or-later
// What contact patches, and translations that part objects, add to a frame in mode `exact`; how long the translations
// are.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

#include "bench/frame_player.h"
#include "lodestone/detector.h"
#include "queries/clearance_search.h"
#include "shared/measured_run.h"

namespace lodestone {

namespace {

/// Frames of one scene: all face pairs alone, with contact patches, and with translations take turns on each frame.
///
/// Reported time: the frame with translations. The counters are medians over the frames in which objects collide,
/// except `parted`, the mean number of translations of such a frame.
void parting(benchmark::State& state, const std::string& scene_name) {
  Frame_player player(scene_name);
  std::deque<Detector<>> detectors;
  for (const auto& [patches, translations] : {std::pair{false, false}, {true, false}, {false, true}}) {
    detectors.emplace_back(Detector_options{.exact = {.parting = translations, .patches = patches}});
    for (auto& object : player.scene().objects) detectors.back().add(std::as_const(object.mesh));
  }
  player.next();
  for (auto& detector : detectors) detector.detect();

  std::array<std::vector<double>, 3> seconds;
  double parted = 0;
  for (auto _ : state) {
    player.next();
    std::array<double, 3> frame_seconds{};
    bool collides = false;
    for (std::size_t i = 0; i < detectors.size(); ++i) {
      const Frame& frame = detectors[i].detect();
      frame_seconds[i] = frame.statistics.seconds.without_build();
      collides = frame.collides();
      for (const auto& pair : frame.pairs) parted += pair.parting && collides ? 1 : 0;
    }
    state.SetIterationTime(frame_seconds.back());
    if (!collides) continue;
    for (std::size_t i = 0; i < seconds.size(); ++i) seconds[i].push_back(frame_seconds[i]);
  }
  state.counters["parted"] = parted / static_cast<double>(seconds[0].size());
  state.counters["pairs_us"] = 1e6 * median(seconds[0]);
  state.counters["patches_us"] = 1e6 * median(seconds[1]);
  state.counters["parting_us"] = 1e6 * median(seconds[2]);
}

/// The i-th of n unit vectors, spread evenly: points on a spiral from pole to pole, a golden angle apart.
Eigen::Vector3d spread_direction(std::size_t i, std::size_t n) {
  const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(n), radius = std::sqrt(1 - z * z);
  const double angle = 2 * std::numbers::pi * static_cast<double>(i) / std::numbers::phi;
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// The object as its tree was refitted to it.
Layout_view view_of(const Detector<>& detector, Object_id id, const Surface_mesh& mesh) {
  const std::span<const double> coordinates(mesh.points().data()->cartesian_begin(), 3 * mesh.number_of_vertices());
  return Basic_tree_view<Aabb>{&detector.tree(id), coordinates};
}

/// The length of the shortest translation of a along 3000 directions that parts the two.
double shortest_of_many(const Layout_view& a, const Layout_view& b) {
  constexpr std::size_t directions = 3000;
  Clearance_search search(a, b);
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < directions; ++i)
    if (const auto clearance = search(spread_direction(i, directions), shortest)) shortest = clearance->length;
  return search.unscaled(shortest);
}

/// How long the translations of one scene are, in lengths of the best of 3000 directions. Every fourth frame is
/// played.
///
/// Reported time: the frame with translations. The counters: the number of translations, and the mean, least and
/// largest ratio.
void parting_length(benchmark::State& state, const std::string& scene_name) {
  constexpr std::size_t step = 4;
  Frame_player player(scene_name);
  Detector detector({.exact = {.parting = true}});
  const auto& objects = player.scene().objects;
  for (const auto& object : objects) detector.add(object.mesh);
  std::vector<double> ratios;
  for (auto _ : state) {
    for (std::size_t i = 0; i < step; ++i) player.next();
    const Frame& frame = detector.detect();
    state.SetIterationTime(frame.statistics.seconds.without_build());
    for (const auto& pair : frame.pairs) {
      if (!pair.parting) continue;
      const auto a = view_of(detector, pair.a, objects[pair.a].mesh),
                 b = view_of(detector, pair.b, objects[pair.b].mesh);
      ratios.push_back(pair.parting->length / shortest_of_many(a, b));
    }
  }
  const auto [least, largest] = std::ranges::minmax(ratios);
  state.counters["translations"] = static_cast<double>(ratios.size());
  state.counters["mean"] = std::accumulate(ratios.begin(), ratios.end(), 0.0) / static_cast<double>(ratios.size());
  state.counters["least"] = least;
  state.counters["largest"] = largest;
}

BENCHMARK_CAPTURE(parting, paper_pair, "teapot_sphere_1")->UseManualTime()->Iterations(300);
BENCHMARK_CAPTURE(parting, spheres_5k, "spheres_5k")->UseManualTime()->Iterations(200);
BENCHMARK_CAPTURE(parting, spheres_50k, "spheres_50k")->UseManualTime()->Iterations(200);
BENCHMARK_CAPTURE(parting, torus_knots_20k, "torus_knots_20k")->UseManualTime()->Iterations(200);
BENCHMARK_CAPTURE(parting, bodies_20_5k, "bodies_20_5k")->UseManualTime()->Iterations(50);

BENCHMARK_CAPTURE(parting_length, paper_pair, "teapot_sphere_1")->UseManualTime()->Iterations(75);
BENCHMARK_CAPTURE(parting_length, spheres_5k, "spheres_5k")->UseManualTime()->Iterations(50);
BENCHMARK_CAPTURE(parting_length, cloth_sphere, "cloth_sphere")->UseManualTime()->Iterations(60);
BENCHMARK_CAPTURE(parting_length, torus_knots, "torus_knots")->UseManualTime()->Iterations(60);
BENCHMARK_CAPTURE(parting_length, bodies_20, "bodies_20")->UseManualTime()->Iterations(60);

}  // namespace

}  // namespace lodestone
