// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "lodestone/bounds/motion_bound.h"
#include "lodestone/mesh/concepts.h"
#include "lodestone/mesh/position_source.h"
#include "lodestone/tree/tree_layout.h"

namespace lodestone {

/// A Motion_bound of any type.
class Node_bound {
 public:
  virtual ~Node_bound() = default;
  /// Number of nodes of the tree.
  virtual std::size_t node_count() const = 0;
  /// A box around the vertices of a node in the current pose: see Motion_bound.
  virtual Aabb box(std::uint32_t node) const = 0;
  /// See Reading_bound.
  virtual Aabb box(std::uint32_t node, std::vector<Eigen::Vector3d>& /*read*/) const { return box(node); }
  /// See Watching_bound.
  virtual bool note_read(std::uint32_t /*leaf*/, const Aabb& /*fitted*/, Coordinates /*coordinates*/) { return true; }
  /// See All_watching_bound; only if `notes_all`.
  virtual bool note_all(std::span<const Aabb> /*fitted*/, Coordinates /*coordinates*/, bool /*all*/) { return true; }
  /// Whether `note_all` takes the place of `note_read`.
  virtual bool notes_all() const { return false; }
  /// Whether `note_read` does anything.
  virtual bool watches() const { return false; }
  /// How many vertices can be read one after the other in the time that a box takes, about.
  virtual std::size_t effort() const { return usual_effort; }
  static constexpr std::size_t usual_effort = 56;  ///< of bounds that do not say
};

/// A bound as a Node_bound.
/// @tparam B  what is kept: the bound, or a reference to it
template <class B>
class Node_bound_of final : public Node_bound {
 public:
  /// Keeps a bound, or a reference to one.
  explicit Node_bound_of(B bound) : bound_(std::forward<B>(bound)) {}

  /// Number of nodes of the tree.
  std::size_t node_count() const override { return bound_.node_count(); }
  /// As the bound gives it.
  Aabb box(std::uint32_t node) const override { return bound_.box(node); }
  Aabb box(std::uint32_t node, std::vector<Eigen::Vector3d>& read) const override {
    if constexpr (Reading_bound<std::remove_reference_t<B>>)
      return bound_.box(node, read);
    else
      return bound_.box(node);
  }
  bool note_read(std::uint32_t leaf, const Aabb& fitted, Coordinates coordinates) override {
    if constexpr (Watching_bound<std::remove_reference_t<B>>)
      return bound_.note_read(leaf, fitted, coordinates);
    else
      return true;
  }
  bool note_all(std::span<const Aabb> fitted, Coordinates coordinates, bool all) override {
    if constexpr (All_watching_bound<std::remove_reference_t<B>>)
      return bound_.note_all(fitted, coordinates, all);
    else
      return true;
  }
  std::size_t effort() const override {
    if constexpr (requires { bound_.effort(); })
      return bound_.effort();
    else
      return usual_effort;
  }
  bool notes_all() const override {
    if constexpr (requires { bound_.notes_all(); })
      return bound_.notes_all();
    else
      return All_watching_bound<std::remove_reference_t<B>>;
  }
  bool watches() const override {
    if constexpr (requires { bound_.watches(); })
      return bound_.watches();
    else
      return Watching_bound<std::remove_reference_t<B>>;
  }

 private:
  B bound_;
};

/// A bound whose type is known only when the program runs. A model of All_watching_bound and Reading_bound.
class Any_bound {
 public:
  /// @param bound  not null
  explicit Any_bound(std::unique_ptr<Node_bound> bound) : bound_(std::move(bound)) {}
  /// Keeps a bound of any type.
  template <Motion_bound B>
  requires(!std::same_as<B, Any_bound>)
  explicit Any_bound(B bound) : bound_(std::make_unique<Node_bound_of<B>>(std::move(bound))) {}

  /// Number of nodes of the tree.
  std::size_t node_count() const { return bound_->node_count(); }
  /// A box around the vertices of a node in the current pose.
  Aabb box(std::uint32_t node) const { return bound_->box(node); }
  /// See Reading_bound; adds nothing if the bound reads nothing.
  Aabb box(std::uint32_t node, std::vector<Eigen::Vector3d>& read) const { return bound_->box(node, read); }
  /// See Watching_bound; true if the bound does not watch.
  bool note_read(std::uint32_t leaf, const Aabb& fitted, Coordinates coordinates) {
    return bound_->note_read(leaf, fitted, coordinates);
  }
  /// See All_watching_bound; only if `notes_all`.
  bool note_all(std::span<const Aabb> fitted, Coordinates coordinates, bool all) {
    return bound_->note_all(fitted, coordinates, all);
  }
  /// Whether `note_all` takes the place of `note_read`.
  bool notes_all() const { return bound_->notes_all(); }
  /// Whether the bound watches.
  bool watches() const { return bound_->watches(); }
  /// How many vertices can be read one after the other in the time that a box takes, about.
  std::size_t effort() const { return bound_->effort(); }

 private:
  std::unique_ptr<Node_bound> bound_;
};

/// What a bound can be made from, once the tree of an object has been built.
struct Bounded_object {
  const Tree_layout& layout;             ///< of its tree
  std::span<const Region_index> labels;  ///< V: region of each vertex; empty: a single region
  Coordinates rest;                      ///< 3 V: where the vertices were then, which is called at rest
  const Position_source& positions;      ///< where they are
};

/// Checks that an object's parts are about the same vertices. O(V).
/// @throws Bad_argument  the layout has others than the positions, or rest or labels have the wrong length
void check_object(const Bounded_object& object);

/// A promise about the motion of an object. The caller owns it, and may change it between frames. A bound is made from
/// it when the object's tree has been built.
///
/// `promise.bound(object)` makes it: a Motion_bound, which may refer to the promise, to the layout and to the
/// positions, but neither to the labels nor to the rest. Models: Lipschitz_promise, Stretch_promise,
/// Displacement_promise and Box_promise, which cannot be copied, since bounds refer to them; Deformed_points and
/// Computed_motion, which bound what they compute.
template <class P>
concept Motion_promise = requires(const P& promise, const Bounded_object& object) {
  { promise.bound(object) } -> Motion_bound;
};

}  // namespace lodestone
