// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "byte_order.h"
#include "lodestone/errors.h"
#include "lodestone/io/motion.h"

namespace lodestone {
namespace {

// The PC2 header: signature (12 bytes), version, number of points, first frame, frames per sample, number of samples.
// Then, per sample, x y z of every point as float32. Everything is little endian.
constexpr std::size_t header_bytes = 32, point_bytes = 12;
constexpr std::size_t version_at = 12, points_at = 16, samples_at = 28;
constexpr std::string_view signature("POINTCACHE2\0", 12);

using Header = std::array<char, header_bytes>;

template <class... Values>
[[noreturn]] void fail(const std::filesystem::path& file, fmt::format_string<Values...> cause, Values&&... values) {
  throw Bad_motion(fmt::format("{}: {}", file.string(), fmt::format(cause, std::forward<Values>(values)...)));
}

Header read_header(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!is_regular_file(file, ignored)) fail(file, "there is no such file, or it is not a regular one");
  Header header{};
  std::ifstream in(file, std::ios::binary);
  if (!in) fail(file, "the file cannot be opened");
  if (!in.read(header.data(), header.size())) fail(file, "byte {}: the file ends within the header", in.gcount());
  if (std::string_view(header.data(), signature.size()) != signature)
    fail(file, "byte 0: expected 'POINTCACHE2', this is no PC2 point cache");
  return header;
}

/// The number of frames that a header promises and the file holds.
std::size_t checked_frames(const std::filesystem::path& file, const Header& header, std::size_t vertices) {
  const auto number_at = [&](std::size_t offset) { return load<std::int32_t>(header.data() + offset); };
  const auto version = number_at(version_at), points = number_at(points_at), samples = number_at(samples_at);
  if (version != 1) fail(file, "byte {}: expected version 1, found {}", version_at, version);
  if (points < 1 || static_cast<std::size_t>(points) != vertices)
    fail(file, "byte {}: the cache has {} vertices, expected {}", points_at, points, vertices);
  if (samples < 1) fail(file, "byte {}: the cache has {} frames, expected 1 or more", samples_at, samples);

  std::error_code ignored;
  const auto bytes = std::filesystem::file_size(file, ignored) - header_bytes;
  const auto frame_bytes = vertices * point_bytes;
  const auto frames = static_cast<std::size_t>(samples);
  if (frames > bytes / frame_bytes)
    fail(file, "{} frames of {} vertices are announced, but the file ends within frame {} (counted from 0)", frames,
         vertices, bytes / frame_bytes);
  return frames;
}

/// The file is opened for each frame: a motion then has no state, and threads may share it.
std::vector<char> read_frame(const std::filesystem::path& file, std::size_t frame, std::size_t vertices) {
  std::vector<char> bytes(vertices * point_bytes);
  std::ifstream in(file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(header_bytes + frame * bytes.size()));
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!in) fail(file, "frame {} (counted from 0) can no longer be read", frame);
  return bytes;
}

Point point_at(const char* bytes) {
  return {load<float>(bytes), load<float>(bytes + sizeof(float)), load<float>(bytes + 2 * sizeof(float))};
}

bool is_finite(const Point& point) {
  return std::isfinite(point.x()) && std::isfinite(point.y()) && std::isfinite(point.z());
}

}  // namespace

Motion read_point_cache(const std::filesystem::path& file, std::size_t vertices) {
  const auto frames = checked_frames(file, read_header(file), vertices);
  const auto pose = [=](std::size_t frame, std::span<Point> positions) {
    if (frame >= frames) fail(file, "frame {} (counted from 0) is asked for, the cache has {}", frame, frames);
    if (positions.size() != vertices)
      fail(file, "positions of {} vertices are asked for, the cache has {}", positions.size(), vertices);
    const auto bytes = read_frame(file, frame, vertices);
    for (std::size_t vertex = 0; vertex < vertices; ++vertex) {
      positions[vertex] = point_at(bytes.data() + vertex * point_bytes);
      if (!is_finite(positions[vertex]))
        fail(file, "frame {}, vertex {} (counted from 0): a coordinate is not finite", frame, vertex);
    }
  };
  return {.frames = frames, .pose = pose};
}

}  // namespace lodestone
