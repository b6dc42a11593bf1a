// SPDX-License-Identifier: GPL-3.0-or-later
// Self-collision of one deforming mesh, and CGAL's self_intersections on the same frames.
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lodestone/detector.h"
#include "lodestone/io/motion/deformation.h"
#include "lodestone/io/results/text_table.h"
#include "lodestone/io/shapes/shapes.h"
#include "shared/experiment.h"
#include "shared/lap_timer.h"
#include "shared/measured_run.h"

namespace lodestone {

namespace {

constexpr std::size_t measured_frames = 6, passes_per_frame = 3;

struct Folding_motion {
  std::string name;
  Surface_mesh mesh;
  Deformation deformation;
};

std::vector<Folding_motion> folding_motions() {
  return {{"sphere that wobbles", icosphere(71), Wobble{.amplitude = 0.05, .waves = 2}},
          {"sphere that folds over", icosphere(71), Wobble{.amplitude = 0.45, .waves = 2}},
          {"torus knot that twists", torus_knot({.segments = 2500, .sides = 20}), Twist{.degrees = 60}},
          {"cloth that waves", cloth(224, 224), Wobble{.amplitude = 0.1, .waves = 2}},
          {"cloth that crumples", cloth(224, 224), Wobble{.amplitude = 0.5, .waves = 6}},
          {"flat cloth", cloth(224, 224), Wobble{.amplitude = 0}}};
}

std::vector<Face_pair> cgal_pairs(const Surface_mesh& mesh) {
  std::vector<std::pair<Surface_mesh::Face_index, Surface_mesh::Face_index>> found;
  CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(found));
  std::vector<Face_pair> pairs;
  for (const auto& [a, b] : found) {
    const auto [first, second] = std::minmax({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)});
    pairs.push_back({first, second});
  }
  std::ranges::sort(pairs);
  return pairs;
}

/// Per frame the least over the passes, in milliseconds.
struct Self_collision_figures {
  std::vector<double> ours, refit, cgal;
  std::size_t pairs = 0, different = 0;
};

Self_collision_figures measure_case(Folding_motion& moving) {
  const std::vector<Point> rest(moving.mesh.points().begin(), moving.mesh.points().end());
  const Motion motion = deform(rest, {moving.deformation});
  std::vector<Point> positions(rest.size());
  Detector<> detector({.mode = Mode::exact, .exact = {.self_collision = true}});
  detector.add(std::as_const(moving.mesh));
  detector.detect();
  Self_collision_figures figures;
  for (std::size_t frame = 0; frame < measured_frames; ++frame) {
    motion.pose(3 + 7 * frame, positions);
    std::ranges::copy(positions, moving.mesh.points().begin());
    double ours = 1e9, refit = 1e9, cgal = 1e9;
    for (std::size_t pass = 0; pass < passes_per_frame; ++pass) {
      Lap_timer timer;
      const Frame& result = detector.detect();
      ours = std::min(ours, 1e3 * timer.lap());
      refit = std::min(refit, 1e3 * result.statistics.seconds.refit);
      timer.lap();
      const auto expected = cgal_pairs(moving.mesh);
      cgal = std::min(cgal, 1e3 * timer.lap());
      if (pass > 0) continue;
      figures.pairs += expected.size();
      figures.different += result.face_pairs == expected ? 0 : 1;
    }
    figures.ours.push_back(ours);
    figures.refit.push_back(refit);
    figures.cgal.push_back(cgal);
  }
  return figures;
}

}  // namespace

std::string run_self_collision(const Experiment_context& context) {
  Text_table table({"mesh", "triangles", "face pairs, all frames", "refit (ms)", "all (ms)", "CGAL (ms)", "CGAL / all",
                    "frames that differ"});
  nlohmann::ordered_json json;
  auto all = folding_motions();
  for (std::size_t c = 0; c < all.size(); ++c) {
    const Self_collision_figures figures = measure_case(all[c]);
    const double ours = median(figures.ours), cgal = median(figures.cgal);
    table.add({all[c].name, std::to_string(all[c].mesh.number_of_faces()), std::to_string(figures.pairs),
               fmt::format("{:.3f}", median(figures.refit)), fmt::format("{:.2f}", ours), fmt::format("{:.1f}", cgal),
               fmt::format("{:.1f}", cgal / ours), std::to_string(figures.different)});
    json.push_back({{"mesh", all[c].name},
                    {"triangles", all[c].mesh.number_of_faces()},
                    {"face_pairs", figures.pairs},
                    {"milliseconds", figures.ours},
                    {"refit_milliseconds", figures.refit},
                    {"cgal_milliseconds", figures.cgal},
                    {"frames_that_differ", figures.different}});
    context.progress(c + 1, all.size());
  }
  write_json(context.out, "self_collision", json);
  return fmt::format(
             "Each figure is the median over {} frames of the least of {} passes, on one core; `all` includes the "
             "refit. CGAL is `Polygon_mesh_processing::self_intersections`, which starts from the bare mesh in every "
             "frame.\n\n",
             measured_frames, passes_per_frame) +
         table.text();
}

}  // namespace lodestone
