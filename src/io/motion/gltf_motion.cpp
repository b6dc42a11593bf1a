// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/motion/gltf_motion.h"
#include "io/motion/rounded_rate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "io/files/file_bytes.h"
#include "io/gltf/gltf_points.h"
#include "io/motion/animation_names.h"
#include "io/motion/check_frames.h"
#include "lodestone/bounds/skin_bound.h"
#include "lodestone/io/motion/computed_motion.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {
namespace {

std::vector<std::string> names_in(const Gltf_scene& scene) {
  std::vector<std::string> names;
  for (const auto& animation : scene.animations) names.push_back(animation.name);
  return names;
}

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
  throw Bad_motion(fmt::format("{}: there is no animation {}, the file has {}", scene.name, detail::quoted_name(name),
                               count > 0 ? animation_list(names_in(scene)) : "none"));
}

/// Whether nothing moves, since no curve has a second key.
bool is_still(const Gltf_animation& animation) {
  return std::ranges::all_of(animation.curves, [](const auto& curve) { return curve.times.size() == 1; });
}

/// Keys that are no farther apart are one: of several curves the same key can differ by how its time was rounded. Far
/// less than the keys of one curve are apart in the mean, however fast they follow each other.
double rounding_of_keys(const Gltf_animation& animation) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& curve : animation.curves)
    if (const std::size_t keys = curve.times.size(); keys > 1)
      least = std::min<double>(least, (curve.times.back() - curve.times.front()) / static_cast<double>(keys - 1));
  return std::min(std::max(1e-5, 4 * rounding_of_times(animation.seconds)), 0.1 * least);
}

/// Keys that follow each other at equal distances.
struct Uniform_keys {
  std::vector<double> times = {};  ///< of all curves; empty: there are none such
  double rate = 0;                 ///< per second
};

Uniform_keys uniform_keys(const Gltf_animation& animation) {
  if (is_still(animation)) return {};
  std::vector<double> all;
  for (const auto& curve : animation.curves) all.insert(all.end(), curve.times.begin(), curve.times.end());
  std::ranges::sort(all);
  const double rounding = rounding_of_keys(animation);
  std::vector<double> times;
  std::ranges::unique_copy(all, std::back_inserter(times),
                           [&](double one, double other) { return other - one <= rounding; });
  if (times.size() < 2) return {};
  const auto steps = static_cast<double>(times.size() - 1);
  const double step = (times.back() - times.front()) / steps, of_floats = rounding_of_times(animation.seconds);
  // Some exporters add up rounded steps: over thousands of them, times drift by whole frames. So neighbours are
  // compared, and the mean may be off by a thousandth.
  constexpr double drift = 1 + 1e-3;
  if (step - of_floats / steps > drift / fewest_keys_per_second) return {};
  // What the project writes has steps that floats have changed by up to a quarter. If the mean is a quarter too small,
  // that is a third of it.
  const double most = std::max(0.01 * step, std::min(2 * of_floats, 0.35 * step));
  for (std::size_t i = 1; i < times.size(); ++i)
    if (std::abs(times[i] - times[i - 1] - step) > most) return {};
  // The latest of those that are one: at the others, a curve with steps would still have the value before.
  for (double& time : times) time = *std::prev(std::ranges::upper_bound(all, time + rounding));
  return {.times = std::move(times), .rate = rounded_rate(1 / step, of_floats / (steps * step))};
}

std::size_t frames_of(const Gltf_scene& scene, const Gltf_animation& animation, double rate, double start,
                      std::size_t max_frames) {
  if (is_still(animation)) return 1;
  // The tolerance allows for an end, and a rate, that were rounded down.
  const double frames = std::floor(std::max(animation.seconds - start, 0.0) * rate + 0.01) + 1;
  if (!(frames <= static_cast<double>(max_frames)))
    throw Bad_motion(fmt::format("{}: {} seconds at {} frames per second are more than {} frames", scene.name,
                                 animation.seconds - start, rate, max_frames));
  return static_cast<std::size_t>(frames);
}

/// When the frames of an animation are.
struct Sampling {
  std::size_t animation = 0;
  std::size_t frames = 0;
  double rate = 0;
  double start = 0;               ///< time of the first frame in seconds
  double rounding = 0;            ///< seconds by which a key and a frame that are one may differ
  std::vector<double> keys = {};  ///< empty: frames follow each other at the rate

  /// Seconds. Key times are rounded: a frame at a key gets the key's exact value.
  double time(std::size_t frame, const Gltf_animation& of_keys) const {
    if (!keys.empty()) return keys[frame];
    const double exact = start + static_cast<double>(frame) / rate;
    std::optional<double> key;  // the latest that is meant: see uniform_keys
    for (const auto& curve : of_keys.curves) {
      const auto after = std::ranges::upper_bound(curve.times, exact + rounding);
      if (after == curve.times.begin() || *std::prev(after) < exact - rounding) continue;
      key = std::max<double>(key.value_or(*std::prev(after)), *std::prev(after));
    }
    return key.value_or(exact);
  }
};

