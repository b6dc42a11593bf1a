// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/candidate_pairs.h"

#include <algorithm>

namespace lodestone {

void candidate_pairs(std::span<const Eigen::Vector3d> a, std::span<const Eigen::Vector3d> b, double distance,
                     Candidate_choice choice, std::vector<Candidate_pair>& candidates) {
  candidates.clear();
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) {
      const double squared_distance = (a[i] - b[j]).squaredNorm();
      if (squared_distance < distance * distance)
        candidates.push_back({squared_distance, static_cast<Region_index>(i), static_cast<Region_index>(j)});
    }
  if (choice == Candidate_choice::closest && !candidates.empty()) {
    candidates.front() = *std::ranges::min_element(candidates, is_nearer);
    candidates.resize(1);
  }
  std::ranges::sort(candidates, is_nearer);
}

}  // namespace lodestone
