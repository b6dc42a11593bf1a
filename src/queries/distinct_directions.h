// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace lodestone {

/// Of many directions those that are worth a try: the first 64, then each that is not within a tenth of a radian of one
/// of these, either way. Of thousands, as the normals of the contact patches of two rough sheets, most differ little.
/// O(n m) for n directions of which m are left.
/// @param directions  unit vectors, or zero: those are left out
inline std::vector<Eigen::Vector3d> distinct_directions(std::span<const Eigen::Vector3d> directions) {
  constexpr std::size_t few = 64;
  constexpr double least_cosine = 0.995;
  std::vector<Eigen::Vector3d> distinct;
  for (const auto& direction : directions) {
    if (direction.isZero()) continue;
    const auto is_along = [&](const auto& other) { return std::abs(direction.dot(other)) > least_cosine; };
    if (distinct.size() < few || std::ranges::none_of(distinct, is_along)) distinct.push_back(direction);
  }
  return distinct;
}

}  // namespace lodestone
