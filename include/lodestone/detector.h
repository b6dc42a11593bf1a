// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "lodestone/detection/make_detection.h"
#include "lodestone/mesh/indexed_mesh.h"
#include "lodestone/partition/lbg.h"
#include "lodestone/partition/strategies.h"
#include "lodestone/queries/ask_each.h"
#include "lodestone/queries/ray_tree.h"
#include "lodestone/version.h"

namespace lodestone {

/// Finds collisions between many deforming meshes, frame after frame.
///
///     Detector detector;
///     const auto teapot = detector.add(teapot_mesh), sphere = detector.add(sphere_mesh);
///     while (simulate(teapot_mesh, sphere_mesh))
///       for (const auto& pair : detector.detect().pairs) ...
///
/// The caller keeps the meshes, of any types, and moves their vertices. The meshes must outlive the detector, or the
/// removal of their objects, and must be neither moved nor assigned to. The caller calls `rebuild` after any change of
/// a mesh's faces, and after any removal of its maps `v:region` and `v:particle`, for instance by `clear`.
///
/// The mode decides how much of a mesh a frame reads, and what it may miss: see `Particle_detection` and
/// `Exact_detection`. What is said of mode `exact` holds for mode `certified` too, unless it says otherwise. Every
/// query asks for the current vertex positions, so results are never stale: see also `hold_positions`. In mode
/// `particles` call `update` before `detect`: it notices regions that have grown. One thread at a time may use a
/// detector.
///
/// Cost. The first query after `add` or `rebuild` builds the object; `add` itself only numbers the mesh, O(V + F). In
/// mode `exact` a query reads all V positions of each object that it asks about, unless they are held; in mode
/// `certified` only where it looks. Then `detect` compares O(log F) pairs of nodes for two objects that meet in one
/// place, and the faces whose boxes overlap there. `visit`, `within`, `closest` and `first_impact` search in the same
/// way, and `parting` does so some dozen times. Rays, `closest_point`, `point_side` and `contains` look at O(log F)
/// nodes where the surface is met in one place. In mode `particles` a frame reads few of the V positions; with
/// meetings, the median frame grew with the square root of the number of faces in the experiment `scaling`.
///
/// Functions of yours that a detector calls must not call it: visitors, point maps, strategies, promises. From there,
/// every call that is not const throws Bad_argument, but for `ignore` and `hold_positions`.
///
/// Queries, `save`, and in mode `particles` `update`, throw Bad_argument in a thread that flushes subnormal numbers to
/// zero, or rounds other than to nearest.
///
/// A call that runs out of memory throws std::bad_alloc, and nothing leaks. Repeat it, or go on without it: the next
/// `detect` is right. A `rebuild` may or may not have taken effect.
///
/// A detector that has been moved from may only be assigned to or destroyed. As the type of a member, write
/// `Detector<>`.
///
/// @tparam Strategy  how surfaces are divided: a Partition_strategy for the type of each mesh
/// @tparam Volume    of the trees in mode `exact`, see Bounding_volume
template <class Strategy = Lbg, Bounding_volume Volume = Aabb>
class Detector {
  static_assert(requires(const Strategy& s) { { s.name } -> std::convertible_to<std::string_view>; },
                "the first template argument of Detector is the partition strategy, which needs a `name`; it is not the "
                "type of the meshes");

 public:
  /// A detector without objects.
  /// @throws Bad_argument  an option out of range, or mode `certified` with other volumes than boxes
  explicit Detector(const Detector_options& options = {}, Strategy strategy = {})
      : strategy_(std::make_shared<const Strategy>(with_threads(std::move(strategy), options.threads))),
        detection_(make_detection<Volume>(options)) {
    need_same_containers();
  }

