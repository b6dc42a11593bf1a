// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/scene_hash.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lodestone/mesh/saved_state.h"

namespace lodestone {

namespace {

template <class Value>
std::uint64_t hash_of_list(std::span<const Value> values) {
  return hash_of(std::as_bytes(values));
}

std::uint64_t hash_of_positions(const Surface_mesh& mesh) {
  const auto& points = mesh.points();
  return hash_of_list(
      std::span<const double>(reinterpret_cast<const double*>(points.data()), 3 * mesh.number_of_vertices()));
}

std::uint64_t hash_of_faces(const Surface_mesh& mesh) {
  std::vector<std::uint32_t> corners;
  for (const auto face : mesh.faces())
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(face))) corners.push_back(v);
  return hash_of_list(std::span<const std::uint32_t>(corners));
}

void add_side(const std::optional<Kernel::Vector_3>& side, std::vector<std::uint64_t>& hashes) {
  if (!side) return;
  for (const double along : {side->x(), side->y(), side->z()}) hashes.push_back(std::bit_cast<std::uint64_t>(along));
}

/// Per object. All objects are in one frame before they are in the next, since some read it together.
std::vector<std::uint64_t> hashes_of_positions(Scene& scene, std::size_t frame) {
  std::vector<std::uint64_t> hashes;
  for (auto& object : scene.objects) {
    pose(object, frame);
    hashes.push_back(hash_of_positions(object.mesh));
  }
  return hashes;
}

}  // namespace

std::string hash_of(Scene& scene) {
  const auto last = hashes_of_positions(scene, scene.frames - 1), first = hashes_of_positions(scene, 0);
  std::vector<std::uint64_t> hashes{scene.frames};
  for (std::size_t o = 0; o < scene.objects.size(); ++o) {
    const auto& object = scene.objects[o];
    hashes.push_back(hash_of_list(std::span<const char>(object.name)));
    hashes.push_back(hash_of_faces(object.mesh));
    hashes.insert(hashes.end(), {object.collision.groups, object.collision.meets, object.particles});
    add_side(object.scattered_side, hashes);
    hashes.insert(hashes.end(), {last[o], first[o]});
  }
  for (const auto& [a, b] : scene.ignored) hashes.insert(hashes.end(), {a, b});
  return fmt::format("{:016x}", hash_of_list(std::span<const std::uint64_t>(hashes)));
}

}  // namespace lodestone
