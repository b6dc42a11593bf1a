// SPDX-License-Identifier: GPL-3.0-or-later
// Partition strategies on a large mesh, and one pass that assigns each vector by brute force once.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <ctime>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "lodestone/io/motion/deformation.h"
#include "lodestone/io/shapes/shapes.h"
#include "lodestone/partition/nearest_code_vector.h"
#include "lodestone/partition/strategies.h"

namespace lodestone {

namespace {

constexpr std::size_t regions = 256;

/// Seconds of some work: by the clock, and of processors, summed over all threads. Processor time is steadier on a busy
/// machine.
struct Seconds {
  double wall = std::numeric_limits<double>::infinity();
  double processor = std::numeric_limits<double>::infinity();

  void keep_least(const Seconds& other) {
    wall = std::min(wall, other.wall);
    processor = std::min(processor, other.processor);
  }
};

template <class Work>
Seconds seconds_of(Work work) {
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t processor_start = std::clock();
  work();
  return {.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
          .processor = static_cast<double>(std::clock() - processor_start) / CLOCKS_PER_SEC};
}

/// A wobbly sphere of a quarter of a million vertices, numbered, and its vectors.
struct Subject {
  Surface_mesh mesh = wobbly_sphere();
  Mesh_numbering<Surface_mesh> numbering{mesh};
  Positions positions = read_positions(numbering, mesh.points());
  Vertex_graph graph = vertex_graph(numbering.vertex_count(), numbering.corners());
  Feature_vectors vectors = feature_vectors(positions, numbering.corners());
  Feature_vectors codes = quantise(vectors, regions).code_vectors;

  Partition_input<Surface_mesh> input() const { return {mesh, numbering, graph, positions}; }

  static Surface_mesh wobbly_sphere() {
    Surface_mesh sphere = icosphere(158);
    std::vector<Point> points(sphere.points().begin(), sphere.points().end());
    const Motion motion = deform(points, {Wobble{.amplitude = 0.05, .waves = 3}});
    motion.pose(0, points);
    std::ranges::copy(points, sphere.points().begin());
    return sphere;
  }
};

const Subject& subject() {
  static const Subject the_subject;
  return the_subject;
}

// The widest vectors of the machine, as in the library's own kernels; on other compilers those of the whole program.
#if defined(__x86_64__) && !defined(__clang__)
#define LODESTONE_WIDEST __attribute__((target_clones("default", "avx2", "arch=x86-64-v4")))
#else
#define LODESTONE_WIDEST
#endif

/// Brute force over eight code vectors of 6 components at a time: each lane keeps the nearest of every eighth.
/// @param codes  N / 8 blocks of 6 rows of eight
LODESTONE_WIDEST void nearest_in_blocks(const double* vectors, std::size_t count, const double* codes,
                                        std::size_t blocks, std::uint32_t* labels) {
  using Eight [[gnu::vector_size(8 * sizeof(double))]] = double;
  for (std::size_t v = 0; v < count; ++v, vectors += 6) {
    Eight nearest = Eight{} + std::numeric_limits<double>::max(), winner = {};
    for (std::size_t block = 0; block < blocks; ++block) {
      Eight squared = {};
      for (std::size_t i = 0; i < 6; ++i) {
        Eight row;
        std::memcpy(&row, codes + (block * 6 + i) * 8, sizeof row);
        const Eight difference = vectors[i] - row;
        squared += difference * difference;
      }
      winner = squared < nearest ? Eight{} + static_cast<double>(block) : winner;
      nearest = squared < nearest ? squared : nearest;
    }
    std::size_t least = 0;
    for (std::size_t lane = 1; lane < 8; ++lane)
      if (nearest[lane] < nearest[least]) least = lane;
    labels[v] = static_cast<std::uint32_t>(8 * winner[least]) + static_cast<std::uint32_t>(least);
  }
}

/// One pass by brute force in two ways: the library's plain loop, and eight code vectors at a time.
struct Brute_force {
  Assignment plain;
  std::vector<double> blocks;
  std::vector<std::uint32_t> labels;

