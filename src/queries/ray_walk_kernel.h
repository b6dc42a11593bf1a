// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "lodestone/queries/ray_node.h"

/// The walk of rays down a Ray_tree, built for several instruction sets and chosen at run time. All show the faces that
/// a ray meets, and some that it does not meet.
namespace lodestone::kernel {

/// Bound on the error of all that a walk computes from relative coordinates, each of which is at most 1 in size: of a
/// position across the ray, and of a depth. There are at most 18 errors of 2^-25.
constexpr float walk_error = 0x1p-20F;

/// A ray in relative coordinates, which starts in or at the box of the surface. Its depth is that along `axes[2]`, from
/// that start.
struct Ray_walk {
  float slope[3];            ///< change along each axis with the depth, at most 1 in size
  float inverse[3];          ///< of the slopes; finite
  float enter[3];            ///< start times inverse, raised by the error of depths
  float leave[3];            ///< the same, lowered
  float across[3];           ///< where the line is along each axis when it is at 0 along `axes[2]`
  float start;               ///< along `axes[2]`, in the direction of the ray
  std::size_t axes[3];       ///< `axes[2]` is that along which the slope is largest
  std::size_t near_side[3];  ///< by which it enters boxes, per axis: where that begins in `Ray_node::sides`
  std::size_t far_side[3];   ///< by which it leaves them
};

/// A ray on its walk.
struct Ray_walker {
  Ray_walk ray;
  float most;                  ///< how deep it has to go
  std::uint64_t next;          ///< what it visits next, see `waiting_child`; 0 before the first step
  std::uint64_t* waiting;      ///< what it may have to visit later; room for `most_waiting` of the tree
  std::uint64_t* end_waiting;  ///< `waiting` before the first step
};

/// The nodes of a Ray_tree, the root first, and its blocks.
struct Ray_nodes {
  const Ray_node* nodes;
  const Ray_block* blocks;
};

/// What walks report to.
class Ray_visitor {
 public:
  /// A face that the ray may meet.
  /// @return how deep the ray has to go from now on; never more than before
  virtual float visit(Ray_walker& walker, const Ray_block& block, std::size_t lane) = 0;
  /// A walk has ended. May give the walker another ray.
  /// @return whether it does
  virtual bool end(Ray_walker& walker) = 0;

 protected:
  ~Ray_visitor() = default;
};

constexpr std::size_t most_ray_walkers = 16;

/// Walks from front to back, as far as boxes tell. The rays take turns, so that what one waits for is read from memory
/// while others walk.
/// @param walkers  at most `most_ray_walkers`
void walk_rays(const Ray_nodes& tree, std::span<Ray_walker* const> walkers, Ray_visitor& visitor);

}  // namespace lodestone::kernel
