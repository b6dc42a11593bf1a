// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "lodestone/partition/partition.h"

namespace lodestone {

/// Partition strategy: equal runs of the vertices in the order of a Hilbert curve \cite hilbert1891.
///
/// The order is that of `CGAL::hilbert_sort` \cite cgal_spatial_sorting, whose curve turns at medians, so it is fine
/// where vertices are dense. Ties between equal coordinates go to the lower vertex index. The curve fills space, not
/// the surface: the vertices of a run are near in space, but may lie on two sides of a thin part. The sizes of runs
/// differ by at most one vertex. O(V log V).
struct Hilbert {
  static constexpr std::string_view name = "hilbert";  ///< for `make_strategy`, tables and messages
  static constexpr bool is_concurrent = true;          ///< see Partition_strategy

  /// See Partition_strategy.
  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  /// The same for a surface by index.
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

}  // namespace lodestone
