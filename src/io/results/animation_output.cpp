// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/results/animation_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "io/files/byte_order.h"
#include "io/files/small_text.h"
#include "io/gltf/gltf_scene.h"
#include "io/motion/point_cache_layout.h"
#include "io/results/animation_frames.h"
#include "lodestone/io/files/atomic_file.h"
#include "lodestone/io/files/atomic_files.h"
#include "lodestone/io/files/numbered_files.h"
#include "lodestone/io/motion/point_cache.h"
#include "lodestone/mesh/errors.h"
#include "mesh/is_finite.h"

namespace lodestone {

namespace fs = std::filesystem;

// ---- Frames ----

Animation_frames::Animation_frames(fs::path output, const Animation& animation, const Animation_output_options& options,
                                   std::size_t passes)
    : output_(std::move(output)),
      animation_(animation),
      options_(options),
      numbers_(options.frames),
      positions_(animation.vertices),
      passes_(passes) {
  if (!numbers_.empty()) return;
  numbers_.resize(animation.motion.frames);
  std::iota(numbers_.begin(), numbers_.end(), std::size_t{0});
}

std::span<const Point> Animation_frames::positions(std::size_t i) {
  if (options_.progress) options_.progress(done_, passes_ * size());
  ++done_;
  animation_.motion.pose(numbers_[i], positions_);
  const auto bad = std::ranges::find_if_not(positions_, [](const Point& point) { return is_finite(point); });
  if (bad != positions_.end())
    throw Bad_motion(fmt::format("{}: frame {}, vertex {} (counted from 0): a coordinate is not finite",
                                 output_.string(), numbers_[i], bad - positions_.begin()));
  return positions_;
}

std::span<const float> Animation_frames::floats(std::size_t i) {
  floats_.clear();
  double largest = 0;
  for (const Point& point : positions(i))
    for (int axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(static_cast<float>(point[axis])))
        throw Bad_motion(fmt::format("{}: frame {}, vertex {} (counted from 0): {} is too large for a float",
                                     output_.string(), numbers_[i], floats_.size() / 3, point[axis]));
      floats_.push_back(static_cast<float>(point[axis]));
      largest = std::max(largest, std::abs(point[axis]));
    }
  if (largest > 0 && largest < std::numeric_limits<float>::min())
    throw Bad_motion(fmt::format("{}: frame {}: its largest coordinate, {}, is too small for a float", output_.string(),
                                 numbers_[i], largest));
  return floats_;
}

namespace {

// ---- Point caches ----

std::string cache_header(Cache_format format, std::size_t vertices, const Animation_frames& frames) {
  std::string bytes;
  const auto count = [](std::size_t value) { return static_cast<std::int32_t>(value); };
  if (format == Cache_format::pc2) {
    bytes = pc2::signature;
    for (const auto value : {std::int32_t{1}, count(vertices)}) append(bytes, value);
    for (const float value : {0.F, 1.F}) append(bytes, value);  // first frame, frames per sample
    append(bytes, count(frames.size()));
    return bytes;
  }
  for (const auto value : {frames.size(), vertices}) append(bytes, count(value), std::endian::big);
  for (std::size_t i = 0; i < frames.size(); ++i) append(bytes, frames.time(i), std::endian::big);
  return bytes;
}

void write_cache(const fs::path& output, Cache_format format, Animation_frames frames, std::size_t vertices) {
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
  if (frames.size() > most || vertices > most)
    throw Bad_argument(
        fmt::format("{}: {} frames of {} vertices are too many for 32 bits", output.string(), frames.size(), vertices));
  const auto order = format == Cache_format::pc2 ? std::endian::little : std::endian::big;
  Atomic_file out(output);
  out.write(cache_header(format, vertices, frames));
  std::string bytes;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    bytes.clear();
    for (const float coordinate : frames.floats(i)) append(bytes, coordinate, order);
    out.write(bytes);
  }
  out.commit();
}

// ---- Mesh files ----

std::string off_text(std::span<const Point> points, std::span<const Corners> faces) {
  auto text = fmt::format("OFF\n{} {} 0\n", points.size(), faces.size());
  for (const Point& p : points) text += fmt::format("{} {} {}\n", p.x(), p.y(), p.z());
  for (const auto& [a, b, c] : faces) text += fmt::format("3 {} {} {}\n", a, b, c);
  return text;
}

