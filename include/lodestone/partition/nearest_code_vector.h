// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "lodestone/concepts.h"
#include "lodestone/partition/feature_vectors.h"

namespace lodestone {

/// Nearest code vector of every feature vector.
struct Assignment {
  std::vector<Region_index> labels;        ///< V; of equally near code vectors the lowest number
  std::vector<double> squared_distances;   ///< V; Euclidean, to the code vector of the label
  std::uint64_t distance_evaluations = 0;  ///< distances between a feature vector and a code vector, all calls
};

/// The plain loop: every feature vector against every code vector. O(k V N) per call.
/// @param vectors  V x k
/// @param codes    N x k
void assign_plain(const Feature_vectors& vectors, const Feature_vectors& codes, Assignment& assignment);

/// Nearest code vectors over consecutive Lloyd iterations, with the same labels and distances as `assign_plain`.
///
/// Two bounds spare most distances. A vector keeps its label when the distance to its code vector is below half the
/// distance between that code vector and its nearest other, or below a lower bound on the distance to the second
/// nearest code vector that is kept from iteration to iteration (Hamerly, "Making k-means even faster", SDM 2010).
/// Otherwise only code vectors within a ball around its own are tried (Newling and Fleuret, "Fast k-means with
/// accurate bounds", ICML 2016, their exponion). Bounds are compared with a margin far above rounding error, and
/// whatever they leave open is computed just as the plain loop does: that is why the labels are equal.
///
/// Memory O(V + N^2); beyond `max_codes` code vectors the plain loop is used.
class Bounded_assignment {
 public:
  static constexpr Eigen::Index max_codes = 2048;

  explicit Bounded_assignment(const Feature_vectors& vectors);

  /// Labels for `codes`, which may have moved and may be more than at the last call. `assignment.labels` is where the
  /// search for each vector starts: any number below N is right, a near one is fast.
  void assign(const Feature_vectors& codes, Assignment& assignment);

 private:
  struct Neighbour {
    double distance;
    Region_index code;
  };

  void follow_drift(const Feature_vectors& codes, const Assignment& assignment);
  void sort_neighbours(const Feature_vectors& codes);
  template <int K>
  void assign_fixed(const Feature_vectors& codes, Assignment& assignment);

  const Feature_vectors& vectors_;
  double margin_;                      ///< absolute part of the margin: above the rounding of any distance here
  Feature_vectors previous_;           ///< code vectors of the last call
  std::vector<double> second_;         ///< per vector: lower bound on the distance to all code vectors but its own
  std::vector<Neighbour> neighbours_;  ///< per code vector: the N - 1 others by distance
};

}  // namespace lodestone
