// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "lodestone/partition/partition.h"

namespace lodestone {

/// How METIS comes to N parts.
enum class Metis_method {
  k_way,      ///< all at once, then refined together: shorter borders
  recursive,  ///< one cut in two after the other: parts of more equal size
};

struct Metis_options {
  std::uint64_t seed = 1;  ///< of the random numbers METIS draws; its lower 31 bits count
  Metis_method method = Metis_method::k_way;
  double imbalance = 0.03;          ///< how much larger than the mean the largest part may be; [0.001, 1]
  std::size_t refinements = 10;     ///< per level of the multilevel scheme; [1, 1000]
  std::size_t vertices_a_part = 8;  ///< METIS makes no smaller parts on average; [2, 1000]
};

/// Partition strategy: parts of the mesh graph with as many vertices each and as few edges between them as METIS finds.
///
/// Karypis and Kumar, "A fast and high quality multilevel scheme for partitioning irregular graphs", 1998, through
/// CGAL's wrapper. Positions do not count, only who is whose neighbour.
///
/// METIS leaves parts empty, and complains aloud, when there are hardly more vertices than parts. So it is asked for no
/// more than V / `vertices_a_part`, and `adjust_region_count` makes up for what is missing. METIS draws from the C
/// library's `rand` and seeds it: calls from several threads wait for each other, but a thread that calls `rand` itself
/// meanwhile changes the result, and finds its own sequence started anew. O(V + N log N) for N regions.
struct Metis {
  static constexpr std::string_view name = "metis";

  Metis_options options = {};

  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  /// @throws Bad_argument  no region wanted, an option out of range, or a mesh beyond METIS's 31-bit numbers
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

}  // namespace lodestone
