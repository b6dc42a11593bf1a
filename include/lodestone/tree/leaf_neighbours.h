// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/mesh/vertex_faces.h"
#include "lodestone/tree/tree_layout.h"

namespace lodestone {

/// Which leaves of a tree lie beside each face: for following curves across the borders of leaves. What lies beside the
/// faces of a leaf is found when it is first asked for, and kept.
class Leaf_neighbours {
 public:
  /// Where faces of more leaves than this share an edge, each of them has only so many beside it: else their lists
  /// would grow with the square of their number.
  static constexpr std::size_t most_per_edge = 8;

  Leaf_neighbours() = default;
  /// O(F).
  /// @param faces  F, of the whole mesh
  Leaf_neighbours(const Tree_layout& layout, std::size_t faces);

  /// Tells where the surface is: before `beside`, and again once it has moved in memory. O(1).
  /// @param layout        the tree that was given to the constructor
  /// @param walked        F: the faces, with the vertices of closed seams as one
  /// @param vertex_faces  of `walked`
  void look_at(const Tree_layout& layout, std::span<const Corners> walked, const Vertex_faces& vertex_faces);

  /// The leaf of a face.
  std::uint32_t leaf_of(std::uint32_t face) const { return faces_[face].leaf; }
  /// The leaves of the faces that share an edge with a face, except its own leaf, and at most `most_per_edge` for each
  /// edge; some more than once. Valid until the next call. O(1); the first call for a leaf O(faces of the leaf x d) for
  /// edges one of whose ends has d <= 64 faces, else O(d log d) once per vertex.
  std::span<const std::uint32_t> beside(std::uint32_t face) {
    if (!known_[leaf_of(face)]) list_leaf(leaf_of(face));
    const std::uint32_t first = faces_[face].first;
    return std::span(beside_).subspan(first + 1, beside_[first]);
  }

 private:
  /// Both in one place of the memory: a search asks for both.
  struct Face {
    std::uint32_t leaf = 0;
    std::uint32_t first = 0;  ///< index in `beside_` of the number of leaves, which follow it
  };

  /// The edges at a vertex with many faces, by their other ends, ascending: a leaf that has faces there, for each of
  /// which the end is listed.
  struct Crowd {
    std::vector<std::uint32_t> ends, leaves;
  };

  void list_leaf(std::uint32_t leaf);
  void list_edge(std::uint32_t own, std::uint32_t v, std::uint32_t w);
  std::span<const std::uint32_t> leaves_at(std::uint32_t v, std::uint32_t w);
  const Crowd& crowd_at(std::uint32_t vertex);

  const Tree_layout* layout_ = nullptr;
  std::span<const Corners> walked_;
  const Vertex_faces* vertex_faces_ = nullptr;
  std::vector<Face> faces_;               ///< F
  std::vector<bool> known_;               ///< per leaf
  std::vector<std::uint32_t> beside_{0};  ///< of the faces of known leaves; at 0 the list of those that have none
  std::vector<std::uint32_t> leaves_;     ///< memory
  std::unordered_map<std::uint32_t, Crowd> crowds_;  ///< of the vertices with many faces that were needed
};

}  // namespace lodestone
