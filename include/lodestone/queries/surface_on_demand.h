// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <cstdint>

#include "lodestone/tree/tree_view.h"

namespace lodestone {

/// What a query needs of a surface whose nodes are bounded, and whose leaves are posed, when it asks for them.
/// Models: Bounded_surface, Fitted_surface.
///
/// - `start_frame()` forgets what was of an earlier pose.
/// - `layout()` is the Tree_layout.
/// - `box(node)` encloses the vertices of a node, unless the surface turns out to be broken. It may be infinite.
/// - `pose(leaf)` makes the faces of a leaf readable, and returns the box fitted to them, which is finite.
/// - `view()` has the coordinates of the leaves that have been posed. They may move in memory with each `pose`.
/// - `is_broken()`: some vertex that has been read lies outside a box that was in use then, or such a box is empty.
/// - `settle()` poses all leaves and fits all boxes, so that nothing is broken any more.
template <class Surface>
concept Surface_on_demand = requires(Surface& surface, const Surface& fixed, std::uint32_t index) {
  surface.start_frame();
  { fixed.layout() } -> std::same_as<const Tree_layout&>;
  { surface.box(index) } -> std::same_as<const Aabb&>;
  { surface.pose(index) } -> std::same_as<const Aabb&>;
  { fixed.view() } -> std::convertible_to<Layout_view>;
  { fixed.is_broken() } -> std::same_as<bool>;
  surface.settle();
};

/// A tree that has been refitted, as a Surface_on_demand: all leaves are posed, and nothing is ever broken.
class Fitted_surface {
 public:
  /// @param view  with boxes
  explicit Fitted_surface(const Layout_view& view) : view_(view) {}

  /// Does nothing.
  void start_frame() {}
  /// How the faces are grouped.
  const Tree_layout& layout() const { return *view_.layout; }
  /// The fitted box of a node.
  const Aabb& box(std::uint32_t node) const { return view_.boxes[node]; }
  /// The fitted box of a leaf, which is posed already.
  const Aabb& pose(std::uint32_t leaf) const { return view_.boxes[layout().leaf_node(leaf)]; }
  /// The tree with its coordinates.
  const Layout_view& view() const { return view_; }
  /// Never.
  bool is_broken() const { return false; }
  /// Does nothing.
  void settle() {}

 private:
  Layout_view view_;
};
static_assert(Surface_on_demand<Fitted_surface>);

/// Poses a surface as a whole if it is broken, or if no box around it is known that is of any use. Distances in units of
/// a box that is larger, though finite, underflow when they are squared.
template <Surface_on_demand Surface>
void settle_if_needed(Surface& surface) {
  constexpr double largest_extent = 1e100;
  if (!(surface.box(0).extent() < largest_extent) || surface.is_broken()) surface.settle();
}

/// Asks a question of surfaces in the current frame. Where a surface turns out to be broken, the answer is dropped, the
/// surface is settled, and the question is asked anew.
/// @param question  a callable without arguments; it may return early once a surface is broken
template <class Question, Surface_on_demand... Surfaces>
auto ask_until_settled(const Question& question, Surfaces&... surfaces) {
  (surfaces.start_frame(), ...);
  for (;;) {
    (settle_if_needed(surfaces), ...);
    auto answer = question();
    if (!(surfaces.is_broken() || ...)) return answer;
  }
}

}  // namespace lodestone
