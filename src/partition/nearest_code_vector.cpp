// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/nearest_code_vector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "partition/assignment_kernel.h"
#include "partition/fixed_components.h"

namespace lodestone {

namespace {

/// The order of the last Lloyd iteration is nearly right for this one: insertion, which gives up when it is not.
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

}  // namespace

void Assignment::start(std::size_t vectors, std::size_t cells, std::size_t components) {
  labels.resize(vectors, 0);
  squared_distances.resize(vectors);
  cell_sums.setZero(static_cast<Eigen::Index>(cells), static_cast<Eigen::Index>(components));
  cell_sizes.assign(cells, 0);
}

void assign_plain(const Feature_vectors& vectors, const Feature_vectors& codes, Assignment& assignment) {
  assignment.start(vectors.rows(), codes.rows(), codes.cols());
  for (Eigen::Index v = 0; v < vectors.rows(); ++v) {
    double nearest = std::numeric_limits<double>::infinity();
    Eigen::Index label = 0;
    for (Eigen::Index c = 0; c < codes.rows(); ++c) {
      const double d = squared_distance<0>(&vectors(v, 0), &codes(c, 0), vectors.cols());
      if (d < nearest) {
        nearest = d;
        label = c;
      }
    }
    assignment.labels[v] = static_cast<Region_index>(label);
    assignment.squared_distances[v] = nearest;
    assignment.cell_sums.row(label) += vectors.row(v);
    ++assignment.cell_sizes[label];
  }
  assignment.distance_evaluations += static_cast<std::uint64_t>(vectors.rows()) * codes.rows();
}

Bounded_assignment::Bounded_assignment(const Feature_vectors& vectors)
    : vectors_(vectors), margin_(1e-12 * std::max(1.0, vectors.size() == 0 ? 0 : vectors.cwiseAbs().maxCoeff())) {
  constexpr auto block = static_cast<Eigen::Index>(kernel::block_size);
  blocks_.resize(vectors.rows() / block * block * vectors.cols());
  double* next = blocks_.data();
  for (Eigen::Index first = 0; first + block <= vectors.rows(); first += block)
    for (Eigen::Index component = 0; component < vectors.cols(); ++component)
      for (Eigen::Index v = first; v < first + block; ++v) *next++ = vectors(v, component);
}

void Bounded_assignment::assign(const Feature_vectors& codes, Assignment& assignment) {
  if (codes.rows() > max_codes) return assign_plain(vectors_, codes, assignment);
  assignment.start(vectors_.rows(), codes.rows(), codes.cols());
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
  kernel::Bounded_pass pass{.vectors = vectors_.data(),
                            .blocks = blocks_.data(),
                            .vector_count = static_cast<std::size_t>(vectors_.rows()),
                            .components = static_cast<std::size_t>(vectors_.cols()),
                            .codes = codes.data(),
                            .neighbourhoods = neighbourhoods.data(),
                            .half_gaps = half_gaps_.data(),
                            .drifts = drifts_.data(),
                            .margin = margin_,
                            .labels = assignment.labels.data(),
                            .squared_distances = assignment.squared_distances.data(),
                            .second_bounds = second_.data(),
                            .cell_sums = assignment.cell_sums.data(),
                            .cell_sizes = assignment.cell_sizes.data(),
                            .distance_evaluations = 0};
  kernel::bounded_pass(pass);
  assignment.distance_evaluations += pass.distance_evaluations;
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
  constexpr double far_away = std::numeric_limits<double>::infinity();
  const auto n = static_cast<std::size_t>(codes.rows());
  const auto k = static_cast<std::size_t>(codes.cols());
  padded_ = (n - 1 + block - 1) / block * block;
  neighbour_distances_.assign(n * padded_, far_away);
  neighbour_codes_.assign(n * padded_, 0);
  neighbour_components_.assign(n * padded_ * k, far_away);
  half_gaps_.assign(n, far_away);

  const bool same_codes = neighbour_order_.size() == n * (n - 1);
  neighbour_order_.resize(n * (n - 1));
  std::vector<std::pair<double, Region_index>> others(n - 1);
  for (std::size_t c = 0; c < n; ++c) {
    Region_index* order = neighbour_order_.data() + c * (n - 1);
    for (std::size_t i = 0; i < n - 1; ++i) {
      if (!same_codes) order[i] = static_cast<Region_index>(i < c ? i : i + 1);
      others[i] = {(codes.row(c) - codes.row(order[i])).norm(), order[i]};
    }
    sort_nearly_sorted(others);
    for (std::size_t i = 0; i < n - 1; ++i) order[i] = others[i].second;
    if (!others.empty()) half_gaps_[c] = std::max(0.0, others[0].first / 2 - margin_);
    for (std::size_t i = 0; i < others.size(); ++i) {
      neighbour_distances_[c * padded_ + i] = others[i].first;
      neighbour_codes_[c * padded_ + i] = others[i].second;
      double* components = neighbour_components_.data() + (c * padded_ + i / block * block) * k + i % block;
      for (std::size_t component = 0; component < k; ++component)
        components[component * block] = codes(others[i].second, component);
    }
  }
}

}  // namespace lodestone
