// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/centroidal.h"

#include <Eigen/Geometry>

#include "lodestone/mesh/scaled_positions.h"
#include "lodestone/partition/farthest_point.h"
#include "lodestone/partition/geodesic_voronoi.h"
#include "lodestone/partition/random_voronoi.h"
#include "partition/used_surface.h"

namespace lodestone {

namespace {

/// A third of the area of each face for each of its corners.
Eigen::VectorXd vertex_areas(const Numbered_surface& surface) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(surface.positions.rows());
  for (const auto& [a, b, c] : surface.faces) {
    const Eigen::RowVector3d first = surface.positions.row(b) - surface.positions.row(a);
    const Eigen::RowVector3d second = surface.positions.row(c) - surface.positions.row(a);
    const double third = first.cross(second).norm() / 6;
    for (const auto corner : {a, b, c}) areas[corner] += third;
  }
  return areas;
}

double energy(const Geodesic_voronoi& cells, const Eigen::VectorXd& areas) {
  double sum = 0;
  for (std::uint32_t v = 0; v < areas.size(); ++v)
    if (cells.nearest_seed(v) != Geodesic_voronoi::no_seed) sum += areas[v] * cells.distance(v) * cells.distance(v);
  return sum;
}

/// One row per cell: its centroid. Computed relative to the seed of the cell, so that no digits are lost far from the
/// origin.
Positions centroids(const Positions& positions, const Geodesic_voronoi& cells, const Eigen::VectorXd& areas) {
  const auto count = static_cast<Eigen::Index>(cells.seeds().size());
  Positions weighted = Positions::Zero(count, 3), plain = Positions::Zero(count, 3);
  Eigen::VectorXd area = Eigen::VectorXd::Zero(count), size = Eigen::VectorXd::Zero(count);
  for (std::uint32_t v = 0; v < areas.size(); ++v) {
    const Region_index cell = cells.nearest_seed(v);
    if (cell == Geodesic_voronoi::no_seed) continue;
    const Eigen::RowVector3d offset = positions.row(v) - positions.row(cells.seeds()[cell]);
    weighted.row(cell) += areas[v] * offset;
    plain.row(cell) += offset;
    area[cell] += areas[v];
    size[cell] += 1;
  }
  for (Eigen::Index cell = 0; cell < count; ++cell) {
    const Eigen::RowVector3d offset = area[cell] > 0 ? weighted.row(cell) / area[cell] : plain.row(cell) / size[cell];
    plain.row(cell) = positions.row(cells.seeds()[cell]) + offset;
  }
  return plain;
}

/// Per cell the vertex nearest to its centroid. Ties go to the seed, then to the lowest index.
std::vector<std::uint32_t> central_vertices(const Positions& positions, const Geodesic_voronoi& cells,
                                            const Eigen::VectorXd& areas) {
  const Positions centroid = centroids(positions, cells, areas);
  const auto squared_distance = [&](std::uint32_t v, Region_index cell) {
    return (positions.row(v) - centroid.row(cell)).squaredNorm();
  };
  std::vector<std::uint32_t> central = cells.seeds();
  std::vector<double> least;
  for (Region_index cell = 0; cell < central.size(); ++cell) least.push_back(squared_distance(central[cell], cell));
  for (std::uint32_t v = 0; v < areas.size(); ++v) {
    const Region_index cell = cells.nearest_seed(v);
    if (cell == Geodesic_voronoi::no_seed) continue;
    const double distance = squared_distance(v, cell);
    if (distance >= least[cell]) continue;
    least[cell] = distance;
    central[cell] = v;
  }
  return central;
}

std::vector<std::uint32_t> first_seeds(const Numbered_surface& surface, std::size_t count,
                                       const Centroidal_options& options) {
  if (options.start == Centroidal_start::random_vertices) return random_vertices(surface.graph, count, options.seed);
  return farthest_points(surface.graph, surface.positions, count, options.seed);
}

}  // namespace

Centroidal_seeds centroidal_seeds(const Numbered_surface& surface, std::size_t count,
                                  const Centroidal_options& options) {
  if (options.max_iterations == 0) throw Bad_argument("centroidal cells: max_iterations must be at least 1");
  const Eigen::VectorXd areas = vertex_areas(surface);
  Geodesic_voronoi cells(surface.graph, surface.positions);
  cells.add(first_seeds(surface, count, options));

  Centroidal_seeds result{.vertices = cells.seeds(), .energies = {energy(cells, areas)}};
  double least = result.energies.front();
  for (std::size_t iteration = 0; iteration < options.max_iterations && !result.settled; ++iteration) {
    const auto seeds = central_vertices(surface.positions, cells, areas);
    result.settled = seeds == cells.seeds();
    cells.clear();
    cells.add(seeds);
    result.energies.push_back(energy(cells, areas));
    if (result.energies.back() > least) continue;
    least = result.energies.back();
    result.vertices = seeds;
  }
  return result;
}

Labelling Centroidal::label(const Numbered_surface& surface, std::size_t regions) const {
  return label_used(surface, regions, [this](const Numbered_surface& used, std::size_t wanted) -> Labelling {
    const Positions positions = scaled_positions(used.positions);
    const auto seeds = centroidal_seeds({used.graph, positions, used.faces}, wanted, options);
    Geodesic_voronoi cells(used.graph, positions);
    cells.add(seeds.vertices);
    return {.labels = cells.labels(), .iterations = seeds.energies.size() - 1};
  });
}

}  // namespace lodestone
