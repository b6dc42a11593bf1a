// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "lodestone/partition/feature_vectors.h"
#include "lodestone/partition/nearest_code_vector.h"
#include "lodestone/partition/partition.h"

namespace lodestone {

/// How one code vector becomes two.
enum class Split {
  principal_axis,  ///< C +- e s u: u the main eigenvector of the cell's covariance, s the spread along it
  multiplicative,  ///< (1 + e) C and (1 - e) C, as published; changes under translation
};

/// How the nearest code vector is found. The labels are the same.
enum class Nearest_search { bounded, plain };

struct Lbg_options {
  double split = 0.005;      ///< e of the split; dimensionless, > 0
  double tolerance = 0.005;  ///< relative drop of the distortion at which Lloyd iterations stop; > 0
  Split split_rule = Split::principal_axis;
  Nearest_search search = Nearest_search::bounded;
  Feature_options features = {};
  std::size_t max_iterations = 1000;  ///< per Lloyd run; a bound that no mesh we know of meets
  std::size_t threads = 1;            ///< at most; 0: as many as the machine has. The result does not depend on it
};

/// Lloyd iterations between two splits.
struct Lloyd_run {
  std::size_t code_vectors = 0;
  std::vector<double> distortion;  ///< after each iteration: sum |X - Q(X)|^2 / (k M)
};

/// Result of quantising M vectors of k components.
struct Quantisation {
  Feature_vectors code_vectors;      ///< n x k, n <= N: each the mean of its cell
  std::vector<Region_index> labels;  ///< M, each below n; no cell is empty
  std::vector<Lloyd_run> runs;       ///< one per number of code vectors: 1, 2, 4, ... N
  std::uint64_t distance_evaluations = 0;
};

/// LBG vector quantisation: split, then Lloyd iterations, until there are N code vectors.
///
/// Linde, Buzo and Gray, "An algorithm for vector quantizer design", 1980, as used in \cite saenghaengtham2006.
/// Where N is no power of two, the last split takes only the cells with the largest distortion. A cell that becomes
/// empty starts anew at the vector farthest from its code vector within the cell of largest distortion. Fewer than N
/// cells come back only when the vectors hold fewer than N different values. O(k M N) per iteration with the plain
/// search, shared by `threads`; neither their number nor the search changes a bit of labels, code vectors and runs.
/// Memory: about three copies of the vectors.
///
/// @param vectors  M x k
/// @param cells    N, >= 1
/// @throws Bad_argument  no vector, no cell, an option out of range, or a component that is not finite or beyond 1e100
Quantisation quantise(const Feature_vectors& vectors, std::size_t cells, const Lbg_options& options = {});

/// Partition strategy: the cells of LBG quantisation over position, normal and further factors of each vertex.
struct Lbg {
  static constexpr std::string_view name = "lbg";

  Lbg_options options = {};
  Feature_vectors extra_factors = {};  ///< V x anything, from `factors()`; empty for none

  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

/// `partition()` by LBG. See there.
template <Triangle_mesh Mesh, Region_map<Mesh> Regions,
          class Named_parameters = CGAL::parameters::Default_named_parameters>
Partition<Mesh> lbg(const Mesh& mesh, std::size_t regions, Regions region_map, const Lbg_options& options = {},
                    const Named_parameters& np = CGAL::parameters::default_values()) {
  return partition(mesh, regions, region_map, Lbg{.options = options}, {}, np);
}

}  // namespace lodestone
