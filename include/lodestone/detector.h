// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lodestone/detection/collision_filter.h"
#include "lodestone/detection/detector_options.h"
#include "lodestone/detection/exact_detection.h"
#include "lodestone/detection/frame.h"
#include "lodestone/detection/particle_detection.h"
#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/region_maps.h"
#include "lodestone/partition/lbg.h"
#include "lodestone/partition/strategies.h"

namespace lodestone {

/// The vertex point map that a mesh has of its own.
template <class Mesh>
using Own_points = typename boost::property_map<Mesh, CGAL::vertex_point_t>::const_type;

/// Finds collisions between many deforming meshes, frame after frame.
///
///     Detector<Surface_mesh> detector({.mode = Mode::exact});
///     const auto teapot = detector.add(teapot_mesh), sphere = detector.add(sphere_mesh);
///     while (simulate(teapot_mesh, sphere_mesh)) {
///       detector.update();
///       for (const auto& pair : detector.detect().pairs) ...
///     }
///
/// Meshes stay with the caller, who moves their vertices, calls `rebuild` after any change of their faces, and after a
/// removal of their maps `v:region` and `v:particle` as by `clear`, and neither moves nor assigns to the mesh itself;
/// they must outlive the detector. How much of a mesh a frame reads, and what may be missed, depends on the mode: see
/// `Particle_detection` and `Exact_detection`. Answers are never those of an earlier frame: positions are read by the
/// call that answers. One thread at a time.
///
/// @tparam Mesh      any model of Triangle_mesh
/// @tparam Strategy  how surfaces are divided, see Partition_strategy
/// @tparam Points    vertex point map
/// @tparam Volume    of the trees in mode `exact`, see Bounding_volume
template <Triangle_mesh Mesh, class Strategy = Lbg, class Points = Own_points<Mesh>, Bounding_volume Volume = Aabb>
class Detector {
 public:
  /// @throws Bad_argument  an option out of range
  explicit Detector(const Detector_options& options = {}, Strategy strategy = {});

  /// Adds an object and leaves `v:region` and `v:particle` on its mesh.
  /// Another detector that the same mesh is added to writes to the same maps.
  /// @throws Bad_mesh      no face, a face that is no triangle
  /// @throws Bad_argument  the mesh has been added before; mode `exact`: `file_vertex` has not a number for each vertex
  Object_id add(Mesh& mesh, const Object_options& options = {}) {
    const Object_id object = add(std::as_const(mesh), options);
    if (exact_)
      exact_->write_maps(object, mesh);
    else
      particles_->write_maps(object, mesh);
    return object;
  }
  /// Adds an object whose mesh cannot be written to.
  Object_id add(const Mesh& mesh, const Object_options& options = {}) {
    for (const Mesh* other : meshes_)
      if (other == &mesh) throw Bad_argument("the mesh has been added before");
    return add(mesh, CGAL::get_const_property_map(CGAL::vertex_point, mesh), options);
  }
  /// Adds an object whose positions are read through `points`. One mesh may be added several times with other points.
  Object_id add(const Mesh& mesh, Points points, const Object_options& options = {});
  /// A mesh that ends with the call cannot be added.
  Object_id add(const Mesh&& mesh, const Object_options& options = {}) = delete;
  Object_id add(const Mesh&& mesh, Points points, const Object_options& options = {}) = delete;

