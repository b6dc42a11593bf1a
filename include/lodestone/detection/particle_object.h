// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "lodestone/mesh/connectivity.h"
#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/mesh/patch.h"
#include "lodestone/mesh/point_reader.h"
#include "lodestone/particles/collision_distance.h"
#include "lodestone/particles/hop_metric.h"
#include "lodestone/particles/relaxation.h"
#include "lodestone/particles/senin.h"
#include "lodestone/partition/particle_count.h"
#include "lodestone/partition/partition.h"
#include "lodestone/partition/region_extents.h"

namespace lodestone {

/// One object of a scene as the particle method keeps it from frame to frame: its surface by number, its regions, its
/// particles, and how large its regions may grow.
template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
class Particle_object {
 public:
  using Reader = Point_reader<Mesh, Points>;

  /// @throws Bad_mesh  see Mesh_numbering
  Particle_object(const Mesh& mesh, Points points);
  Particle_object(const Particle_object&) = delete;  // `position_` refers to the object itself
  Particle_object& operator=(const Particle_object&) = delete;

  /// Divides the surface as it is now into `regions` regions by `strategy`, and puts a particle in each. O(V) and more.
  /// @throws Bad_mesh  a coordinate is not finite or beyond 1e150, or edges are shorter than 1e-150 on average
  template <class Strategy>
  void partition(const Strategy& strategy, std::size_t regions, const Partition_options& options,
                 Distance_measure measure);

  /// Scatters `particles` over the surface as it is now: the predecessor's start.
  void scatter(std::size_t particles, const Senin_options& options, Distance_measure measure);

  /// Reads where the particles are in this frame.
  /// @throws Bad_mesh  a coordinate is not finite, or the number of vertices or faces has changed
  void read_particles();

  /// Whether a region's area exceeds `growth` times the largest of the time of the partition (A*). Follows a few
  /// samples per region; a region that seems to have grown is measured anew along shortest paths before it counts.
  bool has_outgrown(double growth);

  /// The faces that a particle stands for, at their positions in frame number `frame`.
  const Posed_patch& posed_patch(std::size_t particle, std::uint64_t frame);

  Sphere bounding_sphere() const { return lodestone::bounding_sphere(checked_positions()); }
  std::vector<Sphere> sphere_collection(const Particle_count_options& options) const {
    return lodestone::sphere_collection(graph_, checked_positions(), numbering_.corners(), options);
  }

  const Mesh_numbering<Mesh>& numbering() const { return numbering_; }
  const Reader& reader() const { return reader_; }
  const Region_steps& steps() const { return steps_; }
  const std::vector<Region_index>& labels() const { return labels_; }
  const Partition_statistics& partition_statistics() const { return statistics_; }
  const std::vector<Patch>& patches() const { return patches_; }
  double largest_area() const { return largest_area_; }
  Particles& particles() { return particles_; }
  const Particles& particles() const { return particles_; }

 private:
  Positions checked_positions() const;
  Positions measured_positions(Distance_measure measure);
  void start_particles(std::vector<std::uint32_t> vertices, const Positions& positions);
  /// Where a region's particle started, and an edge from there by which directions are found again.
  struct Home {
    std::uint32_t vertex = 0;
    std::uint32_t compass = 0;  ///< a neighbour of the vertex
    double angle = 0;           ///< from the edge to the X axis, around the normal
  };

  void check_connectivity() const;
  double longest_compass() const;
  void find_homes(const std::vector<std::uint32_t>& vertices);
  void measure_extents();
  Eigen::Vector3d normal_at(const Home& home, Region_index region) const;
  Region_extent measure_extent(Region_index region) const;

  const Mesh* mesh_;
  Points points_;
  Mesh_numbering<Mesh> numbering_;
  Reader reader_;
  Position_function position_;  ///< `reader_` for compiled code
  Vertex_graph graph_;
  std::vector<bool> open_border_;

  std::vector<Region_index> labels_;
  Partition_statistics statistics_;
  Region_steps steps_;
  Particles particles_;
  std::vector<Patch> patches_;
  std::vector<Posed_patch> posed_;

  std::vector<Home> homes_;  ///< per region
  std::vector<Region_extent> extents_;
  double largest_area_ = 0;  ///< A*
  double rest_compass_ = 0;  ///< `longest_compass` at the time of the partition

