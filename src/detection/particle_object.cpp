// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/particle_object.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

[[noreturn]] void fail_not_finite(std::uint32_t vertex) {
  throw Bad_mesh("vertex " + std::to_string(vertex) + " has a coordinate that is not finite");
}

}  // namespace

Particle_object::Particle_object(std::unique_ptr<Watched_mesh> mesh)
    : mesh_(std::move(mesh)),
      position_([this](std::uint32_t vertex) { return read_(vertex); }),
      graph_(vertex_graph(mesh_->vertex_count(), corners())),
      open_border_(open_border(mesh_->vertex_count(), corners())) {}

void Particle_object::close_seams() {
  if (!mesh_->divides_by_index()) return;
  // A call that was followed by a failure, perhaps of another object, is repeated when positions may be others.
  if (seams_) {
    graph_ = vertex_graph(mesh_->vertex_count(), corners());
    open_border_ = open_border(mesh_->vertex_count(), corners());
    seams_.reset();
  }
  auto seams = lodestone::close_seams(corners(), open_border_, checked_positions());
  if (!seams) return;
  std::vector<Corners> joined;
  joined.reserve(corners().size());
  for (const auto& [a, b, c] : corners()) joined.push_back({seams->joined(a), seams->joined(b), seams->joined(c)});
  auto graph = vertex_graph(mesh_->vertex_count(), joined);
  auto border = open_border(mesh_->vertex_count(), joined);
  // From here on nothing can fail.
  graph_ = std::move(graph);
  open_border_ = std::move(border);
  joined_corners_ = std::move(joined);
  seams_ = std::move(seams);
}

/// The faces as what walks along the surface sees them.
std::span<const Corners> Particle_object::walked_corners() const { return seams_ ? joined_corners_ : corners(); }

/// With closed seams, the surface without the vertices that were joined to others is divided.
Numbered_partition Particle_object::divide(const Positions& positions, std::size_t regions,
                                           const Partition_options& options) const {
  if (!seams_) return mesh_->partition({graph_, positions, corners()}, regions, options);
  const auto& vertices = seams_->vertices;
  const Positions joined_positions = positions(vertices, Eigen::all);
  const Vertex_graph joined_graph = vertex_graph(static_cast<std::uint32_t>(vertices.size()), seams_->corners);
  auto result = mesh_->partition({joined_graph, joined_positions, seams_->corners}, regions, options);
  std::vector<Region_index> labels;
  labels.reserve(seams_->index.size());
  for (const auto vertex : seams_->index) labels.push_back(result.labels[vertex]);
  result.labels = std::move(labels);
  for (auto& particle : result.particles) particle = vertices[particle];
  return result;
}

void Particle_object::partition(std::size_t regions, const Partition_options& options, Distance_measure measure) {
  const Positions positions = measured_positions(measure);
  auto result = divide(positions, regions, options);
  labels_ = std::move(result.labels);
  statistics_ = result.statistics;
  steps_ = Region_steps(graph_, labels_);
  patches_ = region_patches(corners(), labels_, result.regions);
  find_homes(result.particles);
  start_particles(std::move(result.particles), positions);
  measure_extents();
}

void Particle_object::scatter(std::size_t particles, const Senin_options& options, Distance_measure measure) {
  const Positions positions = measured_positions(measure);
  labels_.assign(mesh_->vertex_count(), 0);
  steps_ = Region_steps(graph_, labels_);
  vertex_faces_.emplace(mesh_->vertex_count(), walked_corners());
  auto vertices = scatter_particles(graph_, positions, particles, options);
  rings_ =
      options.rings > 0 ? options.rings : default_rings(mesh_->vertex_count() - joined_vertices(), vertices.size());
  patches_.assign(vertices.size(), {});
  patch_centres_.assign(vertices.size(), unreached);
  start_particles(std::move(vertices), positions);
}

