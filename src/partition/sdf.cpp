// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/sdf.h"

// The fastest of the implementations of maximum flow must be included before its user.
#include <CGAL/boost/graph/Alpha_expansion_MaxFlow_tag.h>
#include <CGAL/boost/graph/alpha_expansion_graphcut.h>
#include <CGAL/mesh_segmentation.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "lodestone/partition/face_labels.h"
#include "lodestone/partition/lbg.h"
#include "lodestone/partition/oriented_mesh.h"
#include "lodestone/partition/region_count.h"
#include "partition/face_geometry.h"
#include "partition/refusals.h"
#include "partition/used_surface.h"

namespace lodestone {

namespace {

using Diameters = std::vector<double>;  // per face of the mesh

void check(const Sdf_options& options) {
  if (!(options.cone_angle > 0 && options.cone_angle < std::numbers::pi))
    throw Bad_argument("SDF: the cone angle must be between 0 and pi");
  if (options.rays < 1 || options.rays > 1000) throw Bad_argument("SDF: the number of rays must be between 1 and 1000");
  if (options.clusters < 2 || options.clusters > 100)
    throw Bad_argument("SDF: the number of clusters must be between 2 and 100");
  if (!(options.smoothing >= 0 && options.smoothing <= 100))
    throw Bad_argument("SDF: smoothing must be between 0 and 100");
}

/// Whether a face has an area. CGAL's tree of such faces must not be empty.
bool has_area(const Surface_mesh& mesh) {
  return std::ranges::any_of(mesh.faces(), [&](auto f) {
    const auto h = mesh.halfedge(f);
    return !CGAL::collinear(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
                            mesh.point(mesh.target(mesh.next(h))));
  });
}

/// Log-normalised diameters between 0 and 1; empty if all are equal or none is known.
Diameters diameters(const Surface_mesh& mesh, const Sdf_options& options) {
  if (!has_area(mesh)) return {};
  Diameters values(mesh.number_of_faces());
  const auto map = boost::make_iterator_property_map(values.begin(), get(boost::face_index, mesh));
  CGAL::sdf_values(mesh, map, options.cone_angle, options.rays, false);
  if (std::ranges::max(values) < 0) return {};  // no ray has hit anything
  const auto [least, largest] = CGAL::sdf_values_postprocessing(mesh, map);
  // A relative difference of 1e-6 is far above rounding, and far below what distinguishes parts.
  if (!(largest - least > 1e-6 * largest)) return {};
  constexpr double alpha = 5;  // of the paper
  for (auto& value : values) value = std::log(alpha * value + 1) / std::log(alpha + 1);
  return values;
}

/// A mixture of normal distributions of one variable, fitted by expectation-maximisation.
class Mixture {
 public:
  Mixture(const Diameters& values, std::size_t clusters);
  std::size_t size() const { return means_.size(); }
  void fit();
  /// Per cluster: -log of the probability that a value belongs to it. The probabilities sum to 1.
  std::vector<double> costs(double value) const;

 private:
  std::vector<double> probabilities(double value) const;

  // Lower limit of the deviations. Without it a cluster of equal values would be a spike to which no other value can
  // belong.
  static constexpr double narrowest = 0.01;

