// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lodestone/filter/face_candidate.h"
#include "lodestone/tree/tree_view.h"

namespace lodestone {

struct Filter_scratch;
struct Face_columns;
namespace kernel {
struct Leaf_input;
struct Filter_request;
}  // namespace kernel

/// Leaf against leaf: which of their faces are near each other. Holds the memory that it needs; one per thread.
class Face_filter {
 public:
  Face_filter();
  ~Face_filter();
  Face_filter(Face_filter&&) noexcept;
  Face_filter& operator=(Face_filter&&) noexcept;

  /// What follows is about the leaves of these two trees, whose vertices do not move meanwhile: what has been read of a
  /// leaf is kept for the next ones that it meets.
  /// @param margin  >= 0
  void begin(const Layout_view& a, const Layout_view& b, double margin);
  /// The same for the leaves of one tree, and faces that share no vertex.
  void begin_within(const Layout_view& tree);

  /// The face pairs of two leaves that floating point does not prove to be apart; with a margin: farther apart than it.
  /// Each pair once if both leaves are one.
  ///
  /// The box around the near faces of the other leaf rules out faces, boxes of faces rule out pairs, and so do
  /// directions, of corners rounded to floats first: along a normal of either face, within the plane of either across
  /// its edges, or without a margin across an edge of each, the projections of the two are apart by more than all
  /// rounding can amount to. O(n + m + n m / vector width) for leaves of n and m faces; the result is valid until the
  /// next call.
  std::span<const Face_candidate> face_candidates(std::uint32_t leaf_a, std::uint32_t leaf_b);

 private:
  /// A leaf as it was last looked at.
  struct Slot {
    std::uint32_t leaf;
    std::unique_ptr<Face_columns> faces;
    Aabb box;  ///< if the tree has none
  };
  /// Leaves of one tree.
  struct Side {
    Layout_view posed;
    std::vector<Slot> slots;

    void begin(const Layout_view& tree);
    Slot& at(std::uint32_t leaf);
  };
  static kernel::Leaf_input view(Side& side, std::uint32_t leaf);

  std::array<Side, 2> sides_;
  std::unique_ptr<kernel::Filter_request> request_;
  std::unique_ptr<Filter_scratch> scratch_;
  std::vector<Face_candidate> near_;
};

}  // namespace lodestone
