// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <tuple>
#include <vector>

#include "lodestone/mesh/concepts.h"
#include "lodestone/mesh/workers.h"

namespace lodestone {

/// Which of the particle pairs nearer than the collision distance become candidates.
enum class Candidate_choice {
  all,      ///< every such pair
  closest,  ///< only the nearest such pair
};

/// Two regions whose particles are nearer than the collision distance.
struct Candidate_pair {
  double squared_distance = 0;  ///< of the two particles, in squared units of the coordinates
  Region_index a = 0;           ///< region of the first object
  Region_index b = 0;           ///< region of the second object
};

/// Lexicographic order of distance and region indices.
inline bool is_nearer(const Candidate_pair& p, const Candidate_pair& q) {
  return std::tie(p.squared_distance, p.a, p.b) < std::tie(q.squared_distance, q.a, q.b);
}

/// Finds the pairs of particles of two objects that are nearer than `distance`, \cite saenghaengtham2006, eq. (14). The
/// result is in lexicographic order of distance and region indices. O(N N') and the sorting of what is found.
/// @param candidates  receives the pairs; its memory is reused
/// @param workers     share what is compared; the result does not depend on their number
void candidate_pairs(std::span<const Eigen::Vector3d> a, std::span<const Eigen::Vector3d> b, double distance,
                     Candidate_choice choice, std::vector<Candidate_pair>& candidates,
                     Workers& workers = Workers::alone());

}  // namespace lodestone
