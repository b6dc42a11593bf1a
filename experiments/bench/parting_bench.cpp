// SPDX-License-Identifier: GPL-3.0-or-later
// What contact patches, and translations that part objects, add to a frame in mode `exact`.
#include <benchmark/benchmark.h>

#include <array>
#include <deque>
#include <vector>

#include "bench/frame_player.h"
#include "lodestone/detector.h"
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

BENCHMARK_CAPTURE(parting, paper_pair, "teapot_sphere_1")->UseManualTime()->Iterations(300);
BENCHMARK_CAPTURE(parting, spheres_5k, "spheres_5k")->UseManualTime()->Iterations(200);
BENCHMARK_CAPTURE(parting, spheres_50k, "spheres_50k")->UseManualTime()->Iterations(200);
BENCHMARK_CAPTURE(parting, torus_knots_20k, "torus_knots_20k")->UseManualTime()->Iterations(200);
BENCHMARK_CAPTURE(parting, bodies_20_5k, "bodies_20_5k")->UseManualTime()->Iterations(50);

}  // namespace

}  // namespace lodestone
