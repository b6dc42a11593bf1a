// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/motion/animation.h"

#include <fmt/format.h>

#include <numeric>
#include <system_error>
#include <utility>

#include "io/files/small_text.h"
#include "io/meshes/read_mesh_soup.h"
#include "io/meshes/triangulated_soup.h"
#include "io/motion/check_frames.h"
#include "io/motion/game_motion.h"
#include "io/motion/gltf_motion.h"
#include "io/motion/keep_joined.h"
#include "lodestone/io/files/numbered_files.h"
#include "lodestone/io/motion/deformation.h"
#include "lodestone/io/motion/point_cache.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {
namespace {

namespace fs = std::filesystem;

void set_surface(Animation& animation, Mesh_soup soup) {
  animation.vertices = soup.points.size();
  animation.faces = corners_of(soup);
  animation.file_face = std::move(soup.file_face);
  animation.parts = std::move(soup.parts);
  animation.not_read = std::move(soup.not_read);
  animation.ignored_extensions = std::move(soup.ignored_extensions);
}

/// The motion of vertices that stay where they are, for one frame.
Motion rest(std::vector<Point> points) {
  Motion motion = deform(std::move(points), {});
  motion.frames = 1;
  return motion;
}

Animation still(const fs::path& file, const Mesh_file_options& limits) {
  Animation result{.kind = "mesh", .files = {file}};
  Mesh_soup soup = read_mesh_soup(file, limits);
  result.motion = rest(soup.points);
  set_surface(result, std::move(soup));
  return result;
}

Animation gltf(const fs::path& file, const Animation_options& options) {
  auto scene = read_gltf_scene(file, options.limits);
  Animation result{.kind = "gltf", .files = scene->files};
  auto soup = triangulated(soup_of(scene));
  if (scene->animations.empty()) {
    result.motion = rest(soup.points);
    result.motion.joined = soup.joined;
  } else {
    result.motion = motion_of(
        std::move(scene),
        {.frames_per_second = options.frames_per_second, .animation = options.animation, .limits = options.limits});
    result.frames_per_second = result.motion.frames_per_second;
  }
  set_surface(result, std::move(soup));
  return result;
}

Animation game_model(const fs::path& file, const Mesh_file_options& limits) {
  auto model = read_game_model(file, limits);
  Animation result{.kind = model->is_md2 ? "md2" : "md3",
                   .vertices = model->vertices,
                   .faces = model->faces,
                   .not_read = {"texture coordinates"},
                   .files = {file}};
  result.file_face.resize(result.faces.size());
  std::iota(result.file_face.begin(), result.file_face.end(), 0U);
  result.motion = motion_of(std::move(model));
  return result;
}

Animation sequence(const fs::path& pattern, const Mesh_file_options& limits) {
  auto files = find_numbered_files(pattern);
  Animation result{.kind = "sequence", .files = files};
  Mesh_soup soup = read_mesh_soup(files.front(), limits);
  Joined_vertices joined = std::move(soup.joined);
  set_surface(result, std::move(soup));
  result.motion = read_mesh_sequence(std::move(files), result.vertices, limits);
  result.motion.joined = std::move(joined);
  return result;
}

Animation cache(const fs::path& file, const fs::path& mesh, const Mesh_file_options& limits) {
  const auto header = read_point_cache_header(file);
  Animation result{.kind = header.format == Cache_format::pc2 ? "pc2" : "mdd",
                   .vertices = header.vertices,
                   .frames_per_second = header.frames_per_second,
                   .files = {file}};
  Joined_vertices joined;
  if (!mesh.empty()) {
    Mesh_soup soup = read_mesh_soup(mesh, limits);
    joined = std::move(soup.joined);
    set_surface(result, std::move(soup));
    result.files.push_back(mesh);
  }
  const auto read = header.format == Cache_format::pc2 ? read_point_cache : read_mdd_cache;
  result.motion = keep_joined(read(file, result.vertices), joined, mesh);
  result.motion.joined = std::move(joined);
  return result;
}

bool is_cache(const fs::path& file) {
  const auto extension = lower_case(file.extension().string());
  return extension == ".pc2" || extension == ".mdd";
}

/// The + of `MESH+CACHE`. Names of folders and files may hold others: the cache begins behind it, where a file is. The
/// last one if no file is found.
std::size_t find_plus(const std::string& text) {
  const auto last = text.rfind('+');
  std::error_code ignored;
  for (auto plus = last; plus != 0 && plus != text.npos; plus = text.rfind('+', plus - 1))
    if (fs::is_regular_file(text.substr(plus + 1), ignored)) return plus;
  return last;
}

}  // namespace

std::optional<Mesh_and_cache> mesh_and_cache(const fs::path& input) {
  const std::string text = input.string();
  std::error_code ignored;
  if (!is_cache(input) || fs::exists(input, ignored)) return std::nullopt;
  const auto plus = find_plus(text);
  if (plus == 0 || plus == text.npos) return std::nullopt;
  return Mesh_and_cache{.mesh = text.substr(0, plus), .cache = text.substr(plus + 1)};
}

namespace {

Animation read_whatever(const fs::path& input, const Animation_options& options) {
  if (const auto parts = mesh_and_cache(input)) {
    if (options.mesh.empty()) return cache(parts->cache, parts->mesh, options.limits);
    throw Bad_argument(fmt::format("{}: names its mesh already, {}: no other is needed beside it", input.string(),
                                   parts->mesh.string()));
  }
  if (is_cache(input)) return cache(input, options.mesh, options.limits);
  if (!options.mesh.empty())
    throw Bad_argument(fmt::format("{}: only a point cache needs a mesh beside it", input.string()));
  std::error_code ignored;
  if (is_pattern(input) && !fs::is_regular_file(input, ignored)) return sequence(input, options.limits);
  if (is_game_model(input)) return game_model(input, options.limits);
  return is_gltf(input) ? gltf(input, options) : still(input, options.limits);
}

}  // namespace

Animation read_animation(const fs::path& input, const Animation_options& options) {
  Animation animation = read_whatever(input, options);
  check_frames(input.string(), animation.motion.frames, options.limits);
  return animation;
}

}  // namespace lodestone
