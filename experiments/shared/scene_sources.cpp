// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/scene_sources.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <ranges>
#include <string_view>

#include "io/files/small_text.h"
#include "lodestone/io/scenes/given_objects.h"
#include "lodestone/io/scenes/separated_objects.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

namespace fs = std::filesystem;

/// @throws Bad_scene  the folder cannot be read
std::vector<fs::path> sorted_content(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> content;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    content.push_back(entry->path());
  if (error) throw Bad_scene(fmt::format("{}: {}", folder.string(), error.message()));
  std::ranges::sort(content);
  return content;
}

bool is_scene_file(const fs::path& path) { return path.extension() == ".json" && is_regular_file(path); }

fs::path cache_of(const fs::path& mesh) { return fs::path(mesh).replace_extension(".pc2"); }

bool is_mesh(const fs::path& path) { return path.extension() == ".off" && is_regular_file(path); }

bool moves(const fs::path& path) { return is_mesh(path) && is_regular_file(cache_of(path)); }

/// Whether a file has the name of a mesh or of motion, in any format that the library reads.
bool is_like_a_mesh(const fs::path& path) {
  constexpr std::array<std::string_view, 10> extensions{".off",  ".obj", ".ply", ".stl", ".glb",
                                                        ".gltf", ".md2", ".md3", ".pc2", ".mdd"};
  return std::ranges::find(extensions, lower_case(path.extension().string())) != extensions.end();
}

bool holds_real_motion(const fs::path& folder) {
  if (!is_directory(folder)) return false;
  const auto content = sorted_content(folder);
  return std::ranges::none_of(content, is_scene_file) && std::ranges::any_of(content, moves);
}

std::vector<std::string> unplayed_subfolders(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& path : sorted_content(folder))
    if (is_directory(path) && !holds_real_motion(path) && std::ranges::any_of(sorted_content(path), is_like_a_mesh))
      names.push_back(name_of_source(path));
  return names;
}

/// The meshes of a folder as inputs: `MESH+CACHE`, or `MESH` if it does not move.
std::vector<fs::path> inputs_of(const fs::path& folder) {
  std::vector<fs::path> inputs;
  for (const auto& path : sorted_content(folder))
    if (is_mesh(path)) inputs.push_back(moves(path) ? fs::path(path.string() + '+' + cache_of(path).string()) : path);
  return inputs;
}

Scene read_folder(const fs::path& folder) {
  Scene scene = scene_of(inputs_of(folder));
  scene.name = name_of_source(folder);
  return scene;
}

/// Makes an object of each component, where the only object may collide with itself.
void separate_if_alone(Scene& scene) {
  if (scene.objects.size() == 1 && !scene.ignores({0, 0})) separate(scene, Separate::components);
}

}  // namespace

std::vector<fs::path> scene_sources(const fs::path& folder) {
  std::vector<fs::path> sources;
  for (const auto& path : sorted_content(folder))
    if (is_scene_file(path) || holds_real_motion(path)) sources.push_back(path);
  if (sources.empty()) {
    const auto unplayed = note_of_unplayed_subfolders(folder);
    throw Bad_scene(fmt::format(
        "{}: nothing to play: expected scene files NAME.json, or subfolders with meshes NAME.off and their point "
        "caches NAME.pc2{}{}",
        folder.string(), unplayed.empty() ? "" : ". ", unplayed));
  }
  std::ranges::stable_sort(sources, {}, name_of_source);
  return sources;
}

std::string note_of_unplayed_subfolders(const fs::path& folder) {
  const auto names = unplayed_subfolders(folder);
  if (names.empty()) return {};
  return fmt::format(
      "Not played: the meshes in {}. A subfolder is played if it has a mesh NAME.off with its point cache NAME.pc2, "
      "and no scene file.",
      fmt::join(names, ", "));
}

std::vector<fs::path> named_sources(const fs::path& folder, std::span<const std::string> names) {
  const auto all = scene_sources(folder);
  std::vector<fs::path> sources;
  for (const auto& name : names) {
    const auto found = std::ranges::find(all, name, name_of_source);
    if (found == all.end())
      throw Bad_scene(fmt::format("{}: there is no scene {}; the scenes are {}", folder.string(), printable(name),
                                  fmt::join(all | std::views::transform(name_of_source), ", ")));
    sources.push_back(*found);
  }
  return sources;
}

std::vector<fs::path> chosen_sources(const Experiment_context& context, std::span<const std::string> otherwise) {
  if (!context.only.empty()) return named_sources(context.scenes, context.only);
  if (context.scenes_given) return scene_sources(context.scenes);
  std::vector<fs::path> sources;
  for (const auto& name : otherwise) sources.push_back(context.scenes / (name + ".json"));
  return sources;
}

std::string untaken(const std::string& wanted, std::set<std::string>& taken) {
  std::string name = wanted;
  for (std::size_t use = 2; !taken.insert(name).second; ++use) name = fmt::format("{}_{}", wanted, use);
  return name;
}

std::string name_of_source(const fs::path& source) {
  return printable((is_directory(source) ? source.filename() : source.stem()).string());
}

Scene read_source(const fs::path& source) {
  Scene scene = is_directory(source) ? read_folder(source) : read_scene(source);
  separate_if_alone(scene);
  return scene;
}

}  // namespace lodestone
