// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string_view>

#include "lodestone/mesh/concepts.h"

/// Built-in shapes. Every function throws Bad_argument for a count below its documented minimum, a length that is not
/// positive and finite, or more than 50 million triangles. Faces are counter-clockwise seen from outside.
namespace lodestone {

/// Number of squares that each Bezier patch is cut into along its two parameters. Each square gives two triangles.
struct Patch_grid {
  std::size_t u = 9;   ///< across the rows of control points; >= 1
  std::size_t v = 10;  ///< along a row of control points; >= 1
};

/// The Utah teapot: 32 patches, 6.4 units from handle to spout, z up, the bottom in z = 0.
///
/// 64 u v - 8 v triangles: each patch at the lid's knob and at the bottom has one edge that is a single point, and
/// squares there give one triangle each. Body, lid, handle and spout are four components, which have borders and
/// intersect each other. For v = 1 handle and spout are flat, with two sides. The default has 5680 triangles; the
/// teapot of \cite saenghaengtham2006 has 5784 polygons, which no grid gives.
Surface_mesh teapot(const Patch_grid& grid = {});

/// Mesh of bicubic Bezier patches, welded where patches share the control points of a border.
///
/// The text has the number of patches and of points; 16 point indices per patch, row by row, from 0; and three
/// coordinates per point. The cross product (along a row) x (from row to row) points outside; patches that disagree
/// with their neighbours are reversed. Where surfaces share a vertex or cross in an edge, each gets its own copy.
///
/// @param name  used in error messages in place of a file name
/// @throws Bad_mesh  with name, line and cause
Surface_mesh bezier_patches(std::string_view text, std::string_view name, const Patch_grid& grid = {});

/// Unit sphere of `slices` >= 3 sectors around the z-axis and `stacks` >= 2 layers along it:
/// 2 slices (stacks - 1) triangles, 1260 for (30, 22).
Surface_mesh uv_sphere(std::size_t slices, std::size_t stacks);

/// Unit sphere from an icosahedron whose edges are cut into `frequency` >= 1 parts: 20 frequency^2 triangles of nearly
/// equal size.
Surface_mesh icosphere(std::size_t frequency);

/// Options of `torus_knot`.
struct Torus_knot_options {
  std::size_t p = 2;           ///< turns around the z-axis; >= 1
  std::size_t q = 3;           ///< turns around the torus's tube; coprime to p; (1, 0) is a torus
  double radius = 1;           ///< of the torus, from the z-axis to the middle of its tube, whose radius is half; > 0
  double tube = 0.2;           ///< radius of the tube around the knot; > 0
  std::size_t segments = 120;  ///< segments along the knot; >= 3
  std::size_t sides = 12;      ///< sides of the tube's cross section; >= 3
};

/// Closed tube along a (p, q) torus knot: 2 segments sides triangles.
///
/// The tube intersects itself where strands are nearer than two tube radii; this is not checked.
Surface_mesh torus_knot(const Torus_knot_options& options = {});

/// Open grid of columns x rows squares over the unit square [0,1]^2 of the xy-plane, normal +z; both >= 1.
/// 2 columns rows triangles.
Surface_mesh cloth(std::size_t columns, std::size_t rows);

}  // namespace lodestone
