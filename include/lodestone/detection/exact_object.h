// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lodestone/bounds/bounded_surface.h"
#include "lodestone/bounds/placed_bound.h"
#include "lodestone/detection/detector_options.h"
#include "lodestone/detection/kept_ray_tree.h"
#include "lodestone/detection/saved_object.h"
#include "lodestone/detection/watched_mesh.h"
#include "lodestone/mesh/check_finite.h"
#include "lodestone/mesh/joined_vertices.h"
#include "lodestone/mesh/rigid_motion.h"
#include "lodestone/tree/tree_surface.h"

namespace lodestone {

/// The faces whose corners differ, ascending, with those that only `now` has. O(F).
std::vector<std::uint32_t> changed_faces(std::span<const Corners> former, std::span<const Corners> now);

/// Makes the bound of a promise.
using Make_bound = std::function<std::unique_ptr<Node_bound>(const Bounded_object&)>;

/// One object of the mode `exact` or `certified`: its mesh, where that is placed, and its surface.
template <Bounding_volume Volume>
class Exact_object {
 public:
  /// Takes a mesh; its surface has no tree before `build`.
  /// @throws Bad_argument  `file_vertex` does not have one entry per vertex
  Exact_object(std::uint32_t id, std::unique_ptr<Watched_mesh> mesh, const Object_options& options)
      : title(title_of(id, options)), particles(options.particles), faces_(std::move(mesh), options.file_vertex) {
    surface = Basic_tree_surface<Volume>(corners());
  }

  const std::string title;             ///< names the object in messages
  const std::size_t particles;         ///< Object_options::particles
  Basic_tree_surface<Volume> surface;  ///< of `corners()`
  bool built = false;                  ///< whether the surface has a tree

  /// A copy of positions that were given for its vertices.
  /// @param when  which ones they are, for messages: empty, or such as " at the end"
  /// @throws Bad_mesh  another number of rows, a coordinate that is not finite
  Positions checked(const Eigen::Ref<const Positions>& positions, const char* when = "");
  /// Takes positions that came through `update`; none: those of the mesh count again.
  void give(std::optional<Positions> positions) {
    refreshed_in_ = 0;
    if (given_ || positions) ++changes_;
    given_ = std::move(positions);
    if (std::exchange(lacks_bounds_, false)) bounded_.reset();
  }
  /// Places the object elsewhere from now on; none: where its mesh is.
  void place(const std::optional<Rigid_motion>& placement) {
    placement_ = placement;
    refreshed_in_ = 0;
    ++changes_;
  }

  /// The mesh, whatever its type.
  Watched_mesh& mesh() { return *faces_.mesh; }
  /// The faces of the surface, with doubled vertices as one.
  std::span<const Corners> corners() const { return faces_.corners(); }
  /// Vertices that the surface has no face at, once it is built.
  std::span<const std::uint32_t> unused() const { return unused_; }

  /// Where the vertices are now.
  /// @throws Bad_mesh  the mesh has changed since it was numbered
  Coordinates read();

  /// Reads the faces of the mesh anew; given positions, which may be those of other vertices, are dropped.
  /// @throws Bad_mesh, Bad_argument  the object stays as it was
  void rebuild(std::span<const std::uint32_t> file_vertex, Workers& workers) {
    replace(Faces(mesh().renumbered(workers), file_vertex));
  }
  /// The same, reading only what has changed where the type of the mesh allows that.
  void rebuild(const Changed_faces& changed, Workers& workers);

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
    return regions_ ? regions_->labels : std::vector<Region_index>(faces_.mesh->vertex_count(), 0);
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
    if (mesh().pose_number() == 0) ++changes_;
    const std::uint64_t shape_number = mesh().shape_number();
    if (shape_number_ == shape_number) return;
    shape_number_ = shape_number;
    rest_of_points_.clear();
    bounded_.reset();  // bounds refer to the former arrays of the points
  }
  /// Whether positions that are held have been read, and nothing else about the object has changed since.
  /// @param hold  Position_hold::number
  bool is_refreshed(std::uint64_t hold) {
    return hold != 0 && refreshed_in_ == hold && shape_number_ == mesh().shape_number();
  }
  /// Takes note that they have been read.
  void note_refreshed(std::uint64_t hold) { refreshed_in_ = hold; }
  /// Takes note that a query begins for which they need not be read again. O(1).
  /// @throws Bad_mesh  the mesh has changed since it was numbered
  void begin_query_of_refreshed() {
    mesh().check_connectivity(title);
    if (!mesh().in_memory() || given_ || placement_) return;
    const Coordinates now = mesh().read();  // the same numbers, but the mesh may have moved them to other memory
    if (now.data() == surface.coordinates().data()) return;
    surface.follow(now);
    ray_tree_.note_moved();
  }

