// SPDX-License-Identifier: GPL-3.0-or-later
// Tolerances that are many faces wide, where nothing is nearer.
#include <benchmark/benchmark.h>

#include <vector>

#include "lodestone/detector.h"
#include "program/measurement.h"
#include "shared/lap_timer.h"

namespace lodestone {

namespace {

/// A square plate of side 1 at a height, turned or level.
struct Plate {
  std::vector<double> coordinates;
  std::vector<Corners> faces;

  Plate(std::uint32_t squares, double height, bool turned) {
    for (std::uint32_t i = 0; i <= squares; ++i)
      for (std::uint32_t j = 0; j <= squares; ++j) {
        const double u = 1.0 * i / squares, v = 1.0 * j / squares, w = height;
        if (turned)
          add(0.8 * u - 0.36 * v + 0.48 * w, 0.6 * u + 0.48 * v - 0.64 * w, 0.8 * v + 0.6 * w);
        else
          add(u, v, w);
      }
    for (std::uint32_t i = 0; i < squares; ++i)
      for (std::uint32_t j = 0; j < squares; ++j) {
        const std::uint32_t corner = i * (squares + 1) + j, next = corner + squares + 1;
        faces.push_back({corner, next, corner + 1});
        faces.push_back({corner + 1, next, next + 1});
      }
  }
  void add(double x, double y, double z) { coordinates.insert(coordinates.end(), {x, y, z}); }
};

/// Two parallel plates half a side apart, and a tolerance in percent of that: 80, or 100, where it takes exact numbers
/// to tell that no face is nearer. Medians: a frame with the tolerance, `within`, and `closest`.
void wide_tolerance(benchmark::State& state) {
  const auto squares = static_cast<std::uint32_t>(state.range(0));
  const bool turned = state.range(1) != 0;
  const double tolerance = 0.005 * static_cast<double>(state.range(2));
  const Plate low(squares, 0, turned), high(squares, 0.5, turned);
  const Indexed_mesh a(low.coordinates, low.faces), b(high.coordinates, high.faces);
  Detector<> detector({.exact = {.tolerance = tolerance}});
  const auto id_a = detector.add(a), id_b = detector.add(b);
  detector.detect();  // builds
  std::vector<double> frames, withins, closests;
  Frame_statistics statistics;
  for (auto _ : state) {
    Lap_timer timer;
    statistics = detector.detect().statistics;
    frames.push_back(timer.lap());
    benchmark::DoNotOptimize(detector.within(id_a, id_b, tolerance));
    withins.push_back(timer.lap());
    benchmark::DoNotOptimize(detector.closest(id_a, id_b));
    closests.push_back(timer.lap());
  }
  state.counters["faces"] = static_cast<double>(low.faces.size());
  state.counters["exact_tests"] = static_cast<double>(statistics.exact_tests);
  state.counters["contacts"] = static_cast<double>(statistics.contacts);
  state.counters["frame_ms"] = 1e3 * median(frames);
  state.counters["within_ms"] = 1e3 * median(withins);
  state.counters["closest_ms"] = 1e3 * median(closests);
}

BENCHMARK(wide_tolerance)
    ->ArgsProduct({{25, 50, 100}, {0, 1}, {80, 100}})
    ->ArgNames({"squares", "turned", "percent_of_gap"})
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace lodestone
