// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "lodestone/mesh/vertex_graph.h"

namespace lodestone {

struct Island_repair {
  std::size_t regions = 0;         ///< number of regions afterwards
  std::size_t islands_joined = 0;  ///< pieces that joined another region
  std::size_t regions_added = 0;   ///< pieces that became a region of their own: no region reaches their component
  std::size_t islands_left = 0;    ///< pieces beyond the limit of new regions: they keep their label
};

/// Number of connected pieces of all labels together; isolated vertices do not count. Cost O(V + E).
std::size_t count_pieces(const Vertex_graph& graph, const std::vector<Region_index>& labels);

/// Makes every region connected: the largest piece of a label keeps it, every other piece joins the region it shares
/// the longest border with, counted in mesh edges; ties go to the lowest region number.
///
/// A connected component of the mesh in which no label has its largest piece keeps its own largest piece as a new
/// region, since no particle could walk there. There are at most max(regions, 64) new ones, for the largest components:
/// a mesh of loose triangles would otherwise get a particle per triangle. What lies beyond keeps its label, so that its
/// faces are still checked with a region, in which they are an island. Vertices without edges keep their label and
/// count for no region. Cost O((V + E) p) for p passes, as many as islands lie behind islands; mostly 1.
///
/// @param labels  V, each below `regions`; changed in place
Island_repair repair_islands(const Vertex_graph& graph, std::vector<Region_index>& labels, std::size_t regions);

/// Gives every region a vertex with edges: regions that own none are taken out, the numbers of the others close up, and
/// isolated vertices of a region taken out fall to region 0.
/// @return the number of regions left
std::size_t drop_regions_without_edges(const Vertex_graph& graph, std::vector<Region_index>& labels,
                                       std::size_t regions);

}  // namespace lodestone
