// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "lodestone/bounds/motion_bound.h"
#include "lodestone/mesh/computed_points.h"
#include "lodestone/mesh/unset_vector.h"
#include "lodestone/tree/tree_layout.h"
#include "lodestone/tree/tree_view.h"

namespace lodestone {

/// A surface whose nodes are bounded without being read, and whose leaves are posed when somebody needs their faces.
/// Nothing is done before it is asked for, and nothing twice in a pose.
///
/// A bound is a promise. The vertices of a leaf that is posed are compared with the boxes of the leaf and of the whole,
/// and where all vertices are posed with all boxes in use. If one lies outside, `is_broken()` says so, and whoever
/// relied on boxes must `settle` the surface and ask again.
///
/// Not for several threads at once.
class Bounded_surface {
 public:
  /// Points and bounds of any type.
  class Posable {
   public:
    virtual ~Posable() = default;
    virtual std::uint64_t pose_number() const = 0;
    virtual std::uint32_t vertex_count() const = 0;
    virtual std::size_t node_count() const = 0;
    virtual Aabb box(std::uint32_t node) const = 0;
    virtual void pose(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const = 0;
    virtual void pose_all(std::span<double> coordinates) const = 0;
  };

  /// @param layout         must outlive this, as must what follows
  /// @param points         of the same vertices
  /// @param bounds         of the same nodes: a node lies in what all of them have in common
  /// @throws Bad_argument  they have other vertices, or other nodes
  template <Computed_points Points, Motion_bound... Bounds>
  requires(sizeof...(Bounds) > 0)
      Bounded_surface(const Tree_layout& layout, const Points& points, const Bounds&... bounds)
      : Bounded_surface(layout, std::make_unique<Posable_of<Points, Bounds...>>(points, bounds...)) {}
  Bounded_surface(const Tree_layout& layout, std::unique_ptr<const Posable> motion);

  /// Forgets what was of an earlier pose, if the pose has changed. O(1).
  void start_frame();

  const Tree_layout& layout() const { return *layout_; }
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
    return boxes_[layout_->leaf_node(leaf)];
  }
  /// Poses all vertices and fits all boxes. O(V).
  /// @throws Bad_mesh  a coordinate is not finite
  void pose_all();
  /// The same after a broken bound: all boxes are fitted, so nothing is broken any more.
  void settle();

  bool is_posed(std::uint32_t leaf) const { return posed_in_[leaf] == frame_; }
  /// What has been posed. Only leaves that were posed in this frame may be read.
  /// @pre the root has a box in this frame, and it is finite
  Layout_view view() const { return {layout_, coordinates_, boxes_[0], boxes_}; }

  /// Whether a position of this frame was outside a box that was in use, and the surface has not been settled since.
  bool is_broken() const { return violations_ > violations_settled_; }
  // Counts of this frame.
  std::size_t violations() const { return violations_; }  ///< boxes with positions outside
  std::size_t nodes_bounded() const { return nodes_bounded_; }
  std::size_t leaves_posed() const { return leaves_posed_; }
  std::size_t vertices_posed() const { return vertices_posed_; }  ///< those of several leaves count for each

 private:
  template <class Points, class... Bounds>
  class Posable_of final : public Posable {
   public:
    explicit Posable_of(const Points& points, const Bounds&... bounds) : points_(&points), bounds_(&bounds...) {}

    std::uint64_t pose_number() const override { return points_->pose_number(); }
    std::uint32_t vertex_count() const override { return points_->vertex_count(); }
    std::size_t node_count() const override {
      return std::apply([](const auto*... bounds) { return std::min({std::size_t{bounds->node_count()}...}); },
                        bounds_);
    }
    Aabb box(std::uint32_t node) const override {
      return std::apply([node](const auto*... bounds) { return common(bounds->box(node)...); }, bounds_);
    }
    void pose(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const override {
      points_->pose(vertices, coordinates);
    }
    void pose_all(std::span<double> coordinates) const override { points_->pose_all(coordinates); }

   private:
    static Aabb common(const Aabb& box) { return box; }
    template <class... Others>
    static Aabb common(const Aabb& a, const Aabb& b, const Others&... others) {
      return common(common_box(a, b), others...);
    }
    const Points* points_;
    std::tuple<const Bounds*...> bounds_;
  };

  void bound(std::uint32_t node);
  void read(std::uint32_t leaf);
  void check_finite(std::uint32_t leaf) const;

  const Tree_layout* layout_;
  std::unique_ptr<const Posable> motion_;
  Unset_vector<double> coordinates_;     ///< 3 V: only those of posed leaves mean something
  std::vector<Aabb> boxes_;              ///< per node
  std::vector<std::uint64_t> boxed_in_;  ///< per node: the frame of its box
  std::vector<std::uint64_t> posed_in_;  ///< per leaf: the frame in which it was posed
  std::uint64_t frame_ = 0, pose_ = 0;
  bool all_posed_ = false;
  std::size_t violations_ = 0, violations_settled_ = 0, nodes_bounded_ = 0, leaves_posed_ = 0, vertices_posed_ = 0;
};

}  // namespace lodestone
