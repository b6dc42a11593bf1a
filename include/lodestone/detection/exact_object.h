// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lodestone/bounds/bounded_surface.h"
#include "lodestone/detection/kept_ray_tree.h"
#include "lodestone/detection/known_motion.h"
#include "lodestone/detection/placed_mesh.h"
#include "lodestone/detection/saved_object.h"
#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/joined_vertices.h"
#include "lodestone/tree/tree_surface.h"

namespace lodestone {

/// One object of the mode `exact` or `certified`: its mesh, where that is placed, what is known of its motion, and its
/// surface with a tree.
template <Bounding_volume Volume>
class Exact_object {
 public:
  /// Takes a mesh; its surface has no tree before `build`.
  /// @throws Bad_argument  `file_vertex` does not have one entry per vertex
  Exact_object(std::uint32_t id, std::unique_ptr<Watched_mesh> mesh, const Object_options& options)
      : particles(options.particles), mesh_(title_of(id, options), std::move(mesh), options.file_vertex) {
    surface = Basic_tree_surface<Volume>(corners());
  }

  const std::size_t particles;         ///< Object_options::particles
  Basic_tree_surface<Volume> surface;  ///< of `corners()`
  bool built = false;                  ///< whether the surface has a tree

  /// Names the object in messages.
  const std::string& title() const { return mesh_.title(); }
  /// The mesh, whatever its type.
  Watched_mesh& mesh() { return mesh_.mesh(); }
  /// The faces of the surface, with doubled vertices as one.
  std::span<const Corners> corners() const { return mesh_.corners(); }
  /// See Placed_mesh.
  Positions checked(const Eigen::Ref<const Positions>& positions, const char* when = "") const {
    return mesh_.checked(positions, when);
  }
  /// Takes positions that came through `update`; none: those of the mesh count again.
  void give(std::optional<Positions> positions) {
    refreshed_in_ = 0;
    mesh_.give(std::move(positions));
    if (std::exchange(lacks_bounds_, false)) bounded_.reset();
  }
  /// Places the object elsewhere from now on; none: where its mesh is.
  void place(const std::optional<Rigid_motion>& placement) {
    refreshed_in_ = 0;
    mesh_.place(placement);
  }
  /// Where the vertices are now.
  /// @throws Bad_mesh  the mesh has changed since it was numbered
  Coordinates read() { return mesh_.read(); }
  /// Vertices that the surface has no face at, once it is built.
  std::span<const std::uint32_t> unused() const { return unused_; }

  /// Reads the faces of the mesh anew; given positions, which may be those of other vertices, are dropped.
  /// @throws Bad_mesh, Bad_argument  the object stays as it was
  void rebuild(std::span<const std::uint32_t> file_vertex, Workers& workers) {
    auto changed = mesh_.renumber(file_vertex, workers);
    start_anew(std::move(changed), corners().size());
  }
  /// The same, reading only what has changed where the type of the mesh allows that.
  void rebuild(const Changed_faces& changed, Workers& workers) {
    const std::size_t former_faces = corners().size();
    auto listed = mesh_.renumber(changed, workers);
    start_anew(std::move(listed), former_faces);
  }

  /// Mends the tree that the surface had before its faces changed, if there is one and it has no regions. Call it
  /// before `build`, which is then needless.
  /// @param coordinates  3 V; must stay unchanged until the next refit
  /// @return false if the surface needs a new tree, or if a coordinate that faces use is not finite
  bool mend(Coordinates coordinates, const Region_tree_options& options, Workers& workers);
  /// Gives the surface a new tree; `finish` is still to be called. Reads nothing but the coordinates.
  /// @param regions      none: without regions
  /// @param coordinates  3 V, all finite; must stay unchanged until the next refit
  void build(std::optional<Numbered_partition> regions, Coordinates coordinates, const Region_tree_options& options,
             Workers& workers);
  /// Writes the regions of what has been built to the mesh.
  void finish();

  /// V: the region of each vertex, 0 where there are none. Empty before it is built.
  std::vector<Region_index> labels() const {
    if (!built) return {};
    return regions_ ? regions_->labels : std::vector<Region_index>(mesh_.mesh().vertex_count(), 0);
  }

  /// Takes the positions that it has now as those at rest, unless it has some. Once it is built.
  void keep_rest() {
    if (!surface.rest().empty()) return;
    built = false;  // without them it is not, if memory runs out
    surface.keep_rest();
    built = true;
  }

