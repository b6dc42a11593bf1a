// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "lodestone/partition/partition.h"

namespace lodestone {

/// Partition strategy: parts with equally many vertices, by splits at the median as in a k-d tree \cite bentley1975.
///
/// The part with the most vertices is split along the longest axis of its bounding box, until there are N parts. Ties
/// between equal coordinates go to the lower vertex index. So two halves differ by at most one vertex, and if N is a
/// power of two, all parts do. Ties between parts and between axes go to the lowest. O(V log N).
struct Median_split {
  static constexpr std::string_view name = "median_split";  ///< for `make_strategy`, tables and messages
  static constexpr bool is_concurrent = true;               ///< see Partition_strategy

  /// See Partition_strategy.
  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  /// The same for a surface by index.
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

}  // namespace lodestone
