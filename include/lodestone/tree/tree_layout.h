// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/container/static_vector.hpp>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/mesh/saved_state.h"
#include "lodestone/mesh/unset_vector.h"
#include "lodestone/mesh/workers.h"
#include "lodestone/volumes/leaf_faces.h"

namespace lodestone {

/// Options of a tree.
struct Region_tree_options {
  std::size_t leaf_faces = 96;  ///< most faces per leaf, 2 .. 128; the leaves of large regions are nearly full. A
                                ///< leaf that has been mended may hold a third more, at most 128
};

/// @throws Bad_argument  an option out of its range
void check(const Region_tree_options& options);

/// A region tree without its volumes: how the faces of one object are grouped, from its regions down to leaves of a few
/// dozen faces. Built once; nothing here changes when vertices move.
///
/// Every face is in one leaf. A leaf lists each vertex of its faces once, in ascending order, so that a refit reads
/// memory forwards, whatever the order of the vertices in the mesh.
///
/// Nodes are indexed in depth-first order: the first child directly follows its parent. So are leaves.
class Tree_layout {
 public:
  /// What lies below a node.
  struct Node {
    std::uint32_t second_child = 0;  ///< the first child is the next node; 0: the node is a leaf
    std::uint32_t leaf = 0;          ///< index of the first leaf at or below the node
    std::uint32_t end_leaf = 0;      ///< one past the last
  };
  /// A subtree that is refitted in one go. Its nodes and its leaves are consecutive.
  struct Part {
    std::uint32_t first_node = 0;  ///< its topmost node
    std::uint32_t end_node = 0;    ///< one past its last node
    std::uint32_t first_leaf = 0;  ///< its first leaf
    std::uint32_t end_leaf = 0;    ///< one past its last leaf
  };

  Tree_layout() = default;

  /// Groups the regions by halving their number again and again, and splits each region into as few leaves as possible,
  /// of nearly equal size. Both are split along the axis on which the centres are spread widest. O(F log F), shared
  /// among the workers; the result does not depend on their number.
  ///
  /// A face is grouped with the lowest of its corners' regions.
  ///
  /// @param corners      F >= 1 faces
  /// @param labels       V: region of each vertex; empty: a single region
  /// @param coordinates  3 V, all finite
  /// @throws Bad_argument  an option is out of range
  /// @throws Bad_mesh      more than 2^32 / 3 faces
  Tree_layout(std::span<const Corners> corners, std::span<const Region_index> labels, Coordinates coordinates,
              const Region_tree_options& options, Workers& workers = Workers::alone());

  /// The layout after a change of some faces. Leaves without such faces stay as they are. O(F), with a constant far
  /// below that of a new layout.
  /// @param corners      F' >= 1 faces, now
  /// @param changed      indices below F' of the faces that have other corners than in this layout. Faces at F and
  ///                     beyond count as new without being listed, those at F' and beyond as removed
  /// @param coordinates  3 V'
  /// @param options      this layout must have been made without labels; leaves that are a third fuller than the
  ///                     options say, or hold more than 128 faces, are split
  /// @return none if a new layout is better: many faces have changed, or many components are new; or if a
  ///         coordinate that is needed is not finite
  std::optional<Tree_layout> mended(std::span<const Corners> corners, std::span<const std::uint32_t> changed,
                                    Coordinates coordinates, const Region_tree_options& options,
                                    Workers& workers = Workers::alone()) const;

  /// Writes all that cannot be told from the rest. O(F).
  void save(State_writer& state) const;
  /// Reads what `save` has written. O(V + F).
  /// @param corners  F >= 1 faces
  /// @throws Bad_saved_object  the bytes are no layout of these faces
  static Tree_layout load(State_reader& state, std::span<const Corners> corners, std::size_t vertex_count);

  /// Number of nodes: one less than twice that of leaves.
  std::size_t node_count() const { return nodes_.size(); }
  /// What lies below a node.
  const Node& node(std::uint32_t n) const { return nodes_[n]; }
  /// Whether a node has no children.
  bool is_leaf(std::uint32_t n) const { return nodes_[n].second_child == 0; }

  /// Number of faces.
  std::size_t face_count() const { return faces_.size(); }

  /// Number of leaves, at least 1.
  std::size_t leaf_count() const { return leaf_nodes_.size(); }
  /// The node of a leaf.
  std::uint32_t leaf_node(std::size_t leaf) const { return leaf_nodes_[leaf]; }
  /// Indices of the faces of a leaf.
  std::span<const std::uint32_t> faces(std::size_t leaf) const {
    return {faces_.data() + face_begin_[leaf], faces_.data() + face_begin_[leaf + 1]};
  }
  /// Indices of the vertices of a leaf, ascending.
  std::span<const std::uint32_t> vertices(std::size_t leaf) const {
    return {vertices_.data() + vertex_begin_[leaf], vertices_.data() + vertex_begin_[leaf + 1]};
  }
  /// Per face of a leaf: its corners, as indices into `vertices(leaf)`.
  std::span<const Leaf_corners> corners(std::size_t leaf) const {
    return {corners_.data() + face_begin_[leaf], corners_.data() + face_begin_[leaf + 1]};
  }
  /// The faces of a leaf, at these coordinates.
  Leaf_faces leaf_faces(std::size_t leaf, Coordinates coordinates) const {
    return {coordinates, vertices(leaf), corners(leaf)};
  }

  /// Subtrees that can be refitted in any order and by several threads.
  std::span<const Part> parts() const { return parts_; }
  /// The nodes above all parts, parents before children.
  std::span<const std::uint32_t> top_nodes() const { return top_nodes_; }

  /// The vertex lists of all leaves, one after the other, padded with valid indices for kernels that read ahead.
  std::span<const std::uint32_t> all_vertices() const { return vertices_; }
  /// Per leaf and past the last: where its list in `all_vertices` starts.
  std::span<const std::uint32_t> vertex_begin() const { return vertex_begin_; }
  /// Per leaf: the index of its node.
  std::span<const std::uint32_t> leaf_nodes() const { return leaf_nodes_; }

  /// At most so many are the nodes three levels below the root.
  static constexpr std::size_t most_branches = 8;
  /// Nodes by index.
  using Branches = boost::container::static_vector<std::uint32_t, most_branches>;
  /// The nodes three levels below the root, and the leaves above them, ascending. Each leaf is below one of them.
  Branches branches() const;

  /// Per node: the node above it; the root's is itself. O(N) for N nodes.
  std::vector<std::uint32_t> parents() const;

  /// Whether all coordinates that faces use are finite. O(V).
  bool finite(Coordinates coordinates) const;

 protected:
  /// Describes the first violation of the definition above; empty if there is none. O(V + F).
  std::string validate_layout(std::span<const Corners> corners, std::size_t vertex_count) const;

 private:
  friend class Tree_builder;
  friend class Tree_mender;

  static void check(std::span<const Corners> corners, const Region_tree_options& options);
  std::string validate_leaves(std::span<const Corners> corners, std::size_t vertex_count) const;
  std::string validate_nodes() const;
  void finish();
  void find_parts();

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> leaf_nodes_;
  std::vector<std::uint32_t> face_begin_;  ///< per leaf and past the last: where it starts in `faces_` and `corners_`
  std::vector<std::uint32_t> vertex_begin_;
  Unset_vector<std::uint32_t> faces_;
  Unset_vector<std::uint32_t> vertices_;
  Unset_vector<Leaf_corners> corners_;  ///< padded for kernels that read ahead
  std::vector<Part> parts_;
  std::vector<std::uint32_t> top_nodes_;
};

}  // namespace lodestone
