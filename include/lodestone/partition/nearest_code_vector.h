// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "lodestone/mesh/concepts.h"
#include "lodestone/mesh/workers.h"
#include "lodestone/partition/feature_vectors.h"

namespace lodestone {

/// How many consecutive vectors form a chunk, which is one task. Each chunk is summed separately, and these sums are
/// added in the order of the chunks. The size depends on M and N only, so the sums are the same to the last bit for any
/// search and number of threads. It is a multiple of eight, so that chunks consist of whole blocks. There are at most
/// 64 chunks, and their sums together take no more memory than the vectors.
/// @param vectors  M
/// @param cells    N
std::size_t chunk_size(std::size_t vectors, std::size_t cells);

/// Nearest code vector of every feature vector, \cite saenghaengtham2006, eq. (5) and (6), and the sums and sizes of
/// the cells, which give their means, eq. (7).
struct Assignment {
  std::vector<Region_index> labels = {};       ///< M; ties go to the code vector of the lowest index
  std::vector<double> squared_distances = {};  ///< M; Euclidean, to the code vector of the label
  Feature_vectors cell_sums = {};              ///< N x k: sum of the vectors of each cell
  std::vector<std::uint64_t> cell_sizes = {};  ///< N
  std::uint64_t distance_evaluations = 0;      ///< between a vector and a code vector, over all calls

  std::vector<double> chunk_sums = {};          ///< C x N x k: `cell_sums` of each of C chunks
  std::vector<std::uint64_t> chunk_sizes = {};  ///< C x N: `cell_sizes` of each chunk

  /// Makes room for M vectors and N empty cells of k components.
  void start(std::size_t vectors, std::size_t cells, std::size_t components);
};

/// The plain loop: compares every feature vector with every code vector. M N distances per call, each of O(k) for k
/// components.
/// @param vectors  M x k
/// @param codes    N x k
void assign_plain(const Feature_vectors& vectors, const Feature_vectors& codes, Assignment& assignment,
                  Workers& workers = Workers::alone());

/// Nearest code vectors over consecutive Lloyd iterations, with the same labels and distances as `assign_plain`.
///
/// Two bounds avoid most distances. A vector keeps its label if the distance to its code vector is below half the
/// distance between that code vector and the nearest other one. It also keeps its label if that distance is below a
/// lower bound on the distance to the second nearest code vector. This bound is kept from iteration to iteration
/// (Hamerly, "Making k-means even faster", SDM 2010). Otherwise only the code vectors within a ball around its own are
/// tried, eight at a time (the exponion of Newling and Fleuret, "Fast k-means with accurate bounds", ICML 2016). Bounds
/// are compared with a margin far above rounding error, and whatever they leave open is computed exactly as in the
/// plain loop. That is why the labels are equal.
///
/// Memory O(k (M + N^2)). With more than `max_codes` code vectors the plain loop is used.
class Bounded_assignment {
 public:
  /// Above so many code vectors the plain loop is used.
  static constexpr Eigen::Index max_codes = 1024;

  /// Both arguments must outlive this object.
  explicit Bounded_assignment(const Feature_vectors& vectors, Workers& workers = Workers::alone());

  /// Labels for `codes`. Since the last call code vectors may have moved, and their number may have changed. The search
  /// for each vector starts at the code vector of its label in `assignment.labels`. Any index below N gives the right
  /// result; a near one is fast.
  void assign(const Feature_vectors& codes, Assignment& assignment);

  /// Must be called if labels have been changed since the last call of `assign`, because the bounds depend on them.
  void forget();

  /// Must be called if the rows of the vectors have been permuted since the last call of `assign`.
  void reload();

 private:
  void follow_drift(const Feature_vectors& codes);
  void sort_neighbours(const Feature_vectors& codes);
  void sort_neighbours_of(std::size_t c, const Feature_vectors& codes, bool same_codes);

  const Feature_vectors& vectors_;
  Workers& workers_;
  Eigen::VectorXd blocks_;         ///< a copy of the vectors, with eight side by side
  double margin_;                  ///< absolute part of the margin: above the rounding of any distance here
  Feature_vectors previous_;       ///< code vectors of the last call
  std::vector<double> second_;     ///< per vector: lower bound on the distance to all code vectors but its own
  std::vector<double> drifts_;     ///< per code vector: upper bound on the motion of any other since the last reset
  std::vector<double> half_gaps_;  ///< per code vector: half the distance to the nearest other
  std::size_t padded_ = 0;         ///< N - 1 rounded up to whole blocks

  // Per code vector: the other ones by distance, padded to whole blocks.
  std::vector<Region_index> neighbour_order_;
  std::vector<double> neighbour_distances_;
  std::vector<double> neighbour_codes_;  ///< indices, as doubles because they are compared in lanes beside distances
  std::vector<double> neighbour_components_;
};

}  // namespace lodestone
