// SPDX-License-Identifier: GPL-3.0-or-later
// Time of a frame in mode `exact` with each instruction set that this processor has and the kernels are built for.
#include <benchmark/benchmark.h>
#include <hwy/targets.h>

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/frame_player.h"
#include "lodestone/detector.h"
#include "shared/lap_timer.h"
#include "shared/measured_run.h"

namespace lodestone {

namespace {

/// Update and query in the frames of one scene. The instruction sets take turns frame by frame. They change the kernels
/// and the sort of the contacts, but not CGAL's predicates and the walk over the trees. Posing is not timed.
///
/// Reported time: the mean of all. Per instruction set: the median over the frames with contacts, in microseconds.
void instruction_sets(benchmark::State& state, const std::string& scene_name, Contact_query query) {
  Frame_player player(scene_name);
  Detector<> detector({.mode = Mode::exact, .contacts = query});
  for (auto& object : player.scene().objects) detector.add(std::as_const(object.mesh));
  detector.detect();

  const std::int64_t all = hwy::SupportedTargets();
  const auto targets = hwy::SupportedAndGeneratedTargets();
  std::map<std::int64_t, std::vector<double>> seconds;
  for (std::size_t frame = 0; auto _ : state) {
    player.next();
    // The first set changes each time; otherwise one set could get all frames of the forward motion.
    const std::int64_t target = targets[(frame + frame / targets.size()) % targets.size()];
    ++frame;
    hwy::GetChosenTarget().Update(target);
    const Lap_timer timer;
    const bool found = detector.detect().collides();
    const double frame_seconds = timer.seconds();
    state.SetIterationTime(frame_seconds);
    if (found) seconds[target].push_back(frame_seconds);
  }
  hwy::GetChosenTarget().Update(all);
  for (const auto& [target, of_frames] : seconds)
    state.counters[std::string(hwy::TargetName(target)) + "_us"] = 1e6 * median(of_frames);
}

BENCHMARK_CAPTURE(instruction_sets, spheres_5k_all, "spheres_5k", Contact_query::all)
    ->UseManualTime()
    ->Iterations(1000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(instruction_sets, spheres_50k_all, "spheres_50k", Contact_query::all)
    ->UseManualTime()
    ->Iterations(1000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(instruction_sets, spheres_50k_yes_no, "spheres_50k", Contact_query::yes_no)
    ->UseManualTime()
    ->Iterations(1000)
    ->Unit(benchmark::kMicrosecond);

}  // namespace

}  // namespace lodestone
