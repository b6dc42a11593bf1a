// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/dynamic_bitset.hpp>

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
  /// In the lower half a face that is not where it was, or new, in the upper the former leaf that takes it.
  using Placed_face = std::uint64_t;
  static std::uint32_t leaf_with(Placed_face placed) { return static_cast<std::uint32_t>(placed >> 32U); }
  using Vertex_leaves = Unset_vector<std::uint32_t>;  ///< of the vertices of moved faces; all others are not set

  void find_left_faces();
  bool place_faces();
  bool place_waiting_faces(Vertex_leaves& leaf_of, std::span<const std::uint32_t> waiting);
  bool place(std::uint32_t face, Vertex_leaves& leaf_of, std::vector<std::uint32_t>& reached);
  void find_leaves_of_vertices(std::span<const std::uint32_t> faces, bool everywhere, Vertex_leaves& leaf_of) const;
  bool size_leaves();
  void add_node(std::uint32_t former_node, std::size_t level, std::vector<Branch>& branches);
  void copy_leaves();
  void fill_items(std::uint32_t former_leaf, std::uint32_t begin, bool with_centres);
  std::uint32_t leaves_below(std::uint32_t former_node) const;

  const Tree_layout& former_;
  boost::dynamic_bitset<> left_;           ///< per former or new face: whether it has left its leaf
  std::vector<std::uint32_t> moved_;       ///< the changed and the new faces, ascending
  std::vector<Placed_face> placed_;        ///< the same with their leaves, ascending
  std::vector<bool> touched_;              ///< per former leaf: whether its faces are others now
  std::vector<std::uint32_t> face_count_;  ///< per former leaf: of its faces now
  std::vector<std::uint32_t> leaf_begin_;  ///< per former leaf and past the last: the first of the leaves it becomes
  std::vector<std::uint32_t> face_begin_;  ///< per former leaf: where its faces start
  std::uint32_t next_node_ = 0, next_item_ = 0;
  std::size_t levels_ = 0;  ///< of the mended tree
  bool finite_ = true;      ///< the centres of faces that are split
};

}  // namespace lodestone
