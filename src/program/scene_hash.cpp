// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/scene_hash.h"

#include <fmt/format.h>

#include <cstdint>
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

}  // namespace

std::string hash_of(Scene& scene) {
  std::vector<std::uint64_t> hashes{scene.frames};
  for (auto& object : scene.objects) {
    hashes.push_back(hash_of_list(std::span<const char>(object.name)));
    hashes.push_back(hash_of_faces(object.mesh));
    for (const std::size_t frame : {scene.frames - 1, std::size_t{0}}) {
      pose(object, frame);
      hashes.push_back(hash_of_positions(object.mesh));
    }
  }
  return fmt::format("{:016x}", hash_of_list(std::span<const std::uint64_t>(hashes)));
}

}  // namespace lodestone
