// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/interaction.h"

#include <algorithm>
#include <limits>

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
  constexpr double out_of_reach = std::numeric_limits<double>::infinity();  // 1 / infinity adds nothing
  const std::size_t count = x_.size();
  const std::size_t left_out = but < 0 ? count : static_cast<std::size_t>(but);
  double sums[lanes] = {};
  const auto add_range = [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) {
      const double ax = x_[j], ay = y_[j], az = z_[j], reach = squared_reach_[j];
      // All lanes do the same arithmetic, with a choice before the division instead of a branch around it: so the
      // compiler turns the loop into vector instructions.
      for (int lane = 0; lane < lanes; ++lane) {
        const double dx = x[lane] - ax, dy = y[lane] - ay, dz = z[lane] - az;
        const double squared_distance = dx * dx + dy * dy + dz * dz;
        sums[lane] += 1 / (squared_distance < reach ? squared_distance : out_of_reach);
      }
    }
  };
  add_range(0, left_out);
  add_range(std::min(left_out + 1, count), count);
  std::copy_n(sums, lanes, force);
}

}  // namespace lodestone