std::string obj_text(std::span<const Point> points, std::span<const Corners> faces) {
  std::string text;
  for (const Point& p : points) text += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
  for (const auto& [a, b, c] : faces)
    text += fmt::format("f {} {} {}\n", std::size_t{a} + 1, std::size_t{b} + 1, std::size_t{c} + 1);
  return text;
}

std::string ply_text(std::span<const Point> points, std::span<const Corners> faces) {
  auto bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
      "property double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
      points.size(), faces.size());
  for (const Point& p : points)
    for (int axis = 0; axis < 3; ++axis) append(bytes, p[axis]);
  for (const auto& face : faces) {
    append(bytes, std::uint8_t{3});
    for (const auto corner : face) append(bytes, corner);
  }
  return bytes;
}

/// Binary, with normals of zero: a reader computes them from the corners.
std::string stl_bytes(std::span<const float> coordinates, std::span<const Corners> faces) {
  std::string bytes(80, '\0');
  append(bytes, static_cast<std::uint32_t>(faces.size()));
  for (const auto& face : faces) {
    bytes.append(3 * sizeof(float), '\0');
    for (const auto corner : face)
      for (std::size_t axis = 0; axis < 3; ++axis) append(bytes, coordinates[3 * std::size_t{corner} + axis]);
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string mesh_bytes(const std::string& extension, Animation_frames& frames, std::size_t i,
                       std::span<const Corners> faces) {
  if (extension == ".stl") return stl_bytes(frames.floats(i), faces);
  const auto points = frames.positions(i);
  if (extension == ".off") return off_text(points, faces);
  return extension == ".obj" ? obj_text(points, faces) : ply_text(points, faces);
}

void write_meshes(const fs::path& output, const std::string& extension, Animation_frames frames,
                  std::span<const Corners> faces, bool can_be_numbered) {
  const bool numbered = can_be_numbered && is_pattern(output);
  if (!numbered && frames.size() != 1)
    throw Bad_argument(fmt::format("{}: {} frames need a pattern of numbered files, such as frame_####{}",
                                   output.string(), frames.size(), extension));
  Atomic_files files(output.parent_path());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::string bytes = mesh_bytes(extension, frames, i, faces);
    Atomic_file out = files.open((numbered ? numbered_file(output, i) : output).filename());
    out.write(bytes);
    out.commit();
  }
  files.commit();
}

}  // namespace

std::vector<fs::path> files_of(const fs::path& output, std::size_t frames) {
  const auto extension = lower_case(output.extension().string());
  const bool is_one_file = extension == ".pc2" || extension == ".mdd" || is_gltf(output);
  std::vector<fs::path> files;
  if (!is_one_file && is_pattern(output))
    for (std::size_t i = 0; i < frames; ++i) files.push_back(numbered_file(output, i));
  else
    files.push_back(output);
  if (extension == ".gltf") files.push_back(fs::path(output).replace_extension(".bin"));
  return files;
}

double start_at(const Motion& motion, double frames_per_second) {
  const bool has_rate = motion.frames_per_second > 0;  // one frame alone has a time, and no rate
  return std::max(0.0, has_rate ? motion.start * motion.frames_per_second / frames_per_second : motion.start);
}

void write_animation(const fs::path& output, const Animation& animation, const Animation_output_options& options) {
  if (!(options.frames_per_second > 0) || !std::isfinite(options.frames_per_second))
    throw Bad_argument(
        fmt::format("{} frames per second: expected a positive and finite number", options.frames_per_second));
  if (!std::isfinite(options.start) || (options.start < 0 && is_gltf(output)))
    throw Bad_argument(
        fmt::format("a start at {} s: expected a finite number, which is 0 or more in glTF", options.start));
  const auto extension = lower_case(output.extension().string());
  const bool is_mesh = extension == ".off" || extension == ".obj" || extension == ".ply" || extension == ".stl";
  if (extension == ".pc2" || extension == ".mdd")
    return write_cache(output, extension == ".pc2" ? Cache_format::pc2 : Cache_format::mdd,
                       {output, animation, options}, animation.vertices);
  if (!is_mesh && !is_gltf(output))
    throw Bad_argument(fmt::format("{}: animations are written as .pc2, .mdd, .gltf, .glb, .obj, .off, .ply or .stl",
                                   output.string()));
  if (animation.faces.empty())
    throw Bad_argument(fmt::format("{}: there are no faces to write; a point cache needs its mesh", output.string()));
  if (is_mesh) return write_meshes(output, extension, {output, animation, options}, animation.faces, options.numbered);
  write_gltf(output, animation, options);
}

}  // namespace lodestone
