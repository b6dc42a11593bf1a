// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/scene_sources.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <ranges>
#include <utility>

#include "io/files/small_text.h"
#include "lodestone/io/scenes/given_objects.h"
#include "lodestone/mesh/errors.h"
#include "shared/component_objects.h"

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

/// The meshes of a folder with their point caches, as inputs `MESH+CACHE`.
std::vector<fs::path> moving_meshes(const fs::path& folder) {
  std::vector<fs::path> inputs;
  for (const auto& mesh : sorted_content(folder)) {
    const auto cache = fs::path(mesh).replace_extension(".pc2");
    if (mesh.extension() == ".off" && is_regular_file(cache)) inputs.push_back(mesh.string() + '+' + cache.string());
  }
  return inputs;
}

bool holds_real_motion(const fs::path& folder) {
  return is_directory(folder) && std::ranges::none_of(sorted_content(folder), is_scene_file) &&
         !moving_meshes(folder).empty();
}

Scene read_folder(const fs::path& folder) {
  Scene scene = scene_of(moving_meshes(folder));
  scene.name = name_of_source(folder);
  return scene;
}

/// Makes an object of each component, where the only object may collide with itself.
void separate_components(Scene& scene) {
  if (scene.objects.size() != 1 || scene.ignores({0, 0})) return;
  auto parts = component_objects(scene.objects[0]);
  if (parts.size() > 1) scene.objects = std::move(parts);
}

}  // namespace

std::vector<fs::path> scene_sources(const fs::path& folder) {
  std::vector<fs::path> sources;
  for (const auto& path : sorted_content(folder))
    if (is_scene_file(path) || holds_real_motion(path)) sources.push_back(path);
  if (sources.empty())
    throw Bad_scene(fmt::format(
        "{}: nothing to play: expected scene files NAME.json, or subfolders with meshes NAME.off and their point "
        "caches NAME.pc2",
        folder.string()));
  std::ranges::stable_sort(sources, {}, name_of_source);
  return sources;
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

std::string name_of_source(const fs::path& source) {
  return printable((is_directory(source) ? source.filename() : source.stem()).string());
}

Scene read_source(const fs::path& source) {
  Scene scene = is_directory(source) ? read_folder(source) : read_scene(source);
  separate_components(scene);
  return scene;
}

}  // namespace lodestone
