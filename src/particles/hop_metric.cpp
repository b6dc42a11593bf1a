// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/hop_metric.h"

#include <algorithm>
#include <boost/graph/breadth_first_search.hpp>
#include <boost/graph/visitors.hpp>
#include <boost/property_map/property_map.hpp>

namespace lodestone {

std::vector<std::uint32_t> breadth_first_hops(const Vertex_graph& graph, std::uint32_t source) {
  std::vector<std::uint32_t> hops(num_vertices(graph), unreached);
  hops[source] = 0;
  const auto hop_map = boost::make_iterator_property_map(hops.begin(), get(boost::vertex_index, graph));
  boost::breadth_first_search(
      graph, source, boost::visitor(boost::make_bfs_visitor(boost::record_distances(hop_map, boost::on_tree_edge()))));
  return hops;
}

std::size_t hop_eccentricity(const Vertex_graph& graph, std::uint32_t source) {
  std::size_t farthest = 0;
  for (const auto hops : breadth_first_hops(graph, source))
    if (hops != unreached) farthest = std::max<std::size_t>(farthest, hops);
  return farthest;
}

std::size_t hop_diameter(const Vertex_graph& graph, std::span<const std::uint32_t> targets) {
  std::size_t diameter = 0;
  if (targets.size() < 2) return diameter;
  for (const auto source : targets) {
    const auto hops = breadth_first_hops(graph, source);
    for (const auto target : targets)
      if (hops[target] != unreached) diameter = std::max<std::size_t>(diameter, hops[target]);
  }
  return diameter;
}

}  // namespace lodestone
