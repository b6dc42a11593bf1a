// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "queries/ray_walk_kernel.h"
#include "queries/relative_place.h"

/// Where rays enter the box around a surface, built for several instruction sets and chosen at run time.
namespace lodestone::kernel {

/// Some rays in the coordinates of the mesh.
struct alignas(64) Ray_numbers {
  double origin[3][ray_tree_width];
  double direction[3][ray_tree_width];  ///< not zero
  double limit[ray_tree_width];         ///< how deep they have to go at most, see `Ray_frame`
};

/// A bit per ray.
struct Ray_starts {
  std::uint32_t near;   ///< the others have their origin so far away that single precision is not enough
  std::uint32_t walks;  ///< of these; the others surely miss the surface
};

/// Starts rays where they enter the box around the surface.
/// @param rays   numbers beyond `count` are those of any ray; a single ray needs none
/// @param count  of the rays, 1 to `ray_tree_width`
/// @param walks  are overwritten; those of other rays mean nothing
Ray_starts start_rays(const Relative_place& place, const Ray_numbers& rays, std::size_t count, Ray_walks& walks);

}  // namespace lodestone::kernel
