// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "lodestone/detection/exact_object.h"
#include "lodestone/detection/frame.h"
#include "lodestone/detection/held_positions.h"
#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/scaled_positions.h"
#include "lodestone/mesh/side_by_side.h"
#include "lodestone/mesh/stopwatch.h"

namespace lodestone {

/// The objects of the modes `exact` and `certified`, whose trees follow their meshes: built once, refitted in every
/// frame, rebuilt where they have become loose. In mode `certified` an object with bounds is not refitted: its nodes
/// are bounded, and its leaves posed, when a query looks at them.
template <Bounding_volume Volume>
class Exact_objects {
 public:
  using Object = Exact_object<Volume>;         ///< what is kept of an object
  using Surface = Basic_tree_surface<Volume>;  ///< of an object

  /// @param workers  must outlive this
  Exact_objects(const Detector_options& options, Workers& workers) : options_(options), workers_(workers) {}

  /// Adds an object, whose tree is built by the next `refresh`.
  /// @throws Bad_mesh, Bad_argument  nothing has been added
  void add(const Watch_mesh& watch, const Object_options& options) {
    timed(work_.seconds.build, [&] {
      ids_.push_back(size());
      try {
        objects_.push_back(std::make_unique<Object>(ids_.back(), watch(workers_), options));
        awaiting_rest_.push_back(ids_.back());
      } catch (...) {
        objects_.resize(ids_.back());
        ids_.pop_back();
        throw;
      }
    });
  }
  /// Reads the faces of the mesh anew.
  /// @throws Bad_mesh, Bad_argument  the object stays as it was
  void rebuild(Object_id id, std::span<const std::uint32_t> file_vertex) {
    awaiting_rest_.push_back(id);
    timed(work_.seconds.build, [&] { objects_[id]->rebuild(file_vertex, workers_); });
  }
  /// The same where it is known which faces have changed.
  void rebuild(Object_id id, const Changed_faces& changed) {
    awaiting_rest_.push_back(id);
    timed(work_.seconds.build, [&] { objects_[id]->rebuild(changed, workers_); });
  }

  /// Writes what was built of an object, which is built first if it has not been.
  /// @throws Bad_mesh      as `refresh`
  /// @throws Broken_bound  as `throw_if_broken`
  void save(Object_id id, State_writer& state);
  /// Takes what was saved of an object with the same faces.
  /// @throws Bad_saved_object  the object stays as it was
  void load(Object_id id, State_reader& state) {
    timed(work_.seconds.build, [&] { objects_[id]->load(state, options_.exact.self_tolerance > 0); });
  }

  /// The promises that positions stay as they are.
  const std::shared_ptr<Position_hold>& hold() const { return hold_; }

  /// Promises something about the motion of an object. The next query, of whichever objects, finds it at rest.
  void promise(Object_id id, Make_bound make) {
    awaiting_rest_.push_back(id);
    objects_[id]->promise(std::move(make));
  }

  /// Forgets an object. O(objects).
  void remove(Object_id id) {
    objects_[id].reset();
    ids_.erase(std::ranges::lower_bound(ids_, id));
  }

  /// Objects added, removed ones included.
  Object_id size() const { return static_cast<Object_id>(objects_.size()); }
  /// The objects that have not been removed, ascending. All other calls are about such objects.
  std::span<const Object_id> ids() const { return ids_; }
  /// An object by its id.
  Object& operator[](Object_id id) { return *objects_[id]; }
  /// The same, not to be changed.
  const Object& operator[](Object_id id) const { return *objects_[id]; }
  /// The surface of an object.
  const Surface& surface(Object_id id) const { return objects_[id]->surface; }
  /// In mode `certified`: the surface as one that is bounded.
  Bounded_surface& bounded(Object_id id) const { return *objects_[id]->bounded(); }
  /// A box around an object: fitted, or from its bounds. Finite.
  Aabb box(Object_id id);
  /// Whether objects can have bounds.
  static constexpr bool can_have_bounds = std::same_as<Volume, Aabb>;
  /// Whether an object is posed only where it is looked at.
  bool on_demand(Object_id id) const { return objects_[id]->on_demand(); }
  /// Whether one of two objects is.
  bool on_demand(Object_pair pair) const { return on_demand(pair.a) || on_demand(pair.b); }
  /// Poses and refits all of an object.
  /// @throws Bad_mesh  a coordinate is not finite
  void pose_all(Object_id id) {
    if (on_demand(id)) timed(work_.seconds.refit, [&] { bounded(id).pose_all(); });
  }
  /// Poses and refits all of several objects, for a question that must read everything.
  /// @throws Bad_mesh      a coordinate is not finite
  /// @throws Broken_bound  as `throw_if_broken`; the call for one object does not
  void pose_all(std::span<const Object_id> ids) {
    for (const auto id : ids) pose_all(id);
    throw_if_broken(ids);
  }

