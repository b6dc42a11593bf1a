// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/lbg.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "partition/fixed_components.h"

namespace lodestone {

namespace {

void check(const Feature_vectors& vectors, std::size_t cells, const Lbg_options& options) {
  if (vectors.rows() == 0 || vectors.cols() == 0) throw Bad_argument("there is no vector to quantise");
  // Squares and their sums over all vectors must not overflow. The comparison also refuses NaN.
  if (!(vectors.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= 1e100))
    throw Bad_argument("a component of a vector to quantise is not finite, or beyond 1e100");
  if (cells == 0) throw Bad_argument("the number of regions must be at least 1");
  if (!(options.split > 0) || !std::isfinite(options.split)) throw Bad_argument("LBG: split must be finite and > 0");
  if (!(options.tolerance > 0)) throw Bad_argument("LBG: tolerance must be > 0");
  if (options.max_iterations == 0) throw Bad_argument("LBG: max_iterations must be at least 1");
}

/// The spread of a cell around its code vector, which a split needs.
struct Spread {
  double distortion = 0;    ///< sum of squared distances
  Eigen::MatrixXd scatter;  ///< k x k: sum of the products of the offsets' components
};

/// The state of one quantisation: the code vectors, the cell of each vector, and its distance from its code vector. The
/// equations are those of \cite saenghaengtham2006. The constructor sets the first code vector, eq. (1).
class Quantiser {
 public:
  Quantiser(const Feature_vectors& vectors, const Lbg_options& options)
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
  Quantiser(const Quantiser&) = delete;
  Quantiser& operator=(const Quantiser&) = delete;

  std::size_t size() const { return static_cast<std::size_t>(codes_.rows()); }
  void run_lloyd();
  bool split(std::size_t target);
  Quantisation result();

 private:
  std::size_t chunk_length() const { return chunk_size(origin_.size(), 0); }
  std::size_t chunk_count() const { return (origin_.size() + chunk_length() - 1) / chunk_length(); }
  template <class Task>
  void for_chunks(Task task);
  double distortion();
  std::vector<double> cell_distortions() const;
  Spread spread(std::size_t begin, std::size_t end) const;
  std::vector<Spread> cell_spreads();
  Eigen::RowVectorXd principal_offset(const Eigen::MatrixXd& scatter, std::size_t cell_size) const;
  void assign();
  bool reseed_empty_cells();
  void group_by_cell();
  void move_codes_to_means();

  const Lbg_options& options_;
  Workers workers_;
  Feature_vectors vectors_;  ///< in the caller's order at first, then grouped by cell at each split
  std::optional<Bounded_assignment> bounded_;
  Feature_vectors codes_;
  Assignment assignment_;
  std::vector<std::uint32_t> origin_;  ///< per row of `vectors_`: its row in the caller's matrix
  std::vector<Lloyd_run> runs_;