  /// The surface, which has just been refitted, prepared for many rays. Kept for later frames.
  const Ray_tree& ray_tree(Workers& workers)
    requires std::same_as<Volume, Aabb>
  {
    return ray_tree_.of(surface.view(), workers);
  }
  /// See Kept_ray_tree.
  bool pays_for(std::size_t rays) { return ray_tree_.pays_for(rays, corners().size()); }

  /// Takes note that a query begins: positions can have changed since the last one.
  void begin_query() {
    refreshed_in_ = 0;
    ray_tree_.note_moved();
    mesh_.note_query();
    if (motion_.has_another_shape(mesh())) bounded_.reset();
  }
  /// Whether positions that are held have been read, and nothing else about the object has changed since.
  /// @param hold  Position_hold::number
  bool is_refreshed(std::uint64_t hold) {
    return hold != 0 && refreshed_in_ == hold && motion_.has_the_shape_of(mesh());
  }
  /// Takes note that they have been read.
  void note_refreshed(std::uint64_t hold) { refreshed_in_ = hold; }
  /// Takes note that a query begins for which they need not be read again. O(1).
  /// @throws Bad_mesh  the mesh has changed since it was numbered
  void begin_query_of_refreshed() {
    mesh().check_connectivity(title());
    if (!mesh().in_memory() || mesh_.given() || mesh_.placement()) return;
    const Coordinates now = mesh().read();  // the same numbers, but the mesh may have moved them to other memory
    if (now.data() == surface.coordinates().data()) return;
    surface.follow(now);
    ray_tree_.note_moved();
  }

  /// The surface as one that is bounded, in mode `certified`; null: not yet.
  Bounded_surface* bounded() const { return bounded_.get(); }
  /// Whether it is posed only where it is looked at: once `make_bounds` has been called.
  bool on_demand() const { return bounded_ && bounded_->has_bounds() && !mesh_.given(); }
  /// Promises something about the motion.
  void promise(Make_bound make) {
    motion_.promise(std::move(make));
    refreshed_in_ = 0;
    bounded_.reset();
  }
  /// Whether anything has been promised.
  bool is_promised() const { return motion_.is_promised(); }
  /// Whether a promise, or computed points, await the positions at rest.
  bool awaits_rest() const { return motion_.awaits_rest(mesh_.mesh()); }
  /// Takes the positions that the mesh has now as those at rest, where they are awaited. Takes none from a mesh that
  /// cannot be read, because its faces have changed.
  void take_awaited_rest() {
    try {
      mesh().check_connectivity(title());
      if (motion_.has_another_shape(mesh())) bounded_.reset();
      motion_.take_rest(mesh_);
    } catch (const Error&) {  // a query about this object will say so
    }
  }
  /// Makes the bounds of a surface that has just been refitted. Promises that still await positions at rest take those
  /// that the mesh has now.
  /// @param compare_all  see Bounded_surface
  void make_bounds(bool compare_all, Workers& workers);

  /// Writes what was built. Only if something was.
  void save(State_writer& state) const;
  /// Takes what `save` has written for an object with the same faces. The tree has no volumes before the next refit.
  /// @param with_rest          the positions at rest are needed
  /// @throws Bad_saved_object  the object stays as it was
  void load(State_reader& state, bool with_rest);

 private:
  /// Until `finish`: a build that runs out of memory in between leaves an object that is built anew.
  void forget_tree() {
    built = false;
    refreshed_in_ = 0;
    former_.reset();
    bounded_.reset();
    ray_tree_.forget();
  }
  void list_unused() { unused_ = unused_vertices(surface.tree().all_vertices(), mesh().vertex_count()); }

  /// A surface of former faces, and which of its faces have changed since.
  struct Former {
    Basic_tree_surface<Volume> surface;
    std::vector<std::uint32_t> changed;
  };

  std::span<const Region_index> region_labels() const {
    return regions_ ? std::span<const Region_index>(regions_->labels) : std::span<const Region_index>();
  }
  void start_anew(std::vector<std::uint32_t> changed, std::size_t former_faces);
  void drop_repeated(std::vector<std::uint32_t>& changed) const;

