// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>
#include <string_view>

#include "lodestone/partition/partition.h"

namespace lodestone {

struct Sdf_options {
  double cone_angle = 2 * std::numbers::pi / 3;  ///< opening of the cone of rays, in radians; (0, pi)
  std::size_t rays = 25;                         ///< per face; [1, 1000]
  std::size_t clusters = 5;                      ///< of diameters, at most; [2, 100]
  double smoothing = 0.26;                       ///< what a border costs against a wrong cluster; [0, 100]
};

/// Partition strategy: the parts that a thing would be taken apart into, by how thick it is.
///
/// Shapira, Shamir and Cohen-Or, "Consistent mesh partitioning and skeletonisation using the shape diameter function",
/// 2008. CGAL's `sdf_values` sends rays into the body from every face, takes the typical length of the robust ones and
/// smooths it along the surface. The logarithms of these diameters fall into up to `clusters` (LBG, those nearer than a
/// tenth of the whole range joined, then a mixture of normal distributions); CGAL's `alpha_expansion_graphcut` trades
/// each face's fit to its cluster against borders, which are cheap along concave edges. Connected faces of a cluster
/// are a segment. Vertices take the label of most of the area around them, see `vertex_labels`, and
/// `adjust_region_count` brings the number of segments to the number wanted.
///
/// The mixture is ours: CGAL's own divides by zero where a diameter is far from all clusters, and stops at clusters
/// that become empty. A face whose rays all leave through an opening, or that has no area, has the mean diameter of its
/// neighbours, else the smallest of all. A surface on which no ray hits anything, or that is equally thick everywhere
/// (a sheet, a sphere), is one segment per component, all cut by `adjust_region_count`.
///
/// Nothing is drawn at random. O(F log F) for the rays, with a large factor: 200 000 faces take about two minutes.
struct Sdf {
  static constexpr std::string_view name = "sdf";

  Sdf_options options = {};

  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  /// @throws Bad_argument  no region wanted, or an option out of range
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

/// The segments of `Sdf` before their number is adjusted, per face; `no_region` for faces that are no part of a mesh.
std::vector<Region_index> sdf_segments(const Numbered_surface& surface, const Sdf_options& options = {});

}  // namespace lodestone
