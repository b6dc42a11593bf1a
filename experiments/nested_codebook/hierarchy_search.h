// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lodestone/mesh/box.h"
#include "lodestone/mesh/pairs.h"
#include "nested_codebook/face_hierarchy.h"

namespace lodestone {

/// What searches read and reached, summed over object pairs and frames.
struct Search_counts {
  std::size_t opened = 0;            ///< pairs of nodes whose children were looked at
  std::size_t anchors = 0;           ///< nodes whose anchor was read
  std::size_t leaves = 0;            ///< leaves whose vertices were read
  std::size_t leaf_pairs = 0;        ///< pairs of leaves whose boxes overlap: their faces would be compared
  std::size_t vertices = 0;          ///< positions read: anchors, and the vertices of leaves
  std::size_t read_to_first = 0;     ///< positions read until the first leaf pair with a contact, where there is one
  std::size_t colliding = 0;         ///< object pairs with contacts
  std::size_t reached = 0;           ///< of these: a leaf pair with a contact was reached
  std::size_t contacts = 0;          ///< true face pairs
  std::size_t contacts_reached = 0;  ///< of these: in leaf pairs that were reached
};

/// A hierarchy in the current frame, with a record of what was read. In a frame nothing is read twice.
class Hierarchy_in_frame {
 public:
  explicit Hierarchy_in_frame(Face_hierarchy hierarchy);

  /// @param positions  V x 3, must outlive the frame
  void start_frame(const Positions& positions);

  std::span<const std::uint32_t> roots() const { return hierarchy_.roots; }
  const Face_node& node(std::uint32_t n) const { return hierarchy_.nodes[n]; }
  bool is_leaf(std::uint32_t n) const { return node(n).second_child == 0; }
  std::size_t leaf_count() const;
  /// The leaf of a face, as the index of its node.
  std::uint32_t leaf_of(std::uint32_t face) const { return leaf_of_[face]; }

  Eigen::Vector3d anchor(std::uint32_t n);
  const Box& box(std::uint32_t leaf);

  std::size_t vertices_read() const { return anchors_ + leaf_vertices_; }
  /// Adds what was read in this frame.
  void add_reads(Search_counts& counts) const;

 private:
  Face_hierarchy hierarchy_;
  std::vector<std::uint32_t> leaf_of_;
  const Positions* positions_ = nullptr;
  std::size_t frame_ = 0;
  std::vector<std::size_t> anchor_read_, leaf_read_;  ///< per node: the frame of the last read
  std::vector<Box> boxes_;                            ///< per node: of leaves that were read
  std::size_t anchors_ = 0, leaves_ = 0, leaf_vertices_ = 0;
};

/// Opens pairs of nodes from all pairs of regions down as Opening_search does, nearest first relative to their radii,
/// until none is left. Two nodes are taken to be apart if their anchors are farther apart than `reach` times the sum of
/// their radii.
/// @param contacts  the true face pairs of the two surfaces in this frame
void search(Hierarchy_in_frame& a, Hierarchy_in_frame& b, double reach, std::span<const Face_pair> contacts,
            Search_counts& counts);

}  // namespace lodestone
