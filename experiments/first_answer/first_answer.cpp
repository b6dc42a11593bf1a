// SPDX-License-Identifier: GPL-3.0-or-later
// What the first answer about two meshes costs, and from which frame on it pays to build something.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "first_answer/first_measure.h"
#include "lodestone/io/results/text_table.h"
#include "lodestone/mesh/errors.h"
#include "program/measurement.h"
#include "shared/experiment.h"
#include "shared/race_figures.h"

namespace lodestone {

namespace {

/// A contestant whose first answer took longer is left out of larger scenes.
constexpr double most_seconds = 10;

struct Chosen {
  std::vector<Once_kind> kinds;
  std::vector<Once_size> sizes;
};

/// @throws Bad_argument  a name that is neither that of a scene nor a number of triangles
Chosen chosen(const std::vector<std::string>& only) {
  Chosen chosen;
  for (const auto& name : only) {
    const auto kind = std::ranges::find(once_kinds(), name, &Once_kind::name);
    const auto size =
        std::ranges::find(once_sizes(), name, [](const auto& s) { return std::to_string(s.triangles()); });
    if (kind != once_kinds().end())
      chosen.kinds.push_back(*kind);
    else if (size != once_sizes().end())
      chosen.sizes.push_back(*size);
    else
      throw Bad_argument(fmt::format(
          "--only: '{}' is none of far, beside, touching, tenth, deep, inside, and none of 1280, 5120, 20480, "
          "50000, 499280, 1997120 triangles",
          name));
  }
  if (chosen.kinds.empty()) chosen.kinds = once_kinds();
  if (chosen.sizes.empty()) std::ranges::copy_if(once_sizes(), std::back_inserter(chosen.sizes), &Once_size::published);
  chosen.sizes = in_order(std::move(chosen.sizes));  // what is too slow at one size is left out at larger ones
  return chosen;
}

std::string note_of(const Once_figures& f) {
  if (f.left_out) return "too slow in a smaller scene";
  if (f.gave_up) return "gave up";
  return f.right ? "" : "wrong";
}

std::string section(const Once_scene& scene, std::span<const Once_figures> figures) {
  Text_table table({"", "yes/no at once (ms)", "10 frames", "100 frames", "pays from frame", "all pairs at once (ms)",
                    "10 frames", "100 frames", "pays from frame", "peak (MB)", ""});
  const Once_figures& calls = figures.front();
  const auto cells = [](const std::optional<Once_times>& times, const std::optional<Once_times>& of_calls) {
    if (!times) return std::vector<std::string>(4, "-");
    const auto frame = of_calls ? pays_from(*times, *of_calls) : std::nullopt;
    const std::string never = of_calls ? "never" : "-";
    return std::vector<std::string>{milliseconds(times->first), milliseconds(times->of_frames(10)),
                                    milliseconds(times->of_frames(100)), frame ? std::to_string(*frame) : never};
  };
  for (const auto& f : figures) {
    std::vector<std::string> row{f.contestant->name()};
    for (const auto& cell : cells(f.any, calls.any)) row.push_back(cell);
    for (const auto& cell : cells(f.all, calls.all)) row.push_back(cell);
    row.push_back(f.left_out ? "-" : fmt::format("{:.1f}", 1e-6 * static_cast<double>(f.peak_bytes)));
    row.push_back(note_of(f));
    table.add(row);
  }
  return fmt::format("## {}, {} triangles each\n\n{}", scene.name, scene.triangles, table.text());
}

nlohmann::ordered_json to_json(const Once_scene& scene, std::span<const Once_figures> figures) {
  nlohmann::ordered_json json{{"scene", scene.name}, {"triangles", scene.triangles}, {"entries", nullptr}};
  const auto times = [](const std::optional<Once_times>& t) -> nlohmann::ordered_json {
    if (!t) return nullptr;
    return {{"first_milliseconds", 1e3 * t->first}, {"frame_milliseconds", 1e3 * t->frame}};
  };
  for (const auto& f : figures)
    json["entries"].push_back({{"library", f.contestant->library},
                               {"method", f.contestant->method},
                               {"yes_no", times(f.any)},
                               {"all_pairs", times(f.all)},
                               {"peak_bytes", f.peak_bytes},
                               {"right", f.right},
                               {"gave_up", f.gave_up},
                               {"left_out", f.left_out}});
  return json;
}

}  // namespace

std::string run_first_answer(const Experiment_context& context) {
  const auto [kinds, sizes] = chosen(context.only);
  const auto all = once_contestants();
  std::string report;
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  std::size_t done = 0;
  for (const auto& kind : kinds) {
    std::vector<bool> left_out(all.size(), false);
    for (const auto& size : sizes) {
      context.progress(done++, kinds.size() * sizes.size());
      Once_scene scene = make_once_scene(kind, size);
      const auto figures = measure_first_answers(scene, all, left_out);
      for (std::size_t i = 0; i < all.size(); ++i) {
        const auto slow = [](const auto& times) { return times && times->first > most_seconds; };
        if (slow(figures[i].any) || slow(figures[i].all)) left_out[i] = true;
      }
      if (!report.empty()) report += "\n";
      report += section(scene, figures);
      json.push_back(to_json(scene, figures));
    }
  }
  write_json(context.out, "first_answer", json);
  return report;
}

}  // namespace lodestone
