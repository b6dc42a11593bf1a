// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/mesh/vertex_faces.h"
#include "lodestone/tree/tree_layout.h"

namespace lodestone {

/// Which leaves of a tree lie beside each face: for following curves across the borders of leaves.
class Leaf_neighbours {
 public:
  /// Where faces of more leaves than this share an edge, each of them has only so many beside it: else their lists
  /// would grow with the square of their number.
  static constexpr std::size_t most_per_edge = 8;

  /// O(V + F log d) for at most d faces at a vertex.
  /// @param walked        F: the faces, with the vertices of closed seams as one
  /// @param vertex_faces  of `walked`
  Leaf_neighbours(const Tree_layout& layout, std::span<const Corners> walked, const Vertex_faces& vertex_faces);

  /// The leaf of a face.
  std::uint32_t leaf_of(std::uint32_t face) const { return faces_[face].leaf; }
  /// The leaves of the faces that share an edge with a face, except its own leaf, and at most `most_per_edge` for each
  /// edge; some more than once. O(1).
  std::span<const std::uint32_t> beside(std::uint32_t face) const {
    return std::span(beside_).subspan(faces_[face].first, faces_[face + 1].first - faces_[face].first);
  }

 private:
  /// Both in one place of the memory: a search asks for both.
  struct Face {
    std::uint32_t leaf = 0;
    std::uint32_t first = 0;  ///< place in `beside_`; the next face tells the end
  };

  std::vector<Face> faces_;            ///< F + 1
  std::vector<std::uint32_t> beside_;  ///< leaves beside face 0, then those beside face 1 and so on
};

}  // namespace lodestone
