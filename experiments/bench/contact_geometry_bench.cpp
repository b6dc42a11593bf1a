// SPDX-License-Identifier: GPL-3.0-or-later
// What contact points and normals add to a frame in mode `exact`.
#include <benchmark/benchmark.h>

#include <array>
#include <deque>
#include <vector>

#include "bench/frame_player.h"
#include "lodestone/detector.h"
#include "shared/measured_run.h"

namespace lodestone {

namespace {

/// Frames of one scene: all face pairs alone, with points, and with points and normals take turns on each frame.
///
/// Reported time: the frame with points and normals. The counters are medians over the frames that have contacts;
/// `over_pairs` is the ratio of the last to the first.
void contact_geometry(benchmark::State& state, const std::string& scene_name) {
  Frame_player player(scene_name);
  std::deque<Detector<>> detectors;
  for (const auto& [points, normals] : {std::pair{false, false}, {true, false}, {true, true}}) {
    detectors.emplace_back(Detector_options{.mode = Mode::exact,
                                            .contacts = Contact_query::all,
                                            .contact_points = points,
                                            .contact_normals = normals});
    for (auto& object : player.scene().objects) detectors.back().add(std::as_const(object.mesh));
  }
  player.next();
  for (auto& detector : detectors) detector.detect();

  std::array<std::vector<double>, 3> seconds;
  std::vector<double> contacts;
  for (auto _ : state) {
    player.next();
    std::array<double, 3> frame_seconds{};
    std::size_t found = 0;
    for (std::size_t i = 0; i < detectors.size(); ++i) {
      const auto& statistics = detectors[i].detect().statistics;
      frame_seconds[i] = statistics.seconds.refit + statistics.seconds.broad_phase + statistics.seconds.confirmation;
      found = statistics.contacts;
    }
    state.SetIterationTime(frame_seconds.back());
    if (found == 0) continue;
    for (std::size_t i = 0; i < seconds.size(); ++i) seconds[i].push_back(frame_seconds[i]);
    contacts.push_back(static_cast<double>(found));
  }
  state.counters["contacts"] = median(contacts);
  state.counters["pairs_us"] = 1e6 * median(seconds[0]);
  state.counters["points_us"] = 1e6 * median(seconds[1]);
  state.counters["normals_us"] = 1e6 * median(seconds[2]);
  state.counters["over_pairs"] = median(seconds[2]) / median(seconds[0]);
}

BENCHMARK_CAPTURE(contact_geometry, paper_pair, "teapot_sphere_1")->UseManualTime()->Iterations(600);
BENCHMARK_CAPTURE(contact_geometry, spheres_5k, "spheres_5k")->UseManualTime()->Iterations(400);
BENCHMARK_CAPTURE(contact_geometry, spheres_50k, "spheres_50k")->UseManualTime()->Iterations(400);
BENCHMARK_CAPTURE(contact_geometry, torus_knots_20k, "torus_knots_20k")->UseManualTime()->Iterations(400);
BENCHMARK_CAPTURE(contact_geometry, bodies_20_5k, "bodies_20_5k")->UseManualTime()->Iterations(200);

}  // namespace

}  // namespace lodestone
