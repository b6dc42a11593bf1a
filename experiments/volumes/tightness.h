// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <limits>

#include "lodestone/tree/region_tree.h"
#include "lodestone/volumes/spherical_shell.h"
#include "volumes/tree_pieces.h"

namespace lodestone {

/// Volume of bounding volumes over that of the convex hulls of what they enclose. 1 is as tight as a convex volume can
/// be; a volume that is not convex may be tighter. Each figure is a ratio of sums, so a flat piece, whose hull has no
/// volume, still adds its bounding volume.
struct Tightness {
  double leaves = 0;            ///< fitted to their faces
  double regions = 0;           ///< fitted to their faces, see `choose_faces`; not a number if that needs all faces
  double regions_refitted = 0;  ///< as they stand in the tree, around the volumes below
  double objects = 0;           ///< as they stand in the tree
};

/// Volumes of bounding volumes, each kind added up over all pieces.
struct Volume_sums {
  double leaves = 0;
  double regions = 0;
  double regions_refitted = 0;
  double objects = 0;
};

/// Adds the volumes of one refitted tree.
/// @param regions  what volumes of regions are fitted to, see `choose_faces`
template <Bounding_volume Volume>
void add_volumes(const Basic_region_tree<Volume>& tree, const Tree_pieces& pieces, Coordinates coordinates,
                 std::span<const Chosen_faces> regions, Volume_sums& sums) {
  for (const auto leaf : pieces.leaves) sums.leaves += tree.volume(tree.leaf_node(leaf)).volume();
  for (const auto& region : regions) {
    Volume fitted;
    fitted.enclose(region.posed(coordinates));
    // Faces inside the region decide how thin a shell is.
    const bool stands_for_all = region.complete || !std::same_as<Volume, Spherical_shell>;
    sums.regions += stands_for_all ? fitted.volume() : std::numeric_limits<double>::quiet_NaN();
  }
  for (const auto& region : pieces.regions) sums.regions_refitted += tree.volume(region.node).volume();
  sums.objects += tree.volume(0).volume();
}

/// A figure is 0 if its hulls have no volume.
inline Tightness tightness_of(const Volume_sums& volumes, const Hull_sums& hulls) {
  const auto ratio = [](double volume, double hull) { return hull > 0 ? volume / hull : 0; };
  return {.leaves = ratio(volumes.leaves, hulls.leaves),
          .regions = ratio(volumes.regions, hulls.regions),
          .regions_refitted = ratio(volumes.regions_refitted, hulls.regions),
          .objects = ratio(volumes.objects, hulls.objects)};
}

}  // namespace lodestone
