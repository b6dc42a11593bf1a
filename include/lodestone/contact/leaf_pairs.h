// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lodestone/contact/region_tree.h"

namespace lodestone {

/// What leaves are looked at with: how faces are grouped, and where they are.
struct Posed_layout {
  const Tree_layout* layout = nullptr;
  Coordinates coordinates = {};
  Aabb bounds = {};                  ///< around all faces, if only roughly
  std::span<const Aabb> boxes = {};  ///< per node; empty: the tree has volumes of another kind

  Leaf_faces leaf(std::uint32_t number) const { return layout->leaf_faces(number, coordinates); }
};

/// A tree with the coordinates that it was refitted to.
template <Bounding_volume Volume>
struct Basic_posed_tree {
  const Basic_region_tree<Volume>* tree = nullptr;
  Coordinates coordinates = {};

  operator Posed_layout() const {
    if constexpr (std::same_as<Volume, Aabb>)
      return {tree, coordinates, tree->volume(0), tree->volumes()};
    else
      return {tree, coordinates, tree->volume(0).bounds()};
  }
};
using Posed_tree = Basic_posed_tree<Aabb>;

struct Leaf_scratch;
struct Face_columns;
namespace kernel {
struct Leaf_view;
struct Leaf_request;
}  // namespace kernel

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
  void begin(const Posed_layout& a, const Posed_layout& b, double margin);
  /// The same for the leaves of one tree, and faces that share no vertex.
  void begin_within(const Posed_layout& tree);

  /// The face pairs of two leaves that floating point does not prove to be apart; with a margin: farther apart than it.
  /// Each pair once if both leaves are one.
  ///
  /// The box around the near faces of the other leaf rules out faces, boxes of faces rule out pairs, and so do
  /// directions, of corners rounded to floats first: along a normal of either face, within the plane of either across
  /// its edges, or without a margin across an edge of each, the projections of the two are apart by more than all
  /// rounding can amount to. O(n + m + n m / vector width) for leaves of n and m faces; the result is valid until the
  /// next call.
  std::span<const Face_places> near_faces(std::uint32_t leaf_a, std::uint32_t leaf_b);

 private:
  /// A leaf as it was last looked at.
  struct Slot {
    std::uint32_t leaf;
    std::unique_ptr<Face_columns> faces;
    Aabb box;  ///< if the tree has none
  };
  /// Leaves of one tree.
  struct Side {
    Posed_layout posed;
    std::vector<Slot> slots;

    void begin(const Posed_layout& tree);
    Slot& at(std::uint32_t leaf);
  };
  static kernel::Leaf_view view(Side& side, std::uint32_t leaf);

  std::array<Side, 2> sides_;
  std::unique_ptr<kernel::Leaf_request> request_;
  std::unique_ptr<Leaf_scratch> scratch_;
  std::vector<Face_places> near_;
};

}  // namespace lodestone