  const Diameters& values_;
  std::vector<double> means_, deviations_, weights_;
};

/// Means of LBG cells, ascending. The two nearest are joined until all are far enough apart.
std::vector<double> distinct_means(const Diameters& values, std::size_t clusters) {
  const Eigen::Map<const Eigen::VectorXd> column(values.data(), static_cast<Eigen::Index>(values.size()));
  const auto cells = quantise(column, clusters, {.sample = 0});
  std::vector<std::pair<double, double>> means;  // each with its number of values
  for (const double code : cells.code_vectors.reshaped()) means.emplace_back(code, 0);
  for (const auto label : cells.labels) means[label].second += 1;
  std::ranges::sort(means);
  // Clusters that are nearer to each other are one thickness. The cut changes one cluster at a time, so it could not
  // get from such a mixture to fewer clusters.
  constexpr double least_gap = 0.1;
  while (means.size() > 1) {
    std::size_t nearest = 0;
    for (std::size_t c = 0; c + 1 < means.size(); ++c)
      if (means[c + 1].first - means[c].first < means[nearest + 1].first - means[nearest].first) nearest = c;
    auto& [mean, weight] = means[nearest];
    const auto [other, other_weight] = means[nearest + 1];
    if (other - mean >= least_gap) break;
    mean = (weight * mean + other_weight * other) / (weight + other_weight);
    weight += other_weight;
    means.erase(means.begin() + static_cast<std::ptrdiff_t>(nearest) + 1);
  }
  std::vector<double> result;
  for (const auto& entry : means) result.push_back(entry.first);
  return result;
}

/// At the start each value counts for the nearest mean.
Mixture::Mixture(const Diameters& values, std::size_t clusters)
    : values_(values),
      means_(distinct_means(values, clusters)),
      deviations_(means_.size(), 0),
      weights_(means_.size(), 0) {
  for (const double value : values) {
    const auto nearest = std::ranges::min_element(means_, {}, [&](double mean) { return std::abs(mean - value); });
    deviations_[nearest - means_.begin()] += (value - *nearest) * (value - *nearest);
    weights_[nearest - means_.begin()] += 1;
  }
  for (std::size_t c = 0; c < size(); ++c) {
    deviations_[c] = std::max(narrowest, std::sqrt(deviations_[c] / std::max(1.0, weights_[c])));
    weights_[c] = std::max(1.0, weights_[c]) / static_cast<double>(values.size());
  }
}

/// Computed from logarithms, less the largest of them, so that a value far from all clusters belongs to the nearest.
std::vector<double> Mixture::probabilities(double value) const {
  std::vector<double> result(size());
  for (std::size_t c = 0; c < size(); ++c) {
    const double offset = (value - means_[c]) / deviations_[c];
    result[c] = std::log(weights_[c] / deviations_[c]) - offset * offset / 2;
  }
  const double largest = std::ranges::max(result);
  double sum = 0;
  for (auto& p : result) sum += p = std::exp(p - largest);
  for (auto& p : result) p /= sum;
  return result;
}

void Mixture::fit() {
  constexpr int most_iterations = 15;  // as in CGAL; more make no difference that matters
  for (int i = 0; i < most_iterations; ++i) {
    std::vector<double> sums(size(), 0), squares(size(), 0), totals(size(), 0);
    for (const double value : values_) {
      const auto p = probabilities(value);
      for (std::size_t c = 0; c < size(); ++c) {
        totals[c] += p[c];
        sums[c] += p[c] * (value - means_[c]);
        squares[c] += p[c] * (value - means_[c]) * (value - means_[c]);
      }
    }
    for (std::size_t c = 0; c < size(); ++c) {
      if (totals[c] < 1e-9) continue;  // all its values have left
      const double shift = sums[c] / totals[c];
      means_[c] += shift;
      deviations_[c] = std::max(narrowest, std::sqrt(std::max(0.0, squares[c] / totals[c] - shift * shift)));
      weights_[c] = totals[c] / static_cast<double>(values_.size());
    }
  }
}

std::vector<double> Mixture::costs(double value) const {
  constexpr double least_probability = 5e-6;  // keeps the cost finite, so that any face can belong to any cluster
  auto result = probabilities(value);
  // The maximum flow does not accept costs of 0.
  for (auto& p : result)
    p = std::max(-std::log(std::max(p, least_probability)), std::numeric_limits<double>::epsilon());
  return result;
}

/// The cost of a border between two clusters along an edge: largest on a plane, least along a sharp concave edge.
double border_cost(const Oriented_mesh& oriented, const Face_geometry& geometry, Surface_mesh::Halfedge_index h) {
  const auto& mesh = oriented.mesh;
  const auto normal = [&](Surface_mesh::Halfedge_index side) -> Eigen::RowVector3d {
    const auto face = mesh.face(side);
    return (oriented.turned[face] ? -1 : 1) * geometry.normals.row(oriented.face_indices[face]);
  };
  const Eigen::RowVector3d here = normal(h), there = normal(mesh.opposite(h));
  const auto& apex = mesh.point(mesh.target(mesh.next(mesh.opposite(h))));
  const auto rise = apex - mesh.point(mesh.target(h));
  const bool concave = here.dot(Eigen::RowVector3d(rise.x(), rise.y(), rise.z())) > 0;
  const double bend = std::atan2(here.cross(there).norm(), here.dot(there)) / std::numbers::pi;
  constexpr double convex_factor = 0.08;  // as in CGAL; parts meet where a surface is concave
  return -std::log(std::max(concave ? bend : convex_factor * bend, 5e-6));
}

/// The cluster of each face after the cut.
std::vector<std::size_t> cut_clusters(const Oriented_mesh& oriented, const Face_geometry& geometry,
                                      const Mixture& mixture, const Diameters& values, double smoothing) {
  std::vector<std::pair<std::size_t, std::size_t>> edges;
  std::vector<double> edge_costs;
  for (const auto e : oriented.mesh.edges()) {
    const auto h = oriented.mesh.halfedge(e);
    if (oriented.mesh.is_border(e)) continue;
    edges.emplace_back(oriented.mesh.face(h), oriented.mesh.face(oriented.mesh.opposite(h)));
    constexpr double scale = 100;  // as in CGAL; brings useful values of smoothing between 0 and 1
    edge_costs.push_back(scale * smoothing * border_cost(oriented, geometry, h));
  }
  std::vector<std::vector<double>> costs(mixture.size(), std::vector<double>(values.size()));
  std::vector<std::size_t> clusters;
  for (std::size_t f = 0; f < values.size(); ++f) {
    const auto of_face = mixture.costs(values[f]);
    for (std::size_t c = 0; c < costs.size(); ++c) costs[c][f] = of_face[c];
    clusters.push_back(std::ranges::min_element(of_face) - of_face.begin());
  }
  if (edges.empty()) return clusters;  // CGAL does not expect loose triangles
  CGAL::alpha_expansion_graphcut(edges, edge_costs, costs, clusters, CGAL::Alpha_expansion_MaxFlow_tag());
  return clusters;
}

/// A segment for each connected set of faces of one cluster.
std::vector<Region_index> connected_segments(const Surface_mesh& mesh, const std::vector<std::size_t>& clusters) {
  std::vector<Region_index> segments(clusters.size(), no_region);
  Region_index count = 0;
  for (const auto start : mesh.faces()) {
    if (segments[start] != no_region) continue;
    std::vector<Surface_mesh::Face_index> front{start};
    segments[start] = count;
    for (std::size_t i = 0; i < front.size(); ++i)
      for (const auto h : mesh.halfedges_around_face(mesh.halfedge(front[i]))) {
        const auto next = mesh.face(mesh.opposite(h));
        if (next == Surface_mesh::null_face() || segments[next] != no_region || clusters[next] != clusters[start])
          continue;
        segments[next] = count;
        front.push_back(next);
      }
    ++count;
  }
  return segments;
}

std::vector<Region_index> components(const Surface_mesh& mesh) {
  return connected_segments(mesh, std::vector<std::size_t>(mesh.number_of_faces(), 0));
}

std::vector<Region_index> segments_of(const Numbered_surface& surface, const Oriented_mesh& oriented,
                                      const Sdf_options& options) {
  const auto values = diameters(oriented.mesh, options);
  if (values.empty()) return components(oriented.mesh);
  Mixture mixture(values, options.clusters);
  if (mixture.size() == 1) return components(oriented.mesh);
  mixture.fit();
  const auto clusters = cut_clusters(oriented, face_geometry(surface), mixture, values, options.smoothing);
  return connected_segments(oriented.mesh, clusters);
}

}  // namespace

std::vector<Region_index> sdf_segments(const Numbered_surface& surface, const Sdf_options& options) {
  check(options);
  std::vector<Region_index> result(surface.faces.size(), no_region);
  const Oriented_mesh oriented = oriented_mesh(surface);
  if (oriented.face_indices.empty()) return result;
  const auto segments = with_refusals_as_bad_mesh(Sdf::name, [&] { return segments_of(surface, oriented, options); });
  for (std::size_t f = 0; f < segments.size(); ++f) result[oriented.face_indices[f]] = segments[f];
  return result;
}

Labelling Sdf::label(const Numbered_surface& surface, std::size_t regions) const {
  return label_used(surface, regions, [this](const Numbered_surface& used, std::size_t wanted) -> Labelling {
    Labelling result{.labels = vertex_labels(used, sdf_segments(used, options))};
    adjust_region_count(used.graph, used.positions, result.labels, wanted);
    return result;
  });
}

}  // namespace lodestone
