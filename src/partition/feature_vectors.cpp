// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/feature_vectors.h"

#include <Eigen/Geometry>
#include <limits>

#include "lodestone/mesh/scaled_positions.h"

namespace lodestone {

namespace {

/// Positions relative to their mean, scaled such that the farthest is at distance 1.
Positions scaled_to_unit_ball(const Positions& positions) {
  Positions scaled = scaled_positions(positions);
  scaled.rowwise() -= scaled.colwise().mean().eval();
  const double extent = scaled.cwiseAbs().maxCoeff();
  if (extent == 0) return scaled;
  scaled /= extent;
  return scaled / scaled.rowwise().norm().maxCoeff();
}

void check_weights(const Feature_options& options) {
  const auto usable = [](double weight) { return weight >= 0 && weight <= largest_weight; };
  if (!usable(options.position_weight) || !usable(options.normal_weight))
    throw Bad_argument("the weights of position and normal must be between 0 and 1e6");
  if (options.position_weight == 0 && options.normal_weight == 0)
    throw Bad_argument("the weights of position and normal must not both be 0");
}

}  // namespace

Positions vertex_normals(const Positions& positions, std::span<const Corners> faces) {
  const Positions scaled = scaled_positions(positions);
  const double extent = (scaled.colwise().maxCoeff() - scaled.colwise().minCoeff()).maxCoeff();
  Positions normals = Positions::Zero(positions.rows(), 3);
  if (extent == 0) return normals;
  for (const auto& [a, b, c] : faces) {
    const Eigen::RowVector3d first = (scaled.row(b) - scaled.row(a)) / extent;
    const Eigen::RowVector3d second = (scaled.row(c) - scaled.row(a)) / extent;
    const Eigen::RowVector3d area_normal = first.cross(second);
    // The cross product of parallel sides is only rounding error, with an arbitrary direction.
    constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
    if (area_normal.norm() <= rounding * first.norm() * second.norm()) continue;
    for (const auto corner : {a, b, c}) normals.row(corner) += area_normal;
  }
  for (Eigen::Index v = 0; v < normals.rows(); ++v) {
    const double length = normals.row(v).norm();
    if (length > 0) normals.row(v) /= length;
  }
  return normals;
}

Feature_vectors feature_vectors(const Positions& positions, std::span<const Corners> faces,
                                const Feature_options& options) {
  check_weights(options);
  if (options.normal_weight == 0) return options.position_weight * scaled_to_unit_ball(positions);
  if (options.position_weight == 0) return options.normal_weight * vertex_normals(positions, faces);

  Feature_vectors features(positions.rows(), 6);
  features.leftCols<3>() = options.position_weight * scaled_to_unit_ball(positions);
  features.rightCols<3>() = options.normal_weight * vertex_normals(positions, faces);
  return features;
}

}  // namespace lodestone