void Particle_object::start_particles(std::vector<std::uint32_t> vertices, const Positions& positions) {
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

/// Checks that the mesh is the one that was numbered, and finds where its positions are now.
void Particle_object::look() {
  mesh_->check_connectivity("the mesh");
  read_ = mesh_->in_memory() ? Live_positions(mesh_->read().data(), placement_)
                             : Live_positions(
                                   mesh_.get(),
                                   [](const void* mesh, std::uint32_t vertex) {
                                     return static_cast<const Watched_mesh*>(mesh)->read(vertex);
                                   },
                                   placement_);
}

/// All positions. Distances are compared by their squares, which must neither overflow nor vanish.
Positions Particle_object::checked_positions() {
  look();
  Positions positions(mesh_->vertex_count(), 3);
  for (std::uint32_t v = 0; v < mesh_->vertex_count(); ++v) {
    positions.row(v) = read_(v);
    if (!positions.row(v).allFinite()) fail_not_finite(v);
  }
  if (positions.cwiseAbs().maxCoeff() > 1e150) throw Bad_mesh("the mesh has a coordinate beyond 1e150");
  return positions;
}

/// All positions, with mu measured on them: whatever is wrong with them shows before anything else changes.
Positions Particle_object::measured_positions(Distance_measure measure) {
  Positions positions = checked_positions();
  const double mu = collision_distance(graph_, positions, measure);
  if (mu > 0 && mu < 1e-150) throw Bad_mesh("the edges of the mesh are shorter than 1e-150 on average");
  particles_.collision_distance = mu;
  return positions;
}

void Particle_object::read_particles() {
  look();
  particles_.positions.resize(particles_.at.size());
  for (std::size_t p = 0; p < particles_.at.size(); ++p) {
    particles_.positions[p] = read_(particles_.at[p]);
    if (!particles_.positions[p].allFinite()) fail_not_finite(particles_.at[p]);
  }
}

void Particle_object::prepare_meetings(const Region_tree_options& options) {
  const Positions positions = checked_positions();
  const Coordinates coordinates(positions.data(), static_cast<std::size_t>(positions.size()));
  if (!vertex_faces_) vertex_faces_.emplace(mesh_->vertex_count(), walked_corners());
  tree_ = Tree_on_demand(corners(), labels_, coordinates, options);
  tree_.start_frame(read_);
  regions_ = Region_anchors(tree_, corners(), labels_, coordinates);
}

void Particle_object::read_regions(double reach) {
  look();
  tree_.start_frame(read_);
  regions_.read(tree_, reach);
}

bool Particle_object::move_particle(std::uint32_t vertex) {
  const Region_index region = labels_[vertex];
  if (std::exchange(particles_.at[region], vertex) == vertex) return false;
  particles_.positions[region] = read_(vertex);
  return true;
}

const Posed_patch& Particle_object::posed_patch(std::size_t particle, std::uint64_t frame) {
  Posed_patch& posed = posed_[particle];
  if (!patch_centres_.empty() && patch_centres_[particle] != particles_.at[particle]) {
    patch_centres_[particle] = particles_.at[particle];
    patches_[particle] = ring_patch(graph_, *vertex_faces_, corners(), particles_.at[particle], rings_);
    posed.frame = 0;
  }
  pose_patch(posed, read_, frame);
  return posed;
}

Eigen::Vector3d Particle_object::normal_at(const Home& home, Region_index region) const {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const auto face : patches_[region].faces) {
    const auto& [a, b, c] = walked_corners()[face];
    if (a != home.vertex && b != home.vertex && c != home.vertex) continue;
    const Eigen::Vector3d origin = read_(a);
    normal += (read_(b) - origin).cross(read_(c) - origin);
  }
  return normal;
}

Region_extent Particle_object::measure_extent(Region_index region) const {
  const Home& home = homes_[region];
  const Eigen::Vector3d normal = normal_at(home, region);
  // X turns with the surface: the same angle from the same edge as at the time of the partition.
  const Eigen::Vector3d needle = read_(home.compass) - read_(home.vertex);
  const Eigen::Vector3d x_axis =
      normal.isZero(0) ? needle : Eigen::Vector3d(Eigen::AngleAxisd(home.angle, normal.stableNormalized()) * needle);
  return region_extent(Extent_input{graph_, labels_, open_border_, position_}, home.vertex, normal, x_axis);
}

void Particle_object::find_homes(const std::vector<std::uint32_t>& vertices) {
  homes_.clear();
  for (Region_index region = 0; region < vertices.size(); ++region) {
    Home home{.vertex = vertices[region], .compass = neighbours(graph_, vertices[region]).front()};
    home.angle = angle_to_axis(normal_at(home, region), read_(home.compass) - read_(home.vertex));
    homes_.push_back(home);
  }
}

/// Longest of the edges by which the homes find their directions again.
double Particle_object::longest_compass() const {
  double longest = 0;
  for (const Home& home : homes_) {
    const double length = (read_(home.compass) - read_(home.vertex)).norm();
    if (!std::isfinite(length))
      throw Bad_mesh("vertex " + std::to_string(home.vertex) + " or a neighbour has a coordinate that is not finite");
    longest = std::max(longest, length);
  }
  return longest;
}

void Particle_object::measure_extents() {
  rest_compass_ = longest_compass();
  extents_.clear();
  largest_area_ = 0;
  for (Region_index region = 0; region < homes_.size(); ++region) {
    extents_.push_back(measure_extent(region));
    largest_area_ = std::max(largest_area_, extents_.back().area());
  }
}

bool Particle_object::seemed_larger(double growth) const {
  return std::pow(tree_.stretch(), 2) > std::max(growth, 1.02);
}

bool Particle_object::has_outgrown(double growth, std::size_t most_regions) {
  look();
  // A surface that only moves keeps its lengths but for rounding.
  constexpr double rounding = 1 + 1e-9;
  if (largest_area_ == 0) return std::pow(longest_compass(), 2) > growth * rounding * std::pow(rest_compass_, 2);
  const double limit = growth * rounding * largest_area_;
  for (std::size_t checked = 0; checked < std::min(most_regions, extents_.size()); ++checked) {
    last_checked_ = last_checked_ + 1 < extents_.size() ? last_checked_ + 1 : 0;
    const Region_index region = last_checked_;
    const double area = stretched_area(extents_[region], read_);
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
