// SPDX-License-Identifier: GPL-3.0-or-later
// What regions at the top of a tree cost and bring in mode `exact`: to build, and per frame.
#include <benchmark/benchmark.h>

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "bench/frame_player.h"
#include "lodestone/detector.h"
#include "shared/lap_timer.h"
#include "shared/measured_run.h"

namespace lodestone {

namespace {

constexpr std::array<std::size_t, 3> region_counts = {0, 12, 32};

/// Seconds in which an object is numbered and gets its tree, and the first question is answered.
double build_seconds(const Scene& scene, std::size_t regions) {
  const Lap_timer timer;
  Detector<> detector({.particles = regions});
  for (const auto& object : scene.objects) detector.add(object.mesh);
  detector.detect();
  return timer.seconds() / static_cast<double>(scene.objects.size());
}

/// Frames of one scene: trees without regions, with 12 and with 32 take turns on each frame.
///
/// Reported time: the frame without regions. The counters are medians: seconds of a frame and of a build, with regions
/// over without.
void regions(benchmark::State& state, const std::string& scene_name, Contact_query query) {
  Frame_player player(scene_name);
  player.next();
  std::array<std::optional<Detector<>>, region_counts.size()> detectors;
  std::array<std::vector<double>, region_counts.size()> builds, frames;
  for (int round = 0; round < 5; ++round)
    for (std::size_t i = 0; i < region_counts.size(); ++i)
      builds[i].push_back(build_seconds(player.scene(), region_counts[i]));
  for (std::size_t i = 0; i < region_counts.size(); ++i) {
    detectors[i].emplace(Detector_options{.particles = region_counts[i], .contacts = query});
    for (const auto& object : player.scene().objects) detectors[i]->add(object.mesh);
    detectors[i]->detect();
  }
  std::size_t first = 0;
  for (auto _ : state) {
    player.next();
    first = (first + 1) % region_counts.size();
    for (std::size_t turn = 0; turn < region_counts.size(); ++turn) {
      const std::size_t i = (first + turn) % region_counts.size();
      frames[i].push_back(detectors[i]->detect().statistics.seconds.without_build());
    }
    state.SetIterationTime(frames[0].back());
  }
  state.counters["build_ms"] = 1e3 * median(builds[0]);
  state.counters["build_12"] = median(builds[1]) / median(builds[0]);
  state.counters["build_32"] = median(builds[2]) / median(builds[0]);
  state.counters["frame_us"] = 1e6 * median(frames[0]);
  state.counters["frame_12"] = median(frames[1]) / median(frames[0]);
  state.counters["frame_32"] = median(frames[2]) / median(frames[0]);
}

const bool registered = [] {
  for (const std::string name : {"teapot_sphere_1", "spheres_5k", "spheres_50k", "spheres_500k", "torus_knots_20k",
                                 "torus_knots_200k", "cloth_sphere_80k", "bodies_20_5k"})
    for (const auto& [query, suffix] : {std::pair{Contact_query::yes_no, "yes_no"}, {Contact_query::all, "all"}})
      benchmark::RegisterBenchmark(("regions/" + name + "/" + suffix).c_str(), regions, name, query)
          ->UseManualTime()
          ->Iterations(200)
          ->Unit(benchmark::kMicrosecond);
  return true;
}();

}  // namespace

}  // namespace lodestone