  /// Adds an object, and adds the maps `v:region` and `v:particle` to its mesh. Maps of these names that the mesh has
  /// already are taken, and their values replaced. Two detectors that share a mesh write to the same maps,
  /// so in two threads they must add it as const.
  /// @throws Bad_mesh      no face, a face that is not a triangle; a Surface_mesh with removed elements: call its
  ///                       `collect_garbage` first
  /// @throws Bad_argument  the mesh has been added before; mode `exact`: `file_vertex` does not have one entry per
  ///                       vertex
  template <class Mesh>
  requires(!std::is_const_v<Mesh> && Triangle_mesh<Mesh>)
  Object_id add(Mesh& mesh, const Object_options& options = {}) {
    check_new(&mesh);
    return add_watched(
        &mesh,
        [&](Workers& workers) {
          auto watched = watch(mesh, CGAL::get_const_property_map(CGAL::vertex_point, std::as_const(mesh)), workers);
          watched->add_maps(mesh);
          return watched;
        },
        options);
  }
  /// Adds an object whose mesh cannot be written to.
  template <Triangle_mesh Mesh>
  Object_id add(const Mesh& mesh, const Object_options& options = {}) {
    check_new(&mesh);
    return add(mesh, CGAL::get_const_property_map(CGAL::vertex_point, mesh), options);
  }
  /// Adds an object whose positions are read through `points`, a vertex point map, which must outlive the object. One
  /// mesh may be added several times with other points; its property maps are not written. To have it with its own
  /// points too, add it without `points` first: afterwards that is refused.
  template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
  Object_id add(const Mesh& mesh, Points points, const Object_options& options = {}) {
    return add_watched(
        &mesh, [&](Workers& workers) { return watch(mesh, std::move(points), workers); }, options);
  }
  /// Temporaries are rejected.
  template <Triangle_mesh Mesh>
  Object_id add(const Mesh&& mesh, const Object_options& options = {}) = delete;
  template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
  Object_id add(const Mesh&& mesh, Points points, const Object_options& options = {}) = delete;

  /// Tells the detector that the vertices of an object have moved. In mode `particles` an object is repartitioned, and
  /// its number of particles computed again, if the area of a region is found to exceed `Detector_options::growth`
  /// times A*. O(N) while nothing has grown. With meetings a call looks at an eighth of the regions, or at all if the
  /// whole object seems larger. In mode `exact` this only discards given positions; `detect` reads the mesh anyway,
  /// unless positions are held: then the next query of the object reads it.
  /// @throws Bad_argument  no such object
  /// @throws Bad_mesh      as `detect`
  void update(Object_id object) { detection_->update(checked(object)); }
  /// The same for all objects.
  void update() {
    for (Object_id object = 0; object < size(); ++object)
      if (has(object)) update(object);
  }
  /// Gives an object the positions that it has until its next update, in place of those of its mesh. Mode `exact`. The
  /// positions are copied: O(V).
  /// @param positions      V x 3, one row per vertex in the order of `vertices(mesh)`
  /// @throws Bad_argument  no such object, another mode
  /// @throws Bad_mesh      another number of rows, a coordinate that is not finite; the object stays as it was
  void update(Object_id object, const Eigen::Ref<const Positions>& positions) {
    ask<Exact>("update with positions", object).update(object, positions);
  }
  /// Places an object: from now on its vertices are at `placement` * p, for each position p of its mesh, or given by
  /// `update`. Nothing is written to the mesh, and everything is as if these positions were. Another call replaces the
  /// placement; the identity ends it. A placed object costs a pass over all its vertices in mode `exact`, and in mode
  /// `particles` a product for each vertex that is read.
  /// @throws Bad_argument  no such object; a coefficient that is not finite; the linear part is no rotation
  void place(Object_id object, const Eigen::Isometry3d& placement) {
    detection_->place(checked(object), make_rigid_motion(placement));
  }

