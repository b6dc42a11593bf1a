// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/volumes/leaf_faces.h"

/// Loops over the vertices of a leaf, for fitting slab volumes. Built for several instruction sets and chosen at run
/// time. Vertices are processed eight at a time, and sums are added in the same order for any vector width, so all give
/// the same bits. Nothing is read past the z of the last vertex.
namespace lodestone::kernel {

/// K / 2 minima and maxima of rounded sums: of x, y and z; then of x+y, x-y, x+z, x-z, y+z, y-z; then of x+y+z, x+y-z,
/// x-y+z, x-y-z. The last four are computed as (x +- y) +- z. No slack is added.
/// @param K  14: without the sums of two; 18: without the sums of three; 26: all
void dop_limits(const Leaf_faces& faces, int K, double* low, double* high);

/// An origin and three directions.
struct Frame {
  double origin[3];
  double axes[3][3];  ///< by axis, then x, y, z
};

/// Limits of the differences v = vertex - origin, rounded once.
struct Frame_limits {
  double low[6];  ///< of x, y and z of v, then of (axis_x v_x + axis_y v_y) + axis_z v_z per axis, each step rounded
  double high[6];
};

Frame_limits frame_limits(const Leaf_faces& faces, const Frame& frame);

/// Sums over all vertices of v = (vertex - last vertex) scale, and of the products of its components.
struct Moments {
  double first[3];   ///< x, y, z
  double second[6];  ///< xx, yy, zz, xy, xz, yz
};

Moments moments(const Leaf_faces& faces, double scale);

}  // namespace lodestone::kernel
