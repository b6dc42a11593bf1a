// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/interaction.h"

#include <algorithm>

#include "particles/force_kernel.h"

namespace lodestone {

double effective_radius(std::span<const Eigen::Vector3d> particles) {
  double longest = 0;
  for (std::size_t i = 0; i < particles.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) longest = std::max(longest, (particles[i] - particles[j]).stableNorm());
  return longest;
}

void Attractors::reserve(std::size_t count) {
  for (auto* column : {&x_, &y_, &z_, &squared_reach_}) column->reserve(count);
}

void Attractors::clear() {
  for (auto* column : {&x_, &y_, &z_, &squared_reach_}) column->clear();
}

void Attractors::add(const Eigen::Vector3d& position, double squared_reach) {
  x_.push_back(position.x());
  y_.push_back(position.y());
  z_.push_back(position.z());
  squared_reach_.push_back(squared_reach);
}

void Attractors::forces(const double* x, const double* y, const double* z, double* force, std::ptrdiff_t but) const {
  static_assert(lanes == kernel::point_lanes);
  const kernel::Attractor_columns columns{x_.data(), y_.data(), z_.data(), squared_reach_.data()};
  const std::size_t left_out = but < 0 ? size() : static_cast<std::size_t>(but);
  std::fill_n(force, lanes, 0.0);
  kernel::add_forces(columns, 0, left_out, x, y, z, force);
  if (left_out < size()) kernel::add_forces(columns, left_out + 1, size(), x, y, z, force);
}

}  // namespace lodestone
