// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "lodestone/partition/partition.h"

namespace lodestone {

/// Partition strategy: the cubes of a regular grid that hold a vertex. What a mesh is divided into without looking at
/// its surface, to hold the others against.
///
/// The grid starts at the lower corner of the bounding box. Its cubes have the size, found by bisection, at which the
/// number of occupied ones comes nearest to the wanted number from below; that number itself is met unless several
/// vertices enter new cubes at one and the same size, as on regular or symmetric meshes, or are less than 2^-20 of the
/// longest side of the bounding box apart. Of several such sizes the smallest found is taken. Regions are numbered by
/// x, then y, then z of their cubes. Neither a translation nor a uniform scale of the mesh changes more than rounding
/// does. O(V log V) per size tried, of which there are at most 51.
struct Grid {
  static constexpr std::string_view name = "grid";

  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

}  // namespace lodestone