/// @throws Bad_argument, Bad_motion  as `motion_of`
Sampling sampling_of(const Gltf_scene& scene, const Gltf_motion_options& options) {
  const auto asked = options.frames_per_second;
  if (asked && (!(*asked > 0) || !std::isfinite(*asked)))
    throw Bad_argument(fmt::format("{} frames per second: expected a positive and finite number", *asked));
  Sampling sampling{.animation = number_of(scene, options.animation)};
  const auto& animation = scene.animations[sampling.animation];
  Uniform_keys keys;
  if (!asked) keys = uniform_keys(animation);
  sampling.keys = std::move(keys.times);
  sampling.rate = sampling.keys.empty() ? asked.value_or(usual_rate) : keys.rate;
  sampling.start = sampling.keys.empty() ? (asked ? options.start : 0) : sampling.keys.front();
  sampling.rounding = std::min(rounding_of_keys(animation), 0.1 / sampling.rate);
  const std::size_t most = options.limits.max_frames;
  check_frames(scene.name, sampling.keys.size(), options.limits);
  sampling.frames =
      sampling.keys.empty() ? frames_of(scene, animation, sampling.rate, sampling.start, most) : sampling.keys.size();
  return sampling;
}

/// Some vertices of a scene, frame by frame.
class Gltf_computed final : public Computed_motion {
 public:
  Gltf_computed(std::shared_ptr<const Gltf_scene> scene, std::shared_ptr<const Sampling> sampling,
                std::span<const std::uint32_t> vertices)
      : scene_(std::move(scene)), sampling_(std::move(sampling)), points_(scene_, vertices) {}

  void set_frame(std::size_t frame) override {
    if (frame >= sampling_->frames)
      throw Bad_motion(fmt::format("{}: frame {} (counted from 0) is requested, the animation has {}", scene_->name,
                                   frame, sampling_->frames));
    const Gltf_animation& animation = scene_->animations[sampling_->animation];
    points_.set_time(&animation, sampling_->time(frame, animation));
  }
  Any_bound bound(const Bounded_object& object) const override {
    return Any_bound(Skin_bound(points_.points(), object.layout));
  }
  const Skinned_points* skin() const override { return &points_.points(); }
  std::uint32_t vertex_count() const override { return points_.points().vertex_count(); }
  std::uint64_t pose_number() const override { return points_.points().pose_number(); }
  Eigen::Vector3d operator()(std::uint32_t vertex) const override { return points_.points()(vertex); }
  void pose(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const override {
    points_.points().pose(vertices, coordinates);
  }
  void pose_all(std::span<double> coordinates) const override { points_.points().pose_all(coordinates); }
  void pose_all(std::span<Point> positions) const { lodestone::pose_all(points_, scene_->name, positions); }

 private:
  std::shared_ptr<const Gltf_scene> scene_;
  std::shared_ptr<const Sampling> sampling_;
  Gltf_points points_;
};

}  // namespace

Motion motion_of(std::shared_ptr<const Gltf_scene> scene, const Gltf_motion_options& options) {
  const auto sampling = std::make_shared<const Sampling>(sampling_of(*scene, options));
  std::function<Motion(double, double)> resampled;
  if (!options.frames_per_second)
    resampled = [scene, number = sampling->animation, limits = options.limits](double rate, double start) {
      return motion_of(scene, {.frames_per_second = rate, .start = start, .animation = number, .limits = limits});
    };
  // The points hold one pose, and several threads may ask for different frames.
  struct Shared_points {
    std::optional<Gltf_computed> points;  ///< made when a frame is posed as a whole
    std::mutex in_use;
  };
  const auto pose = [scene, sampling, shared = std::make_shared<Shared_points>()](std::size_t frame,
                                                                                  std::span<Point> positions) {
    if (positions.size() != scene->vertices)
      throw Bad_motion(fmt::format("{}: positions of {} vertices are requested, the file has {}", scene->name,
                                   positions.size(), scene->vertices));
    const std::lock_guard lock(shared->in_use);
    if (!shared->points) shared->points.emplace(scene, sampling, all_vertices(*scene));
    shared->points->set_frame(frame);
    shared->points->pose_all(positions);
  };
  const auto computed = [scene, sampling](std::span<const std::uint32_t> vertices) -> std::unique_ptr<Computed_motion> {
    return std::make_unique<Gltf_computed>(scene, sampling, vertices);
  };
  return {.frames = sampling->frames,
          .pose = pose,
          .frames_per_second = sampling->rate,
          .start = sampling->start,
          .resampled = std::move(resampled),
          .computed = computed,
          .joined = joined_vertices(*scene),
          .animations = {.names = names_in(*scene), .played = sampling->animation}};
}

Motion read_gltf_motion(const std::filesystem::path& file, std::size_t vertices, const Gltf_motion_options& options) {
  std::shared_ptr<const Gltf_scene> scene;
  try {
    scene = read_gltf_scene(file, options.limits);
  } catch (const Bad_mesh& error) {
    throw Bad_motion(error.what());
  }
  if (scene->vertices != vertices)
    throw Bad_motion(fmt::format("{}: the file has {} vertices, expected {}", scene->name, scene->vertices, vertices));
  Motion motion = motion_of(scene, options);
  motion.files = scene->files;
  motion.ignored_extensions = scene->ignored_extensions;
  return motion;
}

}  // namespace lodestone
