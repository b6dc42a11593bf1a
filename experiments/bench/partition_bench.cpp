// SPDX-License-Identifier: GPL-3.0-or-later
// LBG with the bounded and with the plain nearest-code-vector search, on the same vectors, with equal labels.
#include <benchmark/benchmark.h>

#include <chrono>

#include "lodestone/io/shapes/shapes.h"
#include "lodestone/partition/lbg.h"
#include "shared/measured_run.h"

namespace lodestone {

namespace {

using Clock = std::chrono::steady_clock;

Feature_vectors vectors_of(const Surface_mesh& mesh) {
  const Mesh_numbering<Surface_mesh> numbering(mesh);
  return feature_vectors(read_positions(numbering, mesh.points()), numbering.corners());
}

/// Both searches run in every iteration, so that a change of the machine's speed affects both.
void lbg_search(benchmark::State& state, const Surface_mesh& mesh) {
  const auto vectors = vectors_of(mesh);
  const auto cells = static_cast<std::size_t>(state.range(0));
  const auto timed = [&](Nearest_search search, std::vector<double>& seconds) {
    const auto start = Clock::now();
    auto result = quantise(vectors, cells, {.search = search});
    seconds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    return result;
  };
  std::vector<double> bounded, plain;
  for (auto _ : state) {
    const auto a = timed(Nearest_search::bounded, bounded);
    const auto b = timed(Nearest_search::plain, plain);
    if (a.labels != b.labels) state.SkipWithError("the labels differ");
    state.SetIterationTime(bounded.back());
  }
  std::vector<double> ratios;
  for (std::size_t i = 0; i < plain.size(); ++i) ratios.push_back(plain[i] / bounded[i]);
  state.counters["vectors"] = static_cast<double>(vectors.rows());
  state.counters["bounded_ms"] = 1e3 * median(bounded);
  state.counters["plain_ms"] = 1e3 * median(plain);
  state.counters["plain_over_bounded"] = median(ratios);
}

void lbg_teapot(benchmark::State& state) { lbg_search(state, teapot({.u = 28, .v = 28})); }
void lbg_sphere(benchmark::State& state) { lbg_search(state, icosphere(50)); }

BENCHMARK(lbg_teapot)
    ->Arg(32)
    ->Arg(64)
    ->Arg(128)
    ->Arg(256)
    ->UseManualTime()
    ->Iterations(15)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(lbg_sphere)->Arg(64)->UseManualTime()->Iterations(15)->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace lodestone
