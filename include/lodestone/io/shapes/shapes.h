// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string_view>

#include "lodestone/mesh/concepts.h"

/// Built-in shapes. Every function throws Bad_argument for a count below the documented least one, a length that is
/// not positive and finite, or more than 50 million triangles. Faces are counter-clockwise seen from outside.
namespace lodestone {

/// Control points of the Utah teapot in the format that `bezier_patches` reads.
extern const char* const teapot_patches;

/// Squares that each Bezier patch is cut into, along its two parameters; each square gives two triangles.
struct Patch_grid {
  std::size_t u = 9;   ///< from one row of control points to the same place in the next row; >= 1
  std::size_t v = 10;  ///< along a row of control points; >= 1
};

/// The Utah teapot: 32 patches, 6.4 units from handle to spout, z up, the bottom in z = 0.
///
/// 64 u v - 8 v triangles: the patches at the lid's knob and at the bottom have one edge that is a single point, where
/// a square gives one triangle. Body, lid, handle and spout are four components; they have borders and pass through
/// each other. For v = 1 handle and spout have two sides and lie flat. The default has 5680 triangles; the teapot of
/// \cite saenghaengtham2006 has 5784 polygons, which no grid gives.
Surface_mesh teapot(const Patch_grid& grid = {});

/// Mesh of bicubic Bezier patches, welded where patches share the control points of a border.
///
/// The text holds the number of patches and of points; 16 point numbers per patch, row by row, counted from 0; and
/// three coordinates per point. Outside is where (along a row) x (from row to row) points; neighbouring patches that
/// disagree are made to agree. Where surfaces touch in a vertex or cross in an edge, each gets a copy of its own.
///
/// @param name  what error messages call the text
/// @throws Bad_mesh with name, line and cause
Surface_mesh bezier_patches(std::string_view text, std::string_view name, const Patch_grid& grid = {});

/// Unit sphere of `slices` >= 3 sectors around the z-axis and `stacks` >= 2 layers along it:
/// 2 slices (stacks - 1) triangles, 1260 for (30, 22).
Surface_mesh uv_sphere(std::size_t slices, std::size_t stacks);

/// Unit sphere from an icosahedron whose edges are cut into `frequency` >= 1 parts: 20 frequency^2 triangles of about
/// equal size.
Surface_mesh icosphere(std::size_t frequency);

struct Torus_knot_options {
  std::size_t p = 2;           ///< turns around the z-axis; >= 1
  std::size_t q = 3;           ///< turns around the torus's own ring; no divisor in common with p; (1, 0) is a torus
  double radius = 1;           ///< from the z-axis to the ring's middle; the ring's own radius is half of it; > 0
  double tube = 0.2;           ///< radius of the tube around the knot; > 0
  std::size_t segments = 120;  ///< cuts along the knot; >= 3
  std::size_t sides = 12;      ///< cuts around the tube; >= 3
};

/// Closed tube along a (p, q) torus knot: 2 segments sides triangles.
///
/// The tube passes through itself where strands are nearer than two tube radii; nothing prevents that.
Surface_mesh torus_knot(const Torus_knot_options& options = {});

/// Open grid of columns x rows squares over the unit square [0,1]^2 of the xy-plane, normal +z; both >= 1.
/// 2 columns rows triangles.
Surface_mesh cloth(std::size_t columns, std::size_t rows);

}  // namespace lodestone
