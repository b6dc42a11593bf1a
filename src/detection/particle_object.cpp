// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/particle_object.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "lodestone/mesh/check_finite.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {

Particle_object::Particle_object(std::unique_ptr<Watched_mesh> mesh) : mesh_(std::move(mesh)) {}

void Particle_object::find_edges() {
  if (num_vertices(edges_.graph) < mesh_->vertex_count()) walk_along(std::nullopt);
}

void Particle_object::close_seams(const Positions& positions) {
  if (!mesh_->divides_by_index()) return;
  // A call that was followed by a failure, perhaps of another object, is repeated when positions may be others.
  if (seams_) walk_along(std::nullopt);
  if (auto seams = lodestone::close_seams(corners(), edges_.open_border, positions)) walk_along(std::move(seams));
}

/// What walks along the surface does so with these seams closed from now on.
void Particle_object::walk_along(std::optional<Closed_seams> seams) {
  std::vector<Corners> joined;
  if (seams) {
    joined.reserve(corners().size());
    for (const auto& [a, b, c] : corners()) joined.push_back({seams->joined(a), seams->joined(b), seams->joined(c)});
  }
  const std::span<const Corners> walked = seams ? std::span<const Corners>(joined) : corners();
  Vertex_faces vertex_faces(mesh_->vertex_count(), walked);
  Surface_edges edges = surface_edges(vertex_faces, walked);
  // From here on nothing can fail.
  vertex_faces_ = std::move(vertex_faces);
  edges_ = std::move(edges);
  joined_corners_ = std::move(joined);
  seams_ = std::move(seams);
}

/// The faces as what walks along the surface sees them.
std::span<const Corners> Particle_object::walked_corners() const { return seams_ ? joined_corners_ : corners(); }

/// With closed seams, the surface without the vertices that were joined to others is divided.
Numbered_partition Particle_object::divide(const Positions& positions, std::size_t regions,
                                           const Partition_options& options) const {
  if (!seams_) return mesh_->partition({edges_.graph, positions, corners()}, regions, options);
  const auto& vertices = seams_->vertices;
  const Positions joined_positions = positions(vertices, Eigen::all);
  const Vertex_graph joined_graph = vertex_graph(static_cast<std::uint32_t>(vertices.size()), seams_->corners);
  const Numbered_surface joined{joined_graph, joined_positions, seams_->corners, vertices, mesh_->vertex_count()};
  auto result = mesh_->partition(joined, regions, options);
  std::vector<Region_index> labels;
  labels.reserve(seams_->index.size());
  for (const auto vertex : seams_->index) labels.push_back(result.labels[vertex]);
  result.labels = std::move(labels);
  for (auto& particle : result.particles) particle = vertices[particle];
  return result;
}

void Particle_object::take_division(Numbered_partition division, const Positions& positions, Workers& workers) {
  labels_ = std::move(division.labels);
  steps_ = Region_steps(edges_.graph, labels_);
  patches_.clear();
  posed_.clear();
  const Live_positions at(positions.data());
  find_homes(division.particles, at);
  start_particles(std::move(division.particles), positions);
  measure_extents(at, workers);
}

void Particle_object::scatter(const Positions& positions, std::size_t particles, const Senin_options& options) {
  labels_.assign(mesh_->vertex_count(), 0);
  steps_ = Region_steps(edges_.graph, labels_);
  auto vertices = scatter_particles(edges_.graph, positions, particles, options);
  const std::size_t rings =
      options.rings > 0 ? options.rings : default_rings(mesh_->vertex_count() - joined_vertices(), vertices.size());
  start_particles(std::move(vertices), positions);
  start_patches(rings);
}

/// The faces around scattered particles are found when they are needed.
void Particle_object::start_patches(std::size_t rings) {
  rings_ = rings;
  patches_.assign(particles_.at.size(), {});
  patch_centres_.assign(particles_.at.size(), unreached);
  make_poses();
}

void Particle_object::start_particles(std::vector<std::uint32_t> vertices, const Positions& positions) {
  particles_.at = std::move(vertices);
  particles_.positions.clear();
  for (const auto vertex : particles_.at) particles_.positions.emplace_back(positions.row(vertex));
  if (particles_.at.size() == 1) {
    // One particle has no other to measure its reach by: it feels as far as the object is wide, and may walk all of it.
    particles_.effective_radius = 2 * bounding_sphere(positions, corners()).radius;
  } else {
    particles_.effective_radius = effective_radius(particles_.positions);
  }
  particles_.hop_limit = hop_reach(edges_.graph, particles_.at);
}

