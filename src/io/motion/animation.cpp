// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/motion/animation.h"

#include <fmt/format.h>

#include "io/files/small_text.h"
#include "io/meshes/read_mesh_soup.h"
#include "io/motion/game_motion.h"
#include "io/motion/gltf_motion.h"
#include "lodestone/io/files/numbered_files.h"
#include "lodestone/io/motion/deformation.h"
#include "lodestone/io/motion/point_cache.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {
namespace {

namespace fs = std::filesystem;

Animation still(const fs::path& file) {
  Mesh_soup soup = read_mesh_soup(file);
  Animation result{.kind = "mesh", .vertices = soup.points.size(), .faces = corners_of(soup)};
  result.motion = deform(std::move(soup.points), {});
  result.motion.frames = 1;
  return result;
}

Animation gltf(const fs::path& file, const Animation_options& options) {
  auto scene = read_gltf_scene(file);
  auto soup = soup_of(*scene);
  Animation result{.kind = "gltf", .vertices = scene->vertices, .faces = corners_of(soup)};
  if (scene->animations.empty()) {
    result.motion = deform(std::move(soup.points), {});
    result.motion.frames = 1;
    return result;
  }
  result.frames_per_second = options.frames_per_second;
  result.motion = motion_of(std::move(scene), {options.frames_per_second, options.animation});
  return result;
}

Animation game_model(const fs::path& file) {
  auto model = read_game_model(file);
  return {.kind = model->is_md2 ? "md2" : "md3",
          .vertices = model->vertices,
          .faces = model->faces,
          .motion = motion_of(std::move(model))};
}

Animation sequence(const fs::path& pattern) {
  auto files = find_numbered_files(pattern);
  const auto first = read_mesh_soup(files.front());
  Animation result{.kind = "sequence", .vertices = first.points.size(), .faces = corners_of(first)};
  result.motion = read_mesh_sequence(std::move(files), result.vertices);
  return result;
}

Animation cache(const fs::path& file, const fs::path& mesh) {
  const auto header = read_point_cache_header(file);
  Animation result{.kind = header.format == Cache_format::pc2 ? "pc2" : "mdd",
                   .vertices = header.vertices,
                   .frames_per_second = header.frames_per_second};
  if (!mesh.empty()) {
    const auto soup = read_mesh_soup(mesh);
    result.vertices = soup.points.size();
    result.faces = corners_of(soup);
  }
  const auto read = header.format == Cache_format::pc2 ? read_point_cache : read_mdd_cache;
  result.motion = read(file, result.vertices);
  return result;
}

}  // namespace

Animation read_animation(const fs::path& input, const Animation_options& options) {
  const auto extension = lower_case(input.extension().string());
  if (extension == ".pc2" || extension == ".mdd") return cache(input, options.mesh);
  if (!options.mesh.empty())
    throw Bad_argument(fmt::format("{}: only a point cache needs a mesh beside it", input.string()));
  if (is_pattern(input)) return sequence(input);
  if (is_game_model(input)) return game_model(input);
  return is_gltf(input) ? gltf(input, options) : still(input);
}

}  // namespace lodestone
