// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "lodestone/detection/watched_mesh.h"
#include "lodestone/mesh/live_positions.h"
#include "lodestone/mesh/patch.h"
#include "lodestone/mesh/seams.h"
#include "lodestone/particles/collision_distance.h"
#include "lodestone/particles/hop_metric.h"
#include "lodestone/particles/relaxation.h"
#include "lodestone/particles/senin.h"
#include "lodestone/particles/walked_surface.h"
#include "lodestone/partition/particle_count.h"
#include "lodestone/partition/region_extents.h"
#include "lodestone/tree/leaf_neighbours.h"
#include "lodestone/tree/region_anchors.h"

namespace lodestone {

/// One object of a scene as the particle method keeps it from frame to frame: its surface by number, its regions, its
/// particles, and how large its regions may grow.
class Particle_object {
 public:
  /// Takes a mesh. O(1).
  explicit Particle_object(std::unique_ptr<Watched_mesh> mesh);

  /// Places the object elsewhere from now on; none: where its mesh is.
  void place(const std::optional<Rigid_motion>& placement) { placement_ = placement; }

  /// Finds the edges, along which all that follows walks, unless that is done. O(V + F).
  void find_edges();
  /// Reads all positions. O(V).
  /// @throws Bad_mesh  a coordinate is not finite or beyond 1e150, or the number of vertices or faces has changed
  Positions read_positions();

  // What follows is done with all positions as they are now, from `read_positions`.

  /// Closes the seams of the surface, for all that walks along it: partition, particles, paths. Does nothing for a
  /// strategy that needs the mesh itself. Before the first partition.
  void close_seams(const Positions& positions);
  /// Number of vertices that were joined to another one.
  std::size_t joined_vertices() const { return seams_ ? seams_->joined_count() : 0; }

  /// Measures mu, the distance at which particles collide. First of all: whatever is wrong with the edges shows here.
  /// @throws Bad_mesh  edges are shorter than 1e-150 on average
  void measure_distance(const Positions& positions, Distance_measure measure);
  /// Divides the surface into `regions` regions, by the strategy, which is the caller's. O(V) and more.
  Numbered_partition divide(const Positions& positions, std::size_t regions, const Partition_options& options) const;
  /// Takes a division, and puts a particle in each of its regions. O(V).
  void take_division(Numbered_partition division, const Positions& positions, Workers& workers = Workers::alone());
  /// Lists the faces of each region, for `posed_patch`. After `take_division`. O(V + F).
  void prepare_patches();
  /// Builds what meetings need: the tree below the regions. After `take_division`. O(F log F).
  void prepare_meetings(const Positions& positions, const Region_tree_options& options,
                        Workers& workers = Workers::alone());

  /// Scatters `particles` over the surface: the predecessor's start, in place of `divide` and `take_division`.
  void scatter(const Positions& positions, std::size_t particles, const Senin_options& options);

  /// Writes what was built. Only if something was.
  void save(State_writer& state) const;
  /// What was built, besides the particles themselves.
  struct Built {
    bool regions;   ///< the particles have regions of their own: they are not scattered
    bool meetings;  ///< there is what meetings need
  };
  /// Takes what `save` has written for an object with the same faces in the same mode.
  /// @param built              what that mode builds
  /// @throws Bad_saved_object  the object stays as it was
  void load(State_reader& state, Built built);

  /// Opens seams that are closed.
  void open_seams() {
    if (seams_) walk_along(std::nullopt);
  }
  /// Spheres around the parts of the surface: see `lodestone::sphere_collection`.
  std::vector<Sphere> sphere_collection(const Positions& positions, const Particle_count_options& options) const {
    return lodestone::sphere_collection(edges_.graph, positions, walked_corners(), options);
  }

  /// Reads where the particles are in this frame.
  /// @throws Bad_mesh  a coordinate is not finite, or the number of vertices or faces has changed
  void read_particles();

  /// Starts a frame: looks where the positions are, but reads none of them. After `prepare_meetings`.
  /// @throws Bad_mesh  the number of vertices or faces has changed
  void start_frame();
  /// Reads where the object is in this frame, after `start_frame`, and its regions if it is large. See Region_anchors.
  /// @throws Bad_mesh  a coordinate is not finite
  void find(double reach) { region_anchors_.find(tree_, reach); }
  /// Reads the regions also if it is small, after `find`.
  void find_regions(double reach) { region_anchors_.find_regions(tree_, reach); }
  /// Where the regions are, as of the last `find` and `find_regions`.
  const Region_anchors& region_anchors() const { return region_anchors_; }
  /// The surface, for particles that may walk anywhere, after `prepare_meetings`.
  Walked_surface walked_surface() const { return {&edges_.graph, &vertex_faces_, walked_corners(), corners(), &read_}; }
  /// The tree below the regions, after `prepare_meetings`.
  Tree_on_demand& tree() { return tree_; }
  /// The leaves beside each face, for contacts that are followed, after `prepare_meetings`.
  Leaf_neighbours& leaf_neighbours();

