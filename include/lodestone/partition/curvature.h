// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lodestone/partition/partition.h"

namespace lodestone {

struct Curvature_options {
  std::size_t rings = 2;  ///< of neighbours that a patch is fitted to, 1 to 10
};

/// Mean curvature of each vertex, per unit of length: 1 / r on a sphere of radius r whose normals point outwards, 0 on
/// a plane, 1 / 2r on a cylinder, negative where the surface is hollow.
///
/// A paraboloid is fitted to each vertex and its rings of neighbours, by CGAL's Monge_via_jet_fitting: Cazals and
/// Pouget, "Estimating differential quantities using polynomial fitting of osculating jets", 2005. Its side is that of
/// the vertex normal. On a smooth surface the error falls with the length of the edges.
///
/// 0 where there is nothing to fit: a vertex with fewer than five neighbours in its rings (isolated vertices, a single
/// triangle), without a normal, or whose neighbours lie on a line or in a point. A vertex with more than 1000 vertices
/// in its rings is fitted to the first 1000 that a breadth-first search meets, those of lower number first. O(V n) for
/// n vertices in the rings of one.
///
/// @throws Bad_argument  rings out of range
std::vector<double> mean_curvatures(const Numbered_surface& surface, const Curvature_options& options = {});

}  // namespace lodestone
