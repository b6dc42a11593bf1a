// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "lodestone/partition/lbg.h"
#include "lodestone/partition/nearest_code_vector.h"

namespace lodestone {

/// The state of one quantisation: the code vectors, the cell of each vector, and its distance from its code vector. The
/// equations are those of \cite saenghaengtham2006. The constructor sets the first code vector, eq. (1).
class Quantiser {
 public:
  /// @param vectors  M x k, M > 0
  /// @param options  must outlive this
  Quantiser(const Feature_vectors& vectors, const Lbg_options& options);
  Quantiser(const Quantiser&) = delete;
  Quantiser& operator=(const Quantiser&) = delete;

  std::size_t size() const { return static_cast<std::size_t>(codes_.rows()); }
  /// Iterates until the relative drop of the distortion, eq. (9), is at most the tolerance.
  void run_lloyd();
  /// Splits every code vector, eq. (3) and (4), or only those of the largest distortion if there would be more than
  /// `target`.
  /// @return whether a code vector was split
  bool split(std::size_t target);
  /// To be called once, at the end.
  Quantisation result();

 private:
  std::size_t chunk_length() const { return chunk_size(origin_.size(), 0); }
  std::size_t chunk_count() const { return (origin_.size() + chunk_length() - 1) / chunk_length(); }
  template <class Task>
  void for_chunks(Task task);
  double distortion();
  struct Spread;
  Spread spread(std::size_t begin, std::size_t end) const;
  std::vector<Spread> cell_spreads();
  Eigen::RowVectorXd principal_offset(const Eigen::MatrixXd& scatter, std::size_t cell_size) const;
  void assign();
  void group_by_cell();

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

}  // namespace lodestone
