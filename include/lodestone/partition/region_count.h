// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/mesh/vertex_graph.h"

namespace lodestone {

/// What `adjust_region_count` has done.
struct Region_adjustment {
  std::size_t regions = 0;  ///< afterwards, numbered from 0 without gaps
  std::size_t joined = 0;   ///< regions that joined another
  std::size_t split = 0;    ///< times that a region was cut in two
};

/// Joins or cuts regions until there are as many as wanted. For strategies that choose the number of regions
/// themselves.
///
/// Too many: the region with the fewest vertices joins the neighbour with which it shares the longest border, counted
/// in mesh edges, until enough are gone. Ties go to the lowest index. A region that is a connected component of the
/// mesh has no neighbour and stays. So more regions than wanted remain if there are more components, but at most
/// `most_regions(wanted)`: the largest, and of equally large ones those of lowest index. Each of the others gets the
/// label of the remaining region whose mean position is nearest to its own.
///
/// Too few: the region with the most vertices is cut in two, until there are enough. A region of several islands gives
/// up all but the largest. A connected region is cut at the median along the longest axis of its vertices, the main
/// eigenvector of their covariance. One half grows from the vertex at one end until it has half the vertices; of the
/// vertices next to it, it takes the first along the axis. Whatever this cuts off from the rest joins that half. So
/// both halves of a connected region are connected. If the mesh has fewer vertices with edges than regions are wanted,
/// the cuts end with regions of a single vertex.
///
/// Vertices without edges are not part of any region and get label 0. The indices of the regions close up in the order
/// that they had. Cost O(E log V) to join, and O(C N) for C components beyond the limit; O(V log V log N) to split into
/// N regions, if the halves are of similar size.
///
/// @param positions  V x 3
/// @param labels     V; changed in place
/// @param wanted     number of regions, >= 1
/// @throws Bad_argument  no region wanted, or the number of labels or positions is not V
Region_adjustment adjust_region_count(const Vertex_graph& graph, const Positions& positions,
                                      std::vector<Region_index>& labels, std::size_t wanted);

}  // namespace lodestone
