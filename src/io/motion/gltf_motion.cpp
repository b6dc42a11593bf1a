// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/motion/gltf_motion.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "io/files/file_bytes.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {
namespace {

constexpr std::size_t most_sampled_frames = 1'000'000;

std::size_t number_of(const Gltf_scene& scene, const std::variant<std::size_t, std::string>& wanted) {
  const auto count = scene.animations.size();
  if (const auto* number = std::get_if<std::size_t>(&wanted)) {
    if (*number >= count)
      throw Bad_motion(
          fmt::format("{}: animation {} (counted from 0) is requested, the file has {}", scene.name, *number, count));
    return *number;
  }
  const auto& name = std::get<std::string>(wanted);
  for (std::size_t i = 0; i < count; ++i)
    if (scene.animations[i].name == name) return i;
  throw Bad_motion(fmt::format("{}: there is no animation {}", scene.name, in_quotes(name)));
}

std::size_t frames_of(const Gltf_scene& scene, const Gltf_animation& animation, double rate) {
  // The tolerance allows for an end that was rounded down to a float.
  const double frames = std::floor(animation.seconds * rate * (1 + 1e-6)) + 1;
  if (!(frames <= double{most_sampled_frames}))
    throw Bad_motion(fmt::format("{}: {} seconds at {} frames per second are more than {} frames", scene.name,
                                 animation.seconds, rate, most_sampled_frames));
  return static_cast<std::size_t>(frames);
}

}  // namespace

Motion motion_of(std::shared_ptr<const Gltf_scene> scene, const Gltf_motion_options& options) {
  const double rate = options.frames_per_second;
  if (!(rate > 0) || !std::isfinite(rate))
    throw Bad_argument(fmt::format("{} frames per second: expected a positive and finite number", rate));
  const auto number = number_of(*scene, options.animation);
  const auto frames = frames_of(*scene, scene->animations[number], rate);
  const auto pose = [scene = std::move(scene), number, frames, rate](std::size_t frame, std::span<Point> positions) {
    if (frame >= frames)
      throw Bad_motion(
          fmt::format("{}: frame {} (counted from 0) is requested, the animation has {}", scene->name, frame, frames));
    if (positions.size() != scene->vertices)
      throw Bad_motion(fmt::format("{}: positions of {} vertices are requested, the file has {}", scene->name,
                                   positions.size(), scene->vertices));
    // Key times are floats. With the same rounding, a frame at a key gets the key's exact value.
    const auto time = static_cast<float>(static_cast<double>(frame) / rate);
    pose_gltf(*scene, &scene->animations[number], time, positions);
  };
  return {.frames = frames, .pose = pose};
}

Motion read_gltf_motion(const std::filesystem::path& file, std::size_t vertices, const Gltf_motion_options& options) {
  std::shared_ptr<const Gltf_scene> scene;
  try {
    scene = read_gltf_scene(file);
  } catch (const Bad_mesh& error) {
    throw Bad_motion(error.what());
  }
  if (scene->vertices != vertices)
    throw Bad_motion(fmt::format("{}: the file has {} vertices, expected {}", scene->name, scene->vertices, vertices));
  return motion_of(std::move(scene), options);
}

}  // namespace lodestone