  /// Calls `answer`, which finds an answer about these objects. If it relied on a broken bound, the object is posed as
  /// a whole, and `answer` is called again. Each repetition settles an object, so there are few.
  /// @param answer         called without arguments
  /// @throws Broken_bound  as `throw_if_broken`
  template <class Answer>
  void until_settled(std::span<const Object_id> ids, Answer answer);
  /// Throws if a bound of one of these objects is broken, and the options ask for an error. Such objects forget their
  /// pose: the next question asks their bounds anew.
  /// @throws Broken_bound  names the first of them
  void throw_if_broken(std::span<const Object_id> ids) const;

  /// Brings everything that depends on positions to where the vertices of these objects are now. Positions that are
  /// held are read once.
  /// @throws Bad_mesh  a coordinate is not finite; a mesh has changed since it was numbered
  void refresh(std::span<const Object_id> ids);

  /// What has been bounded and posed so far of these objects, in their current poses.
  Frame_statistics work_on_demand(std::span<const Object_id> ids) const;
  /// What has been done since the last frame: times, builds, repartitions. Of the refits, only the last counts.
  const Frame_statistics& work() const { return work_; }
  /// Called when a frame has told this work. A frame that fails does not call it, so the next one tells its work too.
  void forget_work() { work_ = {}; }

 private:
  void start_on_demand(std::span<const Object_id> ids);
  void take_awaited_rest();
  void refresh_whole();
  void refit_built(std::span<const Object_id> ids);
  void build_new(std::span<const Object_id> ids);
  bool keeps_tree(Object_id id) const;
  void rebuild_loose(std::span<const Object_id> ids);
  void bound_refitted(std::span<const Object_id> ids);
  void build(std::span<const Object_id> ids, std::span<const Coordinates> coordinates);
  /// How many regions are asked for; 0: none.
  std::size_t region_count(const Object& object) const {
    return object.particles > 0 ? object.particles : options_.particles;
  }
  std::optional<Numbered_partition> divide(Object& object, Coordinates coordinates) const;

  Detector_options options_;
  Workers& workers_;
  std::vector<std::unique_ptr<Object>> objects_;  ///< null: removed
  std::vector<Object_id> ids_;                    ///< of the others
  std::vector<Object_id> awaiting_rest_;          ///< those that may await their positions at rest
  Frame_statistics work_;
  std::shared_ptr<Position_hold> hold_ = std::make_shared<Position_hold>();

