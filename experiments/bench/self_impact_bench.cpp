// SPDX-License-Identifier: GPL-3.0-or-later
// When a mesh first meets itself between two frames, beside CGAL's boxes and beside exhaustive checking.
#include <CGAL/box_intersection_d.h>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "lodestone/queries/impact_search.h"
#include "lodestone/tree/tree_surface.h"
#include "shared/lap_timer.h"
#include "shared/measured_run.h"

namespace lodestone {

namespace {

/// A square cloth with waves, one half of which turns over onto the other in one step: each vertex moves on a straight
/// line, so it meets the other half on its way. With `still` nothing turns, and the waves only grow by a tenth.
struct Folding_cloth {
  std::vector<Corners> faces;
  std::vector<double> start, end;

  Folding_cloth(std::size_t squares, bool still) {
    const auto side = static_cast<std::uint32_t>(squares + 1);
    for (std::uint32_t i = 0; i < side; ++i)
      for (std::uint32_t j = 0; j < side; ++j) {
        const double x = 2.0 * i / static_cast<double>(squares) - 1, y = 2.0 * j / static_cast<double>(squares) - 1;
        const double wave = 0.02 * std::sin(9 * x) * std::cos(7 * y);
        const double angle = still ? 0 : std::numbers::pi * 1.05 * std::clamp(-3 * x, 0.0, 1.0);
        start.insert(start.end(), {x, y, wave});
        end.insert(end.end(), {x * std::cos(angle), y, (still ? 1.1 : 1.0) * wave - x * std::sin(angle)});
      }
    for (std::uint32_t i = 0; i + 1 < side; ++i)
      for (std::uint32_t j = 0; j + 1 < side; ++j) {
        const std::uint32_t p = i * side + j;
        faces.push_back({p, p + 1, p + side});
        faces.push_back({p + 1, p + side + 1, p + side});
      }
  }
  Moving_surface surface() const { return {faces, start, end}; }
};

/// All pairs of faces whose swept boxes overlap go to the exact test, with the earliest time so far as its limit.
std::optional<Impact_time> by_boxes(const Moving_surface& surface) {
  std::vector<Moving_triangle> moving;
  using Swept_box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;
  std::vector<Swept_box> boxes;
  for (std::uint32_t face = 0; face < surface.faces.size(); ++face) {
    const auto at = [&](Coordinates coordinates) {
      return face_triangle(surface.faces[face],
                           [&](auto vertex) { return coordinates.data() + 3 * std::size_t{vertex}; });
    };
    moving.push_back({at(surface.start), at(surface.end)});
    CGAL::Bbox_3 swept;
    for (const Triangle* triangle : {&moving.back().start, &moving.back().end})
      for (const Point& corner : *triangle) swept += corner.bbox();
    boxes.emplace_back(swept, face);
  }
  std::optional<Impact_time> first;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Swept_box& a, const Swept_box& b) {
    const auto &p = surface.faces[a.info()], &q = surface.faces[b.info()];
    if (std::ranges::find_first_of(p, q) != p.end()) return;
    const auto found = first_impact(moving[a.info()], moving[b.info()], first ? first->high() : 1.0);
    if (found && (!first || *found < *first)) first = found;
  });
  return first;
}

/// The arguments are the number of squares along a side, and whether nothing turns. Reported time: refit and search;
/// the tree has been built. The counters are medians in milliseconds. Exhaustive checking is timed once, on the
/// smallest.
void self_impact(benchmark::State& state) {
  const Folding_cloth cloth(static_cast<std::size_t>(state.range(0)), state.range(1) != 0);
  Tree_surface tree(cloth.faces, cloth.start);
  Tree_surface* const trees[]{&tree};
  const Coordinates starts[]{cloth.start};
  std::vector<double> ours, boxes;
  for (auto _ : state) {
    Lap_timer timer;
    refit(trees, starts, Workers::alone());
    const auto impact = first_self_impact(Swept_boxes(tree.view(), cloth.end).view());
    ours.push_back(timer.lap());
    state.SetIterationTime(ours.back());
    const auto other = by_boxes(cloth.surface());
    boxes.push_back(timer.lap());
    if (impact.has_value() != other.has_value() || (impact && impact->exact_time != *other))
      state.SkipWithError("boxes find another time");
    state.counters["meets"] = impact ? 1 : 0;
    if (ours.size() > 1 || cloth.faces.size() > 10'000) continue;
    const auto truth = exhaustive_first_self_impact(cloth.surface());
    state.counters["exhaustive_ms"] = 1e3 * timer.lap();
    if (truth.has_value() != impact.has_value() || (truth && truth->faces != impact->faces))
      state.SkipWithError("exhaustive checking finds another impact");
  }
  state.counters["search_ms"] = 1e3 * median(ours);
  state.counters["boxes_ms"] = 1e3 * median(boxes);
}

BENCHMARK(self_impact)
    ->Name("impact/self")
    ->ArgsProduct({{50, 100, 224}, {0, 1}})
    ->ArgNames({"squares", "still"})
    ->UseManualTime()
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace lodestone
