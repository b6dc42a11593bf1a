// SPDX-License-Identifier: GPL-3.0-or-later
// What it takes to compute the positions of a skinned and morphed surface.
#include <benchmark/benchmark.h>

#include <array>
#include <random>
#include <vector>

#include "lodestone/mesh/skinned_points.h"
#include "shared/lap_timer.h"
#include "shared/measured_run.h"

namespace lodestone {

namespace {

constexpr std::size_t joints = 60, per_vertex = 4, target_count = 8;

/// Vertices in a row: each follows four neighbouring joints, and each target moves a tenth of the row.
struct Row {
  std::vector<double> rest;
  std::vector<std::uint32_t> followed;
  std::vector<double> weights;
  std::vector<Morph_target> targets;
  std::vector<Eigen::Affine3d> motions;

  Row(std::uint32_t vertices, bool morphed) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> number(0.01, 1);
    for (std::size_t i = 0; i < 3 * std::size_t{vertices}; ++i) rest.push_back(number(random));
    for (std::uint64_t v = 0; v < vertices; ++v)
      for (std::size_t k = 0; k < per_vertex; ++k) {
        followed.push_back(static_cast<std::uint32_t>((v * joints / vertices + k) % joints));
        weights.push_back(number(random) / per_vertex);
      }
    for (std::uint32_t t = 0; morphed && t < target_count; ++t) {
      targets.emplace_back();
      for (std::uint32_t v = 0; v < vertices / 10; ++v) {
        targets.back().vertices.push_back(vertices / 10 * t + v);
        for (int axis = 0; axis < 3; ++axis) targets.back().offsets.push_back(number(random));
      }
    }
    for (std::size_t joint = 0; joint < joints; ++joint)
      motions.push_back(Eigen::Translation3d(number(random), number(random), number(random)) *
                        Eigen::AngleAxisd(number(random), Eigen::Vector3d(0, 0.6, 0.8)));
  }
};

/// Linear blend skinning as it is often written: the weighted sum of where the joints take a vertex.
void sum_of_moved(const Row& row, std::vector<double>& coordinates) {
  for (std::size_t v = 0; v < row.rest.size() / 3; ++v) {
    const Eigen::Map<const Eigen::Vector3d> at(row.rest.data() + 3 * v);
    Eigen::Vector3d moved = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < per_vertex; ++k)
      moved += row.weights[per_vertex * v + k] * (row.motions[row.followed[per_vertex * v + k]] * at);
    Eigen::Map<Eigen::Vector3d>(coordinates.data() + 3 * v) = moved;
  }
}

/// Nanoseconds per vertex of all at once, of one by one, and of the usual sum, which is not morphed. They take turns.
/// Reported time: the first. The counters are medians.
void pose(benchmark::State& state) {
  const auto vertices = static_cast<std::uint32_t>(state.range(0));
  const Row row(vertices, state.range(1) != 0);
  Skinned_points points(Morphed_points(row.rest, row.targets),
                        Joint_influences::of(per_vertex, row.followed, row.weights), joints);
  points.set_weights(std::vector<double>(row.targets.size(), 0.5));
  points.set_joints(row.motions);
  std::vector<double> coordinates(row.rest.size());
  std::array<std::vector<double>, 3> seconds;
  for (auto _ : state) {
    Lap_timer timer;
    points.pose_all(coordinates);
    seconds[0].push_back(timer.lap());
    benchmark::DoNotOptimize(coordinates.data());
    timer.lap();
    for (std::uint32_t v = 0; v < vertices; ++v)
      Eigen::Map<Eigen::Vector3d>(coordinates.data() + 3 * std::size_t{v}) = points(v);
    seconds[1].push_back(timer.lap());
    benchmark::DoNotOptimize(coordinates.data());
    timer.lap();
    sum_of_moved(row, coordinates);
    seconds[2].push_back(timer.lap());
    benchmark::DoNotOptimize(coordinates.data());
    state.SetIterationTime(seconds[0].back());
  }
  const auto per_vertex_of = [&](std::size_t way) { return 1e9 * median(seconds[way]) / vertices; };
  state.counters["all_ns"] = per_vertex_of(0);
  state.counters["single_ns"] = per_vertex_of(1);
  state.counters["usual_ns"] = per_vertex_of(2);
  state.counters["usual_over_all"] = median(seconds[2]) / median(seconds[0]);
}

BENCHMARK(pose)
    ->ArgsProduct({{10'000, 250'000, 1'000'000}, {0, 1}})
    ->ArgNames({"vertices", "morphed"})
    ->UseManualTime()
    ->Iterations(21)
    ->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace lodestone