  std::optional<Vertex_faces> vertex_faces_;  ///< only for scattered particles
  std::vector<std::uint32_t> patch_centres_;  ///< only for scattered particles: the vertex each patch lies around
  std::size_t rings_ = 0;
};

template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
Particle_object<Mesh, Points>::Particle_object(const Mesh& mesh, Points points)
    : mesh_(&mesh),
      points_(points),
      numbering_(mesh),
      reader_(Vertex_table<Mesh>(mesh), points),
      position_([this](std::uint32_t vertex) { return reader_(vertex); }),
      graph_(vertex_graph(numbering_.vertex_count(), numbering_.corners())),
      open_border_(open_border(numbering_.vertex_count(), numbering_.corners())) {}

template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
template <class Strategy>
void Particle_object<Mesh, Points>::partition(const Strategy& strategy, std::size_t regions,
                                              const Partition_options& options, Distance_measure measure) {
  const Positions positions = measured_positions(measure);
  auto result =
      partition_numbered(Partition_input<Mesh>{*mesh_, numbering_, graph_, positions}, regions, strategy, options);
  labels_ = std::move(result.labels);
  statistics_ = result.statistics;
  steps_ = Region_steps(graph_, labels_);
  patches_ = region_patches(numbering_.corners(), labels_, result.regions);
  find_homes(result.particles);
  start_particles(std::move(result.particles), positions);
  measure_extents();
}

template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
void Particle_object<Mesh, Points>::scatter(std::size_t particles, const Senin_options& options,
                                            Distance_measure measure) {
  const Positions positions = measured_positions(measure);
  labels_.assign(numbering_.vertex_count(), 0);
  steps_ = Region_steps(graph_, labels_);
  vertex_faces_.emplace(numbering_.vertex_count(), numbering_.corners());
  auto vertices = scatter_particles(graph_, positions, particles, options);
  rings_ = options.rings > 0 ? options.rings : default_rings(numbering_.vertex_count(), vertices.size());
  patches_.assign(vertices.size(), {});
  patch_centres_.assign(vertices.size(), unreached);
  start_particles(std::move(vertices), positions);
}

template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
void Particle_object<Mesh, Points>::start_particles(std::vector<std::uint32_t> vertices, const Positions& positions) {
  particles_.at = std::move(vertices);
  read_particles();
  if (particles_.at.size() == 1) {
    // One particle has no other to measure its reach by: it feels as far as the object is wide, and may walk all of it.
    particles_.effective_radius = 2 * lodestone::bounding_sphere(positions).radius;
    particles_.hop_limit = hop_eccentricity(graph_, particles_.at.front());
  } else {
    particles_.effective_radius = effective_radius(particles_.positions);
    particles_.hop_limit = hop_diameter(graph_, particles_.at);
  }

  posed_.assign(patches_.size(), {});
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    posed_[p].patch = &patches_[p];
    posed_[p].positions.reserve(patches_[p].vertices.size());
  }
}

/// All positions. Distances are compared by their squares, which must neither overflow nor vanish.
template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
Positions Particle_object<Mesh, Points>::checked_positions() const {
  check_connectivity();
  Positions positions = read_positions(numbering_, points_);
  if (positions.cwiseAbs().maxCoeff() > 1e150) throw Bad_mesh("the mesh has a coordinate beyond 1e150");
  return positions;
}

/// All positions, with mu measured on them: whatever is wrong with them shows before anything else changes.
template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
Positions Particle_object<Mesh, Points>::measured_positions(Distance_measure measure) {
  Positions positions = checked_positions();
  const double mu = collision_distance(graph_, positions, measure);
  if (mu > 0 && mu < 1e-150) throw Bad_mesh("the edges of the mesh are shorter than 1e-150 on average");
  particles_.collision_distance = mu;
  return positions;
}

template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
void Particle_object<Mesh, Points>::check_connectivity() const {
  lodestone::check_connectivity(*mesh_, numbering_, [] { return "the mesh"; });
}

