// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/kmeans_plus_plus.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

#include "lodestone/partition/nearest_code_vector.h"
#include "partition/cells.h"
#include "partition/fixed_components.h"
#include "partition/used_surface.h"

namespace lodestone {

void check(const Kmeans_plus_plus_options& options) {
  if (!(options.tolerance >= 0)) throw Bad_argument("k-means++: tolerance must be >= 0");
  if (options.max_iterations == 0) throw Bad_argument("k-means++: max_iterations must be at least 1");
  check(options.features);
}

namespace {

/// Uniform in [0, 1). Unlike the distributions of the standard library it is the same on every platform.
double unit_draw(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

/// Draws an index with a probability proportional to its weight. At least one weight is above 0.
std::size_t weighted_draw(const std::vector<double>& weights, std::mt19937_64& random) {
  double left = unit_draw(random) * std::accumulate(weights.begin(), weights.end(), 0.0);
  std::size_t drawn = 0;
  for (std::size_t i = 0; i < weights.size() && left >= 0; ++i) {
    if (weights[i] > 0) drawn = i;  // the last one if rounding leaves a remainder
    left -= weights[i];
  }
  return drawn;
}

void lower_to_distances_from(std::size_t row, const Feature_vectors& vectors, std::vector<double>& squared_distances) {
  const Eigen::Index k = vectors.cols();
  const double* chosen = vectors.data() + static_cast<Eigen::Index>(row) * k;
  with_fixed_components(k, [&](auto fixed) {
    for (std::size_t v = 0; v < squared_distances.size(); ++v) {
      const double* vector = vectors.data() + static_cast<Eigen::Index>(v) * k;
      squared_distances[v] = std::min(squared_distances[v], squared_distance<fixed.value>(vector, chosen, k));
    }
  });
}

/// The vector farthest from its code vector, among those that share their cell with others.
std::size_t farthest_in_company(const Assignment& assignment) {
  std::size_t farthest = 0;
  double largest = -1;
  for (std::size_t v = 0; v < assignment.labels.size(); ++v) {
    if (assignment.squared_distances[v] <= largest || assignment.cell_sizes[assignment.labels[v]] == 1) continue;
    largest = assignment.squared_distances[v];
    farthest = v;
  }
  return farthest;
}

/// Gives every empty cell a vector of another cell. There is one, because there are no more cells than different
/// vectors.
/// @return whether a label has changed
bool fill_empty_cells(const Feature_vectors& vectors, Assignment& assignment) {
  bool changed = false;
  for (std::size_t empty = 0; empty < assignment.cell_sizes.size(); ++empty) {
    if (assignment.cell_sizes[empty] != 0) continue;
    const std::size_t taken = farthest_in_company(assignment);
    const auto vector = vectors.row(static_cast<Eigen::Index>(taken));
    const Region_index donor = assignment.labels[taken];
    assignment.cell_sums.row(donor) -= vector;
    --assignment.cell_sizes[donor];
    assignment.cell_sums.row(static_cast<Eigen::Index>(empty)) = vector;
    assignment.cell_sizes[empty] = 1;
    assignment.labels[taken] = static_cast<Region_index>(empty);
    assignment.squared_distances[taken] = 0;
    changed = true;
  }
  return changed;
}

/// Lloyd iterations.
/// @return the number of iterations
std::size_t iterate(const Feature_vectors& vectors, Feature_vectors codes, const Kmeans_plus_plus_options& options,
                    Assignment& assignment) {
  Bounded_assignment search(vectors);
  double distortion = std::numeric_limits<double>::infinity();
  for (std::size_t iteration = 1;; ++iteration) {
    const auto labels = assignment.labels;
    search.assign(codes, assignment);
    if (fill_empty_cells(vectors, assignment)) search.forget();
    const double before = distortion;
    distortion = std::accumulate(assignment.squared_distances.begin(), assignment.squared_distances.end(), 0.0);
    const bool settled = labels == assignment.labels;
    const bool drops_little =
        iteration > 1 && options.tolerance > 0 && before - distortion <= options.tolerance * before;
    if (settled || drops_little || iteration == options.max_iterations) return iteration;
    move_codes_to_means(assignment, codes);
  }
}

}  // namespace

std::vector<std::size_t> kmeans_plus_plus_start(const Feature_vectors& vectors, std::size_t count, std::uint64_t seed) {
  if (vectors.rows() == 0 || count == 0) return {};
  std::mt19937_64 random(seed);
  std::vector<std::size_t> rows{random() % static_cast<std::size_t>(vectors.rows())};
  std::vector<double> squared_distances(static_cast<std::size_t>(vectors.rows()),
                                        std::numeric_limits<double>::infinity());
  while (true) {
    lower_to_distances_from(rows.back(), vectors, squared_distances);
    if (rows.size() == count || *std::ranges::max_element(squared_distances) == 0) return rows;
    rows.push_back(weighted_draw(squared_distances, random));
  }
}

Labelling Kmeans_plus_plus::label(const Numbered_surface& surface, std::size_t regions) const {
  check(options);
  return label_used(surface, regions, [this](const Numbered_surface& used, std::size_t wanted) -> Labelling {
    Feature_vectors vectors = feature_vectors(used.positions, used.faces, options.features);
    const auto start = kmeans_plus_plus_start(vectors, wanted, options.seed);
    Feature_vectors codes(static_cast<Eigen::Index>(start.size()), vectors.cols());
    for (std::size_t c = 0; c < start.size(); ++c)
      codes.row(static_cast<Eigen::Index>(c)) = vectors.row(static_cast<Eigen::Index>(start[c]));

    Assignment assignment{.distance_evaluations = start.size() * static_cast<std::uint64_t>(vectors.rows())};
    const std::size_t iterations = iterate(vectors, codes, options, assignment);
    return {.labels = std::move(assignment.labels),
            .vectors = std::move(vectors),
            .iterations = iterations,
            .distance_evaluations = assignment.distance_evaluations};
  });
}

}  // namespace lodestone
