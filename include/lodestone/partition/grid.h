// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "lodestone/partition/partition.h"

namespace lodestone {

/// Partition strategy: the cubes of a regular grid that hold a vertex. It ignores the surface, and serves as a baseline
/// for the other strategies.
///
/// The grid starts at the lower corner of the bounding box. The size of its cubes is found by bisection: the number of
/// occupied cubes comes as near as possible to the wanted number, without exceeding it. The wanted number is met unless
/// several vertices enter new cubes at the same size, as on regular or symmetric meshes, or lie less than 2^-20 of the
/// longest side of the bounding box apart. Of several equally good sizes the smallest found is taken. Regions are
/// sorted by the x, then y, then z of their cubes. A translation or uniform scale of the mesh changes no more than
/// rounding does. O(V log V) per size tried; at most 51 sizes are tried.
struct Grid {
  static constexpr std::string_view name = "grid";  ///< for `make_strategy`, tables and messages
  static constexpr bool is_concurrent = true;       ///< see Partition_strategy

  /// See Partition_strategy.
  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  /// The same for a surface by index.
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

}  // namespace lodestone