  // Buffers for `group_by_cell`, swapped with the members above.
  Feature_vectors grouped_vectors_;
  std::vector<Region_index> grouped_labels_;
  std::vector<double> grouped_distances_;
  std::vector<std::uint32_t> grouped_origin_;
};

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

std::vector<double> Quantiser::cell_distortions() const {
  std::vector<double> sums(size(), 0);
  for (std::size_t v = 0; v < assignment_.labels.size(); ++v)
    sums[assignment_.labels[v]] += assignment_.squared_distances[v];
  return sums;
}

/// Iterates until the relative drop of the distortion, eq. (9), is at most the tolerance.
void Quantiser::run_lloyd() {
  Lloyd_run run{.code_vectors = size(), .distortion = {}};
  for (std::size_t iteration = 0; iteration < options_.max_iterations; ++iteration) {
    assign();
    if (reseed_empty_cells() && bounded_) bounded_->forget();
    run.distortion.push_back(distortion());
    move_codes_to_means();
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

/// @return whether a label has changed
bool Quantiser::reseed_empty_cells() {
  auto& sizes = assignment_.cell_sizes;
  if (std::ranges::find(sizes, 0U) == sizes.end()) return false;
  auto distortions = cell_distortions();
  for (std::size_t cell = 0; cell < sizes.size(); ++cell)
    if (sizes[cell] == 1) distortions[cell] = 0;  // its one vector must stay
  for (std::size_t empty = 0; empty < sizes.size(); ++empty) {
    if (sizes[empty] != 0) continue;
    const auto donor = static_cast<Region_index>(std::ranges::max_element(distortions) - distortions.begin());
    if (distortions[donor] == 0) return true;  // no cell holds two different vectors
    std::size_t farthest = 0;
    double distance = -1;
    for (std::size_t v = 0; v < assignment_.labels.size(); ++v)
      if (assignment_.labels[v] == donor && assignment_.squared_distances[v] > distance) {
        farthest = v;
        distance = assignment_.squared_distances[v];
      }
    codes_.row(empty) = vectors_.row(farthest);
    assignment_.cell_sums.row(empty) = vectors_.row(farthest);
    assignment_.cell_sums.row(donor) -= vectors_.row(farthest);
    assignment_.labels[farthest] = static_cast<Region_index>(empty);
    assignment_.squared_distances[farthest] = 0;
    distortions[donor] -= distance;
    if (--sizes[donor] == 1) distortions[donor] = 0;
  }
  return true;
}

/// Eq. (7).
void Quantiser::move_codes_to_means() {
  for (Eigen::Index c = 0; c < codes_.rows(); ++c)
    if (assignment_.cell_sizes[c] > 0)
      codes_.row(c) = assignment_.cell_sums.row(c) / static_cast<double>(assignment_.cell_sizes[c]);
}

/// The spread of the vectors from `begin` to `end`, which share a cell.
Spread Quantiser::spread(std::size_t begin, std::size_t end) const {
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
std::vector<Spread> Quantiser::cell_spreads() {
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
  // The sign of an eigenvector is arbitrary. The largest component is made positive, so that runs agree.
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  if (axis[largest] < 0) axis = -axis;
  const double variance = std::max(0.0, solver.eigenvalues().tail<1>().value());
  return (options_.split * std::sqrt(variance) * axis).transpose();
}

/// Splits every code vector, eq. (3) and (4), or only those of the largest distortion if there would be more than
/// `target`.
/// @return whether a code vector was split
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
  // Cells are empty here only if the vectors hold fewer than N different values. The indices of the others close up.
  const auto& sizes = assignment_.cell_sizes;
  std::vector<Region_index> renumbered(size());
  Eigen::Index kept = 0;
  for (std::size_t c = 0; c < size(); ++c) {
    renumbered[c] = static_cast<Region_index>(kept);
    if (sizes[c] > 0) codes_.row(kept++) = codes_.row(c).eval();
  }
  std::vector<Region_index> labels(origin_.size());
  for_chunks([&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) labels[origin_[v]] = renumbered[assignment_.labels[v]];
  });
  return {.code_vectors = codes_.topRows(kept),
          .labels = std::move(labels),
          .runs = std::move(runs_),
          .distance_evaluations = assignment_.distance_evaluations};
}

}  // namespace

Quantisation quantise(const Feature_vectors& vectors, std::size_t cells, const Lbg_options& options) {
  check(vectors, cells, options);
  Quantiser quantiser(vectors, options);
  quantiser.run_lloyd();
  while (quantiser.size() < cells && quantiser.split(cells)) quantiser.run_lloyd();
  return quantiser.result();
}

Labelling Lbg::label(const Numbered_surface& surface, std::size_t regions) const {
  Feature_vectors vectors = feature_vectors(surface.positions, surface.faces, options.features);
  if (extra_factors.size() > 0) {
    if (extra_factors.rows() != vectors.rows())
      throw Bad_argument("extra factors have " + std::to_string(extra_factors.rows()) + " rows for " +
                         std::to_string(vectors.rows()) + " vertices");
    const Eigen::Index k = vectors.cols();
    vectors.conservativeResize(Eigen::NoChange, k + extra_factors.cols());
    vectors.rightCols(extra_factors.cols()) = extra_factors;
  }
  Quantisation quantisation = quantise(vectors, regions, options);
  std::size_t iterations = 0;
  for (const auto& run : quantisation.runs) iterations += run.distortion.size();
  return {.labels = std::move(quantisation.labels),
          .vectors = std::move(vectors),
          .iterations = iterations,
          .distance_evaluations = quantisation.distance_evaluations};
}

}  // namespace lodestone
