// SPDX-License-Identifier: GPL-3.0-or-later
// Time of a frame in mode `particles`: relaxation and confirmation, and exhaustive checking on the same frames.
#include <benchmark/benchmark.h>

#include <chrono>
#include <numeric>

#include "bench/frame_player.h"
#include "lodestone/detector.h"
#include "lodestone/queries/exhaustive.h"
#include "shared/measured_run.h"

namespace lodestone {

namespace {

using Clock = std::chrono::steady_clock;

/// Frames of one scene with N particles per object. Posing the meshes is not timed.
///
/// Reported time: relaxation, candidates and confirmation, per frame. `median_us` is the median over the frames,
/// `exhaustive_median_us` that of exhaustive checking on the same frames, `hops` the steps of all particles per frame,
/// `us_per_iteration` the time of all relaxations over the number of their iterations.
void particles(benchmark::State& state, const std::string& scene_name, bool with_exhaustive) {
  Frame_player player(scene_name);
  Detector<> detector({.mode = Mode::particles,
                       .particles = static_cast<std::size_t>(state.range(0)),
                       .meetings = 0,
                       .contacts = Contact_query::yes_no});
  for (auto& object : player.scene().objects) detector.add(std::as_const(object.mesh));
  player.next();
  detector.detect();

  std::vector<double> frame_seconds, relaxation_seconds, exhaustive_seconds;
  double hops = 0, iterations = 0, colliding = 0;
  for (auto _ : state) {
    player.next();
    detector.update();
    const Frame& frame = detector.detect();
    const auto& seconds = frame.statistics.seconds;
    frame_seconds.push_back(seconds.relaxation + seconds.candidates + seconds.confirmation);
    relaxation_seconds.push_back(seconds.relaxation);
    state.SetIterationTime(frame_seconds.back());
    hops += static_cast<double>(frame.statistics.moves);
    iterations += static_cast<double>(frame.statistics.iterations);
    colliding += frame.collides() ? 1 : 0;
    if (!with_exhaustive) continue;
    const auto start = Clock::now();
    benchmark::DoNotOptimize(
        exhaustive_face_pairs(player.scene().objects[0].mesh, player.scene().objects[1].mesh).size());
    exhaustive_seconds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
  }
  const double frames = static_cast<double>(frame_seconds.size());
  const double frame_median = median(frame_seconds);
  state.counters["median_us"] = 1e6 * frame_median;
  state.counters["relaxation_us"] = 1e6 * median(relaxation_seconds);
  state.counters["hops"] = hops / frames;
  state.counters["iterations"] = iterations / frames;
  const double relaxation = std::accumulate(relaxation_seconds.begin(), relaxation_seconds.end(), 0.0);
  state.counters["us_per_iteration"] = 1e6 * relaxation / iterations;
  state.counters["colliding"] = colliding / frames;
  state.counters["triangles"] = static_cast<double>(player.scene().objects[0].mesh.number_of_faces());
  if (!with_exhaustive) return;
  state.counters["exhaustive_median_us"] = 1e6 * median(exhaustive_seconds);
  state.counters["exhaustive_ratio"] = median(exhaustive_seconds) / frame_median;
}

BENCHMARK_CAPTURE(particles, paper_pair, "teapot_sphere_1", true)
    ->Arg(12)
    ->Arg(32)
    ->Arg(64)
    ->UseManualTime()
    ->Iterations(600)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(particles, spheres_5k, "spheres_5k", true)
    ->Arg(12)
    ->Arg(32)
    ->UseManualTime()
    ->Iterations(200)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(particles, spheres_50k, "spheres_50k", true)
    ->Arg(12)
    ->Arg(32)
    ->UseManualTime()
    ->Iterations(200)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(particles, spheres_500k, "spheres_500k", false)
    ->Arg(12)
    ->Arg(32)
    ->UseManualTime()
    ->Iterations(200)
    ->Unit(benchmark::kMicrosecond);

}  // namespace

}  // namespace lodestone
