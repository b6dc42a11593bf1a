// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/bounds/motion_bound.h"
#include "lodestone/bounds/node_bound.h"
#include "lodestone/mesh/position_source.h"
#include "lodestone/volumes/aabb.h"

namespace lodestone {

class Stretch_promise;

/// A vertex by whose position others are judged.
struct Landmark {
  std::uint32_t vertex = 0;  ///< its index
  double radius = 0;         ///< rho: the longest of the shortest paths from here to the vertices that it answers for
};

/// Boxes from a Stretch_promise. Reads the positions of one to three landmarks per node. A model of
/// All_watching_bound and Reading_bound.
///
/// Each vertex of a node answers to the landmark p that is nearest along edges at rest. It lies within
/// sigma rho + 2 e of p, since each edge of a shortest path is at most sigma times as long as at rest. Paths may leave
/// the node. The box of the node is that around the boxes of its landmarks.
///
/// A node whose faces are connected has one landmark, the vertex nearest to the centre of its box: more of them give no
/// smaller boxes than those of its children would. Where a thin body has both its sides in one node, a path from one to
/// the other is long. So each connected part of a node has a landmark of its own, the three largest if there are more.
/// If the search for the paths comes to many more vertices than the node has, or does not come to all of them, the node
/// uses the landmarks of its parent. A vertex that no landmark of the root reaches makes the root's box open.
///
/// *Rounding.* Lengths of edges at rest are rounded up to 4 times, and by each sum along a path of at most V edges.
/// Radii are longer by 2 * 10^-9 + 2^-51 V times their length: half of the first covers the rounding of lengths, of
/// sigma rho + 2 e, and of what 2^-51 V leaves of the sums; the other half covers what `note_read` lets pass. 2 e is
/// made 10^-9 longer. Boxes are moved outwards by one double. Squares of lengths below 10^-150 underflow, so 10^-150 is
/// added to each length.
class Stretch_bound {
 public:
  /// O(V log V log N) for N nodes. Copies the rest.
  /// @param promise        must outlive this, as must the object's layout and positions
  /// @throws Bad_argument  `object` has other vertices than its positions; the rest has the wrong length
  Stretch_bound(const Stretch_promise& promise, const Bounded_object& object);

  /// Number of nodes of the tree.
  std::size_t node_count() const { return begin_.size(); }
  /// The box of a node in the current pose: one position for each of its landmarks.
  Aabb box(std::uint32_t node) const;
  /// The same; adds those positions, unless the landmarks are those of the node's parent.
  Aabb box(std::uint32_t node, std::vector<Eigen::Vector3d>& read) const;
  /// Compares the edges of a leaf that has been read with what was promised.
  /// @return false: an edge of the leaf is longer than was promised, by more than 10^-9 of its length. O(faces).
  bool note_read(std::uint32_t leaf, const Aabb& fitted, Coordinates coordinates) const;
  /// Compares all edges, or those of one leaf in 64, of others in each call: to compare all takes several times as long
  /// as to read all vertices.
  /// @return as `note_read`
  bool note_all(std::span<const Aabb> fitted, Coordinates coordinates, bool all);
  /// See Node_bound.
  std::size_t effort() const { return 120; }

  /// The landmarks of a node.
  std::span<const Landmark> landmarks(std::uint32_t node) const {
    return {landmarks_.data() + begin_[node], landmarks_.data() + end_[node]};
  }

 private:
  /// Between two vertices of a leaf, by index in its list.
  struct Leaf_edge {
    std::uint16_t from, to;
    auto operator<=>(const Leaf_edge&) const = default;
  };
  void list_edges();
  template <class Note>
  Aabb box_around_landmarks(std::uint32_t node, Note note) const;

  const Stretch_promise* promise_;
  const Tree_layout* layout_;
  const Position_source* positions_;
  std::vector<double> rest_;                ///< 3 V
  std::vector<Landmark> landmarks_;         ///< of the nodes that have their own
  std::vector<std::uint32_t> begin_, end_;  ///< per node: where its landmarks stand; maybe those of its parent
  std::vector<bool> has_own_;               ///< per node: they are not those of its parent
  std::vector<std::uint32_t> edge_begin_;   ///< per leaf and past the last: where its edges start
  std::vector<Leaf_edge> edges_;            ///< of each leaf, each once
  std::vector<double> squared_;             ///< per edge: its squared length at rest
  std::size_t turn_ = 0;                    ///< calls of `note_all`
};

/// A promise: no edge is ever longer than sigma times its length at rest. A model of Motion_promise.
///
/// The edges are those of the faces. Sigma is 1 for inextensible cloth that can shrink but not stretch. Vertices that
/// no path of edges connects are not bounded by each other: seams whose vertices are doubled tear a surface apart.
///
/// With e = 0 the promise is about positions as they are computed. Otherwise it is about exact ones, and computed ones
/// are within e of them.
class Stretch_promise {
 public:
  /// @throws Bad_argument  as `set_stretch`
  explicit Stretch_promise(double stretch = 1, double error = 0) { set_stretch(stretch, error); }
  Stretch_promise(const Stretch_promise&) = delete;
  Stretch_promise& operator=(const Stretch_promise&) = delete;

  /// Promises another sigma, for the poses to come.
  /// @param stretch        sigma: finite, >= 0
  /// @param error          e: how far a position may be from the exact one, in units of the coordinates; finite, >= 0
  /// @throws Bad_argument  one of them is out of range; the promise stays as it was
  void set_stretch(double stretch, double error = 0);
  /// Sigma.
  double stretch() const { return stretch_; }
  /// The distance e, in units of the coordinates.
  double error() const { return error_; }

  /// The bound for one object, which this must outlive. O(V log V log N) for N nodes.
  Stretch_bound bound(const Bounded_object& object) const { return {*this, object}; }

 private:
  double stretch_ = 1, error_ = 0;
};

}  // namespace lodestone
