// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/vsa.h"

#include <CGAL/Variational_shape_approximation.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lodestone/partition/face_labels.h"
#include "lodestone/partition/oriented_mesh.h"
#include "lodestone/partition/region_count.h"
#include "partition/face_geometry.h"
#include "partition/refusals.h"
#include "partition/used_surface.h"

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
      area_ += geometry.areas[index];
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

  /// An error of all faces together that may be nothing but the rounding of their normals.
  double rounding() const {
    constexpr double of_normal = 64 * std::numeric_limits<double>::epsilon();
    return area_ * of_normal * of_normal;
  }

 private:
  double area_ = 0;            ///< of all faces
  std::vector<double> areas_;  ///< per face of the mesh
  std::vector<Proxy> normals_;
};

using Approximation =
    CGAL::Variational_shape_approximation<Surface_mesh, Surface_mesh::Property_map<Surface_mesh::Vertex_index, Point>,
                                          Normal_metric>;

/// Proxies one by one, then by doubling, then relaxed. None is added where the error is no more than rounding: it would
/// be as good anywhere.
/// @return the number of relaxations
std::size_t approximate(Approximation& approximation, std::size_t proxies, double rounding,
                        const Vsa_options& options) {
  std::size_t iterations = 0;
  approximation.initialize_seeds(CGAL::parameters::max_number_of_proxies(1));  // one per component
  const auto missing = [&](std::size_t target) { return target - std::min(target, approximation.number_of_proxies()); };
  const std::size_t singles = missing(std::min(proxies, options.single_insertions));
  const auto is_exact = [&] { return approximation.compute_total_error() <= rounding; };
  for (std::size_t i = 0; i < singles && !is_exact(); ++i) {
    if (approximation.add_to_furthest_proxies(1, options.relaxations) == 0) break;
    iterations += options.relaxations;
  }
  while (missing(proxies) > 0 && !is_exact()) {
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

struct Approximated_faces {
  std::vector<Region_index> labels;  ///< the proxy of each face; `no_region` for faces that `oriented_mesh` leaves out
  std::size_t relaxations = 0;
};

Approximated_faces approximated(const Numbered_surface& surface, std::size_t regions, const Vsa_options& options) {
  const Oriented_mesh oriented = oriented_mesh(surface);
  Approximated_faces result{.labels = std::vector<Region_index>(surface.faces.size(), no_region)};
  const std::size_t faces = oriented.mesh.number_of_faces();
  if (faces == 0) return result;
  const Normal_metric metric(oriented, face_geometry(surface));
  with_refusals_as_bad_mesh(Vsa::name, [&] {
    Approximation approximation(oriented.mesh, oriented.mesh.points(), metric);
    result.relaxations =
        approximate(approximation, std::clamp<std::size_t>(regions, 1, faces / 4 + 1), metric.rounding(), options);
    std::vector<std::size_t> proxies(faces);
    approximation.output(CGAL::parameters::face_proxy_map(
        boost::make_iterator_property_map(proxies.begin(), get(boost::face_index, oriented.mesh))));
    for (std::size_t f = 0; f < faces; ++f)
      result.labels[oriented.face_indices[f]] = static_cast<Region_index>(proxies[f]);
  });
  return result;
}

}  // namespace

Labelling Vsa::label(const Numbered_surface& surface, std::size_t regions) const {
  check(options);
  return label_used(surface, regions, [this](const Numbered_surface& used, std::size_t wanted) -> Labelling {
    const Approximated_faces faces = approximated(used, wanted, options);
    Labelling result{.labels = vertex_labels(used, faces.labels), .iterations = faces.relaxations};
    adjust_region_count(used.graph, used.positions, result.labels, wanted);
    return result;
  });
}

}  // namespace lodestone
