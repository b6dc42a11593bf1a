// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "lodestone/contact/tree_box.h"
#include "lodestone/partition/mesh_numbering.h"

namespace lodestone {

/// Coordinates of all vertices in one frame, by vertex number: x, y, z, x, y, z, ...; 3 V values.
using Coordinates = std::span<const double>;

struct Region_tree_options {
  std::size_t leaf_faces = 96;  ///< most faces of a leaf, 2 .. 128; leaves of large regions have at least half as many
};

/// A hierarchy of axis-aligned boxes over the faces of one object: its regions, split further down to leaves of a few
/// dozen faces. Built once, refitted in every frame.
///
/// Every face is in one leaf. A leaf lists the vertices of its faces once, in ascending order, so that a refit walks
/// through memory forwards whatever the order of the vertices in the mesh. No box of a single face is kept.
///
/// Nodes are numbered in the order in which a depth-first walk meets them: the first child follows its parent. So are
/// leaves.
class Region_tree {
 public:
  /// A node's place below others.
  struct Node {
    std::uint32_t second_child = 0;  ///< the first one is the next node; 0: the node is a leaf
    std::uint32_t leaf = 0;          ///< number of the first leaf at or below the node
  };

  Region_tree() = default;

  /// Groups the regions, and splits each, at the median of their centres along the axis on which these are spread
  /// widest. The boxes are those of `coordinates`. O(F log F).
  ///
  /// A face belongs to the lowest region that one of its corners is in.
  ///
  /// @param corners      F >= 1 faces
  /// @param labels       V: region of each vertex; empty: a single region
  /// @param coordinates  3 V, all finite
  /// @throws Bad_argument  an option out of range
  /// @throws Bad_mesh      more than 2^32 / 3 faces
  Region_tree(std::span<const Corners> corners, std::span<const Region_index> labels, Coordinates coordinates,
              const Region_tree_options& options = {});

  /// Fits all boxes to where the vertices are now: each vertex of each leaf is read once. O(V).
  /// @return false: a coordinate is not finite, and the boxes mean nothing until the next refit
  bool refit(Coordinates coordinates);

  /// How many parts a refit consists of. Parts can be refitted in any order and by several threads, then `finish_refit`
  /// joins them: the boxes are the same as those of `refit`.
  std::size_t part_count() const { return parts_.size(); }
  void refit_part(std::size_t part, Coordinates coordinates);
  bool finish_refit(Coordinates coordinates);

  /// Mean extent of a leaf's box (sum of its three sides), in extents of the root's box. It grows when leaves are
  /// pulled apart, and is the same for a mesh that is moved, turned by right angles, or scaled. 0 for a point.
  double looseness() const { return looseness_; }

  /// What contradicts the definition above, in words; empty if nothing does. For tests: O(F log F).
  /// @param corners, coordinates  of the mesh, and of the last refit
  std::string validate(std::span<const Corners> corners, Coordinates coordinates) const;

  std::size_t node_count() const { return nodes_.size(); }
  const Node& node(std::uint32_t n) const { return nodes_[n]; }
  bool is_leaf(std::uint32_t n) const { return nodes_[n].second_child == 0; }
  const Tree_box& box(std::uint32_t n) const { return boxes_[n]; }

  std::size_t leaf_count() const { return leaf_nodes_.size(); }
  std::size_t most_leaf_faces() const { return most_leaf_faces_; }
  std::size_t most_leaf_vertices() const { return most_leaf_vertices_; }
  /// Numbers of the faces of a leaf.
  std::span<const std::uint32_t> faces(std::size_t leaf) const {
    return {faces_.data() + face_begin_[leaf], faces_.data() + face_begin_[leaf + 1]};
  }
  /// Numbers of its vertices, ascending.
  std::span<const std::uint32_t> vertices(std::size_t leaf) const {
    return {vertices_.data() + vertex_begin_[leaf], vertices_.data() + vertex_begin_[leaf + 1]};
  }
  /// Per face of a leaf: its corners, as places in `vertices(leaf)`.
  std::span<const Leaf_corners> corners(std::size_t leaf) const {
    return {corners_.data() + face_begin_[leaf], corners_.data() + face_begin_[leaf + 1]};
  }
  std::uint32_t leaf_node(std::size_t leaf) const { return leaf_nodes_[leaf]; }

 private:
  friend class Tree_builder;

  /// A subtree that is refitted in one go: nodes and leaves are consecutive.
  struct Part {
    std::uint32_t first_node = 0, end_node = 0;
    std::uint32_t first_leaf = 0, end_leaf = 0;
    double coordinate_sum = 0;  ///< not finite if a coordinate is not
    double leaf_extents = 0;
  };

  void find_parts();
  void enclose_children(std::uint32_t n);

  std::vector<Tree_box> boxes_;  ///< per node
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> leaf_nodes_;    ///< per leaf: its node
  std::vector<std::uint32_t> face_begin_;    ///< per leaf and past the last: its start in `faces_` and `corners_`
  std::vector<std::uint32_t> vertex_begin_;  ///< per leaf and past the last: its start in `vertices_`
  std::vector<std::uint32_t> faces_;
  std::vector<std::uint32_t> vertices_;  ///< with some more at the end, for a refit that looks ahead
  std::vector<Leaf_corners> corners_;
  std::vector<Part> parts_;
  std::vector<std::uint32_t> top_nodes_;  ///< above the parts, parents before children
  std::size_t most_leaf_faces_ = 0, most_leaf_vertices_ = 0;
  double looseness_ = 0;
};

}  // namespace lodestone
