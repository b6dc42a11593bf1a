// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>
#include <string_view>

#include "lodestone/partition/partition.h"

namespace lodestone {

/// Options of Sdf.
struct Sdf_options {
  double cone_angle = 2 * std::numbers::pi / 3;  ///< opening of the cone of rays, in radians; (0, pi)
  std::size_t rays = 25;                         ///< per face; [1, 1000]
  std::size_t clusters = 5;                      ///< of diameters, at most; [2, 100]
  double smoothing = 0.26;                       ///< cost of a border relative to that of a wrong cluster; [0, 100]
};

/// Partition strategy: the parts of a body, told apart by their thickness.
///
/// Shapira, Shamir and Cohen-Or, "Consistent mesh partitioning and skeletonisation using the shape diameter function",
/// 2008:
///  - CGAL's `sdf_values` sends rays into the body from every face, takes the typical length of the robust ones, and
///    smooths it along the surface. This is the diameter of the face.
///  - The logarithms of the diameters are divided into at most `clusters`, by LBG. Clusters nearer than a tenth of the
///    whole range are joined, then a mixture of normal distributions is fitted.
///  - CGAL's `alpha_expansion_graphcut` trades each face's fit to its cluster against borders, which are cheap along
///    concave edges. The connected faces of a cluster are a segment.
///  - Vertices take the label with the largest area around them, see `vertex_labels`. Then `adjust_region_count` brings
///    the number of segments to the wanted number.
///
/// The mixture is our own, because CGAL's divides by zero if a diameter is far from all clusters, and stops at clusters
/// that become empty. A face has the mean diameter of its neighbours if all its rays leave through an opening or it has
/// no area; if that is undefined, it has the smallest diameter of all. If no ray hits anything, or the thickness is the
/// same everywhere (a sheet, a sphere), each component is one segment, and `adjust_region_count` makes all cuts.
///
/// Nothing is random. O(F log F) for the rays, with a large factor: 200 000 faces take about two minutes. A fan
/// of n long faces around one vertex takes O(n^2), which is slow from some thousands on.
struct Sdf {
  static constexpr std::string_view name = "sdf";  ///< for `make_strategy`, tables and messages

  Sdf_options options = {};  ///< of the rays and of the clusters

  /// See Partition_strategy.
  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  /// The same for a surface by index.
  /// @throws Bad_argument  no region wanted, or an option out of range
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

/// The segments of `Sdf` before their number is adjusted, per face; `no_region` for faces that `oriented_mesh` leaves
/// out. Cost as of `Sdf`.
std::vector<Region_index> sdf_segments(const Numbered_surface& surface, const Sdf_options& options = {});

}  // namespace lodestone
