// SPDX-License-Identifier: GPL-3.0-or-later
// Time of a frame in mode `exact` with each instruction set that the inner loops are built for and this processor has.
#include <benchmark/benchmark.h>
#include <hwy/targets.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "frame_player.h"
#include "lap_timer.h"
#include "lodestone/detector.h"
#include "measured_run.h"

namespace lodestone {

namespace {

/// Frames of one scene, update and query, each with all instruction sets, which take turns at being the first. Posing
/// the meshes is not timed.
///
/// Reported time: the best instruction set. Per instruction set: the median over the frames in which something is
/// found, in microseconds.
void instruction_sets(benchmark::State& state, const std::string& scene_name, Contact_query query) {
  Frame_player player(scene_name);
  Detector<Surface_mesh> detector({.mode = Mode::exact, .contacts = query});
  for (auto& object : player.scene().objects) detector.add(std::as_const(object.mesh));
  detector.detect();

  const std::int64_t all = hwy::SupportedTargets();
  auto targets = hwy::SupportedAndGeneratedTargets();
  const std::int64_t best = *std::ranges::min_element(targets);  // Highway numbers better ones lower
  std::map<std::int64_t, std::vector<double>> seconds;
  for (auto _ : state) {
    player.next();
    std::rotate(targets.begin(), targets.begin() + 1, targets.end());
    double best_seconds = 0;
    for (const auto target : targets) {
      hwy::GetChosenTarget().Update(target);
      const Lap_timer timer;
      const bool found = detector.detect().collides();
      const double frame_seconds = timer.seconds();
      if (target == best) best_seconds = frame_seconds;
      if (found) seconds[target].push_back(frame_seconds);
    }
    state.SetIterationTime(best_seconds);
  }
  hwy::GetChosenTarget().Update(all);
  for (const auto& [target, of_frames] : seconds)
    state.counters[std::string(hwy::TargetName(target)) + "_us"] = 1e6 * median(of_frames);
}

BENCHMARK_CAPTURE(instruction_sets, spheres_5k_all, "spheres_5k", Contact_query::all)
    ->UseManualTime()
    ->Iterations(400)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(instruction_sets, spheres_50k_all, "spheres_50k", Contact_query::all)
    ->UseManualTime()
    ->Iterations(400)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(instruction_sets, spheres_50k_yes_no, "spheres_50k", Contact_query::yes_no)
    ->UseManualTime()
    ->Iterations(400)
    ->Unit(benchmark::kMicrosecond);

}  // namespace

}  // namespace lodestone
