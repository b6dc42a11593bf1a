// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/scenes/given_objects.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "io/files/json_reader.h"
#include "io/files/small_text.h"
#include "io/files/unique_names.h"
#include "io/scenes/face_count.h"
#include "io/scenes/object_of.h"
#include "io/scenes/scene_fields.h"
#include "io/scenes/shared_clock.h"
#include "lodestone/io/files/numbered_files.h"
#include "lodestone/io/meshes/mesh_file.h"
#include "lodestone/io/motion/computed_motion.h"
#include "lodestone/io/motion/deformation.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

constexpr std::string_view shape_prefix = "shape:", scene_mark = ".json#";

/// The file's name without folder, extension and the number of a pattern: `seq/cloth_###.obj` is `cloth`. Names are
/// shown in tables and messages, so control characters are replaced. So is what is no UTF-8, before names are made to
/// differ: JSON replaces it too, and names could become equal there.
std::string name_of(const std::filesystem::path& input) {
  const auto parts = mesh_and_cache(input);
  const auto file = parts ? parts->mesh : input;
  std::string name = detail::valid_utf8(printable(file.stem().string()));
  if (!is_pattern(file)) return name;
  std::erase_if(name, [](char c) { return c == '*' || c == '#'; });
  const auto last = name.find_last_not_of("_-. ");
  return last == name.npos ? "sequence" : name.substr(0, last + 1);
}

/// Whatever the input is.
Scene_object any_object(const std::filesystem::path& input, const Scene_options& options) {
  auto named = named_object(input, options);
  return named ? std::move(*named) : read_object(name_of(input), input, options.limits);
}

void hold_last_pose(Motion& motion) {
  if (motion.computed)
    motion.computed = [inner = std::move(motion.computed), last = motion.frames - 1](
                          std::span<const std::uint32_t> vertices) { return held(inner(vertices), last); };
  motion.pose = [inner = std::move(motion.pose), last = motion.frames - 1](
                    std::size_t frame, std::span<Point> positions) { inner(std::min(frame, last), positions); };
}

}  // namespace

Scene_object read_object(std::string name, const std::filesystem::path& input, const Mesh_file_options& limits) {
  auto animation = read_animation(input, {.limits = limits});
  if (animation.faces.empty())
    throw Bad_argument(
        fmt::format("{0}: a point cache has no faces: give its mesh beside it, as MESH+{0}", input.string()));
  std::vector<Point> points(animation.vertices);
  animation.motion.pose(0, points);
  auto file = mesh_of(points, animation.faces, input.string());
  Scene_object object = detail::object_of(std::move(file));
  object.name = std::move(name);
  object.file_face = std::move(animation.file_face);
  object.parts = std::move(animation.parts);
  object.ignored_extensions = std::move(animation.ignored_extensions);
  object.motion = std::move(animation.motion);
  object.files = std::move(animation.files);
  return object;
}

Scene_object shape_object(const std::string& shape) {
  const std::string given = printable(fmt::format("{}{}", shape_prefix, shape));
  const auto document =
      shape.starts_with('{') ? detail::parse_json_text(shape, given) : detail::Json{{shape, detail::Json::object()}};
  Scene_object object = detail::object_of(detail::read_shape({document, given}));
  object.name = document.is_object() && document.size() == 1 ? document.begin().key() : shape;
  object.motion = deform({object.mesh.points().begin(), object.mesh.points().end()}, {});
  return object;
}

Scene_object object_of_scene(const std::filesystem::path& file, const std::string& name, const Scene_options& options) {
  Scene scene = read_scene(file, options);
  const bool is_only = name.empty() && scene.objects.size() == 1;
  const auto found = is_only ? scene.objects.begin() : std::ranges::find(scene.objects, name, &Scene_object::name);
  if (found == scene.objects.end()) {
    std::vector<std::string> names;
    for (const auto& object : scene.objects) names.push_back(object.name);
    if (name.empty())
      throw Bad_argument(
          fmt::format("{0}: name one object of the scene, as {0}#NAME: {1}", file.string(), fmt::join(names, ", ")));
    throw Bad_argument(fmt::format("{}: the scene has no object {}; its objects are {}", file.string(), detail::quoted_name(name),
                                   fmt::join(names, ", ")));
  }
  auto& motion = found->motion;
  motion.frames = motion.frames == 0 ? scene.frames : std::min(motion.frames, scene.frames);
  motion.resampled = {};  // the scene has chosen its frames
  found->collision = {};
  found->files.push_back(file);
  return std::move(*found);
}

std::optional<Scene_object> named_object(const std::filesystem::path& input, const Scene_options& options) {
  const std::string text = input.string();
  if (text.starts_with(shape_prefix)) return shape_object(text.substr(shape_prefix.size()));
  const auto mark = lower_case(text).find(scene_mark);
  if (mark == text.npos) return std::nullopt;
  const auto name = mark + scene_mark.size();
  return object_of_scene(text.substr(0, name - 1), text.substr(name), options);
}

Scene scene_of(std::span<const std::filesystem::path> inputs, const Scene_options& options) {
  Scene scene;
  scene.name = "meshes";
  if (inputs.size() > options.max_objects)
    throw Bad_scene(fmt::format("{} inputs, where at most {} objects are allowed", inputs.size(), options.max_objects));
  Unique_names names;
  detail::Face_count faces(options.max_scene_faces);
  for (const auto& input : inputs) {
    auto& object = scene.objects.emplace_back(any_object(input, options));
    if (const auto fault = faces.add(object)) throw Bad_scene(fmt::format("{}: {}", input.string(), *fault));
    object.name = names.take(object.name);
  }
  share_clock(scene.objects);
  for (const auto& object : scene.objects) scene.frames = std::max(scene.frames, object.motion.frames);
  for (auto& object : scene.objects)
    if (object.motion.frames > 0 && object.motion.frames < scene.frames) hold_last_pose(object.motion);
  return scene;
}

Scene read_inputs(std::span<const std::filesystem::path> inputs, const Scene_options& options) {
  const auto is_scene = [](const std::filesystem::path& input) {
    return lower_case(input.extension().string()) == ".json";
  };
  const auto found = std::ranges::find_if(inputs, is_scene);
  if (found == inputs.end()) return scene_of(inputs, options);
  if (inputs.size() > 1) throw Bad_argument(found->string() + ": a scene must be the only input");
  return read_scene(*found, options);
}

Animation animation_of(const Scene_object& object, std::size_t frames) {
  Animation animation{.kind = "object", .vertices = object.file_vertices, .faces = detail::file_corners(object)};
  animation.file_face = object.file_face;
  animation.parts = object.parts;
  animation.ignored_extensions = object.ignored_extensions;
  animation.motion = object.motion;
  animation.frames_per_second = object.motion.frames_per_second;
  if (animation.motion.frames == 0) animation.motion.frames = frames;
  animation.files = object.files;
  return animation;
}

}  // namespace lodestone