  /// Says that the vertices of an object have moved. In mode `particles` an object whose regions have outgrown A* is
  /// repartitioned, with its number of particles computed afresh: O(N) while nothing has grown. In mode `exact` it
  /// takes back positions that were given, and nothing else needs to be done: `detect` reads the mesh.
  /// @throws Bad_argument  no such object
  /// @throws Bad_mesh      as `detect`
  void update(Object_id object);
  /// The same for all objects.
  void update();
  /// Gives an object the positions that it has from now on, whatever its mesh says, until its next update. Mode
  /// `exact`. They are copied: O(V).
  /// @param positions      V x 3, by vertex in the order of `vertices(mesh)`
  /// @throws Bad_argument  no such object, another mode
  /// @throws Bad_mesh      another number of rows, a coordinate that is not finite; the object stays as it was
  void update(Object_id object, const Eigen::Ref<const Positions>& positions);
  /// Says that faces of an object's mesh have come, gone or changed. It is numbered, partitioned and built anew, and
  /// its positions are those of its mesh, as after `update(object)`. Other numbers of vertices or faces are noticed
  /// without it, an edge that was flipped is not.
  /// @param file_vertex    as in Object_options, of the vertices that there are now; left out: every vertex is one by
  ///                       itself, whatever was said before
  /// @throws Bad_argument  no such object; mode `exact`: `file_vertex` has not a number for each vertex
  /// @throws Bad_mesh      as `add`; the object stays as it was
  void rebuild(Object_id object, std::span<const std::uint32_t> file_vertex = {});

  /// Leaves out a pair of objects, or with `ignored` = false takes it in again; a = b: collisions of a with itself.
  /// @throws Bad_argument  no such object
  void ignore(Object_id a, Object_id b, bool ignored = true);

  /// Finds the collisions between all objects as their vertices are now. The first call, and any after an `add`,
  /// partitions the new objects.
  /// @return valid until the next call, and as long as the detector
  /// @throws Bad_mesh  a coordinate that is read is not finite, or beyond 1e150 in mode `particles`; a mesh has another
  ///                   number of vertices or faces than when it was added or rebuilt
  const Frame& detect();
  /// The same for a single pair, in mode `exact`; a = b: collisions of a with itself. Only these two are read.
  /// @throws Bad_argument  no such object, another mode
  const Frame& detect(Object_id a, Object_id b);

  /// Shows the face pairs of two objects to a visitor, which may stop the walk: see `visit_contacts`. Mode `exact`,
  /// with its tolerance; caps and filters do not count. The visitor can ask nothing of the
  /// detector and change no object.
  /// @throws Bad_argument  no such object, one and the same, another mode, a call of the visitor
  /// @throws Bad_mesh      as `detect`
  template <Contact_visitor Visitor>
  Visit visit(Object_id a, Object_id b, Visitor&& visitor) {
    auto& exact = of_exact(a, b);
    if (a == b) throw Bad_argument("the face pairs of object " + std::to_string(a) + " and itself");
    return exact.visit({a, b}, std::forward<Visitor>(visitor));
  }
  /// Where two objects come nearest, in mode `exact`.
  /// @throws Bad_argument  no such object, one and the same, another mode
  /// @throws Bad_mesh      as `detect`
  Closest_faces closest(Object_id a, Object_id b);
  /// Whether the surface of `inner` lies inside that of `outer`, which is closed, in mode `exact`: see `encloses`.
  /// @throws Bad_argument, Bad_mesh  as `closest`
  bool contains(Object_id outer, Object_id inner);

  std::size_t size() const { return meshes_.size(); }
  /// The state of one object in the modes with particles: regions, particles, patches. Valid until it is rebuilt.
  /// @throws Bad_argument  no such object, another mode
  const Particle_object<Mesh, Points>& object(Object_id object) const {
    checked(object);
    if (exact_) throw Bad_argument("objects of mode exact have no particles");
    return particles_->object(object);
  }
  /// The tree of one object in mode `exact`, empty before the first answer. Its volumes are those of the last answer
  /// that the object was part of. It knows no positions, so nothing can be asked of it that they would decide.
  /// @throws Bad_argument  no such object, another mode
  const Basic_region_tree<Volume>& tree(Object_id object) const { return of_exact(object).tree(object); }
  /// Its property maps. Copies of them are of no use after `rebuild`.
  /// @throws Bad_argument  no such object, or one whose mesh could not be written to when it was added
  const Region_maps<Mesh>& maps(Object_id object) const {
    checked(object);
    const auto& maps = exact_ ? exact_->maps(object) : particles_->maps(object);
    if (!maps) throw Bad_argument("object " + std::to_string(object) + " carries no property maps");
    return *maps;
  }