  /// Promises that no vertex of any mesh moves as long as the returned Held_positions lives. Then no position is read
  /// twice, in mode `exact`: the first query of an object refits its tree, later ones cost only what they look at.
  ///
  ///     const auto held = detector.hold_positions();
  ///     for (const auto& pair : detector.detect().pairs) gaps.push_back(detector.closest(pair.a, pair.b));
  ///
  /// What is changed by calls of the detector, say by `place` or `update`, is noticed all the same. Vertices that are
  /// moved otherwise may go unnoticed: answers then mix where they were and where they are, and a coordinate that is
  /// not finite can end the process. Promises may overlap.
  /// A `ray_tree` that is asked for meanwhile stays of use until then. The end of a promise counts as a use of the
  /// detector.
  /// @throws Bad_argument  another mode
  Held_positions hold_positions() { return Held_positions(ask<Exact>("hold_positions").hold()); }

  /// Tells the detector that faces of an object's mesh have been added, removed or changed. The object is numbered
  /// again, and has the positions of its mesh, as after `update(object)`. Its partition and its tree are built again;
  /// in mode `exact` without regions the tree is mended where faces differ, if these are few. Without this call, the
  /// detector notices other numbers of vertices or faces, but not a flipped edge.
  /// @param file_vertex    as in Object_options, for the new vertices; modes with particles ignore it. Empty: no
  ///                       vertices are joined
  /// @throws Bad_argument  no such object; mode `exact`: `file_vertex` does not have one entry per vertex
  /// @throws Bad_mesh      as `add`; the object stays as it was
  void rebuild(Object_id object, std::span<const std::uint32_t> file_vertex = {}) {
    detection_->rebuild(checked(object), file_vertex);
  }

  /// The same where the caller knows which faces have changed, as after CGAL's Euler operations. In mode `exact` the
  /// tree is mended where they are, and no vertices are joined. That takes a fraction of the time for meshes whose
  /// descriptors are indices, such as Surface_mesh; others, such as Polyhedron_3, are numbered as a whole, which takes
  /// most of it. With regions, and in other modes, everything is built again.
  /// @throws Bad_argument  no such object; mode `exact`: no such face, a face that is not listed has lost a corner
  /// @throws Bad_mesh      as `add`; the object stays as it was
  void rebuild(Object_id object, const Changed_faces& changed) { detection_->rebuild(checked(object), changed); }

  /// What has been built of an object, as bytes to keep, for `load`: its tree, or its partition, particles and tree. It
  /// is built first if it has not been, as `detect` would. Same bytes for the same mesh and options. O(V + F).
  /// @throws Bad_argument  no such object
  /// @throws Bad_mesh      as `detect`
  /// @throws Broken_bound  as `detect`
  std::vector<std::byte> save(Object_id object) {
    State_writer state;
    detection_->save(checked(object), state);
    return seal_saved(state.take());
  }
  /// Takes what was saved of an object with the same faces, in mode `exact` also with the same `file_vertex`, by a
  /// detector of the same mode, in place of building it.
  /// Positions may be others than when it was saved. It has the regions, particles and leaves with which it was saved,
  /// whatever the options say; they count when it is built anew. O(V + F).
  /// @throws Bad_argument      no such object
  /// @throws Bad_saved_object  the bytes are broken, or from another mode, mesh or format, or a tolerance within
  ///                           objects needs positions at rest, with which they were not saved; the object stays as it
  ///                           was
  void load(Object_id object, std::span<const std::byte> saved) {
    State_reader state(open_saved(saved));
    detection_->load(checked(object), state);
  }

  /// Removes an object. The others keep their ids, and no object is given this one again. Afterwards the detector
  /// refers to its mesh no more; `v:region` and `v:particle` stay on it as they are. O(n log n) for its n ignored
  /// pairs.
  /// @throws Bad_argument  no such object
  void remove(Object_id object) {
    detection_->remove(checked(object));
    filter_.remove(object);
    const auto entry = objects_of_.find(std::exchange(meshes_[object], nullptr));
    if (--entry->second == 0) objects_of_.erase(entry);
  }
  /// Whether there is an object with this id: it has been added, and not removed.
  bool has(Object_id object) const { return object < meshes_.size() && meshes_[object] != nullptr; }

  /// Excludes a pair of objects, or includes it again with `ignored` = false; a = b: collisions of a with itself.
  /// @throws Bad_argument  no such object
  void ignore(Object_id a, Object_id b, bool ignored = true) { filter_.ignore({checked(a), checked(b)}, ignored); }

