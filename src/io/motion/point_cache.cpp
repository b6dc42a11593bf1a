// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/motion/point_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "io/files/byte_order.h"
#include "io/files/small_text.h"
#include "io/motion/point_cache_layout.h"
#include "io/motion/rounded_rate.h"
#include "lodestone/io/motion/motion.h"
#include "lodestone/mesh/errors.h"
#include "mesh/is_finite.h"

namespace lodestone {
namespace {

namespace fs = std::filesystem;

template <class... Values>
[[noreturn]] void fail(const fs::path& file, fmt::format_string<Values...> cause, Values&&... values) {
  throw Bad_motion(fmt::format("{}: {}", file.string(), fmt::format(cause, std::forward<Values>(values)...)));
}

/// Where the positions of a cache begin, and their endianness.
struct Cache {
  fs::path file;
  Point_cache header = {};
  std::size_t first_frame = 0;
  std::endian order = std::endian::little;
};

std::ifstream open(const fs::path& file) {
  std::error_code ignored;
  if (!is_regular_file(file, ignored)) fail(file, "there is no such file, or it is not a regular one");
  std::ifstream in(file, std::ios::binary);
  if (!in) fail(file, "the file cannot be opened");
  return in;
}

template <std::size_t Bytes>
std::array<char, Bytes> read_header(std::ifstream& in, const fs::path& file) {
  std::array<char, Bytes> header{};
  if (!in.read(header.data(), header.size())) fail(file, "byte {}: the file ends within the header", in.gcount());
  return header;
}

/// @param at  offset of the number in the file, for the message
std::size_t positive(std::int32_t number, std::size_t at, std::string_view things, const fs::path& file) {
  if (number < 1) fail(file, "byte {}: the cache has {} {}, expected 1 or more", at, number, things);
  return static_cast<std::size_t>(number);
}

/// Refuses a file that is shorter than its header announces.
void check_length(const Cache& cache) {
  std::error_code ignored;
  const std::size_t vertices = cache.header.vertices, frames = cache.header.frames;
  const auto bytes = file_size(cache.file, ignored) - cache.first_frame;
  const auto frame_bytes = vertices * point_bytes;
  if (frames > bytes / frame_bytes)
    fail(cache.file, "{} frames of {} vertices are announced, but the file ends within frame {} (counted from 0)",
         frames, vertices, bytes / frame_bytes);
}

// ---- PC2 ----

Cache open_pc2(const fs::path& file) {
  auto in = open(file);
  const auto header = read_header<pc2::header_bytes>(in, file);
  const auto number_at = [&](std::size_t offset) { return load<std::int32_t>(header.data() + offset); };
  if (std::string_view(header.data(), pc2::signature.size()) != pc2::signature)
    fail(file, "byte 0: expected 'POINTCACHE2', this is not a PC2 point cache");
  const auto version = number_at(pc2::version_at);
  if (version != 1) fail(file, "byte {}: expected version 1, found {}", pc2::version_at, version);
  Cache cache{.file = file, .first_frame = pc2::header_bytes};
  cache.header.vertices = positive(number_at(pc2::points_at), pc2::points_at, "vertices", file);
  cache.header.frames = positive(number_at(pc2::samples_at), pc2::samples_at, "frames", file);
  return cache;
}

// ---- MDD ----

/// Sets start and frames per second from the first and last time; the times between them are ignored. One frame alone
/// has a start, and no rate.
void read_mdd_times(std::ifstream& in, const fs::path& file, Point_cache& header) {
  const std::size_t frames = header.frames;
  std::array<char, sizeof(float)> raw{};
  std::array<double, 2> ends{};
  for (const std::size_t end : {0U, 1U}) {
    in.seekg(static_cast<std::streamoff>(mdd::times_at + end * (frames - 1) * sizeof(float)));
    if (!in.read(raw.data(), raw.size())) fail(file, "the times of the frames can no longer be read");
    ends[end] = load<float>(raw.data(), std::endian::big);
  }
  if (frames == 1 && std::isfinite(ends[0])) header.start = ends[0];
  const double rate = static_cast<double>(frames - 1) / (ends[1] - ends[0]);
  if (!std::isfinite(rate) || !(rate > 0)) return;
  const double of_floats = rounding_of_times(std::max(std::abs(ends[0]), std::abs(ends[1])));
  header.frames_per_second = rounded_rate(rate, of_floats / (ends[1] - ends[0]));
  header.start = ends[0];
}

/// The format has no signature: only the length tells an MDD cache from another file.
void check_mdd_length(const Cache& cache) {
  std::error_code ignored;
  const auto wanted = cache.first_frame + cache.header.frames * cache.header.vertices * point_bytes;
  const auto found = file_size(cache.file, ignored);
  if (found != wanted)
    fail(cache.file, "{} frames of {} vertices take {} bytes, the file has {}: this is not an MDD point cache",
         cache.header.frames, cache.header.vertices, wanted, found);
}

Cache open_mdd(const fs::path& file) {
  auto in = open(file);
  const auto header = read_header<mdd::times_at>(in, file);
  const auto number_at = [&](std::size_t offset) {
    return load<std::int32_t>(header.data() + offset, std::endian::big);
  };
  Cache cache{.file = file, .order = std::endian::big};
  cache.header.format = Cache_format::mdd;
  cache.header.frames = positive(number_at(mdd::frames_at), mdd::frames_at, "frames", file);
  cache.header.vertices = positive(number_at(mdd::points_at), mdd::points_at, "vertices", file);
  cache.first_frame = mdd::times_at + cache.header.frames * sizeof(float);
  std::error_code ignored;
  if (cache.first_frame > file_size(file, ignored))
    fail(file, "{} frames are announced, but the file ends within their times", cache.header.frames);
  check_length(cache);
  check_mdd_length(cache);
  read_mdd_times(in, file, cache.header);
  return cache;
}

// ---- Frames ----

/// Opens the file for each frame: a motion then has no state, and threads may share it.
std::vector<char> read_frame(const Cache& cache, std::size_t frame) {
  std::vector<char> bytes(cache.header.vertices * point_bytes);
  std::ifstream in(cache.file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(cache.first_frame + frame * bytes.size()));
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!in) fail(cache.file, "frame {} (counted from 0) can no longer be read", frame);
  return bytes;
}

Point point_at(const char* bytes, std::endian order) {
  const auto coordinate = [&](int axis) { return load<float>(bytes + axis * sizeof(float), order); };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

/// @param vertices  required number of vertices
/// @param counted_at  offset of the number of vertices in the file
Motion motion_of(const Cache& cache, std::size_t vertices, std::size_t counted_at) {
  const auto& header = cache.header;
  if (header.vertices != vertices)
    fail(cache.file, "byte {}: the cache has {} vertices, expected {}", counted_at, header.vertices, vertices);
  check_length(cache);
  const auto pose = [cache](std::size_t frame, std::span<Point> positions) {
    const std::size_t points = cache.header.vertices, frames = cache.header.frames;
    if (frame >= frames) fail(cache.file, "frame {} (counted from 0) is requested, the cache has {}", frame, frames);
    if (positions.size() != points)
      fail(cache.file, "positions of {} vertices are requested, the cache has {}", positions.size(), points);
    const auto bytes = read_frame(cache, frame);
    for (std::size_t vertex = 0; vertex < positions.size(); ++vertex) {
      positions[vertex] = point_at(bytes.data() + vertex * point_bytes, cache.order);
      if (!is_finite(positions[vertex]))
        fail(cache.file, "frame {}, vertex {} (counted from 0): a coordinate is not finite", frame, vertex);
    }
  };
  return {.frames = header.frames, .pose = pose, .frames_per_second = header.frames_per_second, .start = header.start};
}

}  // namespace

Motion read_point_cache(const fs::path& file, std::size_t vertices) {
  return motion_of(open_pc2(file), vertices, pc2::points_at);
}

Motion read_mdd_cache(const fs::path& file, std::size_t vertices) {
  return motion_of(open_mdd(file), vertices, mdd::points_at);
}

Point_cache read_point_cache_header(const fs::path& file) {
  const auto extension = lower_case(file.extension().string());
  if (extension == ".mdd") return open_mdd(file).header;
  if (extension != ".pc2") fail(file, "expected a point cache .pc2 or .mdd");
  const auto cache = open_pc2(file);
  check_length(cache);
  return cache.header;
}

}  // namespace lodestone
