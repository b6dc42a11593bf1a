// SPDX-License-Identifier: GPL-3.0-or-later
#include "partition/cells.h"

#include <algorithm>

namespace lodestone {

namespace {

std::vector<double> cell_distortions(const Assignment& assignment) {
  std::vector<double> sums(assignment.cell_sizes.size(), 0);
  for (std::size_t v = 0; v < assignment.labels.size(); ++v)
    sums[assignment.labels[v]] += assignment.squared_distances[v];
  return sums;
}

}  // namespace

bool refill_empty_cells(const Feature_vectors& vectors, Feature_vectors& codes, Assignment& assignment) {
  auto& sizes = assignment.cell_sizes;
  if (std::ranges::find(sizes, 0U) == sizes.end()) return false;
  auto distortions = cell_distortions(assignment);
  for (std::size_t cell = 0; cell < sizes.size(); ++cell)
    if (sizes[cell] == 1) distortions[cell] = 0;  // its one vector must stay
  for (std::size_t empty = 0; empty < sizes.size(); ++empty) {
    if (sizes[empty] != 0) continue;
    const auto donor = static_cast<Region_index>(std::ranges::max_element(distortions) - distortions.begin());
    if (distortions[donor] == 0) return true;  // no cell holds two different vectors
    std::size_t farthest = 0;
    double distance = -1;
    for (std::size_t v = 0; v < assignment.labels.size(); ++v)
      if (assignment.labels[v] == donor && assignment.squared_distances[v] > distance) {
        farthest = v;
        distance = assignment.squared_distances[v];
      }
    codes.row(empty) = vectors.row(farthest);
    assignment.cell_sums.row(empty) = vectors.row(farthest);
    assignment.cell_sums.row(donor) -= vectors.row(farthest);
    assignment.labels[farthest] = static_cast<Region_index>(empty);
    assignment.squared_distances[farthest] = 0;
    distortions[donor] -= distance;
    sizes[empty] = 1;
    if (--sizes[donor] == 1) distortions[donor] = 0;
  }
  return true;
}

void move_codes_to_means(const Assignment& assignment, Feature_vectors& codes) {
  for (Eigen::Index c = 0; c < codes.rows(); ++c)
    if (assignment.cell_sizes[c] > 0)
      codes.row(c) = assignment.cell_sums.row(c) / static_cast<double>(assignment.cell_sizes[c]);
}

std::vector<Region_index> drop_empty_cells(const Assignment& assignment, Feature_vectors& codes) {
  std::vector<Region_index> renumbered(assignment.cell_sizes.size());
  Eigen::Index kept = 0;
  for (std::size_t c = 0; c < renumbered.size(); ++c) {
    renumbered[c] = static_cast<Region_index>(kept);
    if (assignment.cell_sizes[c] > 0) codes.row(kept++) = codes.row(static_cast<Eigen::Index>(c)).eval();
  }
  codes.conservativeResize(kept, Eigen::NoChange);
  return renumbered;
}

}  // namespace lodestone
