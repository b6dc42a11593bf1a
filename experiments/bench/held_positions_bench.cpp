// SPDX-License-Identifier: GPL-3.0-or-later
// Several questions about one frame: with each of them reading all positions, and with positions that are held.
#include <benchmark/benchmark.h>

#include <optional>
#include <vector>

#include "lodestone/detector.h"
#include "lodestone/io/shapes/shapes.h"
#include "program/measurement.h"
#include "shared/lap_timer.h"

namespace lodestone {

namespace {

constexpr int single_rays = 10, single_points = 10;

/// A frame, then the closest faces, and rays and points that are asked about one by one.
/// @return a number that depends on all answers
double ask(Detector<>& detector) {
  double sum = static_cast<double>(detector.detect().face_pairs.size());
  sum += detector.closest(0, 1).points.distance;
  for (int i = 0; i < single_rays; ++i) {
    const Ray ray{.origin = {-3, 0.05 * i, 0.1}, .direction = {1, 0, 0}};
    if (const auto hit = detector.first_hit(0, ray)) sum += hit->t;
  }
  for (int i = 0; i < single_points; ++i) sum += detector.closest_point(1, Point(3, 0.1 * i, 2)).distance;
  return sum;
}

/// Medians of a frame with all its questions. Both ways take turns, after each move of the vertices; every other
/// time the other is first.
void held_positions(benchmark::State& state) {
  Surface_mesh a = icosphere(static_cast<std::uint32_t>(state.range(0))), b = a;
  for (Point& p : b.points()) p += Kernel::Vector_3(2.1, 0.3, 0.2);
  Detector<> detector;
  detector.add(a), detector.add(b);
  ask(detector);  // builds
  std::vector<double> each, held;
  bool same = true;
  for (auto _ : state) {
    for (Point& p : b.points()) p += Kernel::Vector_3(1e-4, 0, 0);
    double sums[2]{};
    const bool held_first = each.size() % 2 == 0;
    for (const bool is_held : {held_first, !held_first}) {
      const Lap_timer timer;
      std::optional<Held_positions> hold;
      if (is_held) hold.emplace(detector.hold_positions());
      sums[is_held] = ask(detector);
      (is_held ? held : each).push_back(timer.seconds());
    }
    same &= sums[0] == sums[1];
  }
  if (!same) state.SkipWithError("other answers while positions are held");
  state.counters["triangles"] = static_cast<double>(2 * a.number_of_faces());
  state.counters["each_reads_ms"] = 1000 * median(each);
  state.counters["held_ms"] = 1000 * median(held);
  state.counters["ratio"] = median(each) / median(held);
}
BENCHMARK(held_positions)->Arg(8)->Arg(32)->Arg(128)->Iterations(21)->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace lodestone