 private:
  void checked(Object_id object) const {
    if (object >= meshes_.size()) throw Bad_argument("there is no object " + std::to_string(object));
  }
  /// The exact mode, for something that is to be asked of objects.
  template <class... Ids>
  Exact_detection<Mesh, Strategy, Points, Volume>& of_exact(Ids... objects) const {
    (checked(objects), ...);
    if (!exact_) throw Bad_argument("this needs the mode exact");
    return *exact_;
  }

  // One of the two.
  std::unique_ptr<Particle_detection<Mesh, Strategy, Points>> particles_;
  std::unique_ptr<Exact_detection<Mesh, Strategy, Points, Volume>> exact_;
  Collision_filter filter_;
  std::vector<const Mesh*> meshes_;
};

template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
Detector<Mesh, Strategy, Points, Volume>::Detector(const Detector_options& options, Strategy strategy) {
  check(options);
  if (options.mode == Mode::exact)
    exact_ = std::make_unique<Exact_detection<Mesh, Strategy, Points, Volume>>(options, std::move(strategy));
  else
    particles_ = std::make_unique<Particle_detection<Mesh, Strategy, Points>>(options, std::move(strategy));
}

template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
Object_id Detector<Mesh, Strategy, Points, Volume>::add(const Mesh& mesh, Points points,
                                                        const Object_options& options) {
  if (exact_)
    exact_->add(mesh, points, options);
  else
    particles_->add(mesh, points, options);
  filter_.add(options);
  meshes_.push_back(&mesh);
  return static_cast<Object_id>(meshes_.size() - 1);
}

template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
void Detector<Mesh, Strategy, Points, Volume>::update(Object_id object) {
  checked(object);
  if (exact_)
    exact_->update(object);
  else
    particles_->update(object);
}

template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
void Detector<Mesh, Strategy, Points, Volume>::update() {
  for (Object_id object = 0; object < size(); ++object) update(object);
}

template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
void Detector<Mesh, Strategy, Points, Volume>::update(Object_id object, const Eigen::Ref<const Positions>& positions) {
  of_exact(object).update(object, positions);
}

template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
void Detector<Mesh, Strategy, Points, Volume>::rebuild(Object_id object, std::span<const std::uint32_t> file_vertex) {
  checked(object);
  if (exact_)
    exact_->rebuild(object, file_vertex);
  else
    particles_->rebuild(object);
}

template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
void Detector<Mesh, Strategy, Points, Volume>::ignore(Object_id a, Object_id b, bool ignored) {
  checked(a);
  checked(b);
  filter_.ignore({a, b}, ignored);
}

template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
const Frame& Detector<Mesh, Strategy, Points, Volume>::detect() {
  return exact_ ? exact_->detect(filter_) : particles_->detect(filter_);
}

template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
const Frame& Detector<Mesh, Strategy, Points, Volume>::detect(Object_id a, Object_id b) {
  return of_exact(a, b).detect(filter_, {std::min(a, b), std::max(a, b)});
}

template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
Closest_faces Detector<Mesh, Strategy, Points, Volume>::closest(Object_id a, Object_id b) {
  auto& exact = of_exact(a, b);
  if (a == b) throw Bad_argument("the closest faces of object " + std::to_string(a) + " and itself");
  return exact.closest({a, b});
}

template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
bool Detector<Mesh, Strategy, Points, Volume>::contains(Object_id outer, Object_id inner) {
  auto& exact = of_exact(outer, inner);
  if (outer == inner) throw Bad_argument("whether object " + std::to_string(outer) + " contains itself");
  return exact.contains(outer, inner);
}

extern template class Detector<Surface_mesh>;
extern template class Detector<Surface_mesh, Any_strategy>;

/// A detector in whose mode `exact` the trees have volumes of another kind.
template <Bounding_volume Volume, Triangle_mesh Mesh = Surface_mesh, class Strategy = Lbg>
using Volume_detector = Detector<Mesh, Strategy, Own_points<Mesh>, Volume>;

}  // namespace lodestone
