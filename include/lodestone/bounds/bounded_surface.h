// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lodestone/bounds/motion_bound.h"
#include "lodestone/bounds/node_bound.h"
#include "lodestone/mesh/position_source.h"
#include "lodestone/mesh/unset_vector.h"
#include "lodestone/tree/tree_surface.h"

namespace lodestone {

/// A vertex of a surface, and a leaf that lists it.
struct Leaf_vertex {
  std::uint32_t leaf = 0;    ///< its index
  std::uint32_t vertex = 0;  ///< its index in the mesh
};

/// A surface whose nodes are bounded without being read, and whose leaves are posed when a query needs their faces.
/// Nothing is done before it is asked for. Nothing is done twice in a pose, except that leaves which were posed one by
/// one are posed again with all, and that single vertices are read as often as they are asked for. A node below which
/// all leaves have been posed has the box fitted to them.
///
/// A bound is a promise, and what is read is compared with it:
/// - the vertices of a leaf that is posed, with the boxes of the leaf and of the whole, and with those in use between;
/// - a vertex that is read alone, with the boxes in use of its leaf and above it;
/// - positions of a node that its bounds have read, with the box of the node;
/// - the leaves below a node, once all of them have been posed, with the node's box if that was in use;
/// - all vertices, where all are posed, with the box of the whole and with all boxes in use.
///
/// A node's box lies in that of the node above it, if that was in use before. A box that is made later is not compared
/// with what has been read below its node, until all leaves there have been posed.
///
/// If a vertex lies outside, or if bounds have no point in common, `is_broken()` says so, and a query that relied on
/// boxes must `settle` the surface and ask again.
///
/// Boxes, and leaves that are posed one by one, can take longer than to pose all. Both are counted, in vertices that
/// could have been posed in order in that time. Once the count exceeds the vertices of all leaves, all are posed. The
/// next frame then poses all as soon as it needs more than the box of the whole. After that leaves are tried again;
/// each further try that fails is followed by 2, 4 and at most 32 such frames. A frame that needs only the box of the
/// whole ends that.
///
/// Boxes and positions are written to the tree's surface. Not for several threads at once.
class Bounded_surface {
 public:
  /// How much is known about a leaf in the current pose.
  enum class Leaf_state {
    far,      ///< nothing: no query has asked
    bounded,  ///< a box around it
    posed,    ///< where its vertices are
  };

  /// Points and bounds of any type.
  /// @param tree           has been built; must outlive this, as must what follows
  /// @param points         of the same vertices
  /// @param bounds         of the same nodes: a node lies in what all of them have in common
  /// @throws Bad_argument  they have other vertices, or other nodes
  template <Computed_points Points, class... Bounds>
  requires(sizeof...(Bounds) > 0 && (Motion_bound<std::remove_const_t<Bounds>> && ...))
      Bounded_surface(Tree_surface& tree, const Points& points, Bounds&... bounds)
      : Bounded_surface(tree, std::make_unique<Computed_source<Points>>(points), list_of(bounds...)) {}
  /// @param positions  of the vertices of the tree
  /// @param bounds     none: everything is posed as soon as a box is needed
  /// @param workers    share what is done to all vertices; must outlive this
  /// @param title      names the object in messages
  Bounded_surface(Tree_surface& tree, std::unique_ptr<const Position_source> positions,
                  std::vector<std::unique_ptr<Node_bound>> bounds, Workers& workers = Workers::alone(),
                  std::string title = {});

  /// Has all be compared with what was promised, also where all vertices are posed: boxes of all leaves are asked for
  /// then, and watching bounds compare all (see All_watching_bound).
  void compare_all(bool all) { compares_all_ = all; }

  /// Forgets what was of an earlier pose, unless it is known to be that of now. O(1).
  void start_frame();
  /// The next frame is a new one even in this pose: asks the bounds anew.
  void forget_pose() { pose_ = 0; }
  /// Starts a frame to whose positions the tree has just been refitted. O(F).
  void take_refitted();
  /// Compares bounds that have just been made with the positions that were taken: what they say may be broken already.
  /// Asks for the box of the whole; with `compare_all` also for those of all leaves.
  void compare_refitted();

  /// How the faces are grouped.
  const Tree_layout& layout() const { return tree_->tree(); }
  /// The surface whose boxes and positions are written.
  Tree_surface& tree() const { return *tree_; }
  /// Where positions come from.
  const Position_source& positions() const { return *positions_; }
  /// The node above a node; the root's is itself.
  std::uint32_t parent(std::uint32_t node) const { return parents_[node]; }
  /// Whether there is any bound; without one, everything is posed at once.
  bool has_bounds() const { return !bounds_.empty(); }

