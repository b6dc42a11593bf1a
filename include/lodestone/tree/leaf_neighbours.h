// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/mesh/vertex_faces.h"
#include "lodestone/tree/tree_layout.h"

namespace lodestone {

/// Which leaves of a tree lie beside a face: for following curves across the borders of leaves.
class Leaf_neighbours {
 public:
  Leaf_neighbours() = default;
  /// O(V + F).
  /// @param walked  F: the faces, with the vertices of closed seams as one
  Leaf_neighbours(const Tree_layout& layout, std::span<const Corners> walked, std::size_t vertex_count);

  /// The leaf of a face.
  std::uint32_t leaf_of(std::uint32_t face) const { return leaf_of_[face]; }
  /// Appends the leaves of the faces that share an edge with a face, except its own leaf; some more than once. O(1)
  /// inside a leaf, else O(faces at its vertices).
  /// @param walked, vertex_faces  the same faces, and those at each vertex
  void list_beside(std::span<const Corners> walked, const Vertex_faces& vertex_faces, std::uint32_t face,
                   std::vector<std::uint32_t>& leaves) const;

 private:
  std::vector<std::uint32_t> leaf_of_;  ///< F
  std::vector<bool> shared_;            ///< V: faces at this vertex are in several leaves
  std::vector<bool> at_border_;         ///< F: the ends of an edge are shared
};

}  // namespace lodestone