  /// Finds the collisions between all objects where their vertices are now. The first call, and any call after an
  /// `add`, builds the new objects.
  /// @return valid until the next call, and as long as the detector
  /// @throws Bad_mesh      a coordinate that is read is not finite; a mesh has another number of vertices or faces than
  ///                       when it was added or rebuilt; in modes with particles, when an object is built: a coordinate
  ///                       beyond 1e150, or edges shorter than 1e-150 on average
  /// @throws Bad_argument  a strategy cannot divide a surface, or a promise does not fit its object
  /// @throws Broken_bound  mode `certified` with `Exact_options::throw_if_broken`; so does every query
  const Frame& detect() { return detection_->detect(filter_); }
  /// The same for a single pair, in mode `exact`; a = b: collisions of a with itself. Reads only these two. The frame
  /// has no pair if groups or `ignore` leave this one out.
  /// @throws Bad_argument  no such object, another mode
  const Frame& detect(Object_id a, Object_id b) {
    return ask<Exact>("detect of a pair", a, b).detect(filter_, {std::min(a, b), std::max(a, b)});
  }

  /// Shows the contacts of two objects to a visitor, which may stop the walk: see `visit_contacts`. Mode `exact`, with
  /// its tolerance; caps and collision filters do not apply. The visitor must neither call the detector nor move
  /// vertices.
  /// @throws Bad_argument  no such object, one and the same, another mode
  /// @throws Bad_mesh      as `detect`
  template <Contact_visitor Visitor>
  Visit visit(Object_id a, Object_id b, Visitor&& visitor) {
    return ask_two("visit", a, b).visit({a, b}, std::forward<Visitor>(visitor));
  }
  /// Where two objects are closest, in mode `exact`.
  /// @throws Bad_argument  no such object, one and the same, another mode
  /// @throws Bad_mesh      as `detect`
  Closest_faces closest(Object_id a, Object_id b) {
    return ask_two("closest", a, b).closest({a, b});
  }
  /// When two objects meet first if every vertex moves on a straight line, from where it is now at t = 0 to where it
  /// will be at t = 1, in mode `exact`: see `first_impact` of trees. Reads all of both. None if they do not meet.
  /// @param end_a, end_b   V x 3, one row per vertex in the order of `vertices(mesh)`; no placement is applied to them
  /// @throws Bad_argument  no such object, one and the same, another mode
  /// @throws Bad_mesh      as `detect`; another number of rows than vertices, a coordinate that is not finite
  std::optional<Impact> first_impact(Object_id a, const Eigen::Ref<const Positions>& end_a, Object_id b,
                                     const Eigen::Ref<const Positions>& end_b) {
    return ask_two("first_impact", a, b, ", unlike first_self_impact,").first_impact({a, b}, end_a, end_b);
  }
  /// When two faces of one object that share no vertex meet first, in mode `exact`: see `first_self_impact` of trees.
  /// Everything else is as in the other call.
  /// @throws Bad_argument  no such object, another mode
  /// @throws Bad_mesh      as the other call
  std::optional<Impact> first_self_impact(Object_id object, const Eigen::Ref<const Positions>& end) {
    return ask<Exact>("first_self_impact", object).first_self_impact(object, end);
  }
  /// The earliest impact of any two objects, with what `detect` leaves out left out, in mode `exact`; with
  /// `Exact_options::self_collision` also of any object with itself: see `first_self_impact`. Of several pairs at
  /// exactly the same time it is that of the lowest ids.
  /// @param ends           per object, by id: as in the other call; without rows, the object stays where it is
  /// @throws Bad_argument  another mode; not one entry per id, of removed objects too
  /// @throws Bad_mesh      as the other call
  std::optional<Object_impact> first_impact(std::span<const Positions> ends) {
    return ask<Exact>("first_impact").first_impact(filter_, ends);
  }
  /// The first impact of each pair of objects that meet, with what `detect` leaves out left out, in mode `exact`. With
  /// `Exact_options::self_collision` each object is also paired with itself: see `first_self_impact`. Reads each object
  /// once; pairs whose boxes around the whole motion are apart cost nothing, the others are shared among the threads.
  /// @param ends           as in the other call
  /// @return in the order of the pairs; valid as long as you keep it
  /// @throws Bad_argument, Bad_mesh  as the other call
  std::vector<Object_impact> first_impacts(std::span<const Positions> ends) {
    return ask<Exact>("first_impacts").first_impacts(filter_, ends);
  }
  /// Whether two objects have points nearer to each other than a distance, or collide, in mode `exact`. Exact and
  /// strict, unlike a comparison with the rounded distance of `closest`; mostly faster than that, too.
  /// @param distance  >= 0, in units of the coordinates; 0: whether they collide
  /// @throws Bad_argument, Bad_mesh  as `closest`; a distance that is negative or not finite
  bool within(Object_id a, Object_id b, double distance) {
    auto& exact = ask_two("within", a, b);
    if (!(distance >= 0) || !std::isfinite(distance)) throw Bad_argument("the distance must be finite and >= 0");
    return exact.within({a, b}, distance);
  }
  /// Whether the surface of `inner` lies inside that of `outer`, which is closed, in mode `exact`: see `encloses`.
  /// @throws Bad_argument, Bad_mesh  as `closest`
  bool contains(Object_id outer, Object_id inner) {
    return ask_two("contains", outer, inner).contains(outer, inner);
  }
  /// The first face of an object that a ray meets, in mode `exact` or `certified`: see `first_hit` of trees. In mode
  /// `certified` an object with bounds is posed only where the ray passes. While positions are held, many rays one by one
  /// get a Ray_tree as soon as that saves time, as in `first_hits`.
  /// @throws Bad_argument  no such object, another mode, a ray that is not as `Ray` says
  /// @throws Bad_mesh      as `detect`
  std::optional<Ray_hit> first_hit(Object_id object, const Ray& ray) {
    return ask_rays("first_hit", object, [&](auto& asked) { return lodestone::first_hit(asked, ray); });
  }
  /// All faces of an object that a ray meets, in their order along it.
  /// @throws Bad_argument, Bad_mesh  as `first_hit`
  std::vector<Ray_hit> all_hits(Object_id object, const Ray& ray) {
    return ask_rays("all_hits", object, [&](auto& asked) { return lodestone::all_hits(asked, ray); });
  }
  /// The face of an object that is nearest to a point: see `closest_point` of trees.
  /// @throws Bad_argument, Bad_mesh  as `first_hit`
  Closest_point closest_point(Object_id object, const Point& point) {
    return ask_surface("closest_point", object,
                       [&](auto& surface) { return lodestone::closest_point(surface, point); });
  }
  /// On which side of an object's surface, which is closed, a point is: see `point_side`.
  /// @throws Bad_argument, Bad_mesh  as `first_hit`
  Point_side point_side(Object_id object, const Point& point) {
    return ask_surface("point_side", object, [&](auto& surface) { return lodestone::point_side(surface, point); });
  }