  /// A box around the vertices of a node: from the bounds, or fitted where positions are known.
  const Aabb& box(std::uint32_t node) {
    if (boxed_in_[node] != frame_) bound(node);
    return boxes_[node];
  }
  /// Poses the vertices of a leaf; all vertices at once when a large share is posed already.
  /// @return the fitted box
  /// @throws Bad_mesh  a coordinate is not finite
  const Aabb& pose(std::uint32_t leaf) {
    if (posed_in_[leaf] != frame_) read(leaf);
    return boxes_[layout().leaf_node(leaf)];
  }
  /// One vertex of each connected component, with a leaf. O(V) in the first call, then O(1).
  std::span<const Leaf_vertex> component_vertices();
  /// Where a vertex is: reads it, unless its leaf has been posed.
  /// @throws Bad_mesh  a coordinate is not finite
  Eigen::Vector3d position(const Leaf_vertex& at);
  /// Poses all vertices and fits all boxes. O(V).
  /// @throws Bad_mesh  a coordinate that a face uses is not finite
  void pose_all();
  /// The same after a broken bound: all boxes are fitted, so nothing is broken any more.
  void settle();

  /// Whether all vertices have been posed in this frame.
  bool all_posed() const { return all_posed_; }
  /// Whether a leaf has been posed in this frame.
  bool is_posed(std::uint32_t leaf) const { return posed_in_[leaf] == frame_; }
  /// How much is known about a leaf in this frame.
  Leaf_state leaf_state(std::uint32_t leaf) const {
    if (is_posed(leaf)) return Leaf_state::posed;
    return boxed_in_[layout().leaf_node(leaf)] == frame_ ? Leaf_state::bounded : Leaf_state::far;
  }
  /// What has been posed. Only leaves that were posed in this frame may be read. The coordinates can be those of the
  /// mesh: valid until it changes, or other positions are given.
  /// @pre the root has a box in this frame, and it is finite
  Layout_view view() const { return {&layout(), tree_->coordinates(), boxes_[0], boxes_}; }

  /// Whether a position of this frame was outside a box that was in use, and the surface has not been settled since.
  bool is_broken() const { return violations_ > violations_settled_; }
  // Counts of this frame.
  std::size_t violations() const { return violations_; }        ///< boxes with positions outside, promises not kept
  std::size_t nodes_bounded() const { return nodes_bounded_; }  ///< boxes that came from bounds
  /// Leaves whose vertices were read; all of them once all vertices are posed.
  std::size_t leaves_posed() const { return leaves_posed_; }
  std::size_t vertices_posed() const { return vertices_posed_; }  ///< those of several leaves count for each

 private:
  template <class... Bounds>
  static std::vector<std::unique_ptr<Node_bound>> list_of(Bounds&... bounds) {
    std::vector<std::unique_ptr<Node_bound>> list;
    (list.push_back(std::make_unique<Node_bound_of<Bounds&>>(bounds)), ...);
    return list;
  }
  template <class Pose>
  auto or_start_over(const Pose& pose);
  void follow_positions();
  void plan_frame();
  bool is_paused() const { return pause_left_ > 0; }
  bool takes_long() const;
  void give_up();
  void bound(std::uint32_t node);
  bool take_box(std::uint32_t node);
  void take_boxes_to_compare();
  Aabb box_from_bounds(std::uint32_t node);
  template <class Contained>
  bool lies_in_boxes_in_use(std::uint32_t node, const Contained& contained) const;
  void read(std::uint32_t leaf);
  void fit_parents_of(std::uint32_t node);
  void note_refitted();
  void note_read(std::uint32_t leaf);
  bool note_read(Node_bound& bound, std::uint32_t leaf) const;
  bool note_all(Node_bound& bound) const;
  void check_finite(std::uint32_t leaf) const;

  Tree_surface* tree_;
  std::unique_ptr<const Position_source> positions_;
  std::vector<std::unique_ptr<Node_bound>> bounds_;
  Workers* workers_;
  std::string title_;
  Unset_vector<double> posed_;  ///< 3 V: those of posed leaves mean something; empty as long as positions lie in memory
  bool in_memory_ = false;      ///< the tree reads positions where they lie, `posed_` is not used
  bool compares_all_ = false;
  std::size_t effort_of_boxes_ = 0;       ///< of one node: see Node_bound
  std::span<Aabb> boxes_;                 ///< per node, of the tree
  std::vector<std::uint64_t> boxed_in_;   ///< per node: the frame of its box
  std::vector<std::uint64_t> posed_in_;   ///< per leaf: the frame in which it was posed
  std::vector<std::uint64_t> fitted_in_;  ///< per node: the frame in which all below was posed leaf by leaf
  std::vector<std::uint32_t> parents_;    ///< per node; the root's is itself
  std::uint64_t frame_ = 0, pose_ = 0;
  bool all_posed_ = false;
  bool much_was_near_ = false;              ///< all vertices were posed because much was asked for
  std::size_t pause_ = 0, pause_left_ = 0;  ///< frames in which leaves are not posed one by one: planned, still to come
  std::vector<std::uint32_t> bounded_;      ///< nodes whose boxes come from bounds, in this frame
  std::vector<Eigen::Vector3d> read_by_bounds_;  ///< by bounds, of the node whose box is being made
  std::vector<Leaf_vertex> component_vertices_;  ///< empty: not asked for yet
  std::size_t violations_ = 0, violations_settled_ = 0, nodes_bounded_ = 0, leaves_posed_ = 0, vertices_posed_ = 0;
};

}  // namespace lodestone
