// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>

#include "lodestone/mesh/workers.h"
#include "lodestone/queries/ray_tree.h"

namespace lodestone {

/// The Ray_tree of one object, kept from frame to frame.
class Kept_ray_tree {
 public:
  /// The surface, prepared for many rays.
  /// @param surface  has just been refitted; the same faces as before, or `forget` has been called
  const Ray_tree& of(const Layout_view& surface, Workers& workers);
  /// Whether a tree saves more time than it takes, for a call with so many rays and those before it. Counts the rays: a
  /// tree that would not pay in one pose can pay over several. One that has the pose already always pays.
  bool pays_for(std::size_t rays, std::size_t faces);

  /// Positions may have changed since the last query.
  void note_moved() {
    is_current_ = false;
    rays_at_pose_ = 0;
  }
  /// The faces, or the leaves of their tree, have changed.
  void forget();

 private:
  std::optional<Ray_tree> tree_;       ///< none before it is asked for
  bool is_current_ = false;            ///< it has the positions that the last query has read
  std::size_t rays_at_pose_ = 0;       ///< since positions may have changed
  std::size_t rays_without_tree_ = 0;  ///< at poses for which the refit of a tree would have paid
};

}  // namespace lodestone
