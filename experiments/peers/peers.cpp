// SPDX-License-Identifier: GPL-3.0-or-later
// Other collision libraries on the same frames: time, memory, and right and wrong answers.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lodestone/io/results/text_table.h"
#include "peers/peer.h"
#include "peers/peer_entries.h"
#include "shared/experiment.h"
#include "shared/measured_run.h"
#include "shared/race_figures.h"

namespace lodestone {

namespace {

const char* const nothing = "-";

std::string answers_text(const Entry_figures& figures) {
  if (!figures.entry.answers) return nothing;
  if (figures.gave_up) return "gave up";
  if (figures.missed + figures.invented + figures.wrong_later == 0) return "0";
  if (figures.wrong_later > 0) return fmt::format("in {} frames of later passes", figures.wrong_later);
  return fmt::format("{} missed, {} false", figures.missed, figures.invented);
}

std::string sets_text(const Entry_figures& figures) {
  if (!figures.entry.reports_pairs) return nothing;
  if (figures.gave_up) return "gave up";
  if (figures.wrong_sets == 0) return "0";
  return fmt::format("{} ({} missing, {} false)", figures.wrong_sets, figures.missing_pairs, figures.false_pairs);
}

std::string table(const Scene_figures& scene) {
  Text_table table({"method", "volume", "build (ms)", "memory (MiB)", "update (ms)", "yes/no (ms)", "p95",
                    "update + yes/no (ms)", "all pairs (ms)", "p95", "update + all pairs (ms)", "wrong yes/no",
                    "wrong sets", "passes"});
  for (const auto& f : scene.entries) {
    const auto cell = [&](bool shown, double Frame_seconds::*figure) {
      return shown ? milliseconds(median_of(f, figure)) : nothing;
    };
    const auto high = [&](bool shown, double Frame_seconds::*figure) {
      return shown ? milliseconds(percentile_95(values(f, figure))) : nothing;
    };
    const bool any = f.entry.answers && !f.gave_up, all = f.entry.reports_pairs && !f.gave_up;
    table.add({f.entry.name(), f.entry.volume, milliseconds(f.build_seconds),
               fmt::format("{:.1f}", static_cast<double>(f.bytes) / (1 << 20)), cell(true, &Frame_seconds::update),
               cell(any, &Frame_seconds::any), high(any, &Frame_seconds::any),
               cell(any, &Frame_seconds::update_and_any), cell(all, &Frame_seconds::all),
               high(all, &Frame_seconds::all), cell(all, &Frame_seconds::update_and_all), answers_text(f), sets_text(f),
               std::to_string(f.frames.empty() ? 0 : f.passes / f.frames.size())});
  }
  return table.text();
}

/// Names the rows that do not cover all frames.
std::string notes(const Scene_figures& scene) {
  std::string text;
  for (const auto& f : scene.entries) {
    const auto name = fmt::format("- {} ({})", f.entry.name(), f.entry.volume);
    if (f.gave_up)
      text += fmt::format(
          "{} gave up a query after {} s, in frame {}; its wrong answers are counted up to the frame before.\n", name,
          patience, scene.sampled[f.frames.size() - 1]);
    else if (f.left_early)
      text += fmt::format("{} ran out of time before it had answered all {} frames.\n", name, scene.sampled.size());
  }
  return text;
}

/// The fastest with one thread among the entries that meet a condition; null if there is none.
template <class Condition>
const Entry_figures* fastest(const Scene_figures& scene, double Frame_seconds::*figure, const Condition& condition) {
  const Entry_figures* best = nullptr;
  for (const auto& f : scene.entries)
    if (f.entry.threads == 1 && condition(f) && (best == nullptr || median_of(f, figure) < median_of(*best, figure)))
      best = &f;
  return best;
}

bool is_library(const Entry_figures& f) {
  return f.entry.library != "Lodestone" && f.entry.library != "CGAL" && f.entry.answers;
}

/// One line per question: the fastest right library, and how Lodestone compares with it, if it has a right row.
std::string ratios(const Scene_figures& scene) {
  using Figure = double Frame_seconds::*;
  const auto named = [](std::string_view library, std::string_view method) {
    return
        [=](const Entry_figures& f) { return f.entry.library == library && f.entry.method == method && !f.left_early; };
  };
  std::string text;
  const auto* bound = fastest(scene, &Frame_seconds::update, named("bound", "read every vertex once"));
  const auto* culled = fastest(scene, &Frame_seconds::any, named("CGAL", "box_intersection_d, overlap only"));
  for (const auto& [figure, what] :
       {std::pair<Figure, const char*>(&Frame_seconds::update_and_any, "update + yes/no"),
        std::pair<Figure, const char*>(&Frame_seconds::update_and_all, "update + all pairs")}) {
    const bool all = figure == &Frame_seconds::update_and_all;
    const auto is_right = [all](const Entry_figures& f) { return all ? f.all_is_right() : f.any_is_right(); };
    const auto is_own = named("Lodestone", "exact");
    const auto* own = fastest(scene, figure, [&](const Entry_figures& f) { return is_own(f) && is_right(f); });
    const auto* library = fastest(scene, figure, [&](const Entry_figures& f) { return is_library(f) && is_right(f); });
    if (library != nullptr)
      text += fmt::format("- {}: the fastest of FCL, Embree, Bullet and ODE that is right in every frame is {} ({})",
                          what, library->entry.name(), library->entry.volume);
    else
      text += fmt::format("- {}: none of FCL, Embree, Bullet and ODE is right in every frame", what);
    if (own == nullptr) {
      text += ".\n";
      continue;
    }
    const double seconds = median_of(*own, figure);
    if (library != nullptr)
      text += fmt::format("; Lodestone takes 1/{:.2f} of its time", median_of(*library, figure) / seconds);
    if (culled != nullptr)
      text += fmt::format("; 1/{:.2f} of the time of `box_intersection_d, overlap only`",
                          median_of(*culled, figure) / seconds);
    if (bound != nullptr)
      text += fmt::format("; {:.2f} times the bound", seconds / median_of(*bound, &Frame_seconds::update));
    text += ".\n";
  }
  return text;
}

std::string section(const Scene_figures& scene) {
  return scene_heading(scene) + table(scene) + "\n" + notes(scene) + ratios(scene);
}

nlohmann::ordered_json to_json(const Entry_figures& f) {
  const auto figure = [&](double Frame_seconds::*of) -> nlohmann::ordered_json {
    return {{"median_ms", 1e3 * median_of(f, of)},
            {"p95_ms", 1e3 * percentile_95(values(f, of))},
            {"frames_s", values(f, of)}};
  };
  nlohmann::ordered_json json{{"library", f.entry.library},
                              {"method", f.entry.method},
                              {"volume", f.entry.volume},
                              {"threads", f.entry.threads},
                              {"build_s", f.build_seconds},
                              {"heap_bytes", f.bytes},
                              {"passes", f.passes},
                              {"wrong_later", f.wrong_later},
                              {"gave_up", f.gave_up},
                              {"left_early", f.left_early},
                              {"update", figure(&Frame_seconds::update)}};
  if (f.entry.answers) {
    json["yes_no"] = figure(&Frame_seconds::any);
    json["update_and_yes_no"] = figure(&Frame_seconds::update_and_any);
    json["missed"] = f.missed;
    json["invented"] = f.invented;
  }
  if (f.entry.reports_pairs) {
    json["all_pairs"] = figure(&Frame_seconds::all);
    json["update_and_all_pairs"] = figure(&Frame_seconds::update_and_all);
    json["wrong_sets"] = f.wrong_sets;
    json["missing_pairs"] = f.missing_pairs;
    json["false_pairs"] = f.false_pairs;
  }
  return json;
}

nlohmann::ordered_json to_json(const Scene_figures& scene) {
  auto json = scene_figures_json(scene);
  for (const auto& figures : scene.entries) json["entries"].push_back(to_json(figures));
  return json;
}

/// A pass over a small scene takes a millisecond and is easily disturbed, so there are more of them.
std::size_t passes(const Scene& scene) {
  std::size_t triangles = 0;
  for (const auto& object : scene.objects) triangles += object.mesh.number_of_faces();
  return triangles < 20'000 ? 20 : 5;
}

}  // namespace

std::string run_peers(const Experiment_context& context) {
  const auto entries = all_entries();
  std::string report;
  nlohmann::ordered_json json;
  for_each_scene(context, [&](Scene& scene, const Scene_progress& progress) {
    const auto figures = measure_race(scene, entries, {.passes = passes(scene)}, progress);
    if (!report.empty()) report += "\n";
    report += section(figures);
    json.push_back(to_json(figures));
  });
  write_json(context.out, "peers", json);
  return report;
}

}  // namespace lodestone