  // Memory, kept from frame to frame.
  std::vector<Object_id> whole_;  ///< those that are posed as a whole
  std::vector<Surface*> surfaces_;
  std::vector<Coordinates> coordinates_;
};

template <Bounding_volume Volume>
void Exact_objects<Volume>::refresh(std::span<const Object_id> ids) {
  work_.seconds.refit = 0;
  work_.vertices_read = work_.violations = 0;
  whole_.clear();
  if (!awaiting_rest_.empty()) timed(work_.seconds.build, [&] { take_awaited_rest(); });
  for (const auto id : ids) {
    if (objects_[id]->is_refreshed(hold_->number())) {
      objects_[id]->begin_query_of_refreshed();
      continue;
    }
    objects_[id]->begin_query();
    if (!on_demand(id)) whole_.push_back(id);
  }
  start_on_demand(ids);
  if (!whole_.empty()) refresh_whole();  // to look at the clock would be a good part of a query for one ray
  for (const auto id : ids) objects_[id]->note_refreshed(hold_->number());
}

template <Bounding_volume Volume>
void Exact_objects<Volume>::refresh_whole() {
  for (const auto id : whole_) work_.vertices_read += objects_[id]->mesh().vertex_count();
  // Refitted first: a tree that is built now holds the current positions.
  timed(work_.seconds.refit, [&] { refit_built(whole_); });
  build_new(whole_);
  // Not before all positions are known to be finite: those of a mended object may be taken a frame later.
  if (options_.exact.self_tolerance > 0)
    timed(work_.seconds.build, [&] {
      for (const auto id : whole_) objects_[id]->keep_rest();
    });
  rebuild_loose(whole_);
  if (options_.mode == Mode::certified) bound_refitted(whole_);
}

/// Also of objects that the query is not about: a promise must not depend on whom the caller asks about first.
template <Bounding_volume Volume>
void Exact_objects<Volume>::take_awaited_rest() {
  if (options_.mode != Mode::certified) return awaiting_rest_.clear();
  std::erase_if(awaiting_rest_, [this](Object_id id) {
    if (objects_[id] && objects_[id]->awaits_rest()) objects_[id]->take_awaited_rest();
    return !objects_[id] || !objects_[id]->awaits_rest();
  });
}

template <Bounding_volume Volume>
Aabb Exact_objects<Volume>::box(Object_id id) {
  if constexpr (std::same_as<Volume, Aabb>)
    if (on_demand(id)) {
      Bounded_surface& surface = bounded(id);
      if (!std::isfinite(surface.box(0).extent())) surface.pose_all();
      // The box of a broken bound can be empty, and then nobody would look at the object.
      if (surface.is_broken() && !options_.exact.throw_if_broken) surface.settle();
      return surface.box(0);
    }
  return surface(id).tree().volume(0).bounds();
}

template <Bounding_volume Volume>
void Exact_objects<Volume>::start_on_demand(std::span<const Object_id> ids) {
  for (const auto id : ids) {
    if (!on_demand(id)) continue;
    objects_[id]->mesh().check_connectivity(objects_[id]->title());
    bounded(id).start_frame();
  }
}

/// Objects that have just been refitted get their bounds, or take the fitted boxes.
template <Bounding_volume Volume>
void Exact_objects<Volume>::bound_refitted(std::span<const Object_id> ids) {
  for (const auto id : ids) {
    if (objects_[id]->bounded() == nullptr)
      timed(work_.seconds.build, [&] { objects_[id]->make_bounds(options_.exact.throw_if_broken, workers_); });
    else
      timed(work_.seconds.refit, [&] { bounded(id).take_refitted(); });
    if (on_demand(id)) work_.violations += bounded(id).violations();  // frames compare with what is counted from here on
  }
}

template <Bounding_volume Volume>
Frame_statistics Exact_objects<Volume>::work_on_demand(std::span<const Object_id> ids) const {
  Frame_statistics sum;
  for (const auto id : ids) {
    if (!on_demand(id)) continue;
    const Bounded_surface& surface = bounded(id);
    sum.vertices_read += surface.vertices_posed();
    sum.nodes_bounded += surface.nodes_bounded();
    sum.leaves_posed += surface.leaves_posed();
    sum.violations += surface.violations();
  }
  return sum;
}

template <Bounding_volume Volume>
template <class Answer>
void Exact_objects<Volume>::until_settled(std::span<const Object_id> ids, Answer answer) {
  std::size_t before;
  do {
    before = work_on_demand(ids).violations;
    answer();
    throw_if_broken(ids);
    for (const auto id : ids)
      if (on_demand(id) && bounded(id).is_broken()) bounded(id).settle();
  } while (work_on_demand(ids).violations > before);
}

template <Bounding_volume Volume>
void Exact_objects<Volume>::throw_if_broken(std::span<const Object_id> ids) const {
  if (!options_.exact.throw_if_broken) return;
  std::optional<Object_id> broken;
  for (const auto id : ids) {
    if (!on_demand(id) || bounded(id).violations() == 0) continue;
    bounded(id).forget_pose();  // by the next question its promise may have been corrected
    if (!broken) broken = id;
  }
  if (broken) throw Broken_bound(objects_[*broken]->title() + " has vertices that are not where its bounds say");
}

template <Bounding_volume Volume>
void Exact_objects<Volume>::save(Object_id id, State_writer& state) {
  const Object_id ids[] = {id};
  refresh(ids);
  pose_all(ids);
  objects_[id]->save(state);
}

template <Bounding_volume Volume>
void Exact_objects<Volume>::refit_built(std::span<const Object_id> ids) {
  surfaces_.clear();
  coordinates_.clear();
  for (const auto id : ids) {
    if (!objects_[id]->built) continue;
    surfaces_.push_back(&objects_[id]->surface);
    coordinates_.push_back(objects_[id]->read());
  }
  refit<Volume>(surfaces_, coordinates_, workers_);
  for (const auto id : ids) {
    if (!objects_[id]->built) continue;
    if (!surface(id).finite()) check_finite(surface(id).coordinates(), objects_[id]->title());
    check_finite(surface(id).coordinates(), objects_[id]->unused(), objects_[id]->title());
  }
}

template <Bounding_volume Volume>
void Exact_objects<Volume>::build_new(std::span<const Object_id> ids) {
  std::vector<Object_id> fresh;
  for (const auto id : ids)
    if (!objects_[id]->built) fresh.push_back(id);
  if (fresh.empty()) return;
  timed(work_.seconds.build, [&] {
    std::vector<Coordinates> coordinates;
    for (const auto id : fresh) coordinates.push_back(objects_[id]->read());
    build(fresh, coordinates);
  });
  work_.builds += fresh.size();
  // A mended tree has looked at the vertices of its faces only.
  for (const auto id : fresh) check_finite(surface(id).coordinates(), objects_[id]->unused(), objects_[id]->title());
}

/// Whether an object keeps its tree and its regions: bounds are about the tree's nodes, and promises, also those of
/// which no bound has been made yet, are about the regions that the caller has seen.
template <Bounding_volume Volume>
bool Exact_objects<Volume>::keeps_tree(Object_id id) const {
  const Object& object = *objects_[id];
  const bool has_bounds = object.bounded() != nullptr && object.bounded()->has_bounds();
  return has_bounds || (options_.mode == Mode::certified && object.is_promised());
}

/// New trees for objects whose leaves have grown too much in comparison with the whole.
template <Bounding_volume Volume>
void Exact_objects<Volume>::rebuild_loose(std::span<const Object_id> ids) {
  std::vector<Object_id> loose;
  std::vector<Coordinates> coordinates;
  for (const auto id : ids) {
    if (keeps_tree(id) || !surface(id).looser_than(options_.exact.loosest)) continue;
    loose.push_back(id);
    coordinates.push_back(surface(id).coordinates());
  }
  if (loose.empty()) return;
  timed(work_.seconds.repartition, [&] { build(loose, coordinates); });
  work_.repartitions += loose.size();
}

/// Mends the trees of objects of which some faces have changed, and builds those of others, over regions if they are
/// asked for. What calls the user's code, to write maps, or to divide a surface by a strategy that is not concurrent,
/// is done in this thread.
template <Bounding_volume Volume>
void Exact_objects<Volume>::build(std::span<const Object_id> ids, std::span<const Coordinates> coordinates) {
  struct Build {
    Object* object;
    Coordinates coordinates;
    std::optional<Numbered_partition> regions = {};
  };
  std::vector<Build> builds;
  std::vector<std::size_t> faces;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    Object& object = *objects_[ids[i]];
    if (region_count(object) == 0 && object.mend(coordinates[i], options_.tree, workers_)) continue;
    check_finite(coordinates[i], object.title());
    builds.push_back({&object, coordinates[i]});
    faces.push_back(object.corners().size());
  }
  // All are divided before the first is built: where a strategy refuses a surface, nothing has changed.
  const auto divide_if = [&](Build& build, bool concurrent) {
    if (build.object->mesh().divides_concurrently() == concurrent)
      build.regions = divide(*build.object, build.coordinates);
  };
  for (Build& build : builds) divide_if(build, false);
  workers_.run(builds.size(), [&](std::size_t i, std::size_t) { divide_if(builds[i], true); });
  constexpr std::size_t shared_well = 131072;  // faces per worker from which on building a tree is shared well
  side_by_side(
      faces, workers_,
      [&](std::size_t i, Workers& workers) {
        builds[i].object->build(std::move(builds[i].regions), builds[i].coordinates, options_.tree, workers);
      },
      shared_well * workers_.count());
  for (const auto& build : builds) build.object->finish();
}

/// @return none if no regions are asked for
template <Bounding_volume Volume>
std::optional<Numbered_partition> Exact_objects<Volume>::divide(Object& object, Coordinates coordinates) const {
  const std::size_t regions = region_count(object);
  if (regions == 0) return std::nullopt;
  Watched_mesh& mesh = object.mesh();
  const Vertex_graph graph = vertex_graph(mesh.vertex_count(), mesh.corners());
  const Positions positions = positions_in_range(coordinates);
  try {
    return mesh.partition({graph, positions, mesh.corners()}, regions, options_.partition);
  } catch (const Bad_argument& error) {
    throw Bad_argument(object.title() + ": " + error.what());
  }
}

}  // namespace lodestone
