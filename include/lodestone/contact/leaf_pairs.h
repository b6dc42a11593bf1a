// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lodestone/contact/region_tree.h"

namespace lodestone {

/// A tree with the coordinates that it was refitted to.
struct Posed_tree {
  const Region_tree* tree = nullptr;
  Coordinates coordinates = {};
};

struct Leaf_scratch;

/// Leaf against leaf: which of their faces are near each other. Holds the memory that it needs; one per thread.
class Leaf_pairs {
 public:
  Leaf_pairs();
  ~Leaf_pairs();
  Leaf_pairs(Leaf_pairs&&) noexcept;
  Leaf_pairs& operator=(Leaf_pairs&&) noexcept;

  /// The face pairs of two leaves that floating point does not prove to be apart; with a margin: farther apart than it.
  ///
  /// Vertices on one side of the other leaf's box rule out faces, boxes of faces rule out pairs, and so do planes:
  /// along a normal of either face, or within the plane of either across its edges, the projections of the two are
  /// apart by more than all rounding can amount to. O(n + m + n m / vector width) for leaves of n and m faces; the
  /// result is valid until the next call.
  std::span<const Face_places> near_faces(const Posed_tree& a, std::uint32_t leaf_a, const Posed_tree& b,
                                          std::uint32_t leaf_b, double margin);
  /// The same within one mesh, for faces that share no vertex; each pair once if both leaves are one.
  std::span<const Face_places> near_faces_within(const Posed_tree& tree, std::uint32_t leaf_a, std::uint32_t leaf_b);

 private:
  std::span<const Face_places> find(const Posed_tree& a, std::uint32_t leaf_a, const Posed_tree& b,
                                    std::uint32_t leaf_b, double margin, bool one_mesh);

  std::unique_ptr<Leaf_scratch> scratch_;
  std::vector<Face_places> near_;
};

}  // namespace lodestone
