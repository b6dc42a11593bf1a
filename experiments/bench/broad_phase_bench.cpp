// SPDX-License-Identifier: GPL-3.0-or-later
// The pairs of many boxes that overlap, from frame to frame, beside CGAL's box intersection, which begins anew in each.
#include <CGAL/box_intersection_d.h>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <random>
#include <vector>

#include "lodestone/detection/broad_phase.h"
#include "program/measurement.h"

namespace lodestone {

namespace {

enum class Place { cube, floor, column, runaway };  // runaway: a column, and one box far off
enum class Change { small_steps, one_added, all_anew };

/// Unit boxes, each of which overlaps about three others wherever they are.
class Crowd {
 public:
  Crowd(std::size_t count, Place place) : place_(place), count_(count) {
    for (std::size_t i = 0; i < count; ++i) add();
    if (place == Place::runaway) boxes.front().translate(Eigen::Vector3d(1e6, 1e6, 0));
  }

  void add() {
    ids.push_back(static_cast<std::uint32_t>(boxes.size()));
    boxes.push_back(drawn());
  }
  void change(Change change) {
    for (auto& box : boxes) {
      if (change == Change::all_anew) box = drawn();
      box.translate(0.02 * Eigen::Vector3d(unit_(random_) - 0.5, unit_(random_) - 0.5, unit_(random_) - 0.5));
    }
    if (change == Change::one_added) add();
  }

  std::vector<std::uint32_t> ids = {};
  std::vector<Box> boxes = {};

 private:
  /// Sides such that the density is the same: those along which boxes lie on top of each other are short.
  Eigen::Vector3d sides() const {
    const auto n = static_cast<double>(count_);
    if (place_ == Place::cube) return Eigen::Vector3d::Constant(std::cbrt(2.7 * n));
    if (place_ == Place::floor) return {0.1, std::sqrt(1.3 * n), std::sqrt(1.3 * n)};
    return {0.1, 0.1, 0.67 * n};
  }
  Box drawn() {
    const Eigen::Vector3d low = Eigen::Array3d(unit_(random_), unit_(random_), unit_(random_)) * sides().array();
    return {low, low + Eigen::Vector3d::Ones()};
  }

  Place place_;
  std::size_t count_;
  std::mt19937_64 random_{1};
  std::uniform_real_distribution<double> unit_{0, 1};
};

std::vector<Object_pair> pairs_by_cgal(const Crowd& crowd) {
  using Cgal_box = CGAL::Box_intersection_d::Box_d<double, 3, CGAL::Box_intersection_d::ID_EXPLICIT>;
  std::vector<Cgal_box> boxes;
  boxes.reserve(crowd.boxes.size());
  for (const auto& box : crowd.boxes)
    boxes.emplace_back(
        CGAL::Bbox_3(box.min().x(), box.min().y(), box.min().z(), box.max().x(), box.max().y(), box.max().z()));
  const auto first = boxes.front().id();
  std::vector<Object_pair> pairs;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Cgal_box& a, const Cgal_box& b) {
    const auto i = static_cast<std::uint32_t>(a.id() - first), j = static_cast<std::uint32_t>(b.id() - first);
    pairs.push_back({std::min(i, j), std::max(i, j)});
  });
  std::ranges::sort(pairs);
  return pairs;
}

/// One frame after another, in turns. `differences` counts the frames in which the two find other pairs.
void broad_phase(benchmark::State& state, Place place, Change change) {
  Crowd crowd(static_cast<std::size_t>(state.range(0)), place);
  Broad_phase phase;
  std::vector<double> ours, of_cgal, pairs;
  std::size_t differences = 0;
  const auto timed = [](std::vector<double>& seconds, const auto& find) {
    const auto start = std::chrono::steady_clock::now();
    auto found = find();
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    return found;
  };
  std::vector<double> first;
  std::vector<double> reach(crowd.boxes.size());
  timed(first, [&] { return phase.find(crowd.ids, crowd.boxes, reach); });
  for (auto _ : state) {
    crowd.change(change);
    reach.resize(crowd.boxes.size());
    const auto found = timed(ours, [&] { return phase.find(crowd.ids, crowd.boxes, reach); });
    const auto expected = timed(of_cgal, [&] { return pairs_by_cgal(crowd); });
    differences += std::ranges::equal(found, expected) ? 0 : 1;
    pairs.push_back(static_cast<double>(found.size()));
    state.SetIterationTime(ours.back());
  }
  state.counters["pairs"] = median(pairs);
  state.counters["first_us"] = 1e6 * first.front();
  state.counters["median_us"] = 1e6 * median(ours);
  state.counters["cgal_us"] = 1e6 * median(of_cgal);
  state.counters["cgal_ratio"] = median(of_cgal) / median(ours);
  state.counters["differences"] = static_cast<double>(differences);
}

void many(benchmark::internal::Benchmark* run) {
  for (const int count : {100, 1000, 10'000}) run->Arg(count);
  run->UseManualTime()->Iterations(51)->Unit(benchmark::kMicrosecond);
}

BENCHMARK_CAPTURE(broad_phase, cube_small_steps, Place::cube, Change::small_steps)->Apply(many);
BENCHMARK_CAPTURE(broad_phase, cube_one_added, Place::cube, Change::one_added)->Apply(many);
BENCHMARK_CAPTURE(broad_phase, cube_all_anew, Place::cube, Change::all_anew)->Apply(many);
BENCHMARK_CAPTURE(broad_phase, floor_small_steps, Place::floor, Change::small_steps)->Apply(many);
BENCHMARK_CAPTURE(broad_phase, column_small_steps, Place::column, Change::small_steps)->Apply(many);
BENCHMARK_CAPTURE(broad_phase, runaway_small_steps, Place::runaway, Change::small_steps)->Apply(many);

}  // namespace

}  // namespace lodestone