/// Makes room for the positions of all patches.
void Particle_object::make_poses() {
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

Positions Particle_object::read_positions() {
  look();
  const auto vertices = static_cast<Eigen::Index>(mesh_->vertex_count());
  Positions positions = Eigen::Map<const Positions>(mesh_->read().data(), vertices, 3);
  if (placement_)
    for (Eigen::Index v = 0; v < vertices; ++v) positions.row(v) = (*placement_)(positions.row(v));
  // Distances are compared by their squares, which must neither overflow nor vanish. The comparison also refuses NaN.
  if (positions.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= 1e150) return positions;
  for (std::uint32_t v = 0; v < mesh_->vertex_count(); ++v)
    if (!positions.row(v).allFinite()) fail_not_finite(v);
  throw Bad_mesh("the mesh has a coordinate beyond 1e150");
}

void Particle_object::measure_distance(const Positions& positions, Distance_measure measure) {
  const double mu = collision_distance(edges_.graph, positions, measure);
  if (mu > 0 && mu < 1e-150) throw Bad_mesh("the edges of the mesh are shorter than 1e-150 on average");
  particles_.collision_distance = mu;
}

void Particle_object::read_particles() {
  look();
  particles_.positions.resize(particles_.at.size());
  for (std::size_t p = 0; p < particles_.at.size(); ++p) {
    particles_.positions[p] = read_(particles_.at[p]);
    if (!particles_.positions[p].allFinite()) fail_not_finite(particles_.at[p]);
  }
}

void Particle_object::prepare_patches() {
  patches_ = region_patches(corners(), labels_, particles_.at.size());
  make_poses();
}

void Particle_object::prepare_meetings(const Positions& positions, const Region_tree_options& options,
                                       Workers& workers) {
  const Coordinates coordinates(positions.data(), static_cast<std::size_t>(positions.size()));
  tree_ = Tree_on_demand(corners(), labels_, coordinates, options, workers);
  neighbours_ = Leaf_neighbours(tree_.layout(), corners().size());
  tree_.start_frame(Live_positions(positions.data()));  // as they were read: other threads may be reading the mesh
  region_anchors_ = Region_anchors(tree_, corners(), labels_, coordinates);
  tree_.start_frame(read_);
  last_stretch_ = 1;
}

Leaf_neighbours& Particle_object::leaf_neighbours() {
  neighbours_.look_at(tree_.layout(), walked_corners(), vertex_faces_);
  return neighbours_;
}

void Particle_object::start_frame() {
  look();
  tree_.start_frame(read_);
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
    posed.frame = 0;
    patches_[particle] = ring_patch(edges_.graph, vertex_faces_, corners(), particles_.at[particle], rings_);
    patch_centres_[particle] = particles_.at[particle];
  }
  pose_patch(posed, read_, frame);
  return posed;
}

Eigen::Vector3d Particle_object::normal_at(const Home& home, const Live_positions& at) const {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const auto face : vertex_faces_.at(home.vertex)) {
    const auto& [a, b, c] = walked_corners()[face];
    const Eigen::Vector3d origin = at(a);
    normal += (at(b) - origin).cross(at(c) - origin);
  }
  return normal;
}

Extent_start Particle_object::extent_start(const Home& home, const Live_positions& at) const {
  const Eigen::Vector3d normal = normal_at(home, at);
  // X turns with the surface: the same angle from the same edge as at the time of the partition.
  const Eigen::Vector3d needle = at(home.compass) - at(home.vertex);
  const Eigen::Vector3d x_axis =
      normal.isZero(0) ? needle : Eigen::Vector3d(Eigen::AngleAxisd(home.angle, normal.stableNormalized()) * needle);
  return {.home = home.vertex, .normal = normal, .x_axis = x_axis};
}

std::vector<Region_extent> Particle_object::extents_of(std::span<const Home> homes, const Live_positions& at,
                                                       Workers& workers) const {
  std::vector<Extent_start> starts;
  for (const Home& home : homes) starts.push_back(extent_start(home, at));
  return region_extents({edges_.graph, labels_, edges_.open_border, at}, starts, workers);
}

void Particle_object::find_homes(const std::vector<std::uint32_t>& vertices, const Live_positions& at) {
  homes_.clear();
  for (const auto vertex : vertices) {
    const auto around = neighbours(edges_.graph, vertex);
    // Without an edge, where all faces are points, there is no direction to keep.
    Home home{.vertex = vertex, .compass = around.empty() ? vertex : around.front()};
    home.angle = angle_to_axis(normal_at(home, at), at(home.compass) - at(home.vertex));
    homes_.push_back(home);
  }
}

/// Longest of the edges by which the homes find their directions again.
double Particle_object::longest_compass(const Live_positions& at) const {
  double longest = 0;
  for (const Home& home : homes_) {
    const double length = (at(home.compass) - at(home.vertex)).norm();
    if (!std::isfinite(length))
      throw Bad_mesh("vertex " + std::to_string(home.vertex) + " or a neighbour has a coordinate that is not finite");
    longest = std::max(longest, length);
  }
  return longest;
}

void Particle_object::measure_extents(const Live_positions& at, Workers& workers) {
  rest_compass_ = longest_compass(at);
  extents_ = extents_of(homes_, at, workers);
  largest_area_ = 0;
  for (const auto& extent : extents_) largest_area_ = std::max(largest_area_, extent.area());
}

bool Particle_object::seemed_larger(double growth) const {
  return std::pow(last_stretch_, 2) > std::max(growth, 1.02);
}

bool Particle_object::has_outgrown(double growth, std::size_t most_regions) {
  look();
  // A surface that only moves keeps its lengths but for rounding.
  constexpr double rounding = 1 + 1e-9;
  if (largest_area_ == 0) return std::pow(longest_compass(read_), 2) > growth * rounding * std::pow(rest_compass_, 2);
  const double limit = growth * rounding * largest_area_;
  Region_index region = last_checked_;
  bool outgrown = false;
  for (std::size_t checked = 0; checked < std::min(most_regions, extents_.size()) && !outgrown; ++checked) {
    region = region + 1 < extents_.size() ? region + 1 : 0;
    const double area = stretched_area(extents_[region], read_);
    if (!std::isfinite(area))
      throw Bad_mesh("region " + std::to_string(region) + " has a coordinate that is not finite");
    if (area <= limit) continue;
    // The measured paths become the new samples, so that one that was merely no longer the shortest alarms only once.
    extents_[region] = std::move(extents_of({&homes_[region], 1}, read_).front());
    outgrown = extents_[region].area() > limit;
  }
  last_checked_ = region;  // not before: a call that fails is repeated from where it began
  return outgrown;
}

}  // namespace lodestone
