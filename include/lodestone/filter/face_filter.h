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

/// Leaf against leaf: discards the face pairs that floating point proves apart, and no others.
///
/// Holds the memory that it needs, so each thread needs its own.
class Face_filter {
 public:
  /// Has no trees yet: see `begin`.
  Face_filter();
  ~Face_filter();
  /// Takes over the memory of another filter, which can then only be assigned to or destroyed.
  Face_filter(Face_filter&&) noexcept;
  /// Takes over the memory of another filter, in place of its own.
  Face_filter& operator=(Face_filter&&) noexcept;

  /// Sets the two trees whose leaves the next calls compare.
  ///
  /// The vertices must not move until the next `begin`: what has been read of a leaf is kept.
  /// @param margin  >= 0; only pairs farther apart than this are discarded
  void begin(const Layout_view& a, const Layout_view& b, double margin);
  /// The same for leaves of one tree. Pairs of faces that share a vertex are discarded too.
  void begin_within(const Layout_view& tree, double margin);

  /// The face pairs of two leaves that are not proven apart; if the two are one leaf of one tree, each pair once.
  ///
  /// Faces outside the box around the other leaf's nearest faces are discarded. Where many pairs of boxes seem to
  /// overlap, so are faces that only pass by that box: long oblique ones. Then pairs whose boxes do not overlap, then
  /// pairs whose projections onto some direction are farther apart than the margin and any rounding. The
  /// directions are both normals, those across an edge within its plane, and with margin 0 those across one edge of
  /// each face.
  ///
  /// O(n + m + n m / lanes) for leaves of n and m faces.
  /// @return valid until the next call
  std::span<const Face_candidate> face_candidates(std::uint32_t leaf_a, std::uint32_t leaf_b);

 private:
  /// What is kept of one leaf.
  struct Slot {
    std::uint32_t leaf;
    std::unique_ptr<Face_columns> faces;
    Aabb box;  ///< if the tree has no boxes
  };
  /// One tree, and what is kept of its leaves.
  struct Side {
    Layout_view view;
    std::vector<Slot> slots;

    void begin(const Layout_view& tree);
    Slot& slot_of(std::uint32_t leaf);
    kernel::Leaf_input input(std::uint32_t leaf);
  };

  /// Two leaves that are too small to be rounded as the trees are.
  struct Alone;

  const kernel::Filter_request& round_alone(kernel::Leaf_input& a, kernel::Leaf_input& b);

  std::array<Side, 2> sides_;
  std::unique_ptr<kernel::Filter_request> request_;
  std::unique_ptr<Alone> alone_;  ///< null before it is needed
  std::unique_ptr<Filter_scratch> scratch_;
  std::vector<Face_candidate> candidates_;
};

}  // namespace lodestone
