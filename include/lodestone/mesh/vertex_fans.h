// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// The fan of every vertex: the faces around it, sorted into a row wherever they form one.
///
/// Any faces are legal: non-manifold edges, open borders, inconsistent orientation, duplicate faces, faces that use a
/// vertex twice. Fans depend on topology only, so they stay valid from frame to frame.
class Vertex_fans {
 public:
  /// Time and memory O(V + F), even if all faces share a vertex.
  /// @param faces  corners of every face, each below `vertex_count`
  Vertex_fans(std::uint32_t vertex_count, std::span<const Corners> faces);

  /// Number of vertices, V.
  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(starts_.size() - 1); }

  /// Indices of the faces that use `vertex`, each once: in the order of the rim if there is one, otherwise ascending.
  std::span<const std::uint32_t> faces(std::uint32_t vertex) const {
    return {faces_.data() + starts_[vertex], starts_[vertex + 1] - starts_[vertex]};
  }

  /// The rim of `vertex`: its neighbours, in an order such that face i of the fan has the corners `vertex`, rim[i] and
  /// rim[i + 1]. So the rim has one entry more than the fan. If the faces close around the vertex, the last entry
  /// repeats the first; otherwise all entries differ. Empty if the faces do not form a single row, and if there are no
  /// faces.
  std::span<const std::uint32_t> rim(std::uint32_t vertex) const {
    const std::uint32_t* begin = rims_.data() + starts_[vertex] + vertex;
    if (*begin == vertex) return {};
    return {begin, starts_[vertex + 1] - starts_[vertex] + 1};
  }

 private:
  class Ordering;

  std::vector<std::size_t> starts_;   ///< V + 1: per vertex the start of its fan in `faces_`
  std::vector<std::uint32_t> faces_;  ///< all fans
  std::vector<std::uint32_t> rims_;   ///< all rims, each one entry longer than its fan; no rim: starts with its vertex
};

}  // namespace lodestone
