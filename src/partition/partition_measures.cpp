// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/partition_measures.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <boost/graph/filtered_graph.hpp>
#include <boost/property_map/function_property_map.hpp>
#include <boost/property_map/property_map.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>
#include <tuple>

#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/patch.h"
#include "lodestone/partition/particle_count.h"
#include "partition/used_surface.h"

namespace lodestone {

namespace {

using Labels = std::vector<Region_index>;

void check(const Numbered_surface& surface, const Numbered_partition& partition) {
  const auto vertices = static_cast<std::size_t>(surface.positions.rows());
  if (partition.labels.size() != vertices)
    throw Bad_argument("the partition has " + std::to_string(partition.labels.size()) + " labels for " +
                       std::to_string(vertices) + " vertices");
  if (partition.particles.size() != partition.regions)
    throw Bad_argument("the partition has " + std::to_string(partition.particles.size()) + " particles for " +
                       std::to_string(partition.regions) + " regions");
  if (std::ranges::any_of(partition.labels, [&](auto label) { return label >= partition.regions; }) ||
      std::ranges::any_of(partition.particles, [&](auto vertex) { return vertex >= vertices; }))
    throw Bad_argument("the partition has a label or a particle out of range");
}

/// A partition without the vertices that `Used_surface` leaves out.
Numbered_partition used_partition(const Used_surface& used, const Numbered_partition& partition) {
  if (used.is_whole()) return partition;
  const auto& vertices = used.vertices();
  Numbered_partition result{
      .labels = {}, .regions = partition.regions, .particles = {}, .statistics = partition.statistics};
  for (const auto v : vertices) result.labels.push_back(partition.labels[v]);
  for (const auto particle : partition.particles) {
    const auto place = std::ranges::lower_bound(vertices, particle);
    if (place == vertices.end() || *place != particle)
      throw Bad_argument("the particle of region " + std::to_string(result.particles.size()) + " is at vertex " +
                         std::to_string(particle) + ", which no face uses");
    result.particles.push_back(static_cast<std::uint32_t>(place - vertices.begin()));
  }
  return result;
}

/// After `used_partition`: what it leaves out counts for no region.
void check_regions(const Numbered_partition& partition) {
  std::vector<bool> has_vertex(partition.regions, false);
  for (const auto label : partition.labels) has_vertex[label] = true;
  for (Region_index region = 0; region < partition.regions; ++region) {
    if (!has_vertex[region])
      throw Bad_argument("region " + std::to_string(region) + " of the partition has no vertex with a face");
    if (const auto label = partition.labels[partition.particles[region]]; label != region)
      throw Bad_argument("the particle of region " + std::to_string(region) + " is in region " + std::to_string(label));
  }
}

double distortion(const Feature_vectors& vectors, const Labels& labels, std::size_t regions) {
  Feature_vectors means = Feature_vectors::Zero(static_cast<Eigen::Index>(regions), vectors.cols());
  std::vector<double> sizes(regions, 0);
  for (std::size_t v = 0; v < labels.size(); ++v) {
    means.row(labels[v]) += vectors.row(static_cast<Eigen::Index>(v));
    ++sizes[labels[v]];
  }
  for (std::size_t region = 0; region < regions; ++region)
    if (sizes[region] > 0) means.row(static_cast<Eigen::Index>(region)) /= sizes[region];
  double sum = 0;
  for (std::size_t v = 0; v < labels.size(); ++v)
    sum += (vectors.row(static_cast<Eigen::Index>(v)) - means.row(labels[v])).squaredNorm();
  return sum / static_cast<double>(vectors.size());
}

double size_balance(const Labels& labels, std::size_t regions) {
  std::vector<std::size_t> sizes(regions, 0);
  for (const auto label : labels) ++sizes[label];
  return static_cast<double>(std::ranges::max(sizes) * regions) / static_cast<double>(labels.size());
}

/// The corners of a face as points.
struct Face_points {
  std::array<Eigen::Vector3d, 3> at;

