// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "lodestone/bounds/node_bound.h"
#include "lodestone/detection/placed_mesh.h"

namespace lodestone {

/// Makes the bound of a promise.
using Make_bound = std::function<std::unique_ptr<Node_bound>(const Bounded_object&)>;

/// The positions of an object as a Bounded_surface reads them: given, placed, or those of its mesh.
/// @param mesh  must outlive the result
std::unique_ptr<const Position_source> positions_of(Placed_mesh& mesh);

/// What is known of the motion of an object in mode `certified`: what the caller has promised, and what computed points
/// tell of themselves. It is known of the mesh, wherever that is placed.
class Known_motion {
 public:
  /// Another promise.
  void promise(Make_bound make) { promises_.push_back(std::move(make)); }
  /// Whether anything has been promised.
  bool is_promised() const { return !promises_.empty(); }
  /// Whether a promise, or the points themselves, are about positions at rest that are not known yet.
  bool awaits_rest(const Watched_mesh& mesh) const { return promises_await_rest() || points_await_rest(mesh); }
  /// Takes the positions that the mesh has now as those at rest, where they are awaited, if all are finite. O(V).
  void take_rest(const Placed_mesh& mesh);
  /// Forgets the positions at rest: the faces have changed.
  void forget_rest() {
    rest_.clear();
    rest_of_points_.clear();
  }
  /// Takes note that a query begins.
  /// @return true if the points have got other arrays, to which bounds of the former ones must refer no more
  bool has_another_shape(const Watched_mesh& mesh) {
    if (has_the_shape_of(mesh)) return false;
    shape_number_ = mesh.shape_number();
    rest_of_points_.clear();
    return true;
  }
  /// Whether bounds are about the points as they are.
  bool has_the_shape_of(const Watched_mesh& mesh) const { return shape_number_ == mesh.shape_number(); }

  /// The bounds of an object. Where positions at rest are still awaited, they are those that the mesh has now.
  /// @param mesh    must outlive the result; so must this
  /// @param labels  the region of each vertex; none: there are no regions
  /// @throws Bad_argument  a promise does not fit, and is forgotten
  std::vector<std::unique_ptr<Node_bound>> bounds(Placed_mesh& mesh, const Tree_layout& layout,
                                                  std::span<const Region_index> labels);

 private:
  bool promises_await_rest() const { return !promises_.empty() && rest_.empty(); }
  bool points_await_rest(const Watched_mesh& mesh) const {
    return rest_of_points_.empty() && mesh.own_bound_needs_rest();
  }
  std::unique_ptr<Node_bound> bound_of_points(const Placed_mesh& mesh, const Bounded_object& in_mesh);
  std::unique_ptr<Node_bound> promised_bound(std::size_t promise, const Placed_mesh& mesh,
                                             const Bounded_object& in_mesh);

  std::vector<Make_bound> promises_;
  std::vector<double> rest_;            ///< 3 V: the first positions that a promise was about; none before
  std::vector<double> rest_of_points_;  ///< 3 V: the first positions that points with a bound had; none before
  std::uint64_t shape_number_ = 0;      ///< Watched_mesh::shape_number of the points that bounds are about
  std::unique_ptr<const Position_source> positions_in_mesh_;  ///< what bounds look at
};

}  // namespace lodestone