  Placed_mesh mesh_;
  Known_motion motion_;
  std::optional<Former> former_;  ///< between a change of faces and the next build
  std::optional<Numbered_partition> regions_;
  std::vector<std::uint32_t> unused_;
  std::uint64_t refreshed_in_ = 0;  ///< the number of the hold in which positions have been read; 0: none
  std::unique_ptr<Bounded_surface> bounded_;
  bool lacks_bounds_ = false;  ///< the mesh was not finite where others were given when `bounded_` was made
  Kept_ray_tree ray_tree_;
};

template <Bounding_volume Volume>
void Exact_object<Volume>::make_bounds(bool compare_all, Workers& workers) {
  if constexpr (std::same_as<Volume, Aabb>) {
    const Coordinates now = surface.coordinates();
    // Positions that are given hide those of the mesh, which nobody has looked at.
    const bool is_known = !mesh_.given() || surface.tree().finite(mesh().read());
    auto bounds = is_known ? motion_.bounds(mesh_, surface.tree(), region_labels())
                           : std::vector<std::unique_ptr<Node_bound>>();
    auto made = std::make_unique<Bounded_surface>(surface, positions_of(mesh_), std::move(bounds), workers, title());
    made->compare_all(compare_all);
    surface.follow(now);
    made->take_refitted();
    bounded_ = std::move(made);
    lacks_bounds_ = !is_known;
    if (on_demand()) bounded_->compare_refitted();
  }
}

/// The surface of the faces as they are now has no tree yet; that of the former ones waits to be mended. If memory runs
/// out it does not wait: a new tree is built.
/// @param changed       faces of `corners()`; those from `former_faces` on need not be listed
template <Bounding_volume Volume>
void Exact_object<Volume>::start_anew(std::vector<std::uint32_t> changed, std::size_t former_faces) {
  if (std::exchange(built, false)) former_ = Former{std::move(surface), {}};
  bounded_.reset();
  ray_tree_.forget();
  motion_.forget_rest();
  surface = Basic_tree_surface<Volume>(corners());
  give({});
  auto former = std::exchange(former_, std::nullopt);
  if (!former) return;
  std::erase_if(former->changed, [&](std::uint32_t face) { return face >= corners().size(); });
  former->changed.insert(former->changed.end(), changed.begin(), changed.end());
  for (std::size_t face = former_faces; face < corners().size(); ++face)
    former->changed.push_back(static_cast<std::uint32_t>(face));
  drop_repeated(former->changed);
  former_ = std::move(former);
}

/// Drops repeated faces from a list that is longer than all faces together. So its length stays bounded, however often
/// an object is rebuilt before the next query.
template <Bounding_volume Volume>
void Exact_object<Volume>::drop_repeated(std::vector<std::uint32_t>& changed) const {
  if (changed.size() <= corners().size()) return;
  std::ranges::sort(changed);
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
}

template <Bounding_volume Volume>
bool Exact_object<Volume>::mend(Coordinates coordinates, const Region_tree_options& options, Workers& workers) {
  auto former = std::exchange(former_, std::nullopt);
  if (!former || regions_) return false;
  if (!surface.mend(std::move(former->surface), former->changed, coordinates, options, workers)) return false;
  list_unused();
  finish();
  return true;
}

template <Bounding_volume Volume>
void Exact_object<Volume>::build(std::optional<Numbered_partition> regions, Coordinates coordinates,
                                 const Region_tree_options& options, Workers& workers) {
  forget_tree();
  surface.build(regions ? std::span<const Region_index>(regions->labels) : std::span<const Region_index>(), coordinates,
                options, workers);
  regions_ = std::move(regions);
  list_unused();
}

/// Without regions all vertices are marked as one.
template <Bounding_volume Volume>
void Exact_object<Volume>::finish() {
  if (mesh().has_maps()) {
    if (regions_)
      mesh().write_maps(regions_->labels, regions_->particles);
    else
      mesh().write_maps(std::vector<Region_index>(mesh().vertex_count(), 0), {});
  }
  built = true;
}

template <Bounding_volume Volume>
void Exact_object<Volume>::save(State_writer& state) const {
  save_regions(regions_, state);
  surface.save(state);
}

template <Bounding_volume Volume>
void Exact_object<Volume>::load(State_reader& state, bool with_rest) {
  auto regions = load_regions(state, mesh().vertex_count());
  Basic_tree_surface<Volume> loaded(corners());
  loaded.load(state, mesh().vertex_count());
  state.end();
  if (with_rest && loaded.rest().empty())
    throw Bad_saved_object("the object was saved without positions at rest, which a tolerance within one object needs");
  // From here on nothing can fail but for want of memory. Then the object is built anew.
  forget_tree();
  surface = std::move(loaded);
  regions_ = std::move(regions);
  list_unused();
  finish();
}

}  // namespace lodestone
