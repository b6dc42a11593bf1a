// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Vector_3.h>

#include <Eigen/Core>
#include <concepts>
#include <span>

#include "lodestone/mesh/concepts.h"
#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// One row per vertex, one column per component: V x k.
using Feature_vectors = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Largest weight of a factor. Beyond it the other factors no longer count, and much larger weights make squares
/// overflow.
inline constexpr double largest_weight = 1e6;

/// Weights of the factors of a feature vector.
struct Feature_options {
  double position_weight = 1;  ///< of positions scaled to the unit ball around their mean; [0, 1e6]
  double normal_weight = 1;    ///< of unit vertex normals; [0, 1e6]; 0 leaves the normals out, so that k = 3
};

/// @throws Bad_argument  a weight is out of range, or both are 0
void check(const Feature_options& options);

/// Unit normal of each vertex: the sum of the cross products of its faces, which weights faces by area, divided by its
/// length. Zero if that sum is zero (isolated vertices, zero-area faces). Cost O(V + F).
Positions vertex_normals(const Positions& positions, std::span<const Corners> faces);

/// The feature vectors of \cite saenghaengtham2006: position and normal of each vertex, each times its weight.
///
/// Positions are taken relative to their mean and divided by the largest distance from it, so that neither a
/// translation nor a uniform scale of the mesh changes the result, but for rounding. Every position counts, whether or
/// not a face uses it. Cost O(V + F).
///
/// @return V x k: k = 6 components, or k = 3 if one weight is 0
/// @throws Bad_argument  a weight is out of range, or both are 0
Feature_vectors feature_vectors(const Positions& positions, std::span<const Corners> faces,
                                const Feature_options& options = {});

/// The same for a mesh, in the order in which it enumerates its vertices.
/// @param np  `vertex_point_map`
/// @throws Bad_mesh  see Mesh_numbering and read_positions
template <Triangle_mesh Mesh, class Named_parameters = CGAL::parameters::Default_named_parameters>
Feature_vectors feature_vectors(const Mesh& mesh, const Feature_options& options = {},
                                const Named_parameters& np = CGAL::parameters::default_values()) {
  const Mesh_numbering<Mesh> numbering(mesh);
  return feature_vectors(read_positions(numbering, vertex_points(mesh, np)), numbering.corners(), options);
}

/// Further factors of the feature vector from a property map of the mesh, such as curvature or colour.
///
/// The values are multiplied by the weight and not otherwise scaled: bring them to the spread of the positions, which
/// is 1.
///
/// @param map     vertex property map; its values are numbers, or vectors of `Components` numbers indexed by []
/// @param weight  >= 0
/// @return V x Components, for `Lbg::extra_factors`
/// @throws Bad_argument  negative weight, or a value that is not finite
/// @throws Bad_mesh      a Surface_mesh with removed vertices
template <int Components = 1, Triangle_mesh Mesh, class Map>
Feature_vectors factors(const Mesh& mesh, const Map& map, double weight = 1) {
  if (!(weight >= 0)) throw Bad_argument("the weight of a factor must be >= 0");
  Feature_vectors result(num_vertices(mesh), Components);
  Eigen::Index row = 0;
  for (const auto v : vertices(mesh)) {
    const auto& value = get(map, v);
    for (int component = 0; component < Components; ++component) {
      if constexpr (std::convertible_to<decltype(value), double>)
        result(row, component) = weight * static_cast<double>(value);
      else
        result(row, component) = weight * static_cast<double>(value[component]);
    }
    ++row;
  }
  if (row != result.rows()) throw Bad_mesh("the mesh holds removed elements: call collect_garbage() on it first");
  if (!result.allFinite()) throw Bad_argument("a factor has a value that is not finite");
  return result;
}

}  // namespace lodestone
