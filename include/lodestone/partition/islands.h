// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "lodestone/mesh/vertex_graph.h"

namespace lodestone {

/// What `repair_islands` has done.
struct Island_repair {
  std::size_t regions = 0;         ///< number of regions afterwards
  std::size_t parts_before = 0;    ///< `count_parts` of the labels as they were
  std::size_t islands_joined = 0;  ///< parts that joined another region
  std::size_t regions_added = 0;   ///< parts that became a new region, because no region reaches their component
  std::size_t islands_left = 0;    ///< parts beyond the limit of new regions; they keep their label
};

/// Number of connected parts of all labels together; isolated vertices do not count. Cost O(V + E).
std::size_t count_parts(const Vertex_graph& graph, const std::vector<Region_index>& labels);

/// Makes every region connected. The largest part of a label keeps it; every other part joins the region with which
/// it shares the longest border, counted in mesh edges. Ties go to the lowest region index.
///
/// A connected component of the mesh may hold the largest part of no label. No particle could walk there, so the
/// largest part in this component becomes a new region. New regions are made of the largest such parts, until there
/// are `most_regions(wanted)`; otherwise a mesh of loose triangles would get a particle per triangle. Parts beyond
/// that limit keep their label. So their faces are still checked, with a region in which they are an island. Vertices
/// without edges keep their label and count for no region.
///
/// Islands join in rounds, the next only after all that touch a region. Each is looked at once. Cost O(V + E log E).
///
/// @param labels  V, each below `regions`; changed in place
/// @param wanted  number of regions that the caller wants; 0: `regions`
Island_repair repair_islands(const Vertex_graph& graph, std::vector<Region_index>& labels, std::size_t regions,
                             std::size_t wanted = 0);

/// How many regions a mesh of many connected components gets at most: twice as many as wanted, or 64 more, whichever is
/// more.
constexpr std::size_t most_regions(std::size_t wanted) { return wanted + (wanted > 64 ? wanted : 64); }

/// Removes the regions that own no vertex with edges. The indices of the other regions close up, and the isolated
/// vertices of a removed region go to region 0, which stays even if no vertex has an edge, as where all faces are
/// points.
/// @return the number of regions left
std::size_t drop_regions_without_edges(const Vertex_graph& graph, std::vector<Region_index>& labels,
                                       std::size_t regions);

}  // namespace lodestone
