// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/curvature.h"

#include <CGAL/Eigen_matrix.h>
#include <CGAL/Eigen_vector.h>
#include <CGAL/Monge_via_jet_fitting.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/scaled_positions.h"
#include "lodestone/partition/feature_vectors.h"

namespace lodestone {

namespace {

// No predicate decides anything here, so doubles are enough.
using Local_kernel = CGAL::Simple_cartesian<double>;

/// Least-squares solution of smallest norm: the one that CGAL gets from singular values, in a tenth of the time.
struct Least_squares {
  using FT = double;
  using Vector = CGAL::Eigen_vector<double>;
  using Matrix = CGAL::Eigen_matrix<double>;

  static FT solve(const Matrix& matrix, Vector& right_side) {
    right_side.eigen_object() =
        matrix.eigen_object().completeOrthogonalDecomposition().solve(right_side.eigen_object()).eval();
    return 1;  // in place of the condition number, which is not used
  }
};

using Jet_fitting = CGAL::Monge_via_jet_fitting<Local_kernel, Local_kernel, Least_squares>;

constexpr std::size_t fitted_degree = 2;  // of the fitted polynomial
constexpr std::size_t coefficients = 6;   // of the fitted polynomial
constexpr std::size_t whole_rings = 256;  // vertices up to which rings are taken whole
// Vertices that are taken of a larger ring, and neighbours of a vertex of higher degree.
constexpr std::size_t thinned_ring = 64;

/// The index of number `i` of `count` places spread evenly over `size`.
std::size_t spread_index(std::size_t i, std::size_t count, std::size_t size) { return i * size / count; }

/// A vertex and its rings of neighbours, nearer rings first. Few vertices stand for a large ring: a fit to all of them
/// would take long, for each vertex around a hub, and a fit to the first of them would see one side only.
class Rings {
 public:
  explicit Rings(const Vertex_graph& graph) : graph_(graph), seen_by_(num_vertices(graph), no_vertex) {}

  const std::vector<std::uint32_t>& around(std::uint32_t centre, std::size_t rings) {
    found_.assign(1, centre);
    seen_by_[centre] = centre;
    std::size_t begin = 0;
    for (std::size_t ring = 0; ring < rings; ++ring) {
      const std::size_t end = found_.size();
      for (; begin < end; ++begin) reach_neighbours(found_[begin], centre);
      if (found_.size() > whole_rings) thin_out(end);
    }
    return found_;
  }

 private:
  static constexpr std::uint32_t no_vertex = std::numeric_limits<std::uint32_t>::max();

  void reach_neighbours(std::uint32_t vertex, std::uint32_t centre) {
    const auto all = neighbours(graph_, vertex);
    const auto degree = static_cast<std::size_t>(all.size());
    const std::size_t count = std::min(degree, thinned_ring);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t w = all[static_cast<std::ptrdiff_t>(spread_index(i, count, degree))];
      if (seen_by_[w] == centre) continue;
      seen_by_[w] = centre;
      found_.push_back(w);
    }
  }

  /// Keeps some of the ring that begins at `begin`.
  void thin_out(std::size_t begin) {
    const std::size_t size = found_.size() - begin;
    if (size <= thinned_ring) return;
    for (std::size_t i = 0; i < thinned_ring; ++i)
      found_[begin + i] = found_[begin + spread_index(i, thinned_ring, size)];
    found_.resize(begin + thinned_ring);
  }

  const Vertex_graph& graph_;
  std::vector<std::uint32_t> seen_by_;
  std::vector<std::uint32_t> found_;
};

/// Vertices relative to the first of them, scaled such that the farthest is at distance 1.
struct Local_patch {
  std::vector<Local_kernel::Point_3> points;  ///< empty if all vertices coincide
  double radius = 0;                          ///< distance of the farthest before scaling
};

Local_patch local_patch_of(const Positions& positions, const std::vector<std::uint32_t>& vertices) {
  Local_patch patch;
  const Eigen::RowVector3d centre = positions.row(vertices.front());
  for (const auto v : vertices) patch.radius = std::max(patch.radius, (positions.row(v) - centre).stableNorm());
  if (!(patch.radius > 0)) return patch;
  for (const auto v : vertices) {
    const Eigen::RowVector3d offset = (positions.row(v) - centre) / patch.radius;
    patch.points.emplace_back(offset[0], offset[1], offset[2]);
  }
  return patch;
}

/// Mean curvature at the first point of a patch, in units of 1 / radius; 0 if the points do not span a surface.
double fitted_mean_curvature(const Local_patch& patch, const Eigen::RowVector3d& normal) {
  Jet_fitting fitting;
  auto form = fitting(patch.points.begin(), patch.points.end(), fitted_degree, 2);
  // If the points lie on a line, rounding alone decides the second direction of the patch.
  if (!(fitting.pca_basis(1).first > 1e-12 * fitting.pca_basis(0).first)) return 0;
  form.comply_wrt_given_normal({normal[0], normal[1], normal[2]});
  // A sphere curves away from its outward normal, which CGAL counts as negative.
  const double mean = -(form.principal_curvatures(0) + form.principal_curvatures(1)) / 2;
  return std::isfinite(mean) ? mean : 0;
}

}  // namespace

std::vector<double> mean_curvatures(const Numbered_surface& surface, const Curvature_options& options) {
  if (options.rings < 1 || options.rings > 10) throw Bad_argument("curvature: rings must be between 1 and 10");
  const Positions normals = vertex_normals(surface.positions, surface.faces);
  int exponent = 0;
  std::frexp(surface.positions.cwiseAbs().maxCoeff(), &exponent);
  const Positions scaled = scaled_positions(surface.positions);

  std::vector<double> curvatures(num_vertices(surface.graph), 0);
  Rings rings(surface.graph);
  for (std::uint32_t v = 0; v < curvatures.size(); ++v) {
    if (normals.row(v).isZero(0)) continue;
    const auto& vertices = rings.around(v, options.rings);
    if (vertices.size() < coefficients) continue;
    const Local_patch patch = local_patch_of(scaled, vertices);
    if (patch.points.empty()) continue;
    curvatures[v] = std::ldexp(fitted_mean_curvature(patch, normals.row(v)) / patch.radius, -exponent);
  }
  return curvatures;
}

}  // namespace lodestone
