// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tree/tree_builder.h"

namespace lodestone {

/// Makes a Tree_layout from a former one of which some faces have changed: leaves without such faces are copied, the
/// others are made anew.
class Tree_mender : private Tree_builder {
 public:
  /// @param former   of the faces as they were
  /// @param changed  indices of faces with other corners; those beyond the former number of faces are new in any case
  Tree_mender(const Tree_layout& former, Tree_layout& tree, std::span<const Corners> corners,
              std::span<const std::uint32_t> changed, Coordinates coordinates, const Region_tree_options& options,
              Workers& workers);

  /// @return false if a whole build is better or needed; the tree is then unusable
  bool mend();

 private:
  /// A face that is not where it was, or new, and the former leaf that takes it.
  struct Placed_face {
    std::uint32_t leaf, face;
    auto operator<=>(const Placed_face&) const = default;
  };

  bool place_faces();
  bool place_waiting_faces(std::vector<std::uint32_t>& leaf_of, std::vector<std::uint32_t> waiting);
  bool place(std::uint32_t face, std::vector<std::uint32_t>& leaf_of, std::vector<std::uint32_t>& reached);
  void find_leaves_of_vertices(std::vector<std::uint32_t>& leaf_of) const;
  bool size_leaves();
  void add_node(std::uint32_t former_node, std::vector<Branch>& branches);
  void copy_leaf(std::uint32_t former_leaf, const Branch& branch);
  void fill_items(std::uint32_t former_leaf, bool with_centres);
  std::uint32_t leaves_below(std::uint32_t former_node) const;

  const Tree_layout& former_;
  std::vector<std::uint8_t> left_;         ///< per former or new face: 1 if it has left its leaf
  std::vector<std::uint32_t> moved_;       ///< the changed and the new faces, ascending
  std::vector<Placed_face> placed_;        ///< the same with their leaves, ascending
  std::vector<bool> touched_;              ///< per former leaf: whether its faces are others now
  std::vector<std::uint32_t> face_count_;  ///< per former leaf: of its faces now
  std::vector<std::uint32_t> leaf_begin_;  ///< per former leaf and past the last: the first of the leaves it becomes
  std::vector<std::uint32_t> face_begin_;  ///< per former leaf: where its faces start
  std::uint32_t next_node_ = 0;
};

}  // namespace lodestone
