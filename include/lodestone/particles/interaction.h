// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace lodestone {

/// R_eff of one object: the longest distance between two of its initial particles, in units of the positions. O(N^2).
double effective_radius(std::span<const Eigen::Vector3d> particles);

/// The particles whose force one object feels: their positions, and the reach of each one's force.
class Attractors {
 public:
  /// Makes room for so many.
  void reserve(std::size_t count);
  /// Leaves none; the memory is kept.
  void clear();
  /// @param squared_reach  of the force, in squared units of the coordinates
  void add(const Eigen::Vector3d& position, double squared_reach);
  /// Number of attractors.
  std::size_t size() const { return x_.size(); }

  /// Number of points per call of `forces`.
  static constexpr int lanes = 8;

  /// Force on each of eight points, \cite saenghaengtham2006, eq. (10) to (12): the sum over the attractors (12) of
  /// 1 / r^2 if the distance r is below the reach (11), and of 0 otherwise (10). An attractor at r = 0 gives infinity.
  /// O(8 n).
  ///
  /// Each point has a sum of its own, over the attractors in the order in which they were added. So the result for a
  /// point depends neither on the other points nor on the vector width of the machine.
  ///
  /// @param x, y, z  coordinates of the points
  /// @param force    receives the forces, in 1 / length^2
  /// @param but      index of an attractor to leave out, or -1
  void forces(const double* x, const double* y, const double* z, double* force, std::ptrdiff_t but = -1) const;

 private:
  std::vector<double> x_, y_, z_, squared_reach_;
};

}  // namespace lodestone
