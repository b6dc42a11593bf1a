// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/joined_vertices.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <string>

#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

/// @param used  bytes, not bits: a store need not wait for the last one
std::vector<std::uint32_t> indices_of_zeros(std::span<const std::uint8_t> used) {
  std::vector<std::uint32_t> indices;
  std::size_t v = 0;
  const auto next_zero = [&]() -> const void* {
    return v < used.size() ? std::memchr(used.data() + v, 0, used.size() - v) : nullptr;
  };
  while (const void* zero = next_zero()) {
    v = static_cast<std::size_t>(static_cast<const std::uint8_t*>(zero) - used.data());
    indices.push_back(static_cast<std::uint32_t>(v++));
  }
  return indices;
}

}  // namespace

std::vector<Corners> join_vertices(std::span<const Corners> faces, std::uint32_t vertex_count,
                                   std::span<const std::uint32_t> file_vertex) {
  if (file_vertex.empty()) return {};
  if (file_vertex.size() != vertex_count)
    throw Bad_argument("file_vertex has " + std::to_string(file_vertex.size()) + " entries, expected one for each of " +
                       std::to_string(vertex_count) + " vertices");
  std::vector<std::uint32_t> by_file_vertex(vertex_count);
  std::iota(by_file_vertex.begin(), by_file_vertex.end(), 0U);
  std::ranges::stable_sort(by_file_vertex, {}, [&](std::uint32_t v) { return file_vertex[v]; });

  std::vector<std::uint32_t> first(vertex_count);  // of the vertices with the same file vertex
  bool joins = false;
  for (std::size_t i = 0; i < by_file_vertex.size(); ++i) {
    const std::uint32_t v = by_file_vertex[i];
    const bool again = i > 0 && file_vertex[by_file_vertex[i - 1]] == file_vertex[v];
    first[v] = again ? first[by_file_vertex[i - 1]] : v;
    joins |= again;
  }
  if (!joins) return {};

  std::vector<Corners> joined;
  joined.reserve(faces.size());
  for (const auto& [a, b, c] : faces) joined.push_back({first[a], first[b], first[c]});
  return joined;
}

std::vector<std::uint32_t> unused_vertices(std::span<const Corners> faces, std::uint32_t vertex_count) {
  std::vector<std::uint8_t> used(vertex_count, 0);
  for (const auto& corners : faces)
    for (const auto v : corners) used[v] = 1;
  return indices_of_zeros(used);
}

std::vector<std::uint32_t> unused_vertices(std::span<const std::uint32_t> listed, std::uint32_t vertex_count) {
  std::vector<std::uint8_t> used(vertex_count, 0);
  for (const auto v : listed) used[v] = 1;
  return indices_of_zeros(used);
}

}  // namespace lodestone
