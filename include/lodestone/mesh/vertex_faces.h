// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// The faces at each vertex, by index.
class Vertex_faces {
 public:
  Vertex_faces() = default;
  /// O(V + F).
  Vertex_faces(std::uint32_t vertex_count, std::span<const Corners> corners);

  /// Number of vertices, V.
  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(offsets_.size() - 1); }
  /// Ascending; a face with two corners at the vertex twice.
  std::span<const std::uint32_t> at(std::uint32_t vertex) const {
    return std::span(faces_).subspan(offsets_[vertex], offsets_[vertex + 1] - offsets_[vertex]);
  }

 private:
  std::vector<std::size_t> offsets_{0};
  std::vector<std::uint32_t> faces_;
};

}  // namespace lodestone
