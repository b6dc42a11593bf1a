// SPDX-License-Identifier: GPL-3.0-or-later
#include "partition/quantiser.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "partition/cells.h"
#include "partition/eigenvector_sign.h"
#include "partition/fixed_components.h"

namespace lodestone {

/// The spread of a cell around its code vector, which a split needs.
struct Quantiser::Spread {
  double distortion = 0;    ///< sum of squared distances
  Eigen::MatrixXd scatter;  ///< k x k: sum of the products of the offsets' components
};

Quantiser::Quantiser(const Feature_vectors& vectors, const Lbg_options& options)
    : options_(options),
      workers_(options.threads),
      vectors_(vectors.rows(), vectors.cols()),
      codes_(vectors.colwise().mean()),
      origin_(vectors.rows()) {
  assignment_.labels.assign(vectors.rows(), 0);
  for_chunks([&](std::size_t, std::size_t begin, std::size_t end) {
    const auto first = static_cast<Eigen::Index>(begin), count = static_cast<Eigen::Index>(end - begin);
    vectors_.middleRows(first, count) = vectors.middleRows(first, count);
    std::iota(origin_.begin() + first, origin_.begin() + first + count, static_cast<std::uint32_t>(begin));
  });
  if (options.search == Nearest_search::bounded) bounded_.emplace(vectors_, workers_);
}

/// Calls `task(chunk, begin, end)` for each chunk of consecutive vectors.
template <class Task>
void Quantiser::for_chunks(Task task) {
  const std::size_t count = origin_.size(), length = chunk_length();
  workers_.run(chunk_count(), [&](std::size_t chunk, std::size_t) {
    task(chunk, chunk * length, std::min((chunk + 1) * length, count));
  });
}

/// Eq. (5) and (6).
void Quantiser::assign() {
  if (bounded_)
    bounded_->assign(codes_, assignment_);
  else
    assign_plain(vectors_, codes_, assignment_, workers_);
}

/// Eq. (2) for one code vector, eq. (8) for any number.
double Quantiser::distortion() {
  const Eigen::Map<const Eigen::VectorXd> distances(assignment_.squared_distances.data(), vectors_.rows());
  std::vector<double> sums(chunk_count());
  for_chunks([&](std::size_t chunk, std::size_t begin, std::size_t end) {
    sums[chunk] = distances.segment(static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(end - begin)).sum();
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0) / static_cast<double>(vectors_.size());
}

void Quantiser::run_lloyd() {
  Lloyd_run run{.code_vectors = size(), .distortion = {}};
  for (std::size_t iteration = 0; iteration < options_.max_iterations; ++iteration) {
    assign();
    if (refill_empty_cells(vectors_, codes_, assignment_) && bounded_) bounded_->forget();
    run.distortion.push_back(distortion());
    move_codes_to_means(assignment_, codes_);
    if (iteration == 0) continue;
    const double before = run.distortion[iteration - 1];
    if (before - run.distortion[iteration] <= options_.tolerance * before) break;
  }
  runs_.push_back(std::move(run));
}

/// Sorts the vectors by cell and keeps their order within a cell. The search takes eight vectors at a time if they
/// share a cell, and a split sums over each cell.
void Quantiser::group_by_cell() {
  // Per chunk and cell: first the number of vectors, then the row of the next one.
  std::vector<std::vector<std::size_t>> next_rows(chunk_count(), std::vector<std::size_t>(size(), 0));
  for_chunks([&](std::size_t chunk, std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) ++next_rows[chunk][assignment_.labels[v]];
  });
  std::size_t row = 0;
  for (std::size_t cell = 0; cell < size(); ++cell)
    for (auto& of_chunk : next_rows) row += std::exchange(of_chunk[cell], row);

  const Eigen::Index k = vectors_.cols();
  grouped_vectors_.resize(vectors_.rows(), k);
  grouped_labels_.resize(origin_.size());
  grouped_distances_.resize(origin_.size());
  grouped_origin_.resize(origin_.size());
  for_chunks([&](std::size_t chunk, std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const std::size_t to = next_rows[chunk][assignment_.labels[v]]++;
      std::copy_n(vectors_.data() + static_cast<Eigen::Index>(v) * k, k,
                  grouped_vectors_.data() + static_cast<Eigen::Index>(to) * k);
      grouped_labels_[to] = assignment_.labels[v];
      grouped_distances_[to] = assignment_.squared_distances[v];
      grouped_origin_[to] = origin_[v];
    }
  });
  vectors_.swap(grouped_vectors_);
  assignment_.labels.swap(grouped_labels_);
  assignment_.squared_distances.swap(grouped_distances_);
  origin_.swap(grouped_origin_);
  if (bounded_) bounded_->reload();
}