  Brute_force() : blocks(regions * 6), labels(subject().numbering.vertex_count()) {
    for (std::size_t c = 0; c < regions; ++c)
      for (std::size_t i = 0; i < 6; ++i)
        blocks[(c / 8 * 6 + i) * 8 + c % 8] =
            subject().codes(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(i));
  }
  Seconds plain_seconds() {
    return seconds_of([&] { assign_plain(subject().vectors, subject().codes, plain); });
  }
  Seconds vector_seconds() {
    return seconds_of(
        [&] { nearest_in_blocks(subject().vectors.data(), labels.size(), blocks.data(), regions / 8, labels.data()); });
  }
};

/// Runs `timed`, which returns its seconds, and both passes by brute force in turn. `passes` and `vector_passes` are
/// the ratios of their times, `cpu_passes` and `cpu_vector_passes` those of the processor times; all from the least
/// times.
template <class Timed>
void beside_brute_force(benchmark::State& state, Timed timed) {
  Brute_force brute_force;
  Seconds plain, vector, whole;
  for (auto _ : state) {
    plain.keep_least(brute_force.plain_seconds());
    vector.keep_least(brute_force.vector_seconds());
    const Seconds time = timed();
    whole.keep_least(time);
    state.SetIterationTime(time.wall);
  }
  if (brute_force.plain.labels != brute_force.labels) state.SkipWithError("the passes by brute force differ");
  state.counters["least_ms"] = 1e3 * whole.wall;
  state.counters["passes"] = whole.wall / plain.wall;
  state.counters["vector_passes"] = whole.wall / vector.wall;
  state.counters["cpu_ms"] = 1e3 * whole.processor;
  state.counters["cpu_pass_ms"] = 1e3 * plain.processor;
  state.counters["cpu_vector_pass_ms"] = 1e3 * vector.processor;
  state.counters["cpu_passes"] = whole.processor / plain.processor;
  state.counters["cpu_vector_passes"] = whole.processor / vector.processor;
}

/// LBG alone, trained on all vectors, from vectors to labels. With several threads, one thread takes turns with them
/// and gives the same labels.
void lbg_on_threads(benchmark::State& state) {
  const auto threads = static_cast<std::size_t>(state.range(0));
  Quantisation alone, shared;
  Seconds one, several;
  beside_brute_force(state, [&] {
    if (threads != 1) one.keep_least(seconds_of([&] { alone = quantise(subject().vectors, regions, {.sample = 0}); }));
    const Seconds seconds =
        seconds_of([&] { shared = quantise(subject().vectors, regions, {.sample = 0, .threads = threads}); });
    several.keep_least(seconds);
    return seconds;
  });
  if (threads == 1) return;
  if (alone.labels != shared.labels) state.SkipWithError("the labels differ");
  state.counters["one_over_this"] = one.wall / several.wall;
}

/// Mean squared distance of the vectors from the means of their cells, per component.
double distortion(const Feature_vectors& vectors, const Quantisation& cells) {
  double sum = 0;
  for (Eigen::Index v = 0; v < vectors.rows(); ++v)
    sum += (vectors.row(v) - cells.code_vectors.row(cells.labels[static_cast<std::size_t>(v)])).squaredNorm();
  return sum / static_cast<double>(vectors.size());
}

/// The same after all vectors have been assigned once more, and the code vectors moved to the means again.
double distortion_after_another(const Feature_vectors& vectors, Quantisation cells) {
  Assignment again;
  assign_plain(vectors, cells.code_vectors, again);
  for (Eigen::Index c = 0; c < cells.code_vectors.rows(); ++c)
    if (again.cell_sizes[static_cast<std::size_t>(c)] > 0)
      cells.code_vectors.row(c) =
          again.cell_sums.row(c) / static_cast<double>(again.cell_sizes[static_cast<std::size_t>(c)]);
  cells.labels = again.labels;
  return distortion(vectors, cells);
}

/// LBG trained on a sample takes turns with LBG trained on all vectors. `over_all` is the ratio of their distortions,
/// `twice_over_all` the same after a second assignment, `faster` the ratio of their processor times.
void lbg_on_sample(benchmark::State& state, const Surface_mesh& mesh) {
  const Feature_vectors vectors = feature_vectors(mesh);
  const auto cells = static_cast<std::size_t>(state.range(0)), sample = static_cast<std::size_t>(state.range(1));
  Quantisation all, some;
  Seconds all_seconds, some_seconds;
  for (auto _ : state) {
    all_seconds.keep_least(seconds_of([&] { all = quantise(vectors, cells, {.sample = 0}); }));
    const Seconds seconds = seconds_of([&] { some = quantise(vectors, cells, {.sample = sample}); });
    some_seconds.keep_least(seconds);
    state.SetIterationTime(seconds.wall);
  }
  state.counters["vectors"] = static_cast<double>(vectors.rows());
  state.counters["over_all"] = distortion(vectors, some) / distortion(vectors, all);
  state.counters["twice_over_all"] = distortion_after_another(vectors, some) / distortion(vectors, all);
  state.counters["faster"] = all_seconds.processor / some_seconds.processor;
  state.counters["cpu_ms"] = 1e3 * some_seconds.processor;
}

/// A strategy by name, from the numbered mesh to labels.
void strategy(benchmark::State& state, const std::string& name) {
  const auto chosen = make_strategy(name);
  beside_brute_force(state, [&] {
    return seconds_of([&] { benchmark::DoNotOptimize(chosen(subject().input(), regions).labels.data()); });
  });
}

BENCHMARK(lbg_on_threads)
    ->Name("large/lbg/threads")
    ->Arg(1)
    ->Arg(2)
    ->UseManualTime()
    ->Iterations(10)
    ->Unit(benchmark::kMillisecond);

/// The strategies of the library, each by its own name, and samples of several shapes.
const bool registered = [] {
  const std::vector<std::pair<std::string, Surface_mesh (*)()>> shapes{
      {"wobbly_sphere", Subject::wobbly_sphere},
      {"teapot", [] { return teapot({.u = 60, .v = 60}); }},
      {"knot", [] { return torus_knot({.segments = 2000, .sides = 120}); }},
      {"cloth", [] { return cloth(500, 500); }},
      {"sphere", [] { return icosphere(158); }}};
  for (const auto& [name, shape] : shapes)
    benchmark::RegisterBenchmark(("large/sample/" + name).c_str(),
                                 [shape = shape](benchmark::State& state) { lbg_on_sample(state, shape()); })
        ->ArgNames({"N", "sample"})
        ->ArgsProduct({{12, 32, 256}, {1, 8192, 32768}})
        ->UseManualTime()
        ->Iterations(3)
        ->Unit(benchmark::kMillisecond);
  for (const std::string name : {"lbg", "kmeans++", "metis", "vsa"}) {
    if (std::ranges::find(strategies(), name, &Strategy_entry::name) == strategies().end()) continue;
    benchmark::RegisterBenchmark(("large/strategy/" + name).c_str(), strategy, name)
        ->UseManualTime()
        ->Iterations(3)
        ->Unit(benchmark::kMillisecond);
  }
  return true;
}();

}  // namespace

}  // namespace lodestone
