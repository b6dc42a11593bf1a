// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/shell_centre.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

namespace lodestone {
namespace {

/// A sphere or a plane: size |p|^2 + normal . p + constant = 0, in units of the leaf and relative to the mean of its
/// vertices.
struct Fitted_sphere {
  double size;
  Eigen::Vector3d normal;
};

/// Eigenvector of the smallest eigenvalue, accurate enough for a fit. It dominates high powers of the inverse; the
/// shift keeps the inverse from overflowing.
Eigen::Vector4d least_eigenvector(Eigen::Matrix4d matrix) {
  matrix.diagonal().array() += 1e-13 * matrix.trace();
  Eigen::Matrix4d power = matrix.inverse();
  for (int doubling = 0; doubling < 4; ++doubling) {
    power /= power.trace();
    power *= power;
  }
  int largest;
  power.diagonal().maxCoeff(&largest);
  return power.col(largest);
}

/// The sphere of \cite taubin1991. It minimises the mean of (size |p|^2 + normal . p + constant)^2 where the mean
/// squared gradient is 1. The mean of p is 0, so the constant is -size q, with q the mean of |p|^2, and the mean
/// squared gradient is 4 size^2 q + normal^2. So (2 sqrt(q) size, normal) is an eigenvector.
Fitted_sphere fitted_sphere(const kernel::Sphere_moments& moments) {
  const double mean_square = moments.xx + moments.yy + moments.zz, unit = 2 * std::sqrt(mean_square);
  const double square = (moments.rr - mean_square * mean_square) / (unit * unit);
  const double x = moments.rx / unit, y = moments.ry / unit, z = moments.rz / unit;
  Eigen::Matrix4d matrix;
  matrix << square, x, y, z,                  //
      x, moments.xx, moments.xy, moments.zx,  //
      y, moments.xy, moments.yy, moments.yz,  //
      z, moments.zx, moments.yz, moments.zz;
  const Eigen::Vector4d vector = least_eigenvector(matrix);
  return {vector[0] / unit, vector.tail<3>()};
}

/// Sum of the faces' normals, weighted by area.
Eigen::Vector3d mean_normal(const Leaf_faces& faces) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& [a, b, c] : faces.corners) {
    const auto p = [&](std::size_t index) { return Eigen::Map<const Eigen::Vector3d>(faces.position(index)); };
    sum += (p(b) - p(a)).cross(p(c) - p(a));
  }
  return sum;
}

}  // namespace

Eigen::Vector3d shell_centre(const Leaf_faces& faces, const kernel::Leaf_points& points, const Bounding_sphere& ball) {
  constexpr double farthest = 0x1p10;
  const Eigen::Map<const Eigen::Vector3d> origin(ball.centre);
  const auto sum = kernel::sum(points, ball.centre);
  const Eigen::Vector3d mean = origin + Eigen::Vector3d(sum.x, sum.y, sum.z) / static_cast<double>(points.count);
  const auto sphere = fitted_sphere(kernel::sphere_moments(points, mean.data(), 1 / ball.radius));

  const double opposite = 2 * std::abs(sphere.size), length = sphere.normal.norm();
  if (length <= farthest * opposite) return mean - ball.radius / (2 * sphere.size) * sphere.normal;
  const bool outwards = mean_normal(faces).dot(sphere.normal) > 0;
  return mean + (outwards ? -1 : 1) * farthest * ball.radius / length * sphere.normal;
}

}  // namespace lodestone