/// The spread of the vectors from `begin` to `end`, which share a cell.
Quantiser::Spread Quantiser::spread(std::size_t begin, std::size_t end) const {
  const Eigen::Index k = vectors_.cols();
  Spread result{.distortion = 0, .scatter = Eigen::MatrixXd::Zero(k, k)};
  for (std::size_t v = begin; v < end; ++v) result.distortion += assignment_.squared_distances[v];
  if (options_.split_rule != Split::principal_axis) return result;
  with_fixed_components(k, [&](auto fixed) {
    constexpr int components = fixed > 0 ? static_cast<int>(fixed) : Eigen::Dynamic;
    using Vector = Eigen::Matrix<double, components, 1>;
    const Eigen::Map<const Vector> code(codes_.data() + assignment_.labels[begin] * k, k);
    Eigen::Matrix<double, components, components> scatter = result.scatter;
    Vector offset(k);
    for (auto v = static_cast<Eigen::Index>(begin); v < static_cast<Eigen::Index>(end); ++v) {
      offset = Eigen::Map<const Vector>(vectors_.data() + v * k, k) - code;
      scatter.noalias() += offset * offset.transpose();
    }
    result.scatter = scatter;
  });
  return result;
}

/// The spread of every cell. The vectors must be grouped by cell. Each chunk sums its part of a cell separately, and
/// the parts are added in order.
std::vector<Quantiser::Spread> Quantiser::cell_spreads() {
  std::vector<std::vector<std::pair<Region_index, Spread>>> parts(chunk_count());
  for_chunks([&](std::size_t chunk, std::size_t begin, std::size_t end) {
    const auto& labels = assignment_.labels;
    while (begin < end) {
      std::size_t cell_end = begin + 1;
      while (cell_end < end && labels[cell_end] == labels[begin]) ++cell_end;
      parts[chunk].emplace_back(labels[begin], spread(begin, cell_end));
      begin = cell_end;
    }
  });
  std::vector<Spread> spreads(size(),
                              {.distortion = 0, .scatter = Eigen::MatrixXd::Zero(codes_.cols(), codes_.cols())});
  for (const auto& of_chunk : parts)
    for (const auto& [cell, part] : of_chunk) {
      spreads[cell].distortion += part.distortion;
      spreads[cell].scatter += part.scatter;
    }
  return spreads;
}

/// e times the spread of a cell along the main axis of its covariance.
Eigen::RowVectorXd Quantiser::principal_offset(const Eigen::MatrixXd& scatter, std::size_t cell_size) const {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scatter / static_cast<double>(cell_size));
  Eigen::VectorXd axis = solver.eigenvectors().rightCols<1>();
  make_largest_component_positive(axis);
  const double variance = std::max(0.0, solver.eigenvalues().tail<1>().value());
  return (options_.split * std::sqrt(variance) * axis).transpose();
}

bool Quantiser::split(std::size_t target) {
  if (size() > 1) group_by_cell();
  const auto spreads = cell_spreads();
  std::vector<Region_index> order(size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::ranges::greater(), [&](auto cell) { return spreads[cell].distortion; });
  std::erase_if(order, [&](auto cell) { return spreads[cell].distortion == 0; });
  order.resize(std::min(order.size(), target - size()));
  if (order.empty()) return false;
  std::ranges::sort(order);

  const auto& sizes = assignment_.cell_sizes;
  const Eigen::Index before = codes_.rows();
  Feature_vectors split_codes(before + static_cast<Eigen::Index>(order.size()), codes_.cols());
  split_codes.topRows(before) = codes_;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Eigen::RowVectorXd code = codes_.row(order[i]);
    const Eigen::RowVectorXd offset = options_.split_rule == Split::principal_axis
                                          ? principal_offset(spreads[order[i]].scatter, sizes[order[i]])
                                          : options_.split * code;
    split_codes.row(order[i]) = code + offset;
    split_codes.row(before + static_cast<Eigen::Index>(i)) = code - offset;
  }
  codes_ = std::move(split_codes);
  return true;
}

Quantisation Quantiser::result() {
  // Cells are empty here only if the vectors hold fewer than N different values.
  const auto renumbered = drop_empty_cells(assignment_, codes_);
  std::vector<Region_index> labels(origin_.size());
  for_chunks([&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) labels[origin_[v]] = renumbered[assignment_.labels[v]];
  });
  return {.code_vectors = std::move(codes_),
          .labels = std::move(labels),
          .runs = std::move(runs_),
          .distance_evaluations = assignment_.distance_evaluations};
}

}  // namespace lodestone
