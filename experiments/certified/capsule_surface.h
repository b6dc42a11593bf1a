// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "lodestone/mesh/concepts.h"

/// Closed surfaces around capsules: the flesh of characters that the experiment makes itself.
namespace lodestone {

/// All points within a radius of a segment. The radius changes linearly from one end to the other.
struct Capsule {
  std::size_t joint = 0;  ///< that moves it
  Eigen::Vector3d from, to;
  double radius_from = 1, radius_to = 1;

  /// Of a point to the surface; negative inside. Exact where both radii are equal.
  double distance(const Eigen::Vector3d& point) const;
};

struct Capsule_surface_options {
  double cell = 0.1;            ///< edge length of the grid on which the surface is found; > 0
  double rounding = 0.02;       ///< how far from each other capsules still flow together; > 0
  std::size_t smoothings = 12;  ///< passes that even out the triangles
  std::size_t faces = 2500;     ///< left by collapsing edges, or one more
};

/// The surface of a smooth union of capsules: closed, without borders, faces counter-clockwise seen from outside.
///
/// The union is the zero set of -k log sum_i exp(-d_i / k), with the distances d_i and the rounding k. Marching
/// tetrahedra, six to a cell, find it. CGAL collapses edges. Then each pass moves
/// every vertex to the mean of its neighbours, and back onto the surface along the gradient.
Surface_mesh capsule_surface(std::span<const Capsule> capsules, const Capsule_surface_options& options);

}  // namespace lodestone
