// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/region_extents.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <boost/graph/filtered_graph.hpp>
#include <boost/property_map/function_property_map.hpp>
#include <boost/property_map/property_map.hpp>
#include <cmath>
#include <limits>
#include <tuple>

namespace lodestone {

namespace {

struct In_region {
  const Region_index* labels = nullptr;
  Region_index region = 0;
  bool operator()(std::uint32_t vertex) const { return labels[vertex] == region; }
};

struct Shortest_paths {
  std::vector<double> distance;            ///< V; infinity outside the region and its connected part
  std::vector<std::uint32_t> predecessor;  ///< V
};

Shortest_paths shortest_paths(const Extent_input& input, std::uint32_t home) {
  const auto& graph = input.graph;
  Shortest_paths paths{.distance = std::vector<double>(num_vertices(graph), std::numeric_limits<double>::infinity()),
                       .predecessor = std::vector<std::uint32_t>(num_vertices(graph), home)};
  const boost::filtered_graph region(graph, boost::keep_all(), In_region{input.labels.data(), input.labels[home]});
  const auto index = get(boost::vertex_index, graph);
  const auto edge_length =
      boost::make_function_property_map<Vertex_graph::edge_descriptor>([&](const Vertex_graph::edge_descriptor& edge) {
        return (input.position(source(edge, graph)) - input.position(target(edge, graph))).norm();
      });
  boost::dijkstra_shortest_paths(
      region, home,
      boost::weight_map(edge_length)
          .distance_map(boost::make_iterator_property_map(paths.distance.begin(), index))
          .predecessor_map(boost::make_iterator_property_map(paths.predecessor.begin(), index))
          .distance_inf(std::numeric_limits<double>::infinity()));
  return paths;
}

struct Tangent_frame {
  Eigen::Vector3d x, y;
};

Tangent_frame tangent_frame(const Eigen::Vector3d& normal, const Eigen::Vector3d& x_axis) {
  const double length = normal.stableNorm();
  const Eigen::Vector3d n = length > 0 ? Eigen::Vector3d(normal / length) : Eigen::Vector3d::UnitZ();
  Eigen::Vector3d x = x_axis - x_axis.dot(n) * n;
  if (!(x.norm() > 1e-6 * x_axis.norm())) {
    Eigen::Index flattest = 0;
    n.cwiseAbs().minCoeff(&flattest);
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(flattest);
    x = axis - axis.dot(n) * n;
  }
  x.normalize();
  return {.x = x, .y = n.cross(x)};
}

/// The narrowest of four cones around a direction that contains an offset: 0 within 5.6 degrees, 3 within 45; 4: none.
/// The cones are slightly wider than that, so that rounding does not decide about an offset on the edge of a cone.
std::size_t cone(double along, double across) {
  constexpr std::array<double, 4> tangents{0.0985, 0.1989, 0.4142, 1.0};
  std::size_t narrowest = 0;
  while (narrowest < tangents.size() && !(across <= along * tangents[narrowest] * (1 + 1e-9))) ++narrowest;
  return along > 0 ? narrowest : tangents.size();
}

bool on_border(const Extent_input& input, std::uint32_t vertex) {
  if (input.open_border[vertex]) return true;
  return std::ranges::any_of(neighbours(input.graph, vertex),
                             [&](auto w) { return input.labels[w] != input.labels[vertex]; });
}

Border_path border_path(const Extent_input& input, const Shortest_paths& paths, std::uint32_t home, std::uint32_t end) {
  std::vector<std::uint32_t> walk{end};
  while (walk.back() != home) walk.push_back(paths.predecessor[walk.back()]);
  std::ranges::reverse(walk);

  constexpr std::size_t chords = 4;
  Border_path path{.length = paths.distance[end]};
  for (std::size_t i = 0; i <= chords; ++i) {
    const std::uint32_t sample = walk[i * (walk.size() - 1) / chords];
    if (!path.samples.empty() && path.samples.back() == sample) continue;
    if (!path.samples.empty())
      path.sampled_length += (input.position(sample) - input.position(path.samples.back())).norm();
    path.samples.push_back(sample);
  }
  return path;
}

}  // namespace

double angle_to_axis(const Eigen::Vector3d& normal, const Eigen::Vector3d& needle) {
  const auto frame = tangent_frame(normal, Eigen::Vector3d::Zero());
  return -std::atan2(needle.dot(frame.y), needle.dot(frame.x));
}

Region_extent region_extent(const Extent_input& input, std::uint32_t home, const Eigen::Vector3d& normal,
                            const Eigen::Vector3d& x_axis) {
  const auto paths = shortest_paths(input, home);
  const auto frame = tangent_frame(normal, x_axis);
  const Eigen::Vector3d origin = input.position(home);

  std::vector<std::uint32_t> reached;
  for (std::uint32_t v = 0; v < paths.distance.size(); ++v)
    if (v != home && std::isfinite(paths.distance[v])) reached.push_back(v);
  const bool has_border =
      on_border(input, home) || std::ranges::any_of(reached, [&](auto v) { return on_border(input, v); });

  // The nearest border vertex within the narrowest cone that holds one. Without a border: the farthest vertex within 45
  // degrees.
  struct End {
    std::uint32_t vertex;
    std::size_t cone = 4;
    double distance = 0;
  };
  std::array<End, 4> ends;
  ends.fill({.vertex = home});
  for (const auto v : reached) {
    if (has_border && !on_border(input, v)) continue;
    const Eigen::Vector3d offset = input.position(v) - origin;
    const double x = offset.dot(frame.x), y = offset.dot(frame.y);
    // A vertex straight above or below home has no direction in the tangent plane.
    if (std::hypot(x, y) <= 1e-9 * offset.norm()) continue;
    const std::array<double, 4> along{x, -x, y, -y};
    for (std::size_t direction = 0; direction < 4; ++direction) {
      const std::size_t narrowest = cone(along[direction], std::abs(along[(direction + 2) % 4]));
      if (narrowest == 4) continue;
      End& end = ends[direction];
      const double distance = paths.distance[v];
      const bool better =
          has_border ? std::tie(narrowest, distance) < std::tie(end.cone, end.distance) : distance > end.distance;
      if (better) end = {.vertex = v, .cone = narrowest, .distance = distance};
    }
  }

  Region_extent extent;
  for (std::size_t direction = 0; direction < 4; ++direction)
    if (ends[direction].vertex != home)
      extent.paths[direction] = border_path(input, paths, home, ends[direction].vertex);
  return extent;
}

}  // namespace lodestone
