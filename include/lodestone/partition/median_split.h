// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "lodestone/partition/partition.h"

namespace lodestone {

/// Partition strategy: parts of equally many vertices, by splits at the median as in a k-d tree \cite bentley1975.
///
/// The part with the most vertices is split along the longest axis of its bounding box until there are N; equal
/// coordinates are told apart by vertex number, so the halves differ by at most one vertex, and all parts do when N is
/// a power of two. Ties go to the lowest part and axis. O(V log N).
struct Median_split {
  static constexpr std::string_view name = "median_split";

  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

}  // namespace lodestone
