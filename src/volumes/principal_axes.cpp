// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/principal_axes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "lodestone/volumes/aabb.h"
#include "volumes/slab_kernel.h"

namespace lodestone {
namespace {

/// Whether products of two differences were safe from overflow and underflow.
bool measured(const kernel::Moments& sums) {
  const double size = sums.second[0] + sums.second[1] + sums.second[2];
  return size > 1e-250 && size < 1e250;
}

/// A power of 2 that scales the longest side of the box around a leaf to about 1, or as near to 1 as a double allows.
double scale_to_one(const Leaf_faces& faces) {
  Aabb box;
  box.enclose(faces);
  double side = 0;
  for (int axis = 0; axis < 3; ++axis) side = std::max(side, box.high[axis] - box.low[axis]);
  return side > 0 && std::isfinite(side) ? std::ldexp(1.0, -std::clamp(std::ilogb(side), -1000, 1000)) : 1;
}

Eigen::Matrix3d second_moments(const Leaf_faces& faces) {
  auto sums = kernel::moments(faces, 1);
  if (!measured(sums)) sums = kernel::moments(faces, scale_to_one(faces));
  const auto& [xx, yy, zz, xy, xz, yz] = sums.second;
  const Eigen::Vector3d first(sums.first);
  Eigen::Matrix3d second;
  second << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return second - first * (first.transpose() / static_cast<double>(faces.vertices.size()));
}

/// The computed dot products, each at most 1.1 here, have a relative error of less than 4 x 2^-53.
bool orthonormal(const Eigen::Matrix3d& axes) {
  return ((axes * axes.transpose() - Eigen::Matrix3d::Identity()).array().abs() < 2e-15).all();
}

}  // namespace

Eigen::Matrix3d principal_axes(const Eigen::Matrix3d& moments) {
  if (!moments.allFinite()) return Eigen::Matrix3d::Identity();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(moments);
  // The solver's eigenvectors are orthonormal up to a rounding error that is not documented.
  const Eigen::Vector3d longest = solver.eigenvectors().col(2).normalized();
  const Eigen::Vector3d shortest = solver.eigenvectors().col(0);
  const Eigen::Vector3d across = (shortest - shortest.dot(longest) * longest).normalized();
  Eigen::Matrix3d axes;
  axes << across.transpose(), longest.cross(across).transpose(), longest.transpose();
  return orthonormal(axes) ? axes : Eigen::Matrix3d::Identity();
}

Eigen::Matrix3d principal_axes(const Leaf_faces& faces) { return principal_axes(second_moments(faces)); }

}  // namespace lodestone
