// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// The faces around every vertex, in a row wherever they form one.
///
/// Any faces are legal: non-manifold edges, open borders, inconsistent orientation, duplicate faces, faces that use a
/// vertex twice. The mesh's topology does not change from frame to frame, and neither do its fans.
class Vertex_fans {
 public:
  /// Time and memory O(V + F), also with a vertex that all faces share.
  /// @param faces  corners of every face, each below `vertex_count`
  Vertex_fans(std::uint32_t vertex_count, std::span<const Corners> faces);

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(starts_.size() - 1); }

  /// Numbers of the faces that use `vertex`, each once; in the order of the rim where there is one, else ascending.
  std::span<const std::uint32_t> faces(std::uint32_t vertex) const {
    return {faces_.data() + starts_[vertex], starts_[vertex + 1] - starts_[vertex]};
  }

  /// The neighbours of `vertex` such that its face i has the corners `vertex`, rim[i] and rim[i + 1], so there is one
  /// neighbour more than faces. The first is repeated as the last where the faces close around the vertex; else all
  /// differ. Empty where the faces do not follow one another in a single such row, and where there is none.
  std::span<const std::uint32_t> rim(std::uint32_t vertex) const {
    const std::uint32_t* begin = rims_.data() + starts_[vertex] + vertex;
    if (*begin == vertex) return {};
    return {begin, starts_[vertex + 1] - starts_[vertex] + 1};
  }

 private:
  class Ordering;

  std::vector<std::size_t> starts_;   ///< per vertex: where its list in `faces_` starts; V + 1
  std::vector<std::uint32_t> faces_;  ///< all lists of faces
  std::vector<std::uint32_t> rims_;   ///< all rims, one entry longer than the faces; it starts with the vertex: no rim
};

}  // namespace lodestone
