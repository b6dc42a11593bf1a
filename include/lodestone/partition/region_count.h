// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/mesh/vertex_graph.h"

namespace lodestone {

struct Region_adjustment {
  std::size_t regions = 0;  ///< afterwards, numbered from 0 without gaps
  std::size_t joined = 0;   ///< regions that joined a neighbour
  std::size_t split = 0;    ///< times that a region was cut in two
};

/// Brings the regions of a strategy that chooses their number itself to the number wanted.
///
/// Too many: the region of fewest vertices joins the neighbour it shares the longest border with, counted in mesh
/// edges, until enough are gone; ties go to the lowest number. A region that is a connected component of the mesh has
/// no neighbour and stays, so that more regions than wanted remain when there are more components.
///
/// Too few: the region of most vertices is cut in two, until there are enough. A region in several pieces gives up all
/// but the largest. A connected one is cut at the median along the longest axis of its vertices (the main eigenvector
/// of their covariance): one half grows from the vertex at one end, the next along the axis first, until it has half
/// the vertices; what this cuts off from the rest joins it. So both halves of a connected region are connected. Single
/// vertices are left when the mesh has fewer vertices with edges than regions are wanted.
///
/// Vertices without edges are no part of any region; they get label 0. Numbers close up in the order they had.
/// Cost O(E log V) to join; O(V log V log N) to split into N regions.
///
/// @param positions  V x 3
/// @param labels     V; changed in place
/// @param wanted     number of regions, >= 1
/// @throws Bad_argument  no region wanted, or a number of labels or positions other than V
Region_adjustment adjust_region_count(const Vertex_graph& graph, const Positions& positions,
                                      std::vector<Region_index>& labels, std::size_t wanted);

}  // namespace lodestone
