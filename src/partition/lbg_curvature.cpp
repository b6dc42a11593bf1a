// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/lbg_curvature.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "lodestone/mesh/scaled_positions.h"
#include "partition/used_surface.h"

namespace lodestone {

Feature_vectors curvature_factor(const Numbered_surface& surface, const Curvature_options& options) {
  const Used_surface used(surface);
  // Scaled, because curvature or radius alone may overflow where their product does not.
  const Positions scaled = scaled_positions(used.surface().positions);
  const auto curvatures = mean_curvatures({used.surface().graph, scaled, used.surface().faces}, options);
  const Eigen::RowVector3d mean = scaled.colwise().mean();
  const double radius = (scaled.rowwise() - mean).rowwise().stableNorm().maxCoeff();
  Feature_vectors factor(scaled.rows(), 1);
  for (Eigen::Index v = 0; v < factor.rows(); ++v)
    factor(v, 0) = 2 / std::numbers::pi * std::atan(curvatures[v] * radius);
  return used.rows_of_all_vertices(std::move(factor));
}

Labelling Lbg_curvature::label(const Numbered_surface& surface, std::size_t regions) const {
  if (!(options.curvature_weight >= 0 && options.curvature_weight <= largest_weight))
    throw Bad_argument("the weight of the curvature must be between 0 and 1e6");
  const Feature_vectors factor = options.curvature_weight * curvature_factor(surface, options.curvature);
  const Numbered_surface whole{surface.graph, surface.positions, surface.faces};  // the factor has its rows already
  return Lbg{.options = options.lbg, .extra_factors = factor}.label(whole, regions);
}

}  // namespace lodestone
