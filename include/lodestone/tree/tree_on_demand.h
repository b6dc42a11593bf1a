// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/mesh/live_positions.h"
#include "lodestone/tree/node_anchors.h"
#include "lodestone/tree/tree_view.h"

namespace lodestone {

/// A tree over the faces of one object that reads positions only where it is looked at: one vertex per node, its
/// anchor, and all vertices of the leaves that are posed. In a frame no anchor and no leaf is read twice. A vertex is
/// read again only for another node or leaf.
///
/// A node is taken to lie within its radius of its anchor, times `stretch()`. That is a guess, right as long as none of
/// its points has moved farther away from the anchor than so since the tree was built: by local stretch, or because the
/// surface was bent and is straightened.
class Tree_on_demand {
 public:
  Tree_on_demand() = default;
  /// O(F log F + V log V).
  /// @param corners, labels, coordinates, options, workers  as of Tree_layout; coordinates are those at rest
  Tree_on_demand(std::span<const Corners> corners, std::span<const Region_index> labels, Coordinates coordinates,
                 const Region_tree_options& options, Workers& workers = Workers::alone());

  /// Writes the tree and its anchors. O(F).
  void save(State_writer& state) const;
  /// Reads what `save` has written. O(V + F).
  /// @throws Bad_saved_object  the bytes are no tree over these faces
  static Tree_on_demand load(State_reader& state, std::span<const Corners> corners, std::size_t vertex_count);

  /// Forgets what was read. O(1).
  void start_frame(const Live_positions& positions);

  /// How the faces are grouped.
  const Tree_layout& layout() const { return layout_; }
  /// Number of vertices, V.
  std::size_t vertex_count() const { return vertex_count_; }

  /// Where the anchor of a node is.
  /// @throws Bad_mesh  a coordinate is not finite
  const Eigen::Vector3d& anchor(std::uint32_t n) {
    Node& node = nodes_[n];
    if (node.frame != frame_) read_anchor(node);
    return node.position;
  }
  /// How far from its anchor the vertices of a node reach, if the surface is stretched by `stretch()`.
  double radius(std::uint32_t n) const { return stretch_ * nodes_[n].radius; }

  /// Reads the positions of a leaf's vertices, unless they have been read in this frame.
  /// @return its box
  /// @throws Bad_mesh  a coordinate is not finite
  const Aabb& pose(std::uint32_t leaf) {
    if (posed_[leaf] != frame_) read_leaf(leaf);
    return boxes_[layout_.leaf_node(leaf)];
  }
  /// Poses all leaves below a node, and fits the boxes of all nodes there, unless that has been done in this frame.
  /// @throws Bad_mesh  a coordinate is not finite
  void pose_below(std::uint32_t n) {
    if (posed_below_[n] != frame_) read_below(n);
  }
  /// The box of a node, if it or a node above has been given to `pose_below` in this frame, or if it is a posed leaf.
  const Aabb& box(std::uint32_t n) const { return boxes_[n]; }
  /// Whether a leaf has been posed in this frame.
  bool is_posed(std::uint32_t leaf) const { return posed_[leaf] == frame_; }
  /// What has been posed. Only leaves that were posed in this frame may be read.
  Layout_view view() const { return {&layout_, coordinates_, bounds_, boxes_}; }
  /// Encloses all leaves that were posed in this frame, loosely.
  const Aabb& bounds() const { return bounds_; }

  /// How much longer than at rest the surface is taken to be; >= 1. A frame begins with 1; `note_distance` raises it.
  double stretch() const { return stretch_; }
  /// Takes note of a distance between two vertices that are at most `at_rest` apart at rest.
  void note_distance(double now, double at_rest) {
    if (now > stretch_ * at_rest && at_rest > 0) stretch_ = now / at_rest;
  }

  /// Positions read in this frame.
  std::size_t vertices_read() const { return vertices_read_; }

 private:
  Tree_on_demand(Tree_layout layout, std::span<const Node_anchor> anchors, std::size_t vertex_count);

  /// All that a look at a node needs, in one place of the memory.
  struct Node {
    Eigen::Vector3d position;
    double radius = 0;
    std::uint64_t frame = 0;  ///< of the position
    std::uint32_t vertex = 0;
  };

  Aabb guessed_bounds();
  void read_anchor(Node& node);
  void read_leaf(std::uint32_t leaf) { read_leaves(leaf, leaf + 1); }
  void read_leaves(std::uint32_t first, std::uint32_t end);
  void read_below(std::uint32_t n);
  void copy_leaf(std::uint32_t leaf);

  Tree_layout layout_;
  std::vector<Node> nodes_;
  std::vector<std::uint64_t> posed_;        ///< per leaf: the frame in which it was last posed
  std::vector<std::uint64_t> posed_below_;  ///< per node: the frame in which all below was last posed
  std::vector<Aabb> boxes_;                 ///< per node: see `box`
  std::size_t vertex_count_ = 0;
  Coordinates coordinates_ = {};  ///< 3 V, of the mesh or `copied_`: only those of posed leaves may be read
  std::vector<double> copied_;    ///< 3 V, where the positions do not lie in memory
  Aabb bounds_ = {};
  bool bounded_ = false;  ///< whether `bounds_` is of this frame
  Live_positions positions_;
  std::uint64_t frame_ = 0;
  double stretch_ = 1;
  std::size_t vertices_read_ = 0;
};

}  // namespace lodestone
