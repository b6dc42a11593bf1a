// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/partition/curvature.h"
#include "lodestone/partition/lbg.h"

namespace lodestone {

/// Options of Lbg_curvature.
struct Lbg_curvature_options {
  Lbg_options lbg = {};              ///< of the quantisation
  Curvature_options curvature = {};  ///< of the curvature that is one more factor
  double curvature_weight = 1;       ///< of the curvature factor, which lies between -1 and 1; [0, 1e6]
};

/// Partition strategy: the cells of LBG quantisation over position, normal and mean curvature of each vertex. See
/// `Lbg`.
///
/// The factor is 2 / pi atan(H R), where H is the mean curvature (see `mean_curvatures`) and R the largest distance of
/// a vertex from the mean of all vertices that have edges. It has no unit, and is 1/2 on a sphere. It is bounded, so a
/// spike counts no more than any sharp corner.
struct Lbg_curvature {
  static constexpr std::string_view name = "lbg_curvature";  ///< for `make_strategy`, tables and messages
  static constexpr bool is_concurrent = true;                ///< see Partition_strategy

  Lbg_curvature_options options = {};  ///< of the quantisation and of the curvature

  /// See Partition_strategy.
  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  /// The same for a surface by index.
  /// @throws Bad_argument  no region wanted, or an option out of range
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

/// The factor of `Lbg_curvature` per vertex, without its weight: V x 1, between -1 and 1. It is 0 at vertices without
/// edges.
Feature_vectors curvature_factor(const Numbered_surface& surface, const Curvature_options& options = {});

}  // namespace lodestone