  /// `first_hit` of many rays. Each query of an object reads its positions first; this does so once for all rays.
  /// Shared among the threads. In mode `certified` up to F / 64 rays of an object with bounds are not: they pose only
  /// what they pass. More of them pose it as a whole.
  ///
  /// Calls with more than F / 64 rays are answered sooner once they have asked about F / 16 rays together: the detector
  /// then makes a Ray_tree. It keeps the tree, which takes some 70 bytes per face, and refits it in later calls.
  /// @return one per ray, in their order
  /// @throws Bad_argument, Bad_mesh  as `first_hit`
  std::vector<std::optional<Ray_hit>> first_hits(Object_id object, std::span<const Ray> rays) {
    return ask<Exact>("first_hits", object).first_hits(object, rays);
  }
  /// The first face of any object that a ray meets, with its object, in mode `exact` or `certified`. Exact: of several
  /// faces at the same t, that of the lowest object, and of this the lowest. Groups and ignored pairs do not count.
  /// Reads the positions of all objects: many rays at once are faster.
  /// @throws Bad_argument  another mode, a ray that is not as `Ray` says
  /// @throws Bad_mesh      as `detect`
  std::optional<Object_hit> first_hit(const Ray& ray) {
    auto& exact = ask<Exact>("first_hit");
    return exact.first_hits(exact.ids(), {&ray, 1}).front();
  }
  /// The same among some objects, whose positions alone are read.
  /// @param objects        in any order
  /// @throws Bad_argument, Bad_mesh  as the other call; no such object
  std::optional<Object_hit> first_hit(std::span<const Object_id> objects, const Ray& ray) {
    return ask<Exact>("first_hit").first_hits(sorted(objects), {&ray, 1}).front();
  }
  /// The same for many rays. An object is asked about the rays that reach its box, as in the call for one object: see
  /// `first_hits_among`.
  /// @return one per ray, in their order
  /// @throws Bad_argument, Bad_mesh  as `first_hit`
  std::vector<std::optional<Object_hit>> first_hits(std::span<const Ray> rays) {
    auto& exact = ask<Exact>("first_hits");
    return exact.first_hits(exact.ids(), rays);
  }
  /// The same among some objects.
  /// @throws Bad_argument, Bad_mesh  as `first_hit`
  std::vector<std::optional<Object_hit>> first_hits(std::span<const Object_id> objects, std::span<const Ray> rays) {
    return ask<Exact>("first_hits").first_hits(sorted(objects), rays);
  }
  /// An object where it is now, prepared for rays that are asked about one by one: see Ray_tree. It reads positions in
  /// place. It is valid until the next query of the object. While positions are held, queries leave it valid; the first
  /// one after that does not. It is of no use once the object is moved, given positions or a promise, placed, rebuilt,
  /// loaded or removed, or once the mesh moves its memory. The detector keeps it, and refits it when it is asked for
  /// again. In mode `certified` an object with bounds is posed as a whole.
  /// @throws Bad_argument, Bad_mesh  as `first_hit`
  const Ray_tree& ray_tree(Object_id object)
    requires std::same_as<Volume, Aabb>
  {
    return ask<Exact>("ray_tree", object).ray_tree(object);
  }
  /// `closest_point` of many points: see `first_hits`.
  std::vector<Closest_point> closest_points(Object_id object, std::span<const Point> points) {
    return ask_each("closest_points", object, points,
                    [](auto& surface, const Point& point) { return lodestone::closest_point(surface, point); });
  }
  /// `point_side` of many points: see `first_hits`.
  std::vector<Point_side> point_sides(Object_id object, std::span<const Point> points) {
    return ask_each("point_sides", object, points,
                    [](auto& surface, const Point& point) { return lodestone::point_side(surface, point); });
  }

