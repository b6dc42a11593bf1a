// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "lodestone/mesh/concepts.h"
#include "lodestone/mesh/workers.h"
#include "lodestone/partition/feature_vectors.h"

namespace lodestone {

/// How many consecutive vectors are one task. The sums of a chunk are formed apart and added in the order of the
/// chunks: its size depends on nothing else, and so the sums are the same to the last bit for any search and number of
/// threads. A whole number of blocks of eight; at most 64 chunks, whose sums together take no more room than the
/// vectors.
/// @param vectors  M
/// @param cells    N
std::size_t chunk_size(std::size_t vectors, std::size_t cells);

/// Nearest code vector of every feature vector, and what a Lloyd iteration needs of the cells.
struct Assignment {
  std::vector<Region_index> labels = {};       ///< M; of equally near code vectors the lowest number
  std::vector<double> squared_distances = {};  ///< M; Euclidean, to the code vector of the label
  Feature_vectors cell_sums = {};              ///< N x k: sum of the vectors of each cell
  std::vector<std::uint64_t> cell_sizes = {};  ///< N
  std::uint64_t distance_evaluations = 0;      ///< between a vector and a code vector, over all calls

  std::vector<double> chunk_sums = {};          ///< the same of each chunk: C x N x k
  std::vector<std::uint64_t> chunk_sizes = {};  ///< C x N

  /// Room for M vectors and N empty cells of k components.
  void start(std::size_t vectors, std::size_t cells, std::size_t components);
};

/// The plain loop: every feature vector against every code vector. O(k M N) per call.
/// @param vectors  M x k
/// @param codes    N x k
void assign_plain(const Feature_vectors& vectors, const Feature_vectors& codes, Assignment& assignment,
                  Workers& workers = Workers::alone());

/// Nearest code vectors over consecutive Lloyd iterations, with the same labels and distances as `assign_plain`.
///
/// Two bounds spare most distances. A vector keeps its label when the distance to its code vector is below half the
/// distance between that code vector and its nearest other, or below a lower bound on the distance to the second
/// nearest code vector that is kept from iteration to iteration (Hamerly, "Making k-means even faster", SDM 2010).
/// Otherwise only code vectors within a ball around its own are tried (Newling and Fleuret, "Fast k-means with
/// accurate bounds", ICML 2016, their exponion), eight at a time. Bounds are compared with a margin far above rounding
/// error, and whatever they leave open is computed just as the plain loop does: that is why the labels are equal.
///
/// Memory O(M + k N^2); beyond `max_codes` code vectors the plain loop is used.
class Bounded_assignment {
 public:
  static constexpr Eigen::Index max_codes = 1024;

  /// Both are kept by reference.
  explicit Bounded_assignment(const Feature_vectors& vectors, Workers& workers = Workers::alone());

  /// Labels for `codes`, which may have moved and may be more than at the last call. `assignment.labels` is where the
  /// search for each vector starts: any number below N is right, a near one is fast.
  void assign(const Feature_vectors& codes, Assignment& assignment);

  /// Must be called when labels have been changed since the last call of `assign`: its bounds speak of those.
  void forget();

  /// Must be called when the rows of the vectors have changed places since the last call of `assign`.
  void reload();

 private:
  void follow_drift(const Feature_vectors& codes);
  void sort_neighbours(const Feature_vectors& codes);
  void sort_neighbours_of(std::size_t c, const Feature_vectors& codes, bool same_codes);

  const Feature_vectors& vectors_;
  Workers& workers_;
  Eigen::VectorXd blocks_;         ///< the vectors again, eight side by side
  double margin_;                  ///< absolute part of the margin: above the rounding of any distance here
  Feature_vectors previous_;       ///< code vectors of the last call
  std::vector<double> second_;     ///< per vector: lower bound on the distance to all code vectors but its own
  std::vector<double> drifts_;     ///< per code vector: how far, at most, any other has moved since the bounds were new
  std::vector<double> half_gaps_;  ///< per code vector: half the distance to the nearest other
  std::size_t padded_ = 0;         ///< N - 1 rounded up to whole blocks

  // Per code vector the others by distance, in whole blocks.
  std::vector<Region_index> neighbour_order_;
  std::vector<double> neighbour_distances_;
  std::vector<double> neighbour_codes_;  ///< numbers, as doubles: they are compared beside distances
  std::vector<double> neighbour_components_;
};

}  // namespace lodestone
