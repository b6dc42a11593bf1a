// SPDX-License-Identifier: GPL-3.0-or-later
// What it takes to ask two skinned surfaces for contacts, posing only what is near, beside posing all.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "bench/worm.h"
#include "lodestone/detector.h"
#include "lodestone/mesh/computed_points.h"
#include "lodestone/queries/bounded_search.h"
#include "shared/lap_timer.h"
#include "shared/measured_run.h"

namespace lodestone {

namespace {

/// Two worms whose tips meet in some frames. A Bounded_search and a Detector of mode exact, which poses all, take turns
/// on each frame; both get a pose that they have not seen. The question is yes/no (`all`:0) or all face pairs (1).
///
/// Reported time: that of the Bounded_search. The counters are medians, but for `contact_ratio`: the sums over the
/// frames with contacts, Detector over Bounded_search.
void bounded(benchmark::State& state) {
  Worm a(static_cast<std::size_t>(state.range(0))), b(static_cast<std::size_t>(state.range(0)));
  const auto query = state.range(1) != 0 ? Contact_query::all : Contact_query::yes_no;
  Detector<> detector({.mode = Mode::exact, .contacts = query});
  detector.add(std::as_const(a.mesh), point_map(a.mesh, a.points));
  detector.add(std::as_const(b.mesh), point_map(b.mesh, b.points));
  detector.detect();
  Bounded_search search;
  std::array<std::vector<double>, 2> seconds;
  std::array<double, 2> with_contact{};
  std::vector<double> posed;
  std::vector<Face_pair> found;
  int frame = 0;
  for (auto _ : state) {
    ++frame;
    a.pose(0.1 * frame, {0, 0, 0});
    b.pose(0.13 * frame, {18.9 + 0.9 * std::sin(0.7 * frame), 0, 0});
    found.clear();
    Lap_timer timer;
    const bool meet = search.run(a.surface, b.surface, {.query = query}, found).found;
    seconds[0].push_back(timer.lap());
    const Frame& truth = detector.detect();
    seconds[1].push_back(timer.lap());
    const bool truly_meet = std::ranges::any_of(truth.pairs, &Pair_result::collides);
    if (truly_meet != meet || !std::ranges::equal(truth.face_pairs, found))
      throw std::runtime_error("the two answers differ");
    posed.push_back(100.0 * static_cast<double>(a.surface.vertices_posed() + b.surface.vertices_posed()) /
                    static_cast<double>(a.points.vertex_count() + b.points.vertex_count()));
    for (std::size_t who = 0; meet && who < 2; ++who) with_contact[who] += seconds[who].back();
    state.SetIterationTime(seconds[0].back());
  }
  state.counters["bounded_ms"] = 1e3 * median(seconds[0]);
  state.counters["exact_ms"] = 1e3 * median(seconds[1]);
  state.counters["exact_over_bounded"] = median(seconds[1]) / median(seconds[0]);
  state.counters["contact_ratio"] = with_contact[1] / with_contact[0];
  state.counters["posed_percent"] = median(posed);
}

BENCHMARK(bounded)
    ->ArgsProduct({{32, 71, 158, 224, 447}, {0, 1}})
    ->ArgNames({"frequency", "all"})
    ->UseManualTime()
    ->Iterations(60)
    ->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace lodestone
