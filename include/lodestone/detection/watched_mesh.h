// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lodestone/bounds/own_bound.h"
#include "lodestone/mesh/computed_points.h"
#include "lodestone/mesh/connectivity.h"
#include "lodestone/mesh/coordinate_reader.h"
#include "lodestone/mesh/own_points.h"
#include "lodestone/mesh/region_maps.h"
#include "lodestone/mesh/workers.h"
#include "lodestone/partition/partition.h"

namespace lodestone {

/// What a detector asks of one of its meshes, whatever its type. The modes know no mesh types: they see each mesh
/// through this interface, once per frame, and by index.
class Watched_mesh {
 public:
  virtual ~Watched_mesh() = default;

  /// Number of vertices, V.
  virtual std::uint32_t vertex_count() const = 0;
  /// Corners of every face, in the order of `faces(mesh)`.
  virtual std::span<const Corners> corners() const = 0;
  /// Notices that the mesh has changed since it was numbered: see `lodestone::check_connectivity`.
  /// @param title          names the mesh in the message
  /// @throws Bad_mesh      the mesh has another number of vertices or faces than when it was numbered, or removed
  ///                       elements
  /// @throws Bad_argument  its points are computed, and there are fewer than vertices
  virtual void check_connectivity(const std::string& title) const = 0;

  /// Where all vertices are now. O(1) where `in_memory`, otherwise O(V).
  /// @return valid until the next call, and until the mesh changes
  virtual Coordinates read() = 0;
  /// Where one vertex is now.
  virtual Eigen::Vector3d read(std::uint32_t vertex) const = 0;
  /// Where the vertices of a list are now, each to its three places among 3 V coordinates.
  virtual void read(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const = 0;
  /// Whether `read()` refers to the mesh's own memory, instead of copying.
  virtual bool in_memory() const = 0;
  /// Grows whenever positions change; 0: unknown, so they are read anew.
  virtual std::uint64_t pose_number() const = 0;
  /// Grows when `own_bound` must be made anew: see Computed_points.
  virtual std::uint64_t shape_number() const = 0;
  /// The bound that the positions have by themselves; null: none.
  virtual std::unique_ptr<Node_bound> own_bound(const Bounded_object& object) const = 0;
  /// Whether that bound is made from positions at rest.
  virtual bool own_bound_needs_rest() const = 0;

  /// Whether the detector's strategy needs only a surface by index, which need not be that of the mesh.
  virtual bool divides_by_index() const = 0;
  /// Whether `partition` may be called in several threads at once, of this mesh and others.
  virtual bool divides_concurrently() const = 0;
  /// Divides a surface into regions by the detector's strategy: see `partition_numbered`.
  /// @param surface  that of the mesh; another one if `divides_by_index`
  virtual Numbered_partition partition(const Numbered_surface& surface, std::size_t regions,
                                       const Partition_options& options) const = 0;

  /// Whether the mesh has the maps `v:region` and `v:particle`.
  virtual bool has_maps() const = 0;
  /// Writes them, if it has them. O(V).
  virtual void write_maps(const std::vector<Region_index>& labels, const std::vector<std::uint32_t>& particles) = 0;
  /// Moves the particles of `v:particle`, if the mesh has it. O(N).
  virtual void move_particles(const std::vector<std::uint32_t>& particles) = 0;

  /// The same mesh, its vertices and faces numbered anew, and its maps fetched again.
  /// @throws Bad_mesh  see Mesh_numbering
  virtual std::unique_ptr<Watched_mesh> renumbered(Workers& workers) const = 0;
  /// Numbers this mesh anew after a change of its faces: see `Mesh_numbering::renumber`.
  /// @return false if a mesh of this type must be numbered as a whole: nothing has been done
  virtual bool renumber(std::span<const std::uint32_t> changed) = 0;
};

/// Makes a Watched_mesh, whose faces workers share. The time that this takes counts as `build`.
using Watch_mesh = std::function<std::unique_ptr<Watched_mesh>(Workers&)>;

/// A mesh of a known type, with its property maps.
template <Triangle_mesh Mesh>
class Watched_mesh_of : public Watched_mesh {
 public:
  /// @param mesh       must outlive this
  /// @throws Bad_mesh  see Mesh_numbering
  Watched_mesh_of(const Mesh& mesh, Workers& workers) : mesh_(&mesh), numbering_(mesh, workers) {}

  std::uint32_t vertex_count() const override { return numbering_.vertex_count(); }
  std::span<const Corners> corners() const override { return numbering_.corners(); }
  void check_connectivity(const std::string& title) const override {
    lodestone::check_connectivity(*mesh_, numbering_, [&] { return title; });
  }

  bool renumber(std::span<const std::uint32_t> changed) override {
    if constexpr (Vertex_table<Mesh>::by_index) {
      if (maps_) maps_->renew();  // first, since what follows is done as a whole or not at all
      numbering_.renumber(*mesh_, changed);
    }
    return Vertex_table<Mesh>::by_index;
  }

