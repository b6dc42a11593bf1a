// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/particle_count.h"

#include <CGAL/Min_sphere_of_points_d_traits_3.h>
#include <CGAL/Min_sphere_of_spheres_d.h>

#include <algorithm>
#include <boost/graph/connected_components.hpp>
#include <boost/graph/filtered_graph.hpp>
#include <boost/property_map/property_map.hpp>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>

#include "lodestone/mesh/joined_vertices.h"
#include "lodestone/partition/feature_vectors.h"

namespace lodestone {

namespace {

struct Not_critical {
  const std::vector<bool>* critical = nullptr;
  bool operator()(std::uint32_t vertex) const { return !(*critical)[vertex]; }
};

std::vector<bool> critical_vertices(const Vertex_graph& graph, const Positions& normals, double crease_degrees) {
  const double least_cosine = std::cos(crease_degrees * std::numbers::pi / 180);
  std::vector<bool> critical(num_vertices(graph), false);
  for (std::uint32_t v = 0; v < critical.size(); ++v)
    critical[v] = std::ranges::any_of(neighbours(graph, v),
                                      [&](auto w) { return normals.row(v).dot(normals.row(w)) < least_cosine; });
  return critical;
}

/// Connected sets of vertices that are not critical and have edges.
std::vector<std::vector<std::uint32_t>> smooth_parts(const Vertex_graph& graph, const std::vector<bool>& critical) {
  std::vector<std::uint32_t> component(num_vertices(graph), 0);
  const boost::filtered_graph smooth(graph, boost::keep_all(), Not_critical{&critical});
  const auto count = boost::connected_components(
      smooth, boost::make_iterator_property_map(component.begin(), get(boost::vertex_index, graph)));
  std::vector<std::vector<std::uint32_t>> parts(count);
  for (std::uint32_t v = 0; v < component.size(); ++v)
    if (!critical[v] && out_degree(v, graph) > 0) parts[component[v]].push_back(v);
  std::erase_if(parts, [](const auto& part) { return part.empty(); });
  return parts;
}

std::size_t vertices_with_edges(const Vertex_graph& graph) {
  std::size_t count = 0;
  for (std::uint32_t v = 0; v < num_vertices(graph); ++v) count += out_degree(v, graph) > 0 ? 1 : 0;
  return count;
}

/// Keeps the parts that are large enough; if these are too many, the largest of them.
void keep_large_parts(std::vector<std::vector<std::uint32_t>>& parts, std::size_t vertex_count,
                      const Particle_count_options& options) {
  const double least = options.smallest_part * static_cast<double>(vertex_count);
  std::erase_if(parts, [&](const auto& part) { return static_cast<double>(part.size()) < least; });
  if (parts.size() <= options.most_parts) return;
  std::ranges::stable_sort(parts, [](const auto& a, const auto& b) { return a.size() > b.size(); });
  parts.resize(options.most_parts);
  std::ranges::sort(parts, {}, [](const auto& part) { return part.front(); });
}

}  // namespace

void check(const Particle_count_options& options) {
  if (!(options.crease_degrees > 0 && options.crease_degrees <= 180))
    throw Bad_argument("crease_degrees must be above 0 and at most 180");
  if (!(options.smallest_part >= 0 && options.smallest_part <= 1))
    throw Bad_argument("smallest_part must be between 0 and 1");
  if (options.most_parts == 0) throw Bad_argument("most_parts must be at least 1");
  if (options.most_particles == 0) throw Bad_argument("most_particles must be at least 1");
  if (!(options.equal_sizes >= 0)) throw Bad_argument("equal_sizes must be >= 0");
  if (!(options.least_roundness >= 0 && options.least_roundness <= 1))
    throw Bad_argument("least_roundness must be between 0 and 1");
}

std::size_t kissing_particle_count(std::size_t objects) {
  constexpr std::size_t kissing_number = 12;
  return std::clamp<std::size_t>(objects, 1, kissing_number);
}

std::size_t shadow_particle_count(double radius, double smallest) {
  if (!(radius > 0 && smallest > 0) || !std::isfinite(radius) || !std::isfinite(smallest))
    throw Bad_argument("the radii of a shadow must be finite and > 0");
  const double sine = 1 / (radius / smallest + 1);
  // 1 - cos(theta) without cancellation, because the count is large where the shadow is small.
  const double one_minus_cosine = sine * sine / (1 + std::sqrt(1 - sine * sine));
  const double count = std::floor(2 / one_minus_cosine);
  return count < 1e9 ? std::max<std::size_t>(1, static_cast<std::size_t>(count)) : 1'000'000'000;
}

Sphere bounding_sphere(const Positions& positions) {
  using Points_kernel = CGAL::Simple_cartesian<double>;
  using Min_sphere = CGAL::Min_sphere_of_spheres_d<CGAL::Min_sphere_of_points_d_traits_3<Points_kernel, double>>;
  if (positions.rows() == 0) return {};
  // Relative to the extent, so that squares neither overflow nor underflow.
  const Eigen::RowVector3d origin = positions.row(0);
  const double extent = (positions.rowwise() - origin).cwiseAbs().maxCoeff();
  if (!(extent > 0) || !std::isfinite(extent)) return {.centre = origin};
  std::vector<Points_kernel::Point_3> points;
  points.reserve(positions.rows());
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    const Eigen::RowVector3d p = (positions.row(v) - origin) / extent;
    points.emplace_back(p[0], p[1], p[2]);
  }
  Min_sphere sphere(points.begin(), points.end());
  const Eigen::Vector3d centre(sphere.center_cartesian_begin());
  const auto distance = [&](const Points_kernel::Point_3& p) {
    return (Eigen::Vector3d(p.x(), p.y(), p.z()) - centre).norm();
  };
  const double nearest = distance(*std::ranges::min_element(points, {}, distance));
  return {.centre = origin.transpose() + extent * centre,
          .radius = extent * sphere.radius(),
          .roundness = nearest / sphere.radius()};
}

