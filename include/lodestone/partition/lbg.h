// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "lodestone/partition/feature_vectors.h"
#include "lodestone/partition/partition.h"

namespace lodestone {

/// How one code vector becomes two.
enum class Split {
  principal_axis,  ///< C +- e s u: u the main eigenvector of the cell's covariance, s the spread along it
  multiplicative,  ///< (1 + e) C and (1 - e) C: \cite saenghaengtham2006, eq. (3) and (4); changes under translation
};

/// How the nearest code vector is found. Both give the same labels.
enum class Nearest_search {
  bounded,  ///< `Bounded_assignment`: skips distances that bounds make needless
  plain,    ///< `assign_plain`: compares every vector with every code vector
};

/// Options of LBG. The equations are those of \cite saenghaengtham2006.
struct Lbg_options {
  double split = 0.005;      ///< e of the split, eq. (3) and (4); dimensionless, > 0
  double tolerance = 0.005;  ///< relative drop of the distortion, eq. (9), at which Lloyd iterations stop; > 0
  Split split_rule = Split::principal_axis;         ///< how one code vector becomes two
  Nearest_search search = Nearest_search::bounded;  ///< changes times only
  Feature_options features = {};                    ///< of the strategy `Lbg`; `quantise` takes vectors as they are
  /// Vectors to train on at most, but 128 per code vector if that is more. Where there are more vectors, a sample is
  /// trained on, drawn evenly along their order, and then all are assigned once. 0: all are trained on, as published.
  std::size_t sample = 32768;
  std::size_t max_iterations = 1000;  ///< per Lloyd run; no mesh we know of reaches this limit
  std::size_t threads = 1;            ///< at most; 0: as many as the machine has. The result does not depend on it
};

/// @throws Bad_argument  an option out of its range
void check(const Lbg_options& options);

/// Lloyd iterations between two splits.
struct Lloyd_run {
  std::size_t code_vectors = 0;    ///< how many there were
  std::vector<double> distortion;  ///< per iteration: sum |X - Q(X)|^2 / (k M), \cite saenghaengtham2006, eq. (8)
};

/// Result of quantising M vectors of k components.
struct Quantisation {
  Feature_vectors code_vectors;            ///< n x k, n <= N: each the mean of its cell
  std::vector<Region_index> labels;        ///< M, each below n; no cell is empty
  std::vector<Lloyd_run> runs;             ///< of the training, one per number of code vectors: 1, 2, 4, ... N
  std::uint64_t distance_evaluations = 0;  ///< between a vector and a code vector
};

/// LBG vector quantisation: split, then Lloyd iterations, until there are N code vectors.
///
/// Linde, Buzo and Gray, "An algorithm for vector quantizer design", 1980, as used in \cite saenghaengtham2006, eq. (1)
/// to (9):
///  - The first code vector is the mean of all vectors, eq. (1); its distortion is eq. (2).
///  - A split makes two code vectors of one, eq. (3) and (4); see `Split`.
///  - An iteration assigns each vector to the nearest code vector, eq. (5) and (6), and moves each code vector to the
///    mean of its cell, eq. (7).
///  - Iterations stop when the relative drop of the distortion, eq. (8), is at most `tolerance`, eq. (9).
///
/// With more vectors than `sample` the code vectors are trained on some of them. Linde, Buzo and Gray train on a
/// sequence of vectors too, instead of their distribution. Then all vectors are assigned to the nearest code vector,
/// and each code vector moves to the mean of its cell, once.
///
/// If N is not a power of two, the last split takes only the cells with the largest distortion. A cell that becomes
/// empty is re-seeded from the cell of largest distortion, with the vector that is farthest from its code vector. Fewer
/// than N cells are returned only if the vectors hold fewer than N different values; those that differ by less than
/// 1e-150 may count as one.
///
/// Cost: an iteration with the plain search computes M N distances, with M the vectors that are trained on. In the
/// paper's O(kMN), k is the number of iterations, not of components. In addition, the time of a distance grows linearly
/// with the number of components. The threads share this work. Labels, code vectors and runs are the same to the last
/// bit for any number of threads and either search. Memory: about three copies of the vectors.
///
/// @param vectors  M x k: one row of k components per vertex
/// @param cells    N, >= 1
/// @throws Bad_argument  no vector, no cell, an option out of range, or a component that is not finite or beyond 1e100
Quantisation quantise(const Feature_vectors& vectors, std::size_t cells, const Lbg_options& options = {});

/// Partition strategy: the cells of LBG quantisation over position, normal and further factors of each vertex.
struct Lbg {
  static constexpr std::string_view name = "lbg";  ///< for `make_strategy`, tables and messages
  static constexpr bool is_concurrent = true;      ///< see Partition_strategy

  Lbg_options options = {};  ///< of `quantise`, and the weights of position and normal
  /// V rows with any number of columns, from `factors()`; empty for none. They are of one mesh: for a detector of more,
  /// write a strategy that makes them of each.
  Feature_vectors extra_factors = {};

  /// See Partition_strategy.
  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  /// The same for a surface by index.
  /// @throws Bad_argument  as `quantise`; the extra factors do not have one row per vertex
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

/// `partition()` with the strategy `Lbg`.
template <Triangle_mesh Mesh, Region_map<Mesh> Regions,
          class Named_parameters = CGAL::parameters::Default_named_parameters>
Partition<Mesh> lbg(const Mesh& mesh, std::size_t regions, Regions region_map, const Lbg_options& options = {},
                    const Named_parameters& np = CGAL::parameters::default_values()) {
  return partition(mesh, regions, region_map, Lbg{.options = options}, {}, np);
}

}  // namespace lodestone
