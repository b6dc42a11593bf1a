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
struct Face_columns;

/// Leaf against leaf: which of their faces are near each other. Holds the memory that it needs; one per thread.
class Leaf_pairs {
 public:
  Leaf_pairs();
  ~Leaf_pairs();
  Leaf_pairs(Leaf_pairs&&) noexcept;
  Leaf_pairs& operator=(Leaf_pairs&&) noexcept;

  /// What follows is about the leaves of these two trees, whose vertices do not move meanwhile: what has been read of a
  /// leaf is kept for the next ones that it meets.
  /// @param margin  >= 0
  void begin(const Posed_tree& a, const Posed_tree& b, double margin);
  /// The same for the leaves of one tree, and faces that share no vertex.
  void begin_within(const Posed_tree& tree);

  /// The face pairs of two leaves that floating point does not prove to be apart; with a margin: farther apart than it.
  /// Each pair once if both leaves are one.
  ///
  /// The box around the near faces of the other leaf rules out faces, boxes of faces rule out pairs, and so do
  /// directions: along a normal of either face, within the plane of either across its edges, or without a margin across
  /// an edge of each, the projections of the two are apart by more than all rounding can amount to.
  /// O(n + m + n m / vector width) for leaves of n and m faces; the result is valid until the next call.
  std::span<const Face_places> near_faces(std::uint32_t leaf_a, std::uint32_t leaf_b);

 private:
  /// Leaves of one tree as they were last looked at.
  struct Side {
    Posed_tree posed;
    std::vector<std::uint32_t> leaves;  ///< per slot: which one it holds
    std::vector<std::unique_ptr<Face_columns>> faces;

    void begin(const Posed_tree& tree);
    Face_columns& at(std::uint32_t leaf);
  };

  Side sides_[2];
  double margin_ = 0;
  bool one_mesh_ = false;
  std::unique_ptr<Leaf_scratch> scratch_;
  std::vector<Face_places> near_;
};

}  // namespace lodestone
