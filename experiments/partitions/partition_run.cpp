// SPDX-License-Identifier: GPL-3.0-or-later
#include "partitions/partition_run.h"

#include <nlohmann/json.hpp>

#include <limits>

#include "lodestone/mesh/stopwatch.h"
#include "lodestone/partition/partition_measures.h"
#include "program/measures_json.h"
#include "shared/measured_run.h"
#include "shared/memory_peak.h"

namespace lodestone {

namespace {

using Row = nlohmann::ordered_json;

/// The surface of a mesh by number, as it is in the first frame.
struct Numbered {
  Mesh_numbering<Surface_mesh> numbering;
  Vertex_graph graph;
  Positions positions;

  explicit Numbered(const Surface_mesh& mesh)
      : numbering(mesh),
        graph(vertex_graph(numbering.vertex_count(), numbering.corners())),
        positions(read_positions(numbering, mesh.points())) {}
};

struct Divided {
  Numbered_partition partition;
  double seconds = std::numeric_limits<double>::infinity();
  std::size_t peak_kib = 0;  ///< of the first repetition
};

/// The quickest of up to five repetitions, none of which starts after a tenth of a second.
Divided divide(const Partition_input<Surface_mesh>& input, std::size_t regions, const Any_strategy& strategy,
               const Partition_options& options) {
  constexpr int most = 5;
  Divided result;
  double spent = 0;
  for (int repetition = 0; repetition < most && spent < 0.1; ++repetition) {
    double seconds = 0;
    const Memory_peak memory;
    timed(seconds, [&] { result.partition = partition_numbered(input, regions, strategy, options); });
    if (repetition == 0) result.peak_kib = memory.bytes() / 1024;
    result.seconds = std::min(result.seconds, seconds);
    spent += seconds;
  }
  return result;
}

Row parameters(const Partition_run& run, const Numbered& surface) {
  return {{"mesh", run.mesh.name},
          {"vertices", surface.numbering.vertex_count()},
          {"triangles", surface.numbering.corners().size()},
          {"variant", run.variant.name},
          {"strategy", run.variant.strategy},
          {"normal_weight", run.variant.settings.lbg.features.normal_weight},
          {"islands_kept", run.variant.options.keep_islands},
          {"regions_wanted", run.regions},
          {"seed", run.seed}};
}

/// The detectors that play a run: the strategy of the run, and `lbg`, each as published and with meetings.
std::vector<Setting> settings_of(const Partition_run& run, const Any_strategy& strategy) {
  std::vector<Setting> settings;
  for (const std::size_t meetings : {std::size_t{0}, Detector_options().meetings}) {
    const Detector_options base{
        .mode = Mode::particles, .particles = run.regions, .meetings = meetings, .growth = 1.25};
    Detector_options own = base;
    own.partition = run.variant.options;
    own.close_seams = run.labels() == nullptr;  // labels are those of the mesh as it is
    settings.push_back({.name = run.variant.name, .options = own, .strategy = strategy});
    settings.push_back({.name = "lbg", .options = base});
  }
  return settings;
}

/// What the particles find in the scene, beside those of `lbg`, in turn in every frame.
Row in_use(const Partition_run& run, Scene scene, const Any_strategy& strategy) {
  const auto measured = measure({&scene, 1}, settings_of(run, strategy), [](std::size_t, std::size_t) {},
                                {.truth = Truth_source::exact_mode});
  const auto& m = measured.measurements[0];
  const auto& lbg = measured.measurements[1];
  const auto& met = measured.measurements[2];
  const auto& met_lbg = measured.measurements[3];
  return {{"frames", m.score.frames()},
          {"positive", m.score.positives()},
          {"recall", m.score.recall()},
          {"precision", m.score.precision()},
          {"delay_frames", m.score.mean_delay()},
          {"never_seen", m.score.never_seen()},
          {"iterations", mean_count(m, &Frame_statistics::iterations)},
          {"candidates", mean_count(m, &Frame_statistics::candidates)},
          {"exact_tests", mean_count(m, &Frame_statistics::exact_tests)},
          {"repartitions", mean_count(m, &Frame_statistics::repartitions) * static_cast<double>(m.frames.size())},
          {"frame_us", median_microseconds_without_build(m)},
          {"lbg_frame_us", median_microseconds_without_build(lbg)},
          {"mean_frame_us", mean_microseconds_without_build(m)},
          {"lbg_mean_frame_us", mean_microseconds_without_build(lbg)},
          {"met_recall", met.score.recall()},
          {"met_precision", met.score.precision()},
          {"met_vertices_read", mean_count(met, &Frame_statistics::vertices_read)},
          {"met_frame_us", median_microseconds_without_build(met)},
          {"met_lbg_frame_us", median_microseconds_without_build(met_lbg)},
          {"met_mean_frame_us", mean_microseconds_without_build(met)},
          {"met_lbg_mean_frame_us", mean_microseconds_without_build(met_lbg)}};
}

}  // namespace

Row execute(const Partition_run& run) {
  Scene scene = partition_scene(run.mesh, run.seed);
  pose(scene.objects[0], 0);
  const Surface_mesh& mesh = scene.objects[0].mesh;
  const Numbered surface(mesh);
  const Partition_input<Surface_mesh> input{mesh, surface.numbering, surface.graph, surface.positions};
  const auto strategy = run.strategy();

  Row row = parameters(run, surface);
  const auto divided = divide(input, run.regions, strategy, run.variant.options);
  const auto lbg = divide(input, run.regions, Any_strategy(), {});
  row["peak_kib"] = divided.peak_kib;
  row["seconds"] = divided.seconds;
  row["lbg_seconds"] = lbg.seconds;
  const auto measures = measure_partition(input.surface(), divided.partition);
  row["regions"] = measures.regions;
  row.update(to_json(measures));
  row.update(in_use(run, std::move(scene), strategy));
  return row;
}

}  // namespace lodestone