  /// None: the mesh cannot be written to.
  const std::optional<Region_maps<Mesh>>& maps() const { return maps_; }
  bool has_maps() const override { return maps_.has_value(); }
  /// Adds the maps to the mesh, which is the one that is watched.
  void add_maps(Mesh& mesh) { maps_.emplace(mesh); }
  void write_maps(const std::vector<Region_index>& labels, const std::vector<std::uint32_t>& particles) override {
    if (maps_) maps_->write(numbering_, labels, particles);
  }
  void move_particles(const std::vector<std::uint32_t>& particles) override {
    if (maps_) maps_->move_particles(numbering_, particles);
  }

 protected:
  /// Has the maps of another numbering of the same mesh.
  void renew_maps_of(const Watched_mesh_of& other) {
    maps_ = other.maps_;
    if (maps_) maps_->renew();
  }

  const Mesh* mesh_;                       ///< the mesh that is watched
  Mesh_numbering<Mesh> numbering_;         ///< of its vertices and faces
  std::optional<Region_maps<Mesh>> maps_;  ///< none: the mesh cannot be written to
};

/// Computed points behind a point map, if there are any.
template <class Points>
inline constexpr bool is_computed = false;
/// The points of such a map are computed.
template <class Mesh, class Points>
inline constexpr bool is_computed<Computed_point_map<Mesh, Points>> = true;

/// A mesh with a point map through which its positions are read, and the strategy that divides it.
template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points, Partition_strategy<Mesh> Strategy>
class Typed_watched_mesh final : public Watched_mesh_of<Mesh> {
 public:
  /// @param mesh, points  must outlive this
  /// @param strategy      shared by the meshes of a detector
  Typed_watched_mesh(const Mesh& mesh, Points points, std::shared_ptr<const Strategy> strategy,
                     Workers& workers = Workers::alone())
      : Watched_mesh_of<Mesh>(mesh, workers),
        points_(points),
        all_points_(std::move(points)),
        strategy_(std::move(strategy)) {
    if constexpr (is_computed<Points> && !Vertex_table<Mesh>::by_index) in_order_ = points_.in_order(this->numbering_);
  }

  void check_connectivity(const std::string& title) const override {
    Watched_mesh_of<Mesh>::check_connectivity(title);
    if constexpr (is_computed<Points>)
      if (points_.points().vertex_count() < this->numbering_.vertex_count())
        throw Bad_argument(title + " has fewer computed points than vertices");
  }
  Coordinates read() override { return all_points_.read(this->numbering_); }
  Eigen::Vector3d read(std::uint32_t vertex) const override {
    return coordinates(get(points_, this->numbering_.vertex(vertex)));
  }
  void read(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const override {
    if constexpr (is_computed<Points>)
      if (in_order()) return points_.points().pose(vertices, coordinates);
    for (const std::uint32_t vertex : vertices)
      Eigen::Map<Eigen::Vector3d>(coordinates.data() + 3 * std::size_t{vertex}) = read(vertex);
  }
  bool in_memory() const override { return Coordinate_reader<Mesh, Points>::in_memory; }
  std::uint64_t pose_number() const override {
    if constexpr (is_computed<Points>) return points_.points().pose_number();
    return 0;
  }
  std::uint64_t shape_number() const override {
    if constexpr (requires { points_.points().shape_number(); }) return points_.points().shape_number();
    return 0;
  }
  std::unique_ptr<Node_bound> own_bound(const Bounded_object& object) const override {
    if constexpr (is_computed<Points>)
      if constexpr (Bounded_points<std::remove_cvref_t<decltype(points_.points())>>)
        if (in_order()) {
          auto bound = lodestone::own_bound(points_.points(), object);
          return std::make_unique<Node_bound_of<decltype(bound)>>(std::move(bound));
        }
    return nullptr;
  }
  bool own_bound_needs_rest() const override {
    if constexpr (is_computed<Points>)
      return Motion_promise<std::remove_cvref_t<decltype(points_.points())>>;
    else
      return false;
  }

  bool divides_by_index() const override { return Labels_by_index<Strategy>; }
  bool divides_concurrently() const override { return is_concurrent(*strategy_); }
  Numbered_partition partition(const Numbered_surface& surface, std::size_t regions,
                               const Partition_options& options) const override {
    if constexpr (Labels_by_index<Strategy>)
      return partition_numbered(surface, regions, *strategy_, options);
    else
      return partition_numbered(
          Partition_input<Mesh>{*this->mesh_, this->numbering_, surface.graph, surface.positions}, regions, *strategy_,
          options);
  }
  std::unique_ptr<Watched_mesh> renumbered(Workers& workers) const override {
    auto anew = std::make_unique<Typed_watched_mesh>(*this->mesh_, points_of_now(), strategy_, workers);
    anew->renew_maps_of(*this);
    return anew;
  }

 private:
  /// A map of computed points may have indices of the vertices that there were when it was made.
  Points points_of_now() const {
    if constexpr (is_computed<Points> && !Vertex_table<Mesh>::by_index)
      return Points(*this->mesh_, points_.points());
    else
      return points_;
  }
  /// Whether computed points are numbered as the vertices are.
  bool in_order() const {
    if constexpr (is_computed<Points> && Vertex_table<Mesh>::by_index)
      return points_.in_order(this->numbering_);
    else
      return in_order_;
  }

  Points points_;
  bool in_order_ = false;
  Coordinate_reader<Mesh, Points> all_points_;
  std::shared_ptr<const Strategy> strategy_;
};

}  // namespace lodestone