  /// The surface as one that is bounded, in mode `certified`; null: not yet.
  Bounded_surface* bounded() const { return bounded_.get(); }
  /// Whether it is posed only where it is looked at.
  bool on_demand() const { return bounded_ && bounded_->has_bounds() && !given_; }
  /// Promises something about the motion.
  void promise(Make_bound make) {
    promises_.push_back(std::move(make));
    refreshed_in_ = 0;
    bounded_.reset();
  }
  /// Makes the bounds of a surface that has just been refitted. The first time, promises take its positions as those at
  /// rest.
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

  /// The mesh, and what depends on its faces alone.
  struct Faces {
    Faces(std::unique_ptr<Watched_mesh> watched, std::span<const std::uint32_t> file_vertex)
        : mesh(std::move(watched)), joined(join_vertices(mesh->corners(), mesh->vertex_count(), file_vertex)) {}

    std::span<const Corners> corners() const { return joined.empty() ? mesh->corners() : std::span(joined); }

    std::unique_ptr<Watched_mesh> mesh;
    std::vector<Corners> joined;  ///< none if no vertex is doubled
  };

  /// A surface of former faces, and which of its faces have changed since.
  struct Former {
    Basic_tree_surface<Volume> surface;
    std::vector<std::uint32_t> changed;
  };

  /// Where the vertices are, as the mesh or the caller says.
  class Object_positions final : public Position_source {
   public:
    explicit Object_positions(Exact_object& object) : object_(&object) {}

    std::uint32_t vertex_count() const override { return object_->mesh().vertex_count(); }
    std::uint64_t pose_number() const override { return 1 + object_->mesh().pose_number() + object_->changes_; }
    Eigen::Vector3d operator()(std::uint32_t vertex) const override {
      const Eigen::Vector3d position =
          object_->given_ ? Eigen::Vector3d(object_->given_->row(vertex)) : object_->mesh().read(vertex);
      return object_->placement_ ? (*object_->placement_)(position) : position;
    }
    void pose(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const override;
    void pose_all(std::span<double> coordinates) const override {
      std::ranges::copy(object_->read(), coordinates.begin());
    }
    Coordinates in_memory() const override {
      const bool are_there = !object_->placement_ && (object_->given_ || object_->mesh().in_memory());
      return are_there ? object_->read() : Coordinates();
    }
    Coordinates all(std::span<double> /*memory*/) const override { return object_->read(); }

   private:
    Exact_object* object_;
  };

  /// Where the vertices are in the mesh.
  class Mesh_positions final : public Position_source {
   public:
    explicit Mesh_positions(Exact_object& object) : object_(&object) {}

    std::uint32_t vertex_count() const override { return object_->mesh().vertex_count(); }
    std::uint64_t pose_number() const override { return object_->mesh().pose_number(); }
    Eigen::Vector3d operator()(std::uint32_t vertex) const override { return object_->mesh().read(vertex); }
    void pose(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const override {
      object_->mesh().read(vertices, coordinates);
    }
    void pose_all(std::span<double> coordinates) const override {
      std::ranges::copy(object_->mesh().read(), coordinates.begin());
    }
    Coordinates in_memory() const override {
      return object_->mesh().in_memory() ? object_->mesh().read() : Coordinates();
    }

   private:
    Exact_object* object_;
  };

  std::unique_ptr<Node_bound> bound_of_points(const Bounded_object& in_mesh);
  std::vector<std::unique_ptr<Node_bound>> promised_bounds(const Bounded_object& in_mesh);
  void keep_first(std::vector<double>& positions);
  std::unique_ptr<Node_bound> placed(std::unique_ptr<Node_bound> bound, const Bounded_object& in_mesh);
  void show_mesh(Node_bound& bound, const Tree_layout& layout);
  std::vector<std::unique_ptr<Node_bound>> bounds_of_mesh();
  void replace(Faces anew);
  void start_anew(std::vector<std::uint32_t> changed, std::size_t former_faces);