Sphere bounding_sphere(const Positions& positions, std::span<const Corners> faces) {
  const auto count = static_cast<std::uint32_t>(positions.rows());
  const auto unused = unused_vertices(faces, count);
  if (unused.empty() || faces.empty()) return bounding_sphere(positions);
  std::vector<std::uint32_t> all(count), used;
  std::iota(all.begin(), all.end(), 0);
  std::ranges::set_difference(all, unused, std::back_inserter(used));
  return bounding_sphere(Positions(positions(used, Eigen::all)));
}

std::vector<Sphere> sphere_collection(const Vertex_graph& graph, const Positions& positions,
                                      std::span<const Corners> faces, const Particle_count_options& options) {
  check(options);
  auto critical = critical_vertices(graph, vertex_normals(positions, faces), options.crease_degrees);
  const std::size_t vertex_count = vertices_with_edges(graph);
  auto parts = smooth_parts(graph, critical);
  keep_large_parts(parts, vertex_count, options);
  if (parts.empty()) {
    critical.assign(critical.size(), false);
    parts = smooth_parts(graph, critical);
    keep_large_parts(parts, vertex_count, options);
  }

  std::vector<Sphere> spheres;
  for (const auto& part : parts) {
    const Sphere sphere = bounding_sphere(positions(part, Eigen::all));
    if (sphere.radius > 0) spheres.push_back(sphere);
  }
  if (spheres.empty()) spheres.push_back(bounding_sphere(positions, faces));
  return spheres;
}

Radius_range radius_range(std::span<const double> radii) {
  const auto [smallest, largest] = std::ranges::minmax(radii);
  return {.smallest = smallest, .largest = largest, .count = radii.size()};
}

std::size_t particle_count(std::span<const Sphere> object, const Radius_range& radii,
                           const Particle_count_options& options) {
  check(options);
  const double smallest = radii.smallest;
  const bool equal_sizes = radii.largest <= smallest * (1 + options.equal_sizes);
  const bool is_sphere = object.size() == 1 && object[0].roundness >= options.least_roundness;
  // An object without extent casts no shadow to compare with.
  if (smallest <= 0 || (equal_sizes && is_sphere))
    return std::min(kissing_particle_count(radii.count), options.most_particles);
  std::size_t count = 0;
  for (const Sphere& sphere : object)
    if (sphere.radius > 0) count += shadow_particle_count(sphere.radius, smallest);
  return std::clamp<std::size_t>(count, 1, options.most_particles);
}

}  // namespace lodestone
