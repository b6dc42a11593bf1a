// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/container/small_vector.hpp>
#include <cstdint>
#include <span>

#include "lodestone/queries/ray_node.h"

/// The walk of rays down a Ray_tree, built for several instruction sets and chosen at run time. All show the faces that
/// a ray meets, and some that it does not meet.
namespace lodestone::kernel {

/// Bound on the error of all that a walk computes from relative coordinates, each of which is at most 1 in size: of a
/// position across the ray, and of a depth. There are at most 18 errors of 2^-25.
constexpr float walk_error = 0x1p-20F;

/// Some rays in relative coordinates, which start in or at the box of the surface. The depth of a point is its distance
/// from that start along the depth axis, that along which the ray is steepest.
struct alignas(64) Ray_walks {
  float slope[3][ray_tree_width];    ///< change along each axis with the depth, at most 1 in size
  float inverse[3][ray_tree_width];  ///< of the slopes; finite
  float enter[3][ray_tree_width];    ///< start times inverse, raised by the error of depths
  float leave[3][ray_tree_width];    ///< the same, lowered
  float across[3][ray_tree_width];   ///< where the line is along each axis when it is at 0 along the depth axis
  float start[ray_tree_width];       ///< along the depth axis, in the direction of the ray
  float most[ray_tree_width];        ///< how deep it has to go
  std::uint32_t near_side[3][ray_tree_width];  ///< by which it enters boxes: where that begins in `Ray_node::sides`
  std::uint32_t far_side[3][ray_tree_width];   ///< by which it leaves them
  std::uint32_t depth_axis[ray_tree_width];
};

/// The nodes of a Ray_tree, the root first, and its blocks.
struct Ray_nodes {
  const Ray_node* nodes;
  const Ray_block* blocks;
  const double* coordinates;  ///< of the surface: those of faces that may be met are read soon after
  std::size_t most_waiting;   ///< most nodes and blocks that wait at once while a ray walks down

  /// For what waits of one ray: its end, all of the tree that waits, and what is written beyond.
  std::size_t waiting_room() const { return 1 + most_waiting + ray_tree_width; }
};

/// Faces of one block that a ray may meet.
struct Ray_candidates {
  std::uint32_t ray;    ///< index
  std::uint32_t block;  ///< index
  std::uint32_t lanes;  ///< a bit per face
};

enum class Walk_until {
  first_hit,  ///< what is surely behind a face that the ray surely meets is left out
  end,        ///< all candidates are listed
};

/// Rays that walk at once.
constexpr std::size_t ray_walkers = 32;

/// A list of candidates, which grows.
class Ray_candidate_list {
 public:
  std::span<const Ray_candidates> get() const { return {list_.data(), count_}; }
  /// Where the next ones are written, up to a number of them.
  Ray_candidates* room(std::size_t count);
  /// They are written.
  void add(std::size_t count) { count_ += count; }

 private:
  boost::container::small_vector<Ray_candidates, 2 * ray_walkers> list_;
  std::size_t count_ = 0;
};

/// Walks rays from front to back, as far as boxes tell. They take turns, so that what one waits for is read from memory
/// while others walk.
/// @param walks       of all rays
/// @param rays        indices of those that walk
/// @param candidates  are appended: those of each ray in the order in which it comes to them
void walk_rays(const Ray_nodes& tree, const Ray_walks* walks, std::span<const std::uint32_t> rays, Walk_until until,
               Ray_candidate_list& candidates);

}  // namespace lodestone::kernel
