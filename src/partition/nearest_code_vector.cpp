// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/nearest_code_vector.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "partition/assignment_kernel.h"
#include "partition/fixed_components.h"

namespace lodestone {

namespace {

/// Insertion sort, since the order of the last Lloyd iteration is nearly right for this one. Falls back to a full sort
/// after too many swaps.
void sort_nearly_sorted(std::vector<std::pair<double, Region_index>>& others) {
  std::size_t patience = 4 * others.size();
  for (std::size_t i = 1; i < others.size(); ++i)
    for (std::size_t j = i; j > 0 && others[j] < others[j - 1]; --j) {
      std::swap(others[j], others[j - 1]);
      if (--patience > 0) continue;
      std::ranges::sort(others);
      return;
    }
}

/// A run of vectors that one worker assigns.
struct Chunk {
  std::size_t begin, end;
  double* cell_sums;          ///< N x k, all 0
  std::uint64_t* cell_sizes;  ///< N, all 0
};

/// Adds the sums of all chunks to those of the cells, chunk by chunk.
void add_chunks(std::size_t chunks, Assignment& assignment) {
  const auto cells = assignment.cell_sizes.size();
  const auto k = static_cast<std::size_t>(assignment.cell_sums.cols());
  for (std::size_t row = 0; row < chunks * cells; ++row) {
    if (assignment.chunk_sizes[row] == 0) continue;
    assignment.cell_sizes[row % cells] += assignment.chunk_sizes[row];
    double* sum = assignment.cell_sums.data() + row % cells * k;
    for (std::size_t i = 0; i < k; ++i) sum[i] += assignment.chunk_sums[row * k + i];
  }
}

/// Calls `assign(chunk)` for every chunk, and adds up the sums and the numbers of distances that it returns.
template <class Assign>
void assign_chunks(std::size_t vectors, const Feature_vectors& codes, Assignment& assignment, Workers& workers,
                   Assign assign) {
  const auto cells = static_cast<std::size_t>(codes.rows()), k = static_cast<std::size_t>(codes.cols());
  const std::size_t size = chunk_size(vectors, cells), chunks = (vectors + size - 1) / size;
  assignment.start(vectors, cells, k);
  assignment.chunk_sums.resize(chunks * cells * k);
  assignment.chunk_sizes.resize(chunks * cells);
  std::vector<std::uint64_t> evaluations(chunks);
  workers.run(chunks, [&](std::size_t c, std::size_t) {
    const Chunk chunk{.begin = c * size,
                      .end = std::min((c + 1) * size, vectors),
                      .cell_sums = assignment.chunk_sums.data() + c * cells * k,
                      .cell_sizes = assignment.chunk_sizes.data() + c * cells};
    std::fill_n(chunk.cell_sums, cells * k, 0.0);
    std::fill_n(chunk.cell_sizes, cells, 0U);
    evaluations[c] = assign(chunk);
  });
  add_chunks(chunks, assignment);
  assignment.distance_evaluations += std::accumulate(evaluations.begin(), evaluations.end(), std::uint64_t{0});
}

/// Makes room for another number of rows. Eigen frees the old memory first, and would free it again if it gets none.
void make_room(Feature_vectors& matrix, Eigen::Index rows, Eigen::Index columns) {
  if (matrix.rows() == rows && matrix.cols() == columns) return;
  Feature_vectors other(rows, columns);
  matrix.swap(other);
}

}  // namespace

std::size_t chunk_size(std::size_t vectors, std::size_t cells) {
  constexpr auto block = kernel::block_size;
  const std::size_t size = std::max({std::size_t{4096}, cells, (vectors + 63) / 64});
  return (size + block - 1) / block * block;
}

void Assignment::start(std::size_t vectors, std::size_t cells, std::size_t components) {
  labels.resize(vectors, 0);
  squared_distances.resize(vectors);
  make_room(cell_sums, static_cast<Eigen::Index>(cells), static_cast<Eigen::Index>(components));
  cell_sums.setZero();
  cell_sizes.assign(cells, 0);
}

void assign_plain(const Feature_vectors& vectors, const Feature_vectors& codes, Assignment& assignment,
                  Workers& workers) {
  const Eigen::Index k = vectors.cols();
  assign_chunks(vectors.rows(), codes, assignment, workers, [&](const Chunk& chunk) {
    for (std::size_t v = chunk.begin; v < chunk.end; ++v) {
      const double* vector = vectors.data() + static_cast<Eigen::Index>(v) * k;
      double nearest = std::numeric_limits<double>::infinity();
      Eigen::Index label = 0;
      for (Eigen::Index c = 0; c < codes.rows(); ++c) {
        const double d = squared_distance<0>(vector, &codes(c, 0), k);
        if (d < nearest) {
          nearest = d;
          label = c;
        }
      }
      assignment.labels[v] = static_cast<Region_index>(label);
      assignment.squared_distances[v] = nearest;
      for (Eigen::Index i = 0; i < k; ++i) chunk.cell_sums[label * k + i] += vector[i];
      ++chunk.cell_sizes[label];
    }
    return static_cast<std::uint64_t>(chunk.end - chunk.begin) * codes.rows();
  });
}

Bounded_assignment::Bounded_assignment(const Feature_vectors& vectors, Workers& workers)
    : vectors_(vectors),
      workers_(workers),
      margin_(1e-12 * std::max(1.0, vectors.size() == 0 ? 0 : vectors.cwiseAbs().maxCoeff())) {
  reload();
}

void Bounded_assignment::reload() {
  constexpr auto block = kernel::block_size;
  const auto count = static_cast<std::size_t>(vectors_.rows()), k = static_cast<std::size_t>(vectors_.cols());
  blocks_.resize(static_cast<Eigen::Index>((count + block - 1) / block * block * k));
  if (count % block > 0) blocks_.tail(static_cast<Eigen::Index>(block * k)).setZero();
  const std::size_t size = chunk_size(count, 0);
  workers_.run((count + size - 1) / size, [&](std::size_t chunk, std::size_t) {
    for (std::size_t v = chunk * size; v < std::min((chunk + 1) * size, count); ++v) {
      const double* vector = vectors_.data() + v * k;
      double* components = blocks_.data() + v / block * block * k + v % block;
      for (std::size_t i = 0; i < k; ++i) components[i * block] = vector[i];
    }
  });
  previous_.resize(0, 0);  // the next call of `assign` resets the bounds
}

void Bounded_assignment::assign(const Feature_vectors& codes, Assignment& assignment) {
  if (codes.rows() > max_codes) return assign_plain(vectors_, codes, assignment, workers_);
  if (codes.rows() == previous_.rows()) {
    follow_drift(codes);
  } else {
    drifts_.assign(codes.rows(), 0);
    forget();
  }
  sort_neighbours(codes);

  std::vector<kernel::Neighbourhood> neighbourhoods;
  for (std::size_t c = 0; c < static_cast<std::size_t>(codes.rows()); ++c)
    neighbourhoods.push_back({.distances = neighbour_distances_.data() + c * padded_,
                              .codes = neighbour_codes_.data() + c * padded_,
                              .components = neighbour_components_.data() + c * padded_ * codes.cols(),
                              .count = static_cast<std::size_t>(codes.rows()) - 1});
  assign_chunks(vectors_.rows(), codes, assignment, workers_, [&](const Chunk& chunk) {
    kernel::Bounded_pass pass{.blocks = blocks_.data(),
                              .begin = chunk.begin,
                              .end = chunk.end,
                              .components = static_cast<std::size_t>(vectors_.cols()),
                              .codes = codes.data(),
                              .neighbourhoods = neighbourhoods.data(),
                              .half_gaps = half_gaps_.data(),
                              .drifts = drifts_.data(),
                              .margin = margin_,
                              .labels = assignment.labels.data(),
                              .squared_distances = assignment.squared_distances.data(),
                              .second_bounds = second_.data(),
                              .cell_sums = chunk.cell_sums,
                              .cell_sizes = chunk.cell_sizes,
                              .distance_evaluations = 0};
    kernel::bounded_pass(pass);
    return pass.distance_evaluations;
  });
  make_room(previous_, codes.rows(), codes.cols());
  previous_ = codes;
}

void Bounded_assignment::forget() { second_.assign(vectors_.rows(), 0); }

void Bounded_assignment::follow_drift(const Feature_vectors& codes) {
  const Eigen::VectorXd moved = (codes - previous_).rowwise().norm();
  Eigen::Index farthest = 0;
  const double largest = moved.maxCoeff(&farthest);
  double runner_up = 0;
  for (Eigen::Index c = 0; c < moved.size(); ++c)
    if (c != farthest) runner_up = std::max(runner_up, moved[c]);
  for (Eigen::Index c = 0; c < moved.size(); ++c) drifts_[c] += (c == farthest ? runner_up : largest) + margin_;
}

void Bounded_assignment::sort_neighbours(const Feature_vectors& codes) {
  constexpr auto block = kernel::block_size;
  const auto n = static_cast<std::size_t>(codes.rows());
  const auto k = static_cast<std::size_t>(codes.cols());
  padded_ = (n - 1 + block - 1) / block * block;
  neighbour_distances_.resize(n * padded_);
  neighbour_codes_.resize(n * padded_);
  neighbour_components_.resize(n * padded_ * k);
  half_gaps_.resize(n);
  const bool same_codes = neighbour_order_.size() == n * (n - 1);
  neighbour_order_.resize(n * (n - 1));
  constexpr std::size_t some = 16;  // code vectors per task
  workers_.run((n + some - 1) / some, [&](std::size_t task, std::size_t) {
    for (std::size_t c = task * some; c < std::min((task + 1) * some, n); ++c) sort_neighbours_of(c, codes, same_codes);
  });
}

void Bounded_assignment::sort_neighbours_of(std::size_t c, const Feature_vectors& codes, bool same_codes) {
  constexpr auto block = kernel::block_size;
  constexpr double far_away = std::numeric_limits<double>::infinity();
  const auto others = static_cast<std::size_t>(codes.rows()) - 1;
  const auto k = static_cast<std::size_t>(codes.cols());
  Region_index* order = neighbour_order_.data() + c * others;
  std::vector<std::pair<double, Region_index>> sorted(others);
  for (std::size_t i = 0; i < others; ++i) {
    if (!same_codes) order[i] = static_cast<Region_index>(i < c ? i : i + 1);
    sorted[i] = {(codes.row(c) - codes.row(order[i])).norm(), order[i]};
  }
  sort_nearly_sorted(sorted);
  for (std::size_t i = 0; i < others; ++i) order[i] = sorted[i].second;
  half_gaps_[c] = others > 0 ? std::max(0.0, sorted[0].first / 2 - margin_) : far_away;
  for (std::size_t i = 0; i < padded_; ++i) {
    neighbour_distances_[c * padded_ + i] = i < others ? sorted[i].first : far_away;
    neighbour_codes_[c * padded_ + i] = i < others ? sorted[i].second : 0;
    double* components = neighbour_components_.data() + (c * padded_ + i / block * block) * k + i % block;
    for (std::size_t component = 0; component < k; ++component)
      components[component * block] = i < others ? codes(sorted[i].second, component) : far_away;
  }
}

}  // namespace lodestone
