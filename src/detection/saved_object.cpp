// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/saved_object.h"

#include <fmt/format.h>

#include <algorithm>

#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

constexpr std::string_view signature = "lodestone object";
constexpr std::uint32_t format = 2;
constexpr std::uint32_t byte_order = 0x01020304;

std::uint64_t hash_of_faces(std::span<const Corners> corners) { return hash_of(std::as_bytes(corners)); }

}  // namespace

std::vector<std::byte> seal_saved(std::span<const std::byte> rest) {
  State_writer front;
  for (const char character : signature) front.value(character);
  front.value(format);
  front.value(byte_order);
  front.value(hash_of(rest));
  front.value(std::uint64_t{rest.size()});
  std::vector<std::byte> bytes = front.take();
  bytes.insert(bytes.end(), rest.begin(), rest.end());
  return bytes;
}

std::span<const std::byte> open_saved(std::span<const std::byte> bytes) {
  const auto starts_right = [&] {
    return bytes.size() >= signature.size() &&
           std::ranges::equal(bytes.first(signature.size()), std::as_bytes(std::span(signature)));
  };
  if (!starts_right()) throw Bad_saved_object("this is no saved object");
  State_reader front(bytes.subspan(signature.size()));
  const auto saved_format = front.value<std::uint32_t>(), saved_order = front.value<std::uint32_t>();
  if (saved_order != byte_order) throw Bad_saved_object("the object was saved on a machine with another byte order");
  if (saved_format != format)
    throw Bad_saved_object(
        fmt::format("the object was saved in format {}, but this version reads format {}", saved_format, format));
  const auto hash = front.value<std::uint64_t>(), size = front.value<std::uint64_t>();
  const auto rest = bytes.subspan(signature.size() + 2 * sizeof(std::uint32_t) + 2 * sizeof(std::uint64_t));
  State_reader::require(rest.size() >= size, "it ends too early");
  State_reader::require(rest.size() == size, "there are more bytes than it has");
  State_reader::require(hash_of(rest) == hash, "its bytes have changed");
  return rest;
}

void save_origin(const Saved_origin& origin, State_writer& state) {
  state.list(std::span<const char>(origin.mode));
  state.value(origin.vertices);
  state.value(std::uint64_t{origin.corners.size()});
  state.value(hash_of_faces(origin.corners));
}

namespace {

/// The name of a mode, for a message on one line: the bytes can have anything in its place.
std::string shown(std::span<const char> mode) {
  constexpr std::size_t longest = 40;
  std::string result;
  for (const char c : mode.first(std::min(mode.size(), longest))) result += c >= ' ' && c <= '~' ? c : '?';
  return result;
}

}  // namespace

void check_origin(const Saved_origin& origin, const std::string& title, State_reader& state) {
  const auto mode = state.list<char>();
  if (!std::ranges::equal(mode, origin.mode))
    throw Bad_saved_object(
        fmt::format("the object was saved in mode {}, but {} is in mode {}", shown(mode), title, origin.mode));
  const auto vertices = state.value<std::uint64_t>(), faces = state.value<std::uint64_t>();
  if (vertices != origin.vertices || faces != origin.corners.size())
    throw Bad_saved_object(
        fmt::format("the object was saved with {} vertices and {} faces, but {} has {} vertices and {} faces", vertices,
                    faces, title, origin.vertices, origin.corners.size()));
  if (state.value<std::uint64_t>() != hash_of_faces(origin.corners))
    throw Bad_saved_object(title + " has other faces, or other joined vertices, than the object that was saved");
}

void save_regions(const std::optional<Numbered_partition>& regions, State_writer& state) {
  if (!regions) return state.value(std::uint64_t{0});
  state.value(std::uint64_t{regions->regions});
  state.list(regions->labels);
  state.list(regions->particles);
}

std::optional<Numbered_partition> load_regions(State_reader& state, std::size_t vertex_count) {
  Numbered_partition loaded;
  loaded.regions = state.value<std::uint64_t>();
  if (loaded.regions == 0) return std::nullopt;
  loaded.labels = state.list<Region_index>();
  loaded.particles = state.list<std::uint32_t>();
  State_reader::require(loaded.labels.size() == vertex_count, "it does not have one region for each vertex");
  State_reader::require(std::ranges::all_of(loaded.labels, [&](auto label) { return label < loaded.regions; }),
                        "a vertex is in a region that does not exist");
  State_reader::require(loaded.particles.size() == loaded.regions, "it does not have one particle in each region");
  for (Region_index region = 0; region < loaded.regions; ++region)
    State_reader::require(loaded.particles[region] < vertex_count && loaded.labels[loaded.particles[region]] == region,
                          "a particle is not in its region");
  return loaded;
}

}  // namespace lodestone