  Faces faces_;
  std::optional<Former> former_;  ///< between a change of faces and the next build
  std::optional<Numbered_partition> regions_;
  std::vector<std::uint32_t> unused_;
  std::optional<Positions> given_ = {};  ///< in place of those of the mesh
  std::optional<Rigid_motion> placement_ = {};
  std::uint64_t changes_ = 0;  ///< grows with given positions, with placements, and with queries of a mesh whose points
                               ///< have no pose number
  std::uint64_t refreshed_in_ = 0;  ///< the number of the hold in which positions have been read; 0: none
  std::vector<Make_bound> promises_;
  std::vector<double> rest_;            ///< 3 V: the first positions that a promise was about; none before
  std::vector<double> rest_of_points_;  ///< 3 V: the first positions that points with a bound had; none before
  std::uint64_t shape_number_ = 0;      ///< Watched_mesh::shape_number of the points that bounds are about
  std::unique_ptr<Mesh_positions> mesh_positions_;  ///< what bounds look at
  std::unique_ptr<Bounded_surface> bounded_;
  bool lacks_bounds_ = false;  ///< the mesh was not finite where others were given when `bounded_` was made
  Kept_ray_tree ray_tree_;
  std::vector<double> placed_;  ///< memory of `read`
};

template <Bounding_volume Volume>
Positions Exact_object<Volume>::checked(const Eigen::Ref<const Positions>& positions, const char* when) {
  if (positions.rows() != mesh().vertex_count())
    throw Bad_mesh(title + " has " + std::to_string(mesh().vertex_count()) + " vertices, but got " +
                   std::to_string(positions.rows()) + " positions" + when);
  Positions copy = positions;
  check_finite({copy.data(), static_cast<std::size_t>(copy.size())}, title + when);
  return copy;
}

template <Bounding_volume Volume>
Coordinates Exact_object<Volume>::read() {
  mesh().check_connectivity(title);
  const Coordinates unplaced =
      given_ ? Coordinates(given_->data(), static_cast<std::size_t>(given_->size())) : mesh().read();
  return placement_ ? (*placement_)(unplaced, placed_) : unplaced;
}

/// Those of the mesh, unless others are given; then places them.
template <Bounding_volume Volume>
void Exact_object<Volume>::Object_positions::pose(std::span<const std::uint32_t> vertices,
                                                  std::span<double> coordinates) const {
  if (!object_->given_) object_->mesh().read(vertices, coordinates);
  if (!object_->given_ && !object_->placement_) return;
  for (const std::uint32_t vertex : vertices) {
    Eigen::Map<Eigen::Vector3d> position(coordinates.data() + 3 * std::size_t{vertex});
    if (object_->given_) position = object_->given_->row(vertex);
    if (object_->placement_) position = (*object_->placement_)(position);
  }
}

/// The bound that the points of the mesh have by themselves; null: none.
template <Bounding_volume Volume>
std::unique_ptr<Node_bound> Exact_object<Volume>::bound_of_points(const Bounded_object& in_mesh) {
  if (mesh().own_bound_needs_rest()) keep_first(rest_of_points_);
  auto bound = mesh().own_bound({in_mesh.layout, in_mesh.labels, rest_of_points_, in_mesh.positions});
  return bound ? placed(std::move(bound), in_mesh) : nullptr;
}

/// Keeps the positions that the mesh has now, unless some were kept before.
template <Bounding_volume Volume>
void Exact_object<Volume>::keep_first(std::vector<double>& positions) {
  if (!positions.empty()) return;
  std::vector<double> first(3 * std::size_t{mesh().vertex_count()});
  mesh_positions_->pose_all(first);
  positions = std::move(first);
}

/// What is known of the mesh is known of the object, wherever it is placed.
template <Bounding_volume Volume>
std::unique_ptr<Node_bound> Exact_object<Volume>::placed(std::unique_ptr<Node_bound> bound,
                                                         const Bounded_object& in_mesh) {
  if (given_ && bound->watches()) show_mesh(*bound, in_mesh.layout);
  return std::make_unique<Placed_bound>(std::move(bound), placement_, given_, in_mesh);
}

/// Shows a bound where the vertices are in the mesh. As long as others are given, nobody else does.
template <Bounding_volume Volume>
void Exact_object<Volume>::show_mesh(Node_bound& bound, const Tree_layout& layout) {
  const Coordinates in_mesh = mesh().read();
  for (std::uint32_t leaf = 0; leaf < layout.leaf_count(); ++leaf) {
    Aabb box;
    box.enclose(layout.leaf_faces(leaf, in_mesh));
    bound.note_read(leaf, box, in_mesh);
  }
}

/// A promise that does not fit is forgotten: it would stand in the way of every query to come.
template <Bounding_volume Volume>
std::vector<std::unique_ptr<Node_bound>> Exact_object<Volume>::promised_bounds(const Bounded_object& in_mesh) {
  std::vector<std::unique_ptr<Node_bound>> bounds;
  for (auto promise = promises_.begin(); promise != promises_.end(); ++promise) {
    std::unique_ptr<Node_bound> bound;
    try {
      bound = (*promise)(in_mesh);
    } catch (const Bad_argument& misfit) {
      promises_.erase(promise);
      throw Bad_argument("a promise about " + title + " is dropped: " + misfit.what());
    }
    bounds.push_back(placed(std::move(bound), in_mesh));
  }
  return bounds;
}

template <Bounding_volume Volume>
std::vector<std::unique_ptr<Node_bound>> Exact_object<Volume>::bounds_of_mesh() {
  mesh_positions_ = std::make_unique<Mesh_positions>(*this);
  if (!promises_.empty()) keep_first(rest_);
  const Bounded_object in_mesh{
      .layout = surface.tree(),
      .labels = regions_ ? std::span<const Region_index>(regions_->labels) : std::span<const Region_index>(),
      .rest = rest_,
      .positions = *mesh_positions_};
  std::vector<std::unique_ptr<Node_bound>> bounds;
  if (auto own = bound_of_points(in_mesh)) bounds.push_back(std::move(own));
  for (auto& bound : promised_bounds(in_mesh)) bounds.push_back(std::move(bound));
  return bounds;
}

template <Bounding_volume Volume>
void Exact_object<Volume>::make_bounds(bool compare_all, Workers& workers) {
  if constexpr (std::same_as<Volume, Aabb>) {
    const Coordinates now = surface.coordinates();
    // Positions that are given hide those of the mesh, which nobody has looked at.
    const bool is_known = !given_ || surface.tree().finite(mesh().read());
    auto bounds = is_known ? bounds_of_mesh() : std::vector<std::unique_ptr<Node_bound>>();
    auto made = std::make_unique<Bounded_surface>(surface, std::make_unique<Object_positions>(*this),
                                                  std::move(bounds), workers, title);
    made->compare_all(compare_all);
    surface.follow(now);
    made->take_refitted();
    bounded_ = std::move(made);
    lacks_bounds_ = !is_known;
  }
}

template <Bounding_volume Volume>
void Exact_object<Volume>::replace(Faces anew) {
  auto changed = changed_faces(corners(), anew.corners());
  faces_ = std::move(anew);
  start_anew(std::move(changed), corners().size());
}

template <Bounding_volume Volume>
void Exact_object<Volume>::rebuild(const Changed_faces& changed, Workers& workers) {
  const std::size_t former_faces = corners().size();
  // Copied first: if memory ran out later, the mesh would be numbered anew beside the former surface.
  std::vector<std::uint32_t> listed(changed.faces.begin(), changed.faces.end());
  if (!faces_.joined.empty() || !mesh().renumber(changed.faces)) {
    Faces anew(mesh().renumbered(workers), {});
    check_faces(changed.faces, anew.corners().size());
    return replace(std::move(anew));
  }
  start_anew(std::move(listed), former_faces);
}

/// The surface of the faces as they are now has no tree yet; that of the former ones waits to be mended. If memory runs
/// out it does not wait: a new tree is built.
/// @param changed       faces of `corners()`; those from `former_faces` on need not be listed
template <Bounding_volume Volume>
void Exact_object<Volume>::start_anew(std::vector<std::uint32_t> changed, std::size_t former_faces) {
  if (std::exchange(built, false)) former_ = Former{std::move(surface), {}};
  bounded_.reset();
  ray_tree_.forget();
  rest_.clear();
  rest_of_points_.clear();
  surface = Basic_tree_surface<Volume>(corners());
  give({});
  auto former = std::exchange(former_, std::nullopt);
  if (!former) return;
  std::erase_if(former->changed, [&](std::uint32_t face) { return face >= corners().size(); });
  former->changed.insert(former->changed.end(), changed.begin(), changed.end());
  for (std::size_t face = former_faces; face < corners().size(); ++face)
    former->changed.push_back(static_cast<std::uint32_t>(face));
  former_ = std::move(former);
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
