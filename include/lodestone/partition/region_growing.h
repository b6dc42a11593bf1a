// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "lodestone/partition/partition.h"

namespace lodestone {

struct Region_growing_options {
  double angle = 25;       ///< most degrees between the normal of a face and that of its region's plane; [0, 90]
  double distance = 0.02;  ///< of a corner from the plane, relative to the longest side of the bounding box; [0, 1]
};

/// Partition strategy: nearly flat areas, each grown from one face.
///
/// Region growing of Lafarge and Mallet, "Creating large-scale city models from 3D-point clouds: a robust approach with
/// hybrid representation", 2012, by CGAL's Shape_detection: from the first face that has no region a region spreads
/// over neighbours that fit the plane of what it has, which is fitted anew after each ring. Unlike `vsa` nothing is
/// optimised, and the shape decides how many regions there are; `adjust_region_count` then brings them to the number
/// wanted. Vertices take the label of most of the area around them, see `vertex_labels`.
///
/// A face without area is a region of its own, which falls to its neighbours. Nothing is drawn at random. O(F r) for
/// regions r rings across.
struct Region_growing {
  static constexpr std::string_view name = "region_growing";

  Region_growing_options options = {};

  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  /// @throws Bad_argument  no region wanted, or an option out of range
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

/// The areas of `Region_growing` before their number is adjusted, per face; `no_region` for faces without area, and for
/// those that are no part of a mesh.
std::vector<Region_index> flat_areas(const Numbered_surface& surface, const Region_growing_options& options = {});

}  // namespace lodestone
