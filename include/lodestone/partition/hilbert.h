// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "lodestone/partition/partition.h"

namespace lodestone {

/// Partition strategy: equal runs of the vertices in the order of a Hilbert curve \cite hilbert1891.
///
/// The order is that of `CGAL::hilbert_sort`, whose curve turns at medians, so that it is fine where vertices are dense
/// \cite cgal_spatial_sorting; equal coordinates are told apart by vertex number. The curve fills space, not the
/// surface: a run is near in space, but may lie on two sides of something thin. The sizes of runs differ by at most one
/// vertex. O(V log V).
struct Hilbert {
  static constexpr std::string_view name = "hilbert";

  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

}  // namespace lodestone
