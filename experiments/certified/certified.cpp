// SPDX-License-Identifier: GPL-3.0-or-later
// What mode certified saves where objects say how they move: characters with joints and morph targets, and promises.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "certified/certified_report.h"
#include "certified/made_character.h"
#include "lodestone/io/files/made_folders.h"
#include "lodestone/mesh/errors.h"
#include "program/installed_files.h"
#include "program/measurement.h"
#include "shared/experiment.h"
#include "shared/race_figures.h"

namespace lodestone {

namespace {

namespace fs = std::filesystem;

/// Triangles of both characters together.
constexpr std::size_t published_sizes[] = {20'000, 100'000, 500'000, 2'000'000, 4'000'000};

/// Two of the project's own characters.
struct Own_scene {
  const char *name, *first, *second;
  double aside = 0;
};
/// Where both stretch out their right hands, these meet if the second stands aside.
constexpr Own_scene own_scenes[] = {{"hands", "hand", "hand"},
                                    {"hand_face", "hand", "face"},
                                    {"faces", "face", "face"},
                                    {"bodies", "body", "body", -0.74}};

/// A scene that is made when its turn comes.
struct Scene_source {
  std::string name;
  std::function<Character_scene()> make;
};

Character own_character(const std::string& name) {
  return *read_character(installed_files() / "characters" / (name + ".glb"));
}

std::vector<Scene_source> own_sources() {
  std::vector<Scene_source> sources;
  for (const auto& own : own_scenes)
    sources.push_back({own.name, [own] {
                         return touching(own.name, own_character(own.first), own_character(own.second), own.aside);
                       }});
  sources.push_back({"knots", knots_through_each_other});
  return sources;
}

/// Two of each character that a folder holds.
struct Given_sources {
  std::vector<Scene_source> sources;
  std::vector<std::string> skipped;  ///< files in which nothing moves
};

Given_sources given_sources(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".glb" || entry.path().extension() == ".gltf") files.push_back(entry.path());
  std::ranges::sort(files);
  Given_sources given;
  for (const auto& file : files) {
    const auto character = read_character(file);
    if (!character)
      given.skipped.push_back(file.filename().string());
    else
      given.sources.push_back(
          {character->name, [character = *character] { return touching(character.name, character, character); }});
  }
  return given;
}

struct Plan {
  std::vector<Scene_source> characters;
  std::vector<std::size_t> sizes;
  std::vector<std::string> skipped;
  std::optional<Experiment_context> promises;  ///< of the scenes with promises; none: they are left out
};

std::optional<std::size_t> number_of(const std::string& text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number == 0) return std::nullopt;
  return number;
}

/// `--only` takes names of character scenes, numbers of triangles and names of scene files.
Plan plan_of(const Experiment_context& context) {
  Plan plan;
  auto all = own_sources();
  if (context.scenes_given) {
    auto given = given_sources(context.scenes);
    std::ranges::move(given.sources, std::back_inserter(all));
    plan.skipped = std::move(given.skipped);
  }
  std::vector<std::string> scenes;
  for (const auto& name : context.only) {
    const auto found = std::ranges::find(all, name, &Scene_source::name);
    if (const auto size = number_of(name))
      plan.sizes.push_back(*size);
    else if (found != all.end())
      plan.characters.push_back(*found);
    else
      scenes.push_back(name);
  }
  if (plan.characters.empty() && scenes.empty()) plan.characters = all;
  if (plan.sizes.empty()) plan.sizes.assign(std::begin(published_sizes), std::end(published_sizes));
  if (!scenes.empty() || (context.only.empty() && !context.scenes_given)) {
    plan.promises = context;
    plan.promises->only = scenes;
    scene_names(*plan.promises);  // an unknown name must not end the experiment after hours
  }
  return plan;
}

std::string write_characters(const fs::path& folder) {
  Made_folders folders(folder);
  std::string report;
  for (const auto& character : made_characters()) {
    const fs::path file = folder / (character.name + ".glb");
    write_glb(character, file);
    report += fmt::format("{}\n", file.string());
  }
  return report;
}

}  // namespace

std::string run_certified(const Experiment_context& context) {
  if (!context.write_meshes.empty()) return write_characters(context.write_meshes);
  const Plan plan = plan_of(context);
  constexpr std::size_t steps = 1000;  // per part of the plan
  const std::size_t parts = plan.characters.size() * plan.sizes.size() + (plan.promises ? 1 : 0);
  std::size_t done = 0;
  std::string report;
  nlohmann::ordered_json json;
  std::vector<Character_figures> figures;
  for (const auto& source : plan.characters) {
    context.progress(done * steps, parts * steps);
    const Character_scene coarse = source.make();
    for (const std::size_t triangles : plan.sizes) {
      Character_scene scene = with_triangles(coarse, triangles / 2);
      figures.push_back(race(scene, {}, [&](double share) {
        context.progress(done * steps + static_cast<std::size_t>(share * steps), parts * steps);
      }));
      figures.back().size = triangles;
      ++done;
      report += section(figures.back()) + "\n";
      json["characters"].push_back(to_json(figures.back()));
    }
  }
  report += summary(figures);
  if (plan.promises) {
    Experiment_context inner = *plan.promises;
    inner.progress = [&](std::size_t at, std::size_t of) {
      context.progress(done * steps + at * steps / std::max<std::size_t>(of, 1), parts * steps);
    };
    std::vector<Promise_figures> promised;
    for_each_scene(inner, [&](Scene& scene, const Scene_progress& progress) {
      promised.push_back(race_promises(scene, progress));
      json["promises"].push_back(to_json(promised.back()));
    });
    report += (report.empty() ? "" : "\n") + table(promised);
  }
  if (!plan.skipped.empty())
    report += fmt::format("\nSkipped, because nothing moves: {}.\n", fmt::join(plan.skipped, ", "));
  write_json(context.out, "certified", json);
  return report;
}

}  // namespace lodestone
