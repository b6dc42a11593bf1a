// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace lodestone {

/// R_eff of one object: the longest distance between two of its initial particles. O(N^2).
double effective_radius(std::span<const Eigen::Vector3d> particles);

/// The particles of other objects as one object feels them: positions, and how far each one's force reaches.
class Attractors {
 public:
  void reserve(std::size_t count);
  void clear();
  void add(const Eigen::Vector3d& position, double squared_reach);
  std::size_t size() const { return x_.size(); }

  /// Number of points that `forces` takes at once.
  static constexpr int lanes = 8;

  /// Force on each of eight points: the sum of 1 / r^2 over the attractors at distance r below their reach. O(8 n).
  ///
  /// Sums run over the attractors in the order in which they were added, separately per point, so the result of a
  /// point depends neither on its neighbours nor on the machine's vector width. An attractor at r = 0 gives infinity.
  ///
  /// @param x, y, z  coordinates of the points
  /// @param force    receives the forces, in 1 / length^2
  /// @param but      number of an attractor to leave out, or -1
  void forces(const double* x, const double* y, const double* z, double* force, std::ptrdiff_t but = -1) const;

 private:
  std::vector<double> x_, y_, z_, squared_reach_;
};

}  // namespace lodestone
