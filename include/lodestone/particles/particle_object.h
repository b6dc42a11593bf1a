// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "lodestone/baselines/senin.h"
#include "lodestone/contact/region_patches.h"
#include "lodestone/particles/collision_distance.h"
#include "lodestone/particles/hop_metric.h"
#include "lodestone/particles/relaxation.h"
#include "lodestone/partition/mesh_numbering.h"
#include "lodestone/partition/particle_count.h"
#include "lodestone/partition/partition.h"
#include "lodestone/partition/region_extents.h"

namespace lodestone {

/// Reads positions by vertex number through a vertex point map.
template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
class Point_reader {
 public:
  Point_reader(Vertex_table<Mesh> table, Points points) : table_(std::move(table)), points_(std::move(points)) {}
  Eigen::Vector3d operator()(std::uint32_t vertex) const { return coordinates(get(points_, table_[vertex])); }

 private:
  Vertex_table<Mesh> table_;
  Points points_;
};

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
  /// @throws Bad_mesh  a coordinate is not finite
  template <class Strategy>
  void partition(const Strategy& strategy, std::size_t regions, const Partition_options& options,
                 Distance_measure measure);

  /// Scatters `particles` over the surface as it is now: the predecessor's start.
  void scatter(std::size_t particles, const Senin_options& options, Distance_measure measure);

  /// Reads where the particles are in this frame.
  /// @throws Bad_mesh  a coordinate is not finite
  void read_particles();

  /// Whether a region's area exceeds `growth` times the largest of the time of the partition (A*). Follows a few
  /// samples per region; a region that seems to have grown is measured anew along shortest paths before it counts.
  bool has_outgrown(double growth);

  /// The faces that a particle stands for, at their positions in frame number `frame`.
  const Posed_patch& posed_patch(std::size_t particle, std::uint64_t frame);

  Sphere bounding_sphere() const { return lodestone::bounding_sphere(read_positions(numbering_, points_)); }
  std::vector<Sphere> sphere_collection(const Particle_count_options& options) const {
    return lodestone::sphere_collection(graph_, read_positions(numbering_, points_), numbering_.corners(), options);
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
  void start_particles(std::vector<std::uint32_t> vertices, const Positions& positions, Distance_measure measure);
  /// Where a region's particle started, and an edge from there by which directions are found again.
  struct Home {
    std::uint32_t vertex = 0;
    std::uint32_t compass = 0;  ///< a neighbour of the vertex
    double angle = 0;           ///< from the edge to the X axis, around the normal
  };

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
  const Positions positions = read_positions(numbering_, points_);
  auto result =
      partition_numbered(Partition_input<Mesh>{*mesh_, numbering_, graph_, positions}, regions, strategy, options);
  labels_ = std::move(result.labels);
  statistics_ = result.statistics;
  steps_ = Region_steps(graph_, labels_);
  patches_ = region_patches(numbering_.corners(), labels_, result.regions);
  find_homes(result.particles);
  start_particles(std::move(result.particles), positions, measure);
  measure_extents();
}

template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
void Particle_object<Mesh, Points>::scatter(std::size_t particles, const Senin_options& options,
                                            Distance_measure measure) {
  const Positions positions = read_positions(numbering_, points_);
  labels_.assign(numbering_.vertex_count(), 0);
  steps_ = Region_steps(graph_, labels_);
  vertex_faces_.emplace(numbering_.vertex_count(), numbering_.corners());
  auto vertices = scatter_particles(graph_, positions, particles, options);
  rings_ = options.rings > 0 ? options.rings : default_rings(numbering_.vertex_count(), vertices.size());
  patches_.assign(vertices.size(), {});
  patch_centres_.assign(vertices.size(), unreached);
  start_particles(std::move(vertices), positions, measure);
}

template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
void Particle_object<Mesh, Points>::start_particles(std::vector<std::uint32_t> vertices, const Positions& positions,
                                                    Distance_measure measure) {
  particles_.at = std::move(vertices);
  read_particles();
  particles_.effective_radius = effective_radius(particles_.positions);
  particles_.hop_limit = hop_diameter(graph_, particles_.at);
  particles_.collision_distance = collision_distance(graph_, positions, measure);

  posed_.assign(patches_.size(), {});
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    posed_[p].patch = &patches_[p];
    posed_[p].positions.reserve(patches_[p].vertices.size());
  }
}

template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
void Particle_object<Mesh, Points>::read_particles() {
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
      normal.isZero(0) ? needle : Eigen::Vector3d(Eigen::AngleAxisd(home.angle, normal.normalized()) * needle);
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

template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
void Particle_object<Mesh, Points>::measure_extents() {
  extents_.clear();
  largest_area_ = 0;
  for (Region_index region = 0; region < homes_.size(); ++region) {
    extents_.push_back(measure_extent(region));
    largest_area_ = std::max(largest_area_, extents_.back().area());
  }
}

template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
bool Particle_object<Mesh, Points>::has_outgrown(double growth) {
  // An object whose vertices all lay on each other has grown as soon as an edge has a length.
  if (particles_.collision_distance == 0)
    return std::ranges::any_of(homes_, [&](const Home& h) { return reader_(h.vertex) != reader_(h.compass); });

  // A surface that only moves keeps its lengths but for rounding.
  const double limit = growth * largest_area_ * (1 + 1e-9);
  if (!(limit > 0)) return false;
  for (Region_index region = 0; region < extents_.size(); ++region) {
    if (stretched_area(extents_[region], reader_) <= limit) continue;
    // The measured paths become the new samples, so that one that was merely no longer the shortest alarms only once.
    extents_[region] = measure_extent(region);
    if (extents_[region].area() > limit) return true;
  }
  return false;
}

}  // namespace lodestone
