// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "lodestone/bounds/motion_bound.h"
#include "lodestone/bounds/node_bound.h"
#include "lodestone/bounds/node_regions.h"
#include "lodestone/volumes/aabb.h"

namespace lodestone {

class Box_promise;

/// Boxes from a Box_promise. Reads no positions. A model of Motion_bound.
class Promised_boxes {
 public:
  /// O(V).
  /// @param promise        must outlive this
  /// @throws Bad_argument  `object` has other vertices than its positions; rest or labels have the wrong length
  Promised_boxes(const Box_promise& promise, const Bounded_object& object);

  /// Number of nodes of the tree.
  std::size_t node_count() const { return rest_.size(); }
  /// The box of a node in the current pose: one call of the promise.
  /// @throws Bad_argument  a lower end is above the upper one
  Aabb box(std::uint32_t node) const;

 private:
  const Box_promise* promise_;
  std::vector<Aabb> rest_;             ///< per node: the box of its vertices at rest
  std::vector<Region_index> regions_;  ///< per node; `several_regions` where they differ
};

/// A promise that the caller computes: boxes in which vertices of the mesh are now. A model of Motion_promise.
///
/// The caller's function is given a region, and a box at rest. It returns a box that contains, in the current pose and
/// as they are computed, all vertices of that region that lie in the given box at rest. With `several_regions` they are
/// those of any region. The result is taken as it is; an axis with an end that is not finite is open. A query throws
/// Bad_argument if a lower end is above the upper one.
///
/// The function may be called by several threads at once, and several times with the same arguments.
class Box_promise {
 public:
  /// The caller's function, as above.
  using Function = std::function<Aabb(Region_index region, const Aabb& rest_box)>;

  /// @throws Bad_argument  there is no function
  explicit Box_promise(Function box);
  Box_promise(const Box_promise&) = delete;
  Box_promise& operator=(const Box_promise&) = delete;

  /// Calls the caller's function.
  Aabb box(Region_index region, const Aabb& rest_box) const { return box_(region, rest_box); }

  /// The bound for one object, which this must outlive. O(V).
  Promised_boxes bound(const Bounded_object& object) const { return {*this, object}; }

 private:
  Function box_;
};

}  // namespace lodestone
