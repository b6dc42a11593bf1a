// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/geodesic_voronoi.h"

#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <boost/graph/filtered_graph.hpp>
#include <boost/property_map/function_property_map.hpp>
#include <boost/property_map/property_map.hpp>
#include <functional>
#include <string>

#include "lodestone/mesh/errors.h"

namespace lodestone {

Geodesic_voronoi::Geodesic_voronoi(const Vertex_graph& graph, const Positions& positions)
    : graph_(graph), positions_(positions), lengths_(num_edges(graph)) {
  for (const auto& edge : boost::make_iterator_range(edges(graph)))
    lengths_[get(boost::edge_index, graph, edge)] =
        (positions.row(source(edge, graph)) - positions.row(target(edge, graph))).norm();
  clear();
}

void Geodesic_voronoi::clear() {
  nearest_.assign(num_vertices(graph_), {});
  is_seed_.assign(num_vertices(graph_), false);
  seeds_.clear();
}

bool Geodesic_voronoi::shortens(const Edge& edge) const {
  const std::uint32_t end = target(edge, graph_);
  return !is_seed_[end] && nearest_[source(edge, graph_)].after(length(edge)) < nearest_[end];
}

void Geodesic_voronoi::add(std::span<const std::uint32_t> vertices) {
  for (const auto v : vertices) {
    if (v >= num_vertices(graph_)) throw Bad_argument("there is no vertex " + std::to_string(v) + " to be a seed");
    if (is_seed_[v]) throw Bad_argument("vertex " + std::to_string(v) + " is a seed already");
    is_seed_[v] = true;
    nearest_[v] = {.distance = 0, .seed = static_cast<Region_index>(seeds_.size())};
    seeds_.push_back(v);
  }

  // The filtered graph has only edges that shorten a path, so the search ends where the cells of earlier seeds begin.
  const boost::filtered_graph shortening(graph_, Shortens{this});
  const auto index = get(boost::vertex_index, graph_);
  boost::dijkstra_shortest_paths_no_init(
      shortening, vertices.begin(), vertices.end(), boost::dummy_property_map(),
      boost::make_iterator_property_map(nearest_.begin(), index),
      boost::make_function_property_map<Edge>([this](const Edge& edge) { return length(edge); }), index,
      std::less<Seed_distance>(), [](const Seed_distance& nearest, double length) { return nearest.after(length); },
      Seed_distance{.distance = 0, .seed = 0}, boost::dijkstra_visitor<>());
}

std::vector<Region_index> Geodesic_voronoi::labels() const {
  std::vector<Region_index> labels(nearest_.size());
  for (std::uint32_t v = 0; v < labels.size(); ++v)
    labels[v] = nearest_seed(v) == no_seed ? nearest_in_a_straight_line(v) : nearest_seed(v);
  return labels;
}

Region_index Geodesic_voronoi::nearest_in_a_straight_line(std::uint32_t vertex) const {
  Region_index nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (Region_index seed = 0; seed < seeds_.size(); ++seed) {
    const double squared_distance = (positions_.row(vertex) - positions_.row(seeds_[seed])).squaredNorm();
    if (squared_distance < least) {
      least = squared_distance;
      nearest = seed;
    }
  }
  return nearest;
}

}  // namespace lodestone
