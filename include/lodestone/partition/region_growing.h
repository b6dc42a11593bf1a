// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "lodestone/partition/partition.h"

namespace lodestone {

/// Options of Region_growing.
struct Region_growing_options {
  double angle = 25;  ///< largest angle between the normals of a face and of its region's plane, degrees; [0, 90]
  double distance =
      0.02;  ///< largest distance of a corner from that plane, in longest sides of the bounding box; [0, 1]
};

/// Partition strategy: nearly flat areas, each grown from one face.
///
/// Region growing of Lafarge and Mallet, "Creating large-scale city models from 3D-point clouds: a robust approach with
/// hybrid representation", 2012, by CGAL's Shape_detection. A region starts at the first face that has none. It spreads
/// over neighbours that fit the plane of its faces, which is fitted again after each ring. Unlike `vsa` nothing is
/// optimised, and the shape decides how many regions there are. Then `adjust_region_count` brings them to the wanted
/// number. Vertices take the label with the largest area around them, see `vertex_labels`.
///
/// A face without area is a region of its own at first, and then goes to its neighbours. Nothing is random. O(F r) for
/// regions that are r rings across: O(F^1.5) for a flat square, and O(F^2) for a long flat strip.
struct Region_growing {
  static constexpr std::string_view name = "region_growing";  ///< for `make_strategy`, tables and messages
  static constexpr bool is_concurrent = true;                 ///< see Partition_strategy

  Region_growing_options options = {};  ///< what counts as flat

  /// See Partition_strategy.
  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  /// The same for a surface by index.
  /// @throws Bad_argument  no region wanted, or an option out of range
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

/// The areas of `Region_growing` before their number is adjusted, per face; `no_region` for faces without area, and for
/// those that `oriented_mesh` leaves out. Cost as of `Region_growing`.
std::vector<Region_index> flat_areas(const Numbered_surface& surface, const Region_growing_options& options = {});

}  // namespace lodestone
