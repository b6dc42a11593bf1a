// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lodestone/partition/partition.h"

namespace lodestone {

/// Options of `mean_curvatures`.
struct Curvature_options {
  std::size_t rings = 2;  ///< rings of neighbours to which a paraboloid is fitted; [1, 10]
};

/// Mean curvature of each vertex, per unit of length: 1 / r on a sphere of radius r whose normals point outwards, 0 on
/// a plane, 1 / 2r on a cylinder, negative where the surface is concave.
///
/// CGAL's Monge_via_jet_fitting fits a paraboloid to each vertex and its rings of neighbours: Cazals and Pouget,
/// "Estimating differential quantities using polynomial fitting of osculating jets", 2005. The vertex normal tells the
/// outer side. On a smooth surface the error falls with the length of the edges.
///
/// The curvature is 0 where there is nothing to fit. That is so at a vertex with fewer than five neighbours in its
/// rings (isolated vertices, a single triangle) and at a vertex without a normal. It is also so where all neighbours
/// lie on a line or in a point.
///
/// The fit takes whole rings where degrees are ordinary. Of a vertex with more than 64 neighbours, 64 count as its
/// neighbours, spread evenly over their order by index. A ring that would bring the vertices to more than 256 is
/// thinned to 64 in the same way, in the order in which they are reached. So the cost is O(V), whatever the degrees,
/// with a factor that grows with the rings.
///
/// @throws Bad_argument  rings out of range
std::vector<double> mean_curvatures(const Numbered_surface& surface, const Curvature_options& options = {});

}  // namespace lodestone
