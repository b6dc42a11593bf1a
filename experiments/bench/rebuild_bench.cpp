// SPDX-License-Identifier: GPL-3.0-or-later
// What it takes to follow a change of some faces, beside building everything anew.
#include <CGAL/boost/graph/Euler_operations.h>
#include <benchmark/benchmark.h>

#include <array>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "lodestone/detector.h"
#include "lodestone/io/shapes/shapes.h"
#include "shared/lap_timer.h"
#include "shared/measured_run.h"

namespace lodestone {

namespace {

/// Flips edges around some random places, as a cut or a local remeshing would, until so many faces have changed.
/// @return these faces, ascending
std::vector<std::uint32_t> flip_edges(Surface_mesh& mesh, std::size_t faces, std::mt19937_64& random) {
  std::set<std::uint32_t> changed;
  while (changed.size() < faces) {
    Surface_mesh::Halfedge_index h(static_cast<std::uint32_t>(random() % mesh.number_of_halfedges()));
    for (int step = 0; step < 1000 && changed.size() < faces; ++step) {
      h = mesh.opposite(random() % 2 == 0 ? mesh.next(h) : mesh.prev(h));
      const auto o = mesh.opposite(h);
      if (mesh.halfedge(mesh.target(mesh.next(h)), mesh.target(mesh.next(o))).is_valid()) continue;
      CGAL::Euler::flip_edge(h, mesh);
      changed.insert({mesh.face(h), mesh.face(o)});
    }
  }
  return {changed.begin(), changed.end()};
}

/// A sphere of which a share of the faces changes, in thousandths, again and again. Three detectors take turns: one is
/// told which faces have changed, one that something has, one is made anew. Each then answers yes or no about the
/// sphere and a small one far away.
///
/// Reported time: the first of the three. The counters are medians.
void rebuild(benchmark::State& state) {
  Surface_mesh mesh = icosphere(static_cast<std::size_t>(state.range(0)));
  Surface_mesh other = icosphere(1);
  for (const auto v : other.vertices()) other.point(v) = other.point(v) + Kernel::Vector_3(5, 0, 0);
  const std::size_t faces = mesh.number_of_faces() * static_cast<std::size_t>(state.range(1)) / 1000;
  const auto make_detector = [&] {
    Detector<> detector;
    detector.add(std::as_const(mesh));
    detector.add(std::as_const(other));
    return detector;
  };
  auto told = make_detector(), untold = make_detector();
  told.detect();
  untold.detect();
  std::mt19937_64 random(1);
  std::array<std::vector<double>, 3> seconds;
  for (auto _ : state) {
    const auto changed = flip_edges(mesh, faces, random);
    Lap_timer timer;
    told.rebuild(0, Changed_faces{changed});
    told.detect();
    seconds[0].push_back(timer.lap());
    untold.rebuild(0);
    untold.detect();
    seconds[1].push_back(timer.lap());
    make_detector().detect();
    seconds[2].push_back(timer.lap());
    state.SetIterationTime(seconds[0].back());
  }
  state.counters["told_ms"] = 1e3 * median(seconds[0]);
  state.counters["untold_ms"] = 1e3 * median(seconds[1]);
  state.counters["anew_ms"] = 1e3 * median(seconds[2]);
  state.counters["anew_over_told"] = median(seconds[2]) / median(seconds[0]);
}

BENCHMARK(rebuild)
    ->ArgsProduct({{16, 50, 158, 316}, {1, 10, 100}})
    ->ArgNames({"frequency", "thousandths"})
    ->UseManualTime()
    ->Iterations(30)
    ->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace lodestone