template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
void Particle_object<Mesh, Points>::read_particles() {
  check_connectivity();
  particles_.positions.resize(particles_.at.size());
  for (std::size_t p = 0; p < particles_.at.size(); ++p) {
    particles_.positions[p] = reader_(particles_.at[p]);
    if (!particles_.positions[p].allFinite())
      throw Bad_mesh("vertex " + std::to_string(particles_.at[p]) + " has a coordinate that is not finite");
  }
}

template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
const Posed_patch& Particle_object<Mesh, Points>::posed_patch(std::size_t particle, std::uint64_t frame) {
  Posed_patch& posed = posed_[particle];
  if (vertex_faces_ && patch_centres_[particle] != particles_.at[particle]) {
    patch_centres_[particle] = particles_.at[particle];
    patches_[particle] = ring_patch(graph_, *vertex_faces_, numbering_.corners(), particles_.at[particle], rings_);
    posed.frame = 0;
  }
  pose_patch(posed, reader_, frame);
  return posed;
}

template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
Eigen::Vector3d Particle_object<Mesh, Points>::normal_at(const Home& home, Region_index region) const {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const auto face : patches_[region].faces) {
    const auto& [a, b, c] = numbering_.corners()[face];
    if (a != home.vertex && b != home.vertex && c != home.vertex) continue;
    const Eigen::Vector3d origin = reader_(a);
    normal += (reader_(b) - origin).cross(reader_(c) - origin);
  }
  return normal;
}

template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
Region_extent Particle_object<Mesh, Points>::measure_extent(Region_index region) const {
  const Home& home = homes_[region];
  const Eigen::Vector3d normal = normal_at(home, region);
  // X turns with the surface: the same angle from the same edge as at the time of the partition.
  const Eigen::Vector3d needle = reader_(home.compass) - reader_(home.vertex);
  const Eigen::Vector3d x_axis =
      normal.isZero(0) ? needle : Eigen::Vector3d(Eigen::AngleAxisd(home.angle, normal.stableNormalized()) * needle);
  return region_extent(Extent_input{graph_, labels_, open_border_, position_}, home.vertex, normal, x_axis);
}

template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
void Particle_object<Mesh, Points>::find_homes(const std::vector<std::uint32_t>& vertices) {
  homes_.clear();
  for (Region_index region = 0; region < vertices.size(); ++region) {
    Home home{.vertex = vertices[region], .compass = neighbours(graph_, vertices[region]).front()};
    home.angle = angle_to_axis(normal_at(home, region), reader_(home.compass) - reader_(home.vertex));
    homes_.push_back(home);
  }
}

/// Longest of the edges by which the homes find their directions again.
template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
double Particle_object<Mesh, Points>::longest_compass() const {
  double longest = 0;
  for (const Home& home : homes_) {
    const double length = (reader_(home.compass) - reader_(home.vertex)).norm();
    if (!std::isfinite(length))
      throw Bad_mesh("vertex " + std::to_string(home.vertex) + " or a neighbour has a coordinate that is not finite");
    longest = std::max(longest, length);
  }
  return longest;
}

template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
void Particle_object<Mesh, Points>::measure_extents() {
  rest_compass_ = longest_compass();
  extents_.clear();
  largest_area_ = 0;
  for (Region_index region = 0; region < homes_.size(); ++region) {
    extents_.push_back(measure_extent(region));
    largest_area_ = std::max(largest_area_, extents_.back().area());
  }
}

template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
bool Particle_object<Mesh, Points>::has_outgrown(double growth) {
  check_connectivity();
  // A surface that only moves keeps its lengths but for rounding.
  constexpr double rounding = 1 + 1e-9;
  if (largest_area_ == 0) return std::pow(longest_compass(), 2) > growth * rounding * std::pow(rest_compass_, 2);
  const double limit = growth * rounding * largest_area_;
  for (Region_index region = 0; region < extents_.size(); ++region) {
    const double area = stretched_area(extents_[region], reader_);
    if (!std::isfinite(area))
      throw Bad_mesh("region " + std::to_string(region) + " has a coordinate that is not finite");
    if (area <= limit) continue;
    // The measured paths become the new samples, so that one that was merely no longer the shortest alarms only once.
    extents_[region] = measure_extent(region);
    if (extents_[region].area() > limit) return true;
  }
  return false;
}

}  // namespace lodestone