  Face_points(const Positions& positions, const Corners& corners)
      : at{positions.row(corners[0]), positions.row(corners[1]), positions.row(corners[2])} {}
  /// Half the cross product of two sides: its direction is the normal, its length the area.
  Eigen::Vector3d area_vector() const { return 0.5 * (at[1] - at[0]).cross(at[2] - at[0]); }
};

/// Length of the border within one face.
double border_in(const Face_points& face, const std::array<Region_index, 3>& labels) {
  const Eigen::Vector3d centroid = (face.at[0] + face.at[1] + face.at[2]) / 3;
  const bool three = labels[0] != labels[1] && labels[1] != labels[2] && labels[2] != labels[0];
  double length = 0;
  Eigen::Vector3d cut = Eigen::Vector3d::Zero();  // difference of the midpoints of the two sides that are cut
  double sign = 1;
  for (std::size_t side = 0; side < 3; ++side) {
    const std::size_t next = (side + 1) % 3;
    if (labels[side] == labels[next]) continue;
    const Eigen::Vector3d middle = 0.5 * (face.at[side] + face.at[next]);
    length += three ? (middle - centroid).norm() : 0;
    cut += sign * middle;
    sign = -1;
  }
  return three ? length : (sign < 0 ? cut.norm() : 0);
}

double border_length(const Positions& positions, std::span<const Corners> faces, const Labels& labels) {
  double border = 0, area = 0;
  for (const auto& corners : faces) {
    const Face_points face(positions, corners);
    area += face.area_vector().norm();
    border += border_in(face, {labels[corners[0]], labels[corners[1]], labels[corners[2]]});
  }
  return area > 0 ? border / std::sqrt(area) : 0;
}

/// Per region the sum of the area vectors of its faces; 0 where it is nothing but rounding, as of a closed region.
std::vector<Eigen::Vector3d> mean_normals(const Positions& positions, std::span<const Corners> faces,
                                          const Labels& labels, std::size_t regions) {
  constexpr double rounding = 1e-12;  // of the area
  std::vector<Eigen::Vector3d> mean(regions, Eigen::Vector3d::Zero());
  std::vector<double> area(regions, 0);
  for (const auto& corners : faces) {
    const Eigen::Vector3d vector = Face_points(positions, corners).area_vector();
    for (const auto corner : corners) {
      mean[labels[corner]] += vector;
      area[labels[corner]] += vector.norm();
    }
  }
  for (std::size_t region = 0; region < regions; ++region)
    if (mean[region].norm() <= rounding * area[region]) mean[region].setZero();
  return mean;
}

/// A face counts with a third of its area for the region of each of its corners.
double normal_deviation(const Positions& positions, std::span<const Corners> faces, const Labels& labels,
                        std::size_t regions) {
  constexpr double right_angle = std::numbers::pi / 2;
  const auto mean = mean_normals(positions, faces, labels, regions);
  double sum = 0, area = 0;
  for (const auto& corners : faces) {
    const Eigen::Vector3d vector = Face_points(positions, corners).area_vector();
    for (const auto corner : corners) {
      const Eigen::Vector3d& normal = mean[labels[corner]];
      const double angle = normal.isZero(0) ? right_angle : std::atan2(vector.cross(normal).norm(), vector.dot(normal));
      sum += vector.norm() * angle * angle;
      area += vector.norm();
    }
  }
  return area > 0 ? std::sqrt(sum / area) * 180 / std::numbers::pi : 0;
}

/// An edge both ends of which lie in one region.
struct Within_region {
  const Vertex_graph* graph = nullptr;
  const Region_index* labels = nullptr;
  bool operator()(const Vertex_graph::edge_descriptor& edge) const {
    return labels[source(edge, *graph)] == labels[target(edge, *graph)];
  }
};

/// Searches from all particles at once. No path leaves its region, so the searches do not interfere.
double mean_geodesic_radius(const Vertex_graph& graph, const Positions& positions,
                            const Numbered_partition& partition) {
  std::vector<double> distance(partition.labels.size(), std::numeric_limits<double>::infinity());
  const auto index = get(boost::vertex_index, graph);
  const auto distances = boost::make_iterator_property_map(distance.begin(), index);
  const auto length =
      boost::make_function_property_map<Vertex_graph::edge_descriptor>([&](const Vertex_graph::edge_descriptor& edge) {
        return (positions.row(source(edge, graph)) - positions.row(target(edge, graph))).norm();
      });
  for (const auto particle : partition.particles) distance[particle] = 0;
  const boost::filtered_graph regions(graph, Within_region{&graph, partition.labels.data()});
  std::vector<boost::default_color_type> colours(partition.labels.size(), boost::white_color);
  boost::dijkstra_shortest_paths_no_init(regions, partition.particles.begin(), partition.particles.end(),
                                         boost::dummy_property_map(), distances, length, index, std::less<>(),
                                         std::plus<>(), 0.0, boost::dijkstra_visitor<>(),
                                         boost::make_iterator_property_map(colours.begin(), index));

  std::vector<double> radii(partition.regions, 0);
  for (std::size_t v = 0; v < distance.size(); ++v)
    if (std::isfinite(distance[v])) radii[partition.labels[v]] = std::max(radii[partition.labels[v]], distance[v]);
  return std::accumulate(radii.begin(), radii.end(), 0.0) / static_cast<double>(partition.regions);
}

double ball_volume(const Positions& positions) { return std::pow(bounding_sphere(positions).radius, 3); }

double box_volume(const Positions& positions) {
  return (positions.colwise().maxCoeff() - positions.colwise().minCoeff()).prod();
}

void measure_volumes(const Positions& positions, std::span<const Corners> faces, const Numbered_partition& partition,
                     Partition_measures& measures) {
  double boxes = 0, balls = 0;
  for (const auto& patch : region_patches(faces, partition.labels, partition.regions)) {
    const Positions points = positions(patch.vertices, Eigen::all);
    boxes += box_volume(points);
    balls += ball_volume(points);
  }
  const double box = box_volume(positions), ball = ball_volume(positions);
  measures.box_volume = box > 0 ? boxes / box : 0;
  measures.ball_volume = ball > 0 ? balls / ball : 0;
}

}  // namespace

Partition_measures measure_partition(const Numbered_surface& surface, const Numbered_partition& whole_partition) {
  check(surface, whole_partition);
  const Used_surface used(surface);
  const Numbered_partition partition = used_partition(used, whole_partition);
  check_regions(partition);
  const Numbered_surface part = used.surface();
  const auto& [graph, original, faces] = std::tie(part.graph, part.positions, part.faces);
  const auto& labels = partition.labels;
  const Feature_vectors vectors = feature_vectors(original, faces);
  const Positions positions = vectors.leftCols<3>();  // scaled to radius 1

  Partition_measures measures{.regions = partition.regions};
  measures.distortion = distortion(vectors, labels, partition.regions);
  measures.size_balance = size_balance(labels, partition.regions);
  measures.parts_per_region =
      static_cast<double>(partition.statistics.repair.parts_before) / static_cast<double>(partition.regions);
  measures.border_length = border_length(positions, faces, labels);
  measures.normal_deviation = normal_deviation(positions, faces, labels, partition.regions);
  measures.geodesic_radius = mean_geodesic_radius(graph, positions, partition);
  measure_volumes(positions, faces, partition, measures);
  return measures;
}

}  // namespace lodestone