  /// A short translation of a that parts it from b, or whose opposite parts b from a: afterwards they do not collide,
  /// and neither lies inside the other, in mode `exact`: see `parting`. None if this holds already.
  /// @throws Bad_argument, Bad_mesh  as `closest`
  std::optional<Parting> parting(Object_id a, Object_id b) {
    return ask_two("parting", a, b).parting({a, b});
  }

  /// Promises something about how an object moves, in mode `certified`: see Motion_promise. The promise must outlive
  /// the object, or the detector; it may change between frames. It is about the positions of the mesh: `place` is
  /// known to the detector, and an object with positions from `update` is read as a whole. The positions of the mesh in
  /// the next query, of whichever objects, are those at rest, unless an earlier promise about this object has set them.
  /// Several promises hold together. Computed points with joints, morph targets or other bounds of their own need no
  /// promise.
  ///
  /// The bound is made in the next query. If the promise does not fit the object, say with displacements for other
  /// regions than it has, that query throws Bad_argument, and the promise is dropped.
  /// @throws Bad_argument  no such object, another mode
  template <Motion_promise Promise>
  void promise(Object_id object, const Promise& promise) {
    const auto make = [&promise](const Bounded_object& bounded) -> std::unique_ptr<Node_bound> {
      auto bound = promise.bound(bounded);
      return std::make_unique<Node_bound_of<decltype(bound)>>(std::move(bound));
    };
    checked(object);
    auto* exact = dynamic_cast<Exact*>(detection_.get());
    if (exact == nullptr) throw Bad_argument("promise needs the mode certified");
    exact->promise(object, make);
  }
  template <Motion_promise Promise>
  void promise(Object_id object, const Promise&& promise) = delete;
  /// What the last query knew of an object in mode `certified`: which leaves of its tree it has bounded, and which it
  /// has posed. Null before the first query, and in mode `exact`.
  /// @throws Bad_argument  no such object, another mode
  const Bounded_surface* bounded(Object_id object) const { return ask<Exact>("bounded", object).bounded(object); }

