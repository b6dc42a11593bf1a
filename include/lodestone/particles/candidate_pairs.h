// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "lodestone/mesh/concepts.h"

namespace lodestone {

/// Which of the particle pairs that are near enough get their regions checked.
enum class Candidate_choice {
  all,      ///< every pair nearer than the collision distance
  closest,  ///< the nearest of them only
};

/// Two regions whose particles are nearer than the collision distance.
struct Candidate_pair {
  double squared_distance = 0;
  Region_index a = 0;
  Region_index b = 0;
};

/// Pairs of particles of two objects nearer than `distance`, nearest first, equally near ones by region numbers.
/// O(N N') and the sorting of what is found.
/// @param candidates  receives the pairs; its memory is used again
void candidate_pairs(std::span<const Eigen::Vector3d> a, std::span<const Eigen::Vector3d> b, double distance,
                     Candidate_choice choice, std::vector<Candidate_pair>& candidates);

}  // namespace lodestone
