// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lodestone/mesh/unset_vector.h"
#include "lodestone/mesh/workers.h"
#include "lodestone/queries/ray_node.h"
#include "lodestone/queries/ray_search.h"

namespace lodestone {

/// One pose of a surface, prepared for many rays: wide nodes over blocks of eight faces, in single precision
/// \cite wald2008. Single precision only discards what it proves missed, so rays get the same answers as from the
/// surface itself, and mostly sooner. It is refitted, or made anew, after vertices have moved.
///
/// Making it takes as long as some F / 20 rays save, a refit as long as some F / 60 rays save. Fewer rays are better
/// asked without it.
class Ray_tree {
 public:
  /// Packs the faces of each leaf into blocks, by where they are now. O(F), shared among the workers.
  /// @param surface  with boxes; must outlive this, and stay as it is
  explicit Ray_tree(const Layout_view& surface, Workers& workers = Workers::alone());

  /// Follows the surface to another pose. Faces stay packed together, and rays take longer where these have moved
  /// apart. O(F), a third of the time of making a tree; shared among the workers.
  /// @param surface  with boxes and the same faces; must outlive this, and stay as it is
  /// @throws Bad_argument  it has other numbers of faces or vertices; this stays as it is
  void refit(const Layout_view& surface, Workers& workers = Workers::alone());

  /// Whether so many rays save more time than it takes to make a tree, on one thread.
  static constexpr bool pays(std::size_t rays, std::size_t faces) {
    return rays > std::max<std::size_t>(1, faces / 16);
  }
  /// The same of a tree that is refitted.
  static constexpr bool refit_pays(std::size_t rays, std::size_t faces) {
    return rays > std::max<std::size_t>(1, faces / 64);
  }

  /// What it was made of.
  const Layout_view& surface() const { return surface_; }
  /// Nodes, the root first. None if the surface is a point, or larger than 2^500 or smaller than 2^-500, or if most of
  /// its leaves are smaller than a 2^16th of the whole: its rays are asked without this.
  std::span<const Ray_node> nodes() const { return {nodes_.data(), is_fitted_ ? nodes_.size() : 0}; }
  /// Blocks, those of a leaf one after the other.
  std::span<const Ray_block> blocks() const { return {blocks_.data(), blocks_.size()}; }
  /// Most nodes and blocks that wait at once while a ray walks down.
  std::size_t most_waiting() const { return most_waiting_; }
  /// Relative coordinates are those of the mesh less this, times `scale`. They are at most 1 in size.
  const std::array<double, 3>& middle() const { return middle_; }
  /// A power of two.
  double scale() const { return scale_; }

 private:
  friend class Ray_tree_builder;

  Layout_view surface_;
  std::size_t face_count_;
  std::array<double, 3> middle_ = {};
  double scale_ = 1;
  bool is_fitted_ = false;  ///< nodes and blocks are those of the surface; false: the surface is asked, since there is
                            ///< no fitting scale, or leaves are too small beside the whole
  Unset_vector<Ray_node> nodes_;
  Unset_vector<Ray_block> blocks_;
  Unset_vector<Ray_box> block_boxes_;
  std::size_t most_waiting_ = 1;
};

/// `first_hit` of a ray, the same as of the surface. For rays that depend on the answers about earlier ones: many at
/// once take less time.
/// @throws Bad_argument  the ray is not as `Ray` says
std::optional<Ray_hit> first_hit(const Ray_tree& tree, const Ray& ray);

/// `all_hits` of a ray, the same as of the surface.
/// @throws Bad_argument  the ray is not as `Ray` says
std::vector<Ray_hit> all_hits(const Ray_tree& tree, const Ray& ray);

/// `first_hit` of each ray, the same as of the surface. Shared among the workers.
/// @return one per ray, in their order
/// @throws Bad_argument  a ray is not as `Ray` says
std::vector<std::optional<Ray_hit>> first_hits(const Ray_tree& tree, std::span<const Ray> rays,
                                               Workers& workers = Workers::alone());

/// `all_hits` of each ray, the same as of the surface. Shared among the workers.
/// @return one list per ray, in their order
/// @throws Bad_argument  a ray is not as `Ray` says
std::vector<std::vector<Ray_hit>> all_hits(const Ray_tree& tree, std::span<const Ray> rays,
                                           Workers& workers = Workers::alone());

/// `first_hit` of each ray. Makes a Ray_tree first where the rays are many enough to be worth it. Shared among the
/// workers.
/// @param surface  with boxes
/// @return one per ray, in their order
/// @throws Bad_argument  a ray is not as `Ray` says
std::vector<std::optional<Ray_hit>> first_hits(const Layout_view& surface, std::span<const Ray> rays,
                                               Workers& workers = Workers::alone());

/// The same for a surface that is bounded, which one thread asks about one ray after the other: see `first_hit`.
/// @throws Bad_argument, Bad_mesh  as `first_hit`
std::vector<std::optional<Ray_hit>> first_hits(Bounded_surface& surface, std::span<const Ray> rays,
                                               Workers& workers = Workers::alone());

}  // namespace lodestone
