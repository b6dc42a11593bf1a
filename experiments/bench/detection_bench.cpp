// SPDX-License-Identifier: GPL-3.0-or-later
// Time of a frame in mode `particles`, with meetings and as published, and of exhaustive checking on the same frames.
#include <benchmark/benchmark.h>

#include <numeric>
#include <utility>

#include "bench/frame_player.h"
#include "lodestone/detector.h"
#include "lodestone/queries/exhaustive.h"
#include "shared/lap_timer.h"
#include "shared/measured_run.h"

namespace lodestone {

namespace {

/// A detector of one method, and what its frames cost.
class Method {
 public:
  Method(Scene& scene, std::size_t particles, std::size_t meetings)
      : detector_({.mode = Mode::particles,
                   .particles = particles,
                   .meetings = meetings,
                   .contacts = Contact_query::yes_no}) {
    for (auto& object : scene.objects) detector_.add(std::as_const(object.mesh));
  }

  /// Answers in the current pose without being counted.
  void build() { detector_.detect(); }

  /// @return the seconds of all stages but the build
  double play() {
    detector_.update();
    const Frame& frame = detector_.detect();
    frame_seconds_.push_back(frame.statistics.seconds.without_build());
    relaxation_seconds_.push_back(frame.statistics.seconds.relaxation);
    hops_ += static_cast<double>(frame.statistics.moves);
    iterations_ += static_cast<double>(frame.statistics.iterations);
    read_ += static_cast<double>(frame.statistics.vertices_read);
    colliding_ += frame.collides() ? 1 : 0;
    return frame_seconds_.back();
  }

  double median_seconds() const { return median(frame_seconds_); }
  double read() const { return read_ / frames(); }
  double colliding() const { return colliding_ / frames(); }

  void add_relaxation(benchmark::State& state) const {
    state.counters["relaxation_us"] = 1e6 * median(relaxation_seconds_);
    state.counters["hops"] = hops_ / frames();
    state.counters["iterations"] = iterations_ / frames();
    const double relaxation = std::accumulate(relaxation_seconds_.begin(), relaxation_seconds_.end(), 0.0);
    state.counters["us_per_iteration"] = 1e6 * relaxation / iterations_;
  }

 private:
  double frames() const { return static_cast<double>(frame_seconds_.size()); }

  Detector<> detector_;
  std::vector<double> frame_seconds_, relaxation_seconds_;
  double hops_ = 0, iterations_ = 0, read_ = 0, colliding_ = 0;
};

/// Frames of one scene with N particles per object. Both methods, and exhaustive checking, take turns on each frame.
/// Posing the meshes is not timed.
///
/// Reported time: all stages of a frame with meetings but the build. Medians over the frames: `median_us` with
/// meetings, `published_us` as published, `exhaustive_us` of exhaustive checking; of these `relaxation_us` is the part
/// of the published relaxation, `hops` its steps per frame, `us_per_iteration` its time over the number of its
/// iterations. `read` and `published_read` are positions per frame.
void particles(benchmark::State& state, const std::string& scene_name, bool with_exhaustive) {
  Frame_player player(scene_name);
  const auto count = static_cast<std::size_t>(state.range(0));
  Method meetings(player.scene(), count, Detector_options().meetings), published(player.scene(), count, 0);
  player.next();
  meetings.build();
  published.build();

  std::vector<double> exhaustive_seconds;
  bool published_first = false;
  for (auto _ : state) {
    player.next();
    if (std::exchange(published_first, !published_first)) published.play();
    state.SetIterationTime(meetings.play());
    if (published_first) published.play();
    if (!with_exhaustive) continue;
    const Lap_timer timer;
    benchmark::DoNotOptimize(
        exhaustive_face_pairs(player.scene().objects[0].mesh, player.scene().objects[1].mesh).size());
    exhaustive_seconds.push_back(timer.seconds());
  }
  state.counters["median_us"] = 1e6 * meetings.median_seconds();
  state.counters["published_us"] = 1e6 * published.median_seconds();
  state.counters["published_ratio"] = published.median_seconds() / meetings.median_seconds();
  state.counters["read"] = meetings.read();
  state.counters["published_read"] = published.read();
  state.counters["colliding"] = meetings.colliding();
  state.counters["published_colliding"] = published.colliding();
  state.counters["triangles"] = static_cast<double>(player.scene().objects[0].mesh.number_of_faces());
  published.add_relaxation(state);
  if (!with_exhaustive) return;
  state.counters["exhaustive_us"] = 1e6 * median(exhaustive_seconds);
  state.counters["exhaustive_ratio"] = median(exhaustive_seconds) / meetings.median_seconds();
}

void play_all_frames(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(12)->Arg(32)->Arg(64)->UseManualTime()->Iterations(200)->Unit(benchmark::kMicrosecond);
}

BENCHMARK_CAPTURE(particles, paper_pair, "teapot_sphere_1", true)->Apply(play_all_frames);
BENCHMARK_CAPTURE(particles, spheres_5k, "spheres_5k", true)->Apply(play_all_frames);
BENCHMARK_CAPTURE(particles, spheres_50k, "spheres_50k", true)->Apply(play_all_frames);
BENCHMARK_CAPTURE(particles, spheres_500k, "spheres_500k", false)->Apply(play_all_frames);

}  // namespace

}  // namespace lodestone
