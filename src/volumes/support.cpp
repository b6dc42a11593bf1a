// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/support.h"

#include <algorithm>

namespace lodestone {
namespace {

using Weights = Eigen::Vector4d;

/// A ball with the new point p and some of the old points q_i on its boundary, and its centre p + sum w_i (q_i - p) in
/// their convex hull. It is the smallest ball around these points, so the largest of all such balls is the smallest
/// ball around all points.
struct Ball {
  double squared_radius = 0;
  Weights weights = Weights::Zero();

  void keep_larger(double squared, const Weights& others) {
    if (!(squared > squared_radius)) return;
    squared_radius = squared;
    weights = others;
  }
};

/// Dot products of the differences q_i - p. The centre is equidistant from p and the q_i, so
/// sum_j gram(i, j) w_j = gram(i, i) / 2, and the squared radius is half the sum of w_i gram(i, i).
using Gram = Eigen::Matrix4d;

void try_one(const Gram& gram, int i, Ball& best) {
  Weights weights = Weights::Zero();
  weights[i] = 0.5;
  best.keep_larger(gram(i, i) / 4, weights);
}

void try_two(const Gram& gram, int i, int j, Ball& best) {
  const double ii = gram(i, i), jj = gram(j, j), ij = gram(i, j);
  const double determinant = ii * jj - ij * ij;
  const double a = jj * (ii - ij), b = ii * (jj - ij);
  if (!(a >= 0 && b >= 0 && a + b <= 2 * determinant && determinant > 1e-12 * (ii * jj))) return;
  Weights weights = Weights::Zero();
  weights[i] = a / (2 * determinant);
  weights[j] = b / (2 * determinant);
  best.keep_larger((weights[i] * ii + weights[j] * jj) / 2, weights);
}

void try_three(const Gram& gram, int i, int j, int k, Ball& best) {
  const double ii = gram(i, i), jj = gram(j, j), kk = gram(k, k);
  const double ij = gram(i, j), jk = gram(j, k), ki = gram(k, i);
  const double cofactor_ii = jj * kk - jk * jk, cofactor_jj = kk * ii - ki * ki, cofactor_kk = ii * jj - ij * ij;
  const double cofactor_ij = jk * ki - kk * ij, cofactor_jk = ki * ij - ii * jk, cofactor_ki = ij * jk - jj * ki;
  const double determinant = ii * cofactor_ii + ij * cofactor_ij + ki * cofactor_ki;
  const double a = cofactor_ii * ii + cofactor_ij * jj + cofactor_ki * kk;
  const double b = cofactor_ij * ii + cofactor_jj * jj + cofactor_jk * kk;
  const double c = cofactor_ki * ii + cofactor_jk * jj + cofactor_kk * kk;
  if (!(a >= 0 && b >= 0 && c >= 0 && a + b + c <= 2 * determinant && determinant > 1e-12 * (ii * jj * kk))) return;
  Weights weights = Weights::Zero();
  weights[i] = a / (2 * determinant);
  weights[j] = b / (2 * determinant);
  weights[k] = c / (2 * determinant);
  best.keep_larger((weights[i] * ii + weights[j] * jj + weights[k] * kk) / 2, weights);
}

Ball largest_of_the_smallest(const Gram& gram, int size) {
  Ball best;
  for (int i = 0; i < size; ++i) {
    try_one(gram, i, best);
    for (int j = 0; j < i; ++j) {
      try_two(gram, i, j, best);
      for (int k = 0; k < j; ++k) try_three(gram, i, j, k, best);
    }
  }
  return best;
}

}  // namespace

bool Support::add(const Eigen::Vector3d& point) {
  Eigen::Vector3d differences[4];
  for (int i = 0; i < size_; ++i) differences[i] = points_[i] - point;
  // In units of the longest difference, so that no product of six entries overflows or underflows.
  double unit = 0;
  for (int i = 0; i < size_; ++i) unit = std::max(unit, differences[i].squaredNorm());
  Gram gram;
  for (int i = 0; i < size_; ++i)
    for (int j = 0; j <= i; ++j) gram(i, j) = gram(j, i) = differences[i].dot(differences[j]) / unit;

  const Ball ball = largest_of_the_smallest(gram, size_);
  if (!(ball.squared_radius * unit > squared_radius_)) return false;
  squared_radius_ = ball.squared_radius * unit;
  centre_ = point;
  int kept = 0;
  for (int i = 0; i < size_; ++i) {
    if (!(ball.weights[i] > 0)) continue;
    centre_ += ball.weights[i] * differences[i];
    points_[kept++] = points_[i];
  }
  points_[kept] = point;
  size_ = kept + 1;
  return true;
}

}  // namespace lodestone
