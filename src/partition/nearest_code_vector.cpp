// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/nearest_code_vector.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lodestone {

namespace {

/// Squared distance, summed from the first component to the last: one order for every caller, so that equal inputs
/// give equal bits. K is the number of components where it is known at compile time.
template <int K>
double squared_distance(const double* a, const double* b, Eigen::Index k) {
  double sum = 0;
  for (Eigen::Index i = 0; i < (K > 0 ? K : k); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

template <int K>
void assign_plain_fixed(const Feature_vectors& vectors, const Feature_vectors& codes, Assignment& assignment) {
  const Eigen::Index k = vectors.cols();
  for (Eigen::Index v = 0; v < vectors.rows(); ++v) {
    double nearest = std::numeric_limits<double>::infinity();
    Region_index label = 0;
    for (Eigen::Index c = 0; c < codes.rows(); ++c) {
      const double d = squared_distance<K>(vectors.data() + v * k, codes.data() + c * k, k);
      if (d < nearest) {
        nearest = d;
        label = static_cast<Region_index>(c);
      }
    }
    assignment.labels[v] = label;
    assignment.squared_distances[v] = nearest;
  }
}

/// Calls `function` with k as a compile-time constant for the usual numbers of components, 0 for any other.
template <class Function>
void with_fixed_k(Eigen::Index k, Function function) {
  switch (k) {
    case 3:
      return function(std::integral_constant<int, 3>());
    case 6:
      return function(std::integral_constant<int, 6>());
    case 7:
      return function(std::integral_constant<int, 7>());
    default:
      return function(std::integral_constant<int, 0>());
  }
}

}  // namespace

void assign_plain(const Feature_vectors& vectors, const Feature_vectors& codes, Assignment& assignment) {
  assignment.labels.resize(vectors.rows());
  assignment.squared_distances.resize(vectors.rows());
  assignment.distance_evaluations += static_cast<std::uint64_t>(vectors.rows()) * codes.rows();
  with_fixed_k(vectors.cols(), [&](auto k) { assign_plain_fixed<k.value>(vectors, codes, assignment); });
}

Bounded_assignment::Bounded_assignment(const Feature_vectors& vectors)
    : vectors_(vectors), margin_(1e-12 * std::max(1.0, vectors.size() == 0 ? 0 : vectors.cwiseAbs().maxCoeff())) {}

void Bounded_assignment::assign(const Feature_vectors& codes, Assignment& assignment) {
  if (codes.rows() > max_codes) return assign_plain(vectors_, codes, assignment);
  assignment.labels.resize(vectors_.rows(), 0);
  assignment.squared_distances.resize(vectors_.rows());
  if (codes.rows() == previous_.rows())
    follow_drift(codes, assignment);
  else
    second_.assign(vectors_.rows(), 0);
  sort_neighbours(codes);
  with_fixed_k(vectors_.cols(), [&](auto k) { assign_fixed<k.value>(codes, assignment); });
  previous_ = codes;
}

void Bounded_assignment::follow_drift(const Feature_vectors& codes, const Assignment& assignment) {
  const Eigen::VectorXd drift = (codes - previous_).rowwise().norm();
  Eigen::Index farthest = 0;
  const double largest = drift.maxCoeff(&farthest);
  double runner_up = 0;
  for (Eigen::Index c = 0; c < drift.size(); ++c)
    if (c != farthest) runner_up = std::max(runner_up, drift[c]);
  for (std::size_t v = 0; v < second_.size(); ++v)
    second_[v] -= assignment.labels[v] == static_cast<Region_index>(farthest) ? runner_up : largest;
}

void Bounded_assignment::sort_neighbours(const Feature_vectors& codes) {
  const auto n = static_cast<std::size_t>(codes.rows());
  neighbours_.resize(n * (n - 1));
  for (std::size_t c = 0; c < n; ++c) {
    Neighbour* row = neighbours_.data() + c * (n - 1);
    for (std::size_t other = 0; other < n; ++other)
      if (other != c) *row++ = {(codes.row(c) - codes.row(other)).norm(), static_cast<Region_index>(other)};
    std::sort(row - (n - 1), row, [](const Neighbour& a, const Neighbour& b) { return a.distance < b.distance; });
  }
}

template <int K>
void Bounded_assignment::assign_fixed(const Feature_vectors& codes, Assignment& assignment) {
  const Eigen::Index k = vectors_.cols();
  const auto others = static_cast<std::size_t>(codes.rows()) - 1;
  const auto widened = [this](double distance) { return distance * (1 + 1e-9) + margin_; };

  for (Eigen::Index v = 0; v < vectors_.rows(); ++v) {
    const double* vector = vectors_.data() + v * k;
    const Region_index start = assignment.labels[v];
    Region_index label = start;
    double nearest = squared_distance<K>(vector, codes.data() + start * k, k);
    ++assignment.distance_evaluations;
    assignment.squared_distances[v] = nearest;
    if (others == 0) continue;

    const Neighbour* row = neighbours_.data() + start * others;
    const double distance = std::sqrt(nearest);
    const double gap = row[0].distance;
    if (widened(distance) < std::max(second_[v], gap / 2)) continue;

    // Both the nearest and the second nearest code vector lie within 2 distance + gap of the one we start from.
    const double reach = widened(2 * distance + gap);
    double second = std::numeric_limits<double>::infinity();
    std::size_t tried = 0;
    for (; tried < others && row[tried].distance <= reach; ++tried) {
      const Region_index code = row[tried].code;
      const double d = squared_distance<K>(vector, codes.data() + code * k, k);
      if (d < nearest || (d == nearest && code < label)) {
        second = nearest;
        nearest = d;
        label = code;
      } else {
        second = std::min(second, d);
      }
    }
    assignment.distance_evaluations += tried;
    assignment.labels[v] = label;
    assignment.squared_distances[v] = nearest;
    second_[v] = std::sqrt(second) * (1 - 1e-9);
  }
}

}  // namespace lodestone
