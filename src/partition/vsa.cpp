// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/vsa.h"

#include <CGAL/Variational_shape_approximation.h>

#include <algorithm>
#include <cmath>

#include "lodestone/partition/face_labels.h"
#include "lodestone/partition/oriented_mesh.h"
#include "lodestone/partition/region_count.h"
#include "partition/face_geometry.h"
#include "partition/refusals.h"

namespace lodestone {

namespace {

void check(const Vsa_options& options) {
  if (options.relaxations < 1 || options.relaxations > 100)
    throw Bad_argument("VSA: the number of relaxations must be between 1 and 100");
  if (options.single_insertions > 1000000) throw Bad_argument("VSA: single_insertions must be at most 1e6");
  if (!(options.tolerance > 0 && options.tolerance < 1)) throw Bad_argument("VSA: tolerance must be between 0 and 1");
  if (options.max_iterations > 1000000) throw Bad_argument("VSA: max_iterations must be at most 1e6");
}

/// The metric L2,1, a model of CGAL's ErrorMetricProxy, on normals and areas that are finite on any surface.
class Normal_metric {
 public:
  using Proxy = Eigen::RowVector3d;
  using Face_index = Surface_mesh::Face_index;

  Normal_metric(const Oriented_mesh& oriented, const Face_geometry& geometry) {
    for (std::size_t f = 0; f < oriented.face_indices.size(); ++f) {
      const auto index = oriented.face_indices[f];
      areas_.push_back(geometry.areas[index]);
      normals_.emplace_back((oriented.turned[f] ? -1 : 1) * geometry.normals.row(index));
    }
  }

  double compute_error(Face_index f, const Surface_mesh&, const Proxy& proxy) const {
    return areas_[f] * (normals_[f] - proxy).squaredNorm();
  }

  template <class Faces>
  Proxy fit_proxy(const Faces& faces, const Surface_mesh&) const {
    Proxy sum = Proxy::Zero();
    for (const auto f : faces) sum += areas_[f] * normals_[f];
    const double length = sum.norm();
    return length > 0 ? Proxy(sum / length) : sum;
  }

 private:
  std::vector<double> areas_;  ///< per face of the mesh
  std::vector<Proxy> normals_;
};

using Approximation =
    CGAL::Variational_shape_approximation<Surface_mesh, Surface_mesh::Property_map<Surface_mesh::Vertex_index, Point>,
                                          Normal_metric>;

/// Proxies one by one, then by doubling, then relaxed.
/// @return the number of relaxations
std::size_t approximate(Approximation& approximation, std::size_t proxies, const Vsa_options& options) {
  std::size_t iterations = 0;
  approximation.initialize_seeds(CGAL::parameters::max_number_of_proxies(1));  // one per component
  const auto missing = [&](std::size_t target) { return target - std::min(target, approximation.number_of_proxies()); };
  const std::size_t singles = missing(std::min(proxies, options.single_insertions));
  iterations += options.relaxations * approximation.add_to_furthest_proxies(singles, options.relaxations);
  while (missing(proxies) > 0) {
    const std::size_t wanted = std::min(missing(proxies), approximation.number_of_proxies());
    if (approximation.add_proxies_error_diffusion(wanted) == 0) break;
    approximation.run(options.relaxations);
    iterations += options.relaxations;
  }
  double error = approximation.run();
  for (std::size_t i = 0; i < options.max_iterations && error > 0; ++i) {
    const double before = error;
    error = approximation.run();
    ++iterations;
    if (std::abs(before - error) <= options.tolerance * before) break;
  }
  return iterations + 1;
}

}  // namespace

Labelling Vsa::label(const Numbered_surface& surface, std::size_t regions) const {
  check(options);
  const Oriented_mesh oriented = oriented_mesh(surface);
  std::vector<Region_index> face_labels(surface.faces.size(), no_region);
  Labelling result;
  if (const std::size_t faces = oriented.mesh.number_of_faces(); faces > 0) {
    const Normal_metric metric(oriented, face_geometry(surface));
    result.iterations = with_refusals_as_bad_mesh(name, [&] {
      Approximation approximation(oriented.mesh, oriented.mesh.points(), metric);
      const auto iterations = approximate(approximation, std::clamp<std::size_t>(regions, 1, faces / 4 + 1), options);
      std::vector<std::size_t> proxies(faces);
      approximation.output(CGAL::parameters::face_proxy_map(
          boost::make_iterator_property_map(proxies.begin(), get(boost::face_index, oriented.mesh))));
      for (std::size_t f = 0; f < faces; ++f)
        face_labels[oriented.face_indices[f]] = static_cast<Region_index>(proxies[f]);
      return iterations;
    });
  }
  result.labels = vertex_labels(surface, face_labels);
  adjust_region_count(surface.graph, surface.positions, result.labels, regions);
  return result;
}

}  // namespace lodestone
