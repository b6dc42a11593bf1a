// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/feature_vectors.h"

#include <Eigen/Geometry>
#include <cmath>

#include "lodestone/mesh/scaled_positions.h"
#include "partition/parallel_sides.h"

namespace lodestone {

namespace {

/// Moves the mean of the positions to the origin, and scales them such that the farthest is at distance 1.
void move_into_unit_ball(Positions& positions) {
  positions.rowwise() -= positions.colwise().mean().eval();
  const double extent = positions.cwiseAbs().maxCoeff();
  if (extent == 0) return;
  positions /= extent;
  positions /= std::sqrt(positions.rowwise().squaredNorm().maxCoeff());
}

/// `vertex_normals` of scaled positions.
Positions normals_of(const Positions& scaled, std::span<const Corners> faces) {
  const double extent = (scaled.colwise().maxCoeff() - scaled.colwise().minCoeff()).maxCoeff();
  Positions normals = Positions::Zero(scaled.rows(), 3);
  if (extent == 0) return normals;
  for (const auto& [a, b, c] : faces) {
    const Eigen::RowVector3d first = (scaled.row(b) - scaled.row(a)) / extent;
    const Eigen::RowVector3d second = (scaled.row(c) - scaled.row(a)) / extent;
    const Eigen::RowVector3d area_normal = first.cross(second);
    if (parallel_sides(first, second, area_normal)) continue;
    for (const auto corner : {a, b, c}) normals.row(corner) += area_normal;
  }
  for (Eigen::Index v = 0; v < normals.rows(); ++v) {
    const double length = normals.row(v).norm();
    if (length > 0) normals.row(v) /= length;
  }
  return normals;
}

}  // namespace

void check(const Feature_options& options) {
  const auto usable = [](double weight) { return weight >= 0 && weight <= largest_weight; };
  if (!usable(options.position_weight) || !usable(options.normal_weight))
    throw Bad_argument("the weights of position and normal must be between 0 and 1e6");
  if (options.position_weight == 0 && options.normal_weight == 0)
    throw Bad_argument("the weights of position and normal must not both be 0");
}

Positions vertex_normals(const Positions& positions, std::span<const Corners> faces) {
  return normals_of(scaled_positions(positions), faces);
}

Feature_vectors feature_vectors(const Positions& positions, std::span<const Corners> faces,
                                const Feature_options& options) {
  check(options);
  Positions scaled = scaled_positions(positions);
  if (options.position_weight == 0) return options.normal_weight * normals_of(scaled, faces);
  Feature_vectors features(positions.rows(), options.normal_weight == 0 ? 3 : 6);
  if (options.normal_weight != 0) features.rightCols<3>() = options.normal_weight * normals_of(scaled, faces);
  move_into_unit_ball(scaled);
  features.leftCols<3>() = options.position_weight * scaled;
  return features;
}

}  // namespace lodestone
