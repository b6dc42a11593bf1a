// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "lodestone/partition/partition.h"

namespace lodestone {

/// How METIS makes N parts.
enum class Metis_method {
  k_way,      ///< all at once, then refined together: shorter borders
  recursive,  ///< by repeated cuts in two: parts of more equal size
};

/// Options of Metis.
struct Metis_options {
  std::uint64_t seed = 1;                     ///< of the random numbers that METIS draws; only its lower 31 bits count
  Metis_method method = Metis_method::k_way;  ///< how the parts are made
  double imbalance = 0.03;          ///< by how much the largest part may exceed the mean, relative to it; [0.001, 1]
  std::size_t refinements = 10;     ///< per level of the multilevel scheme; [1, 1000]
  std::size_t vertices_a_part = 8;  ///< least mean number of vertices in the parts that METIS makes; [2, 1000]
};

/// Partition strategy: parts of the mesh graph with equally many vertices, and with as few edges between them as METIS
/// finds.
///
/// Karypis and Kumar, "A fast and high quality multilevel scheme for partitioning irregular graphs", 1998, through
/// CGAL's wrapper. Only the graph counts, not the positions.
///
/// METIS leaves parts empty and prints warnings if there are hardly more vertices than parts. So it is asked for at
/// most V / `vertices_a_part` parts, and `adjust_region_count` makes the missing ones.
///
/// METIS seeds `rand` of the C library and draws from it. Calls of this strategy from several threads wait for each
/// other. But a thread that calls `rand` itself meanwhile changes the result and finds its own sequence restarted. O(V
/// + N log N) for N regions.
struct Metis {
  static constexpr std::string_view name = "metis";  ///< for `make_strategy`, tables and messages

  Metis_options options = {};  ///< given to METIS

  /// See Partition_strategy.
  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  /// The same for a surface by index.
  /// @throws Bad_argument  no region wanted, an option out of range, or too many faces for METIS's 31-bit integers
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

}  // namespace lodestone