  /// Number of objects added, removed ones included: every id is below it.
  std::size_t size() const { return meshes_.size(); }
  /// V: the region of each vertex of an object, as of its last partition; 0 where the mode makes no regions.
  /// @throws Bad_argument  no such object, or one that no query has built yet
  std::vector<Region_index> regions(Object_id object) const {
    auto labels = detection_->labels(checked(object));
    if (labels.empty())
      throw Bad_argument("object " + std::to_string(object) + " has no regions before the first query");
    return labels;
  }
  /// The state of one object in a mode with particles: regions, particles, patches. Valid until it is rebuilt.
  /// @throws Bad_argument  no such object, another mode
  const Particle_object& object(Object_id object) const {
    return ask<Particle_detection>("object", object).object(object);
  }
  /// The tree of one object in mode `exact`, empty before the first query. Its volumes are those of the last query that
  /// the object was part of. It holds no positions, so it cannot answer what depends on them.
  /// @throws Bad_argument  no such object, another mode
  const Basic_region_tree<Volume>& tree(Object_id object) const { return ask<Exact>("tree", object).tree(object); }
  /// The property maps of an object. `rebuild` invalidates copies of them.
  /// @tparam Mesh          the type of its mesh
  /// @throws Bad_argument  no such object, one of another type, or one whose mesh was added as const or with a point
  ///                       map
  template <Triangle_mesh Mesh = Surface_mesh>
  const Region_maps<Mesh>& maps(Object_id object) const {
    const auto* mesh = dynamic_cast<const Watched_mesh_of<Mesh>*>(&detection_->mesh(checked(object)));
    if (mesh == nullptr) throw Bad_argument("the mesh of object " + std::to_string(object) + " is of another type");
    if (!mesh->maps()) throw Bad_argument("object " + std::to_string(object) + " carries no property maps");
    return *mesh->maps();
  }

 private:
  using Exact = Exact_detection<Volume>;

  /// A strategy that shares work among threads takes those of the detector, unless it asks for another number than 1.
  static Strategy with_threads(Strategy strategy, std::size_t threads) {
    if constexpr (requires { { strategy.options.threads } -> std::same_as<std::size_t&>; })
      if (strategy.options.threads == 1) strategy.options.threads = threads;
    if constexpr (requires { { strategy.options.lbg.threads } -> std::same_as<std::size_t&>; })
      if (strategy.options.lbg.threads == 1) strategy.options.lbg.threads = threads;
    return strategy;
  }

