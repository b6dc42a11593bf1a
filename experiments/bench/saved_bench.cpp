// SPDX-License-Identifier: GPL-3.0-or-later
// What it takes to load an object that was saved, beside building it, and beside reading its file.
#include <benchmark/benchmark.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "lodestone/detector.h"
#include "lodestone/io/objects/object_file.h"
#include "lodestone/io/shapes/shapes.h"
#include "shared/lap_timer.h"
#include "shared/measured_run.h"

namespace lodestone {

namespace {

/// A file that is removed at the end.
struct Scratch_file {
  std::filesystem::path path = std::filesystem::temp_directory_path() / "lodestone_saved_bench.object";
  ~Scratch_file() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
};

std::size_t read_whole(const std::filesystem::path& file) {
  std::string bytes(std::filesystem::file_size(file), '\0');
  std::ifstream(file, std::ios::binary).read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return bytes.size();
}

/// A sphere, and a small one far away, which is not counted. In turns: a detector that builds the sphere, one that
/// loads it from a file that the system has just read, each with its first answer; and the file is read into memory.
/// The numbering of the mesh when it is added is counted apart, since both need it.
///
/// Reported time: the load. The counters are medians.
void saved(benchmark::State& state) {
  Surface_mesh mesh = icosphere(static_cast<std::size_t>(state.range(0)));
  Surface_mesh other = icosphere(1);
  for (const auto v : other.vertices()) other.point(v) = other.point(v) + Kernel::Vector_3(5, 0, 0);
  const bool particles = state.range(1) == 1;
  const Detector_options options{.mode = particles ? Mode::particles : Mode::exact, .particles = particles ? 32U : 0U};
  const Scratch_file file;
  {
    Detector<> detector(options);
    detector.add(std::as_const(mesh));
    detector.add(std::as_const(other));
    save_object(detector, 0, file.path);
  }
  std::array<std::vector<double>, 4> seconds;
  for (auto _ : state) {
    Detector<> building(options), loading(options);
    building.add(std::as_const(other));
    loading.add(std::as_const(other));
    building.detect();
    loading.detect();
    Lap_timer timer;
    building.add(std::as_const(mesh));
    seconds[0].push_back(timer.lap());
    building.detect();
    seconds[1].push_back(timer.lap());
    loading.add(std::as_const(mesh));
    timer.lap();
    load_object(loading, 1, file.path);
    loading.detect();
    seconds[2].push_back(timer.lap());
    benchmark::DoNotOptimize(read_whole(file.path));
    seconds[3].push_back(timer.lap());
    state.SetIterationTime(seconds[2].back());
  }
  state.counters["number_ms"] = 1e3 * median(seconds[0]);
  state.counters["build_ms"] = 1e3 * median(seconds[1]);
  state.counters["load_ms"] = 1e3 * median(seconds[2]);
  state.counters["read_ms"] = 1e3 * median(seconds[3]);
  state.counters["build_over_load"] = median(seconds[1]) / median(seconds[2]);
  state.counters["bytes_per_face"] =
      static_cast<double>(std::filesystem::file_size(file.path)) / static_cast<double>(mesh.number_of_faces());
}

BENCHMARK(saved)
    ->ArgsProduct({{16, 50, 158, 316}, {0, 1}})
    ->ArgNames({"frequency", "particles"})
    ->UseManualTime()
    ->Iterations(11)
    ->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace lodestone
