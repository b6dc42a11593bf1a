// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/candidate_pairs.h"

#include <algorithm>
#include <functional>

namespace lodestone {

namespace {

/// Compares some particles of the first object, from `first` on to before `end`, with all of the second.
void add_near(std::span<const Eigen::Vector3d> a, std::size_t first, std::size_t end,
              std::span<const Eigen::Vector3d> b, double distance, std::vector<Candidate_pair>& candidates) {
  for (std::size_t i = first; i < end; ++i)
    for (std::size_t j = 0; j < b.size(); ++j) {
      const double squared_distance = (a[i] - b[j]).squaredNorm();
      if (squared_distance < distance * distance)
        candidates.push_back({squared_distance, static_cast<Region_index>(i), static_cast<Region_index>(j)});
    }
}

/// Compares all with all. One worker allocates nothing.
void add_all_near(std::span<const Eigen::Vector3d> a, std::span<const Eigen::Vector3d> b, double distance,
                  std::vector<Candidate_pair>& candidates, Workers& workers) {
  constexpr std::size_t pairs_per_task = 1 << 16;
  const std::size_t per_task = pairs_per_task / std::min(pairs_per_task, b.size() + 1) + 1;
  if (workers.count() == 1 || a.size() <= per_task) {
    add_near(a, 0, a.size(), b, distance, candidates);
    return;
  }
  std::vector<std::vector<Candidate_pair>> parts((a.size() + per_task - 1) / per_task);
  const auto add_part = [&](std::size_t task, std::size_t) {
    add_near(a, task * per_task, std::min(a.size(), (task + 1) * per_task), b, distance, parts[task]);
  };
  workers.run(parts.size(), std::cref(add_part));
  for (const auto& part : parts) candidates.insert(candidates.end(), part.begin(), part.end());
}

}  // namespace

void candidate_pairs(std::span<const Eigen::Vector3d> a, std::span<const Eigen::Vector3d> b, double distance,
                     Candidate_choice choice, std::vector<Candidate_pair>& candidates, Workers& workers) {
  candidates.clear();
  add_all_near(a, b, distance, candidates, workers);
  if (choice == Candidate_choice::closest && !candidates.empty()) {
    candidates.front() = *std::ranges::min_element(candidates, is_nearer);
    candidates.resize(1);
  }
  std::ranges::sort(candidates, is_nearer);
}

}  // namespace lodestone
