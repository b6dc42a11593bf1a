// SPDX-License-Identifier: GPL-3.0-or-later
// What a frame costs in each mode, and what it misses.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "lodestone/mesh/errors.h"
#include "modes/mode_report.h"
#include "shared/experiment.h"
#include "shared/measured_run.h"
#include "shared/scene_detector.h"
#include "shared/scene_sources.h"

namespace lodestone {

namespace {

const std::vector<std::string> published_scenes{
    "teapot_sphere_1", "torus_knots",      "cloth_sphere", "bodies_20",        "spheres_5k",   "spheres_50k",
    "torus_knots_20k", "cloth_sphere_80k", "bodies_20_5k", "torus_knots_200k", "spheres_500k", "spheres_2m"};

/// Each play starts with another partition.
constexpr std::size_t plays = 3;
/// Larger scenes are played once: their partitions take minutes.
constexpr std::size_t most_triangles_for_all_plays = 1'000'000;
/// In larger scenes exhaustive checking would take longer than all settings together.
constexpr std::size_t most_triangles_for_exhaustive_truth = 20'000;

/// Particles as they are by default, and as in the published method; then the mode exact.
std::vector<Setting> mode_settings() {
  std::vector<Setting> settings;
  const std::size_t meetings = Detector_options().meetings;
  for (const auto& [method, most_meetings] : {std::pair("particles", meetings), {"particles, no meetings", 0}})
    for (const std::size_t particles : {12, 32, 64, 128})
      settings.push_back({fmt::format("{}, {}", method, particles),
                          {.mode = Mode::particles, .particles = particles, .meetings = most_meetings}});
  settings.push_back({"exact", {.mode = Mode::exact}});
  return settings;
}

/// The sources, without those in which no two objects can meet.
struct Playable {
  std::vector<std::filesystem::path> sources;
  std::vector<std::string> skipped;  ///< names of scenes
};

/// Reads every source, so that a broken one is reported before the first is played.
/// @throws Bad_scene  nothing is left
Playable playable(const std::vector<std::filesystem::path>& sources, const std::filesystem::path& folder) {
  Playable result;
  for (const auto& source : sources) {
    const Scene scene = read_source(source);
    if (object_pairs(scene).empty())
      result.skipped.push_back(scene.name);
    else
      result.sources.push_back(source);
  }
  if (result.sources.empty())
    throw Bad_scene(fmt::format("{}: no scene has two objects that can meet: {}", folder.string(),
                                fmt::join(result.skipped, ", ")));
  return result;
}

/// One row per setting; `exact` is the last setting.
/// @param progress  called with the share of the work that is done
std::vector<Mode_figures> play(Scene scene, std::span<const Setting> settings,
                               const std::function<void(double)>& progress) {
  std::size_t triangles = 0, vertices = 0;
  for (const auto& object : scene.objects) {
    triangles += object.mesh.number_of_faces();
    vertices += object.mesh.number_of_vertices();
  }
  const auto truth =
      triangles <= most_triangles_for_exhaustive_truth ? Truth_source::exhaustive : Truth_source::exact_mode;
  const std::size_t timed_plays = triangles <= most_triangles_for_all_plays ? plays : 1;
  const auto show = [&](std::size_t frames) {  // of the timed plays, and of one for the face pairs
    progress(static_cast<double>(frames) / static_cast<double>((timed_plays + 1) * scene.frames));
  };
  const auto run = measure({&scene, 1}, settings, [&](std::size_t done, std::size_t) { show(done); },
                           {.truth = truth, .plays = timed_plays});
  const auto face_pairs = count_face_pairs(
      scene, settings, [&](std::size_t done, std::size_t) { show(timed_plays * scene.frames + done); });

  const double exact = median_microseconds_without_build(run.measurements.back());
  std::vector<Mode_figures> rows;
  for (std::size_t s = 0; s < settings.size(); ++s) {
    const bool is_truth = truth == Truth_source::exact_mode && settings[s].options.mode == Mode::exact;
    rows.push_back({.scene = scene.name,
                    .triangles = triangles,
                    .vertices = vertices,
                    .measurement = run.measurements[s],
                    .is_truth = is_truth,
                    .face_pairs = face_pairs[s],
                    .exact_median = exact});
  }
  return rows;
}

std::string report(std::span<const Mode_figures> rows, std::span<const std::string> skipped,
                   const std::string& unplayed) {
  std::string text = fmt::format(
      "Each setting answers yes or no in every frame, on one core. `no meetings` is the published method. A scene "
      "whose "
      "only object has several connected components is played with one object per component. Every scene is played {} "
      "times, with partitions made in the poses of {} different frames; once beyond {} triangles. Recall is the mean "
      "over the plays, with Wilson's interval of 95 % over their colliding frames. `face pairs` is the recall of face "
      "pairs: the share "
      "of the intersecting face pairs that a setting reports in another play, when asked for all contacts. `read` is "
      "the mean number of positions that a frame reads, as a share of all vertices. In scenes "
      "of more than {} triangles the mode exact is the truth, and has no recall of its own.\n\n",
      plays, plays, most_triangles_for_all_plays, most_triangles_for_exhaustive_truth);
  text += table_of_scenes(rows);
  text += "\nOver the scenes in which something collides; precision over all scenes and plays:\n\n";
  text += table_of_settings(rows);
  if (!skipped.empty())
    text += fmt::format("\nSkipped, because no two of their objects can meet: {}.\n", fmt::join(skipped, ", "));
  if (!unplayed.empty()) text += fmt::format("\n{}\n", unplayed);
  return text;
}

}  // namespace

std::string run_modes(const Experiment_context& context) {
  const auto chosen = playable(chosen_sources(context, published_scenes), context.scenes);
  const auto& sources = chosen.sources;
  const auto settings = mode_settings();
  constexpr std::size_t steps = 1000;  // per scene
  std::set<std::string> taken;
  std::vector<Mode_figures> rows;
  nlohmann::ordered_json json;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    Scene scene = read_source(sources[s]);
    scene.name = untaken(scene.name, taken);
    for (auto& row : play(std::move(scene), settings, [&](double share) {
           context.progress(s * steps + static_cast<std::size_t>(share * steps), sources.size() * steps);
         })) {
      json.push_back(to_json(row));
      rows.push_back(std::move(row));
    }
  }
  write_json(context.out, "modes", json);
  return report(rows, chosen.skipped,
                context.scenes_given && context.only.empty() ? note_of_unplayed_subfolders(context.scenes) : "");
}

}  // namespace lodestone
