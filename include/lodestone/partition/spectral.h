// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "lodestone/partition/partition.h"

namespace lodestone {

/// Where a part is cut along its Fiedler vector.
enum class Spectral_cut {
  median,  ///< two halves of equal size, as Pothen, Simon and Liou
  zero,    ///< between negative and positive values, as Fiedler: where the part is narrowest, however unequal
};

/// The matrix whose second eigenvector is the Fiedler vector.
enum class Laplacian {
  combinatorial,  ///< D - A
  normalised,     ///< D^-1 (D - A): weighs a vertex by its number of neighbours
};

/// Options of Spectral.
struct Spectral_options {
  std::uint64_t seed = 1;                          ///< of the vectors the iteration starts from
  Spectral_cut cut = Spectral_cut::median;         ///< where a part is cut
  Laplacian laplacian = Laplacian::combinatorial;  ///< whose eigenvector is taken
  double tolerance = 1e-6;                         ///< of the residual, relative to the eigenvalue; (0, 1)
  std::size_t max_iterations = 300;                ///< per Fiedler vector; the vector reached by then is used; [1, 1e6]
};

/// Partition strategy: the largest part is cut in two along its Fiedler vector, until there are N.
///
/// The Fiedler vector is the eigenvector of the second smallest eigenvalue of the Laplacian of the part's mesh graph:
/// Fiedler, "Algebraic connectivity of graphs", 1973; Pothen, Simon and Liou, "Partitioning sparse matrices with
/// eigenvectors of graphs", 1990. It comes from inverse iteration on a block of vectors with a sparse Cholesky
/// factorisation; for few vertices, from a dense solver. A part of several islands is first divided into whole islands:
/// they go to the emptier side one after the other, the largest first. Only the graph counts, not the positions. The
/// sign is chosen such that the lowest vertex of the part is on the side of the smaller values. Of vertices with equal
/// values, those of lower index go to that side.
///
/// A factorisation of V vertices of a surface takes O(V^1.5) time and O(V log V) memory, and more for a graph unlike
/// that of a surface. 100 000 vertices and 64 regions take about 10 s. The strategy refuses meshes with more than
/// `most_vertices` vertices.
struct Spectral {
  static constexpr std::string_view name = "spectral";  ///< for `make_strategy`, tables and messages
  static constexpr std::size_t most_vertices = 200000;  ///< of a mesh that is not refused

  Spectral_options options = {};  ///< of the cuts and of the iteration

  /// See Partition_strategy.
  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  /// The same for a surface by index.
  /// @throws Bad_argument  no region wanted, more than `most_vertices` vertices, or an option out of range
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

/// Fiedler vector of a connected graph and its eigenvalue, the algebraic connectivity of the graph.
struct Fiedler_vector {
  double eigenvalue = 0;       ///< the second smallest of the Laplacian
  Eigen::VectorXd values;      ///< per vertex; that of the lowest vertex is not above 0
  std::size_t iterations = 0;  ///< 1 for a dense solver
};

/// The Fiedler vector of a graph, and its cost: see Spectral.
/// @param graph     connected, two vertices or more
/// @throws Bad_argument  an option out of range, or fewer than two vertices
Fiedler_vector fiedler_vector(const Vertex_graph& graph, const Spectral_options& options = {});

}  // namespace lodestone