  void check_new(const void* mesh) const {
    const auto entry = objects_of_.find(mesh);
    if (entry != objects_of_.end() && entry->second > 0) throw Bad_argument("the mesh has been added before");
  }
  template <class Mesh, class Points>
  auto watch(const Mesh& mesh, Points points, Workers& workers) const {
    return std::make_unique<Typed_watched_mesh<Mesh, Points, Strategy>>(mesh, std::move(points), strategy_, workers);
  }
  /// Adds an object to all that lists objects, or to nothing.
  template <class Watch>
  Object_id add_watched(const void* mesh, const Watch& watch, const Object_options& options) {
    if (meshes_.size() == meshes_.capacity()) meshes_.reserve(2 * meshes_.size() + 1);
    filter_.add(options);
    const auto entry = [&] {
      try {
        const auto added = objects_of_.try_emplace(mesh, 0).first;
        detection_->add(watch, options);
        return added;
      } catch (...) {
        if (const auto left = objects_of_.find(mesh); left != objects_of_.end() && left->second == 0)
          objects_of_.erase(left);
        filter_.take_back();
        throw;
      }
    }();
    meshes_.push_back(mesh);
    ++entry->second;
    return static_cast<Object_id>(meshes_.size() - 1);
  }

  Object_id checked(Object_id object) const {
    if (has(object)) return object;
    if (object < meshes_.size()) throw Bad_argument("object " + std::to_string(object) + " has been removed");
    throw Bad_argument("there is no object " + std::to_string(object));
  }
  /// Ascending, each once.
  std::vector<Object_id> sorted(std::span<const Object_id> objects) const {
    std::vector<Object_id> ids;
    for (const auto object : objects) ids.push_back(checked(object));
    std::ranges::sort(ids);
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
  }
  /// The mode, for a question about objects that only `Model` answers.
  /// @throws Bad_argument  no such object, another mode
  template <class Model, class... Ids>
  Model& ask(const char* question, Ids... objects) const {
    (checked(objects), ...);
    if (auto* model = dynamic_cast<Model*>(detection_.get())) return *model;
    throw Bad_argument(std::string(question) + Model::needed);
  }
  /// The mode, for a question about two objects that must not be the same.
  /// @throws Bad_argument  no such object, the same twice, another mode
  Exact& ask_two(const char* question, Object_id a, Object_id b, const char* unlike = "") const {
    auto& exact = ask<Exact>(question, a, b);
    if (a != b) return exact;
    throw Bad_argument(std::string(question) + unlike + " needs two different objects, but both are object " +
                       std::to_string(a));
  }
  template <class Question>
  auto ask_surface(const char* name, Object_id object, const Question& question) {
    return ask<Exact>(name, object).of_surface(object, question);
  }
  template <class Question>
  auto ask_rays(const char* name, Object_id object, const Question& question) {
    return ask<Exact>(name, object).of_rays(object, question);
  }

  template <class Asked, class Question>
  auto ask_each(const char* name, Object_id object, std::span<const Asked> asked, const Question& question) {
    auto& exact = ask<Exact>(name, object);
    const auto ask_all = [&](auto& surface) { return lodestone::ask_each(surface, asked, question, exact.workers()); };
    return exact.of_surface(object, ask_all, asked.size());
  }

  std::shared_ptr<const Strategy> strategy_;
  std::unique_ptr<Detection> detection_;
  Collision_filter filter_;
  std::vector<const void*> meshes_;                          ///< null: the object has been removed
  std::unordered_map<const void*, std::size_t> objects_of_;  ///< per mesh: how many objects have it
};

// The library holds what a detector of Surface_mesh needs: a file that uses one does not compile it again.
extern template class Exact_objects<Aabb>;
extern template class Exact_pairs<Aabb>;
extern template class Exact_detection<Aabb>;
extern template std::unique_ptr<Detection> make_detection<Aabb>(const Detector_options&);
extern template class Typed_watched_mesh<Surface_mesh, Own_points<Surface_mesh>, Lbg>;
extern template class Typed_watched_mesh<Surface_mesh, Own_points<Surface_mesh>, Any_strategy>;
extern template class Typed_watched_mesh<Indexed_mesh, Indexed_points, Lbg>;
extern template class Typed_watched_mesh<Indexed_mesh, Indexed_points, Any_strategy>;
extern template class Detector<Lbg>;
extern template class Detector<Any_strategy>;

/// A detector in whose mode `exact` the trees have volumes of another kind.
template <Bounding_volume Volume, class Strategy = Lbg>
using Volume_detector = Detector<Strategy, Volume>;

}  // namespace lodestone
