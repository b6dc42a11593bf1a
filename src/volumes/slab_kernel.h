// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/volumes/leaf_faces.h"

/// The loops over the vertices of a leaf that fit slab volumes, built for several instruction sets and chosen at run
/// time. All handle eight vertices at a time and add sums in one order, so all give the same bits. They read nothing
/// past the z of the last vertex.
namespace lodestone::kernel {

/// Least and greatest values of K / 2 rounded sums, in this order: x, y, z; x+y, x-y, x+z, x-z, y+z, y-z; (x+y)+z,
/// (x+y)-z, (x-y)+z, (x-y)-z.
/// @param K  14: without the sums of two; 18: without the sums of three; 26: all
void dop_limits(const Leaf_faces& faces, int K, double* low, double* high);

/// An origin and three directions.
struct Frame {
  double origin[3];
  double axes[3][3];  ///< by axis, then x, y, z
};

/// Limits of the differences v = vertex - origin, rounded.
struct Frame_limits {
  double low[6];   ///< of v_x, v_y, v_z, then of (axis_x v_x + axis_y v_y) + axis_z v_z per axis, each step rounded
  double high[6];  ///< of the same
};

Frame_limits frame_limits(const Leaf_faces& faces, const Frame& frame);

/// Sums over all vertices of v = (vertex - last vertex) scale.
struct Moments {
  double first[3];   ///< of v_x, v_y, v_z
  double second[6];  ///< of their products xx, yy, zz, xy, xz, yz
};

Moments moments(const Leaf_faces& faces, double scale);

}  // namespace lodestone::kernel