  /// Moves the particle of a vertex's region to that vertex.
  /// @return whether it was elsewhere
  bool move_particle(std::uint32_t vertex);

  /// Whether a region's area exceeds `growth` times the largest of the time of the partition (A*). Follows a few
  /// samples per region; a region that seems to have grown is measured anew along shortest paths before it counts.
  /// @param most_regions  so many regions are looked at, from where the last call ended
  bool has_outgrown(double growth, std::size_t most_regions = std::numeric_limits<std::size_t>::max());
  /// The last region that `has_outgrown` has looked at.
  Region_index last_checked() const { return last_checked_; }
  /// The next call looks at the region after this one first.
  void check_after(Region_index region) { last_checked_ = region; }
  /// Keeps for `seemed_larger` how far the surface is stretched in this frame. For frames that do not fail.
  void keep_stretch() { last_stretch_ = tree_.stretch(); }
  /// Whether the anchors of the regions had spread by more than the growth limit in the last frame, if they were read
  /// in it. After `prepare_meetings`.
  bool seemed_larger(double growth) const;

  /// The faces that a particle stands for, at their positions in frame number `frame`. After `prepare_patches` or
  /// `scatter`.
  const Posed_patch& posed_patch(std::size_t particle, std::uint64_t frame);
  /// Whether `posed_patch` has read their positions in this frame.
  bool is_posed(std::size_t particle, std::uint64_t frame) const { return posed_[particle].frame == frame; }

  /// The mesh, whatever its type.
  Watched_mesh& mesh() { return *mesh_; }
  /// The same, not to be changed.
  const Watched_mesh& mesh() const { return *mesh_; }
  /// Where the object is placed; none: where its mesh is.
  const std::optional<Rigid_motion>& placement() const { return placement_; }
  /// The faces of the mesh, F.
  std::span<const Corners> corners() const { return mesh_->corners(); }
  /// Where its vertices are, as of the last call that looked at the mesh: `start_frame`, `read_particles`,
  /// `read_positions` or `has_outgrown`.
  const Live_positions& positions() const { return read_; }
  /// Where a particle can step.
  const Region_steps& steps() const { return steps_; }
  /// V: region of each vertex; 0 everywhere for scattered particles.
  const std::vector<Region_index>& labels() const { return labels_; }
  /// Per particle: the faces that it stands for. After `prepare_patches` or `scatter`.
  const std::vector<Patch>& patches() const { return patches_; }
  /// A*, the largest area of a region when it was made; in squared units of the coordinates.
  double largest_area() const { return largest_area_; }
  /// The particles of this frame.
  Particles& particles() { return particles_; }
  /// The same, not to be changed.
  const Particles& particles() const { return particles_; }

 private:
  std::span<const Corners> walked_corners() const;
  void walk_along(std::optional<Closed_seams> seams);
  void look();
  void start_patches(std::size_t rings);
  void make_poses();
  void start_particles(std::vector<std::uint32_t> vertices, const Positions& positions);
  /// Where a region's particle started, and an edge from there by which directions are found again.
  struct Home {
    std::uint32_t vertex = 0;
    std::uint32_t compass = 0;  ///< a neighbour of the vertex
    double angle = 0;           ///< from the edge to the X axis, around the normal
  };
  struct Saved;

  double longest_compass(const Live_positions& at) const;
  void find_homes(const std::vector<std::uint32_t>& vertices, const Live_positions& at);
  void measure_extents(const Live_positions& at, Workers& workers);
  Eigen::Vector3d normal_at(const Home& home, const Live_positions& at) const;
  Extent_start extent_start(const Home& home, const Live_positions& at) const;
  std::vector<Region_extent> extents_of(std::span<const Home> homes, const Live_positions& at,
                                        Workers& workers = Workers::alone()) const;

  std::unique_ptr<Watched_mesh> mesh_;
  std::optional<Rigid_motion> placement_;
  Live_positions read_;  ///< of the last `look`
  std::optional<Closed_seams> seams_;
  std::vector<Corners> joined_corners_;  ///< F, if seams are closed: vertices of the mesh, the joined ones for all
  Vertex_faces vertex_faces_;            ///< of `walked_corners()`, like everything else that is walked along
  Surface_edges edges_;

  std::vector<Region_index> labels_;
  Region_steps steps_;
  Particles particles_;
  std::vector<Patch> patches_;
  std::vector<Posed_patch> posed_;

  std::vector<Home> homes_;  ///< per region
  std::vector<Region_extent> extents_;
  Region_index last_checked_ = 0;  ///< the last region whose growth was looked at
  double last_stretch_ = 1;        ///< of the whole object in the last frame that did not fail
  double largest_area_ = 0;        ///< A*
  double rest_compass_ = 0;        ///< `longest_compass` at the time of the partition

  // Only for meetings.
  Tree_on_demand tree_;
  Leaf_neighbours neighbours_;
  Region_anchors region_anchors_;

  std::vector<std::uint32_t> patch_centres_;  ///< only for scattered particles: the vertex each patch lies around
  std::size_t rings_ = 0;
};

}  // namespace lodestone
