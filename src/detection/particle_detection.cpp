// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/particle_detection.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lodestone/mesh/arithmetic.h"
#include "lodestone/mesh/side_by_side.h"
#include "lodestone/mesh/stopwatch.h"

namespace lodestone {

namespace {

double radius_of(const Particle_object& object, const Positions& positions) {
  return bounding_sphere(positions, object.corners()).radius;
}

}  // namespace

void Particle_detection::add(const Watch_mesh& watch, const Object_options& options) {
  Busy::check(busy_);
  const auto id = static_cast<Object_id>(objects_.size());
  timed(since_last_frame_.seconds.build,
        [&] { objects_.push_back(std::make_unique<Object>(id, watch(workers_), options)); });
}

void Particle_detection::update(Object_id id) {
  const Busy busy(busy_);
  Object& object = *objects_[id];
  if (options_.mode != Mode::particles) return;
  check_arithmetic();
  if (!object.prepared) return;
  timed(since_last_frame_.seconds.repartition, [&] {
    const Region_index checked = object.particle_object.last_checked();
    if (!object.named([&] { return has_outgrown(object.particle_object); })) return;
    Object* const outgrown[] = {&object};
    double& distance = object.particle_object.particles().collision_distance;
    const double radius_before = object.radius, distance_before = distance;
    try {
      measure_new_radii();
      build(outgrown, Seams::keep);
    } catch (...) {
      // The regions are still the old ones, unless memory has run out. A call that is repeated finds it again.
      object.radius = radius_before, distance = distance_before;
      object.particle_object.check_after(checked);
      throw;
    }
    ++since_last_frame_.repartitions;
  });
}

/// With meetings each call looks at an eighth of the regions, unless the whole object was larger in the last frame:
/// radii grow with the stretch of the surface, so a region that has grown unnoticed for some frames costs little.
bool Particle_detection::has_outgrown(Particle_object& object) {
  if (!meets() || object.seemed_larger(options_.growth)) return object.has_outgrown(options_.growth);
  return object.has_outgrown(options_.growth, (object.particles().at.size() + 7) / 8);
}

void Particle_detection::rebuild(Object_id id, std::span<const std::uint32_t> /*file_vertex*/) {
  const Busy busy(busy_);
  timed(since_last_frame_.seconds.build, [&] {
    const Object& old = *objects_[id];
    auto anew = std::make_unique<Object>(id, old.particle_object.mesh().renumbered(workers_), old.options);
    anew->particle_object.place(old.particle_object.placement());
    objects_[id] = std::move(anew);
    meeting_search_.forget(id);
  });
}

Saved_origin Particle_detection::origin(const Object& object) const {
  const bool published = options_.mode == Mode::particles && !meets();
  return {.mode = std::string(name_of(options_.mode)) + (published ? " without meetings" : ""),
          .vertices = object.particle_object.mesh().vertex_count(),
          .corners = object.particle_object.corners()};
}

void Particle_detection::save(Object_id id, State_writer& state) {
  const Busy busy(busy_);
  check_arithmetic();
  prepare();
  Object& object = *objects_[id];
  save_origin(origin(object), state);
  // A detector that loads the object may need it.
  const auto measured = [&] { return radius_of(object.particle_object, object.particle_object.read_positions()); };
  state.value(object.radius > 0 ? object.radius : object.named(measured));
  object.particle_object.save(state);
}

void Particle_detection::load(Object_id id, State_reader& state) {
  const Busy busy(busy_);
  Object& object = *objects_[id];
  timed(since_last_frame_.seconds.build, [&] {
    check_origin(origin(object), title_of(id, object.options), state);
    const double radius = state.finite();
    const bool was_prepared = std::exchange(object.prepared, false);  // if memory runs out, it is built anew
    try {
      object.particle_object.load(state, {.regions = options_.mode != Mode::senin, .meetings = meets()});
    } catch (const Bad_saved_object&) {
      object.prepared = was_prepared;
      throw;
    }
    object.radius = radius;
    write_maps(object);
    meeting_search_.forget(id);
    has_room_ = false;
    object.prepared = true;
  });
}

const Frame& Particle_detection::detect(const Collision_filter& filter) {
  const Busy busy(busy_);
  check_arithmetic();
  prepare();
  note_vertices();
  frame_.start(since_last_frame_);
  try {
    if (meets())
      detect_by_meetings(filter);
    else
      detect_as_published(filter);
  } catch (...) {
    restore_vertices();
    throw;
  }
  since_last_frame_ = {};
  for (auto& object : objects_)
    if (object) object->particle_object.keep_stretch();
  return frame_.finish();
}

/// Where the particles are before the frame.
void Particle_detection::note_vertices() {
  for (auto& object : objects_)
    if (object) object->vertices_before = object->particle_object.particles().at;
}

/// A frame that fails leaves the particles where they were, so that the next one answers as if it had not been begun.
void Particle_detection::restore_vertices() {
  for (auto& object : objects_) {
    if (!object || object->vertices_before == object->particle_object.particles().at) continue;
    object->particle_object.particles().at.swap(object->vertices_before);
    object->particle_object.mesh().move_particles(object->particle_object.particles().at);
  }
}

/// The method of \cite saenghaengtham2006, or its predecessor.
void Particle_detection::detect_as_published(const Collision_filter& filter) {
  confirmation_.reset_count();
  timed(frame_.seconds().broad_phase, [&] { find_candidates(filter); });
  timed(frame_.seconds().relaxation, [&] { walk(); });
  for (const auto pair : object_candidates_) check_regions(pair);
  frame_.statistics().exact_tests = confirmation_.exact_tests();
}

/// Partitions the objects that are new. The radii of all must be known first: particle counts depend on them.
void Particle_detection::prepare() {
  std::vector<Object*> fresh;
  for (auto& object : objects_)
    if (object && !object->prepared) fresh.push_back(object.get());
  // An object that was removed before it was built has left a place, for which there is no room yet.
  if (fresh.empty() && has_room_ && boxes_.size() == objects_.size()) return;
  auto& seconds = since_last_frame_.seconds;
  const bool repartitioned = fresh.empty() && since_last_frame_.repartitions > 0;
  timed(repartitioned ? seconds.repartition : seconds.build, [&] {
    if (!fresh.empty()) build(fresh, options_.close_seams ? Seams::close : Seams::open);
    make_room();
  });
  since_last_frame_.builds += fresh.size();
}

/// Until all is done the objects count as not prepared: if it fails, the next frame begins anew. Where seams are kept,
/// they stay prepared until they have been divided: a strategy may refuse to divide one again.
void Particle_detection::build(std::span<Object* const> objects, Seams seams) {
  std::vector<Building> all = read(objects);
  const auto count_as_unprepared = [&] {
    for (Object* object : objects) object->prepared = false;
  };
  if (seams != Seams::keep) count_as_unprepared();
  measure(all, seams);
  divide(all);
  count_as_unprepared();
  start(all);
  for (Object* object : objects) write_maps(*object);
  has_room_ = false;
  for (Object* object : objects) object->prepared = true;
}

/// Reads all positions. That calls the user's code, so it is done in this thread, object by object.
std::vector<Particle_detection::Building> Particle_detection::read(std::span<Object* const> objects) const {
  std::vector<Building> all;
  for (Object* object : objects)
    all.push_back(
        {.object = object, .positions = object->named([&] { return object->particle_object.read_positions(); })});
  return all;
}

/// Does some work for each object, side by side.
template <class Work>
void Particle_detection::for_each(std::span<Building> all, const Work& work) {
  workers_.run(all.size(), [&](std::size_t i, std::size_t) { all[i].object->named([&] { work(all[i]); }); });
}

/// Finds edges and seams, the collision distance, and how many particles each object gets, which depends on the radii
/// of all.
void Particle_detection::measure(std::span<Building> all, Seams seams) {
  for_each(all, [&](Building& building) {
    Object& object = *building.object;
    object.particle_object.find_edges();
    if (seams == Seams::close) object.particle_object.close_seams(building.positions);
    if (seams == Seams::open) object.particle_object.open_seams();  // of a file that could not be loaded
    if (options_.particles == 0) object.radius = radius_of(object.particle_object, building.positions);
  });
  const Radius_range range = radii();
  for_each(all, [&](Building& building) {
    building.object->particle_object.measure_distance(building.positions, options_.distance_measure);
    building.particles = particles_of(*building.object, building.positions, range);
  });
}

/// Divides the surfaces into regions; not in mode `senin`. A strategy that is not concurrent may call the user's code:
/// it divides in this thread, object by object.
void Particle_detection::divide(std::span<Building> all) {
  if (options_.mode == Mode::senin) return;
  const auto divide_if = [&](Building& building, bool concurrent) {
    auto& object = building.object->particle_object;
    if (object.mesh().divides_concurrently() == concurrent)
      building.division = object.divide(building.positions, building.particles, options_.partition);
  };
  for (Building& building : all) building.object->named([&] { divide_if(building, false); });
  for_each(all, [&](Building& building) { divide_if(building, true); });
}

/// Sets the particles up, and what they need in frames.
void Particle_detection::start(std::span<Building> all) {
  std::vector<std::size_t> faces;
  for (const Building& building : all) faces.push_back(building.object->particle_object.corners().size());
  side_by_side(faces, workers_,
               [&](std::size_t i, Workers& workers) { all[i].object->named([&] { start(all[i], workers); }); });
}

void Particle_detection::start(Building& building, Workers& workers) {
  Object& object = *building.object;
  if (options_.mode == Mode::senin) {
    Senin_options scattering = options_.senin;
    scattering.seed += object.id;  // objects of one shape must not start alike
    if (object.options.scattered_side) scattering.side = object.options.scattered_side;
    object.particle_object.scatter(building.positions, building.particles, scattering);
    return;
  }
  object.particle_object.take_division(std::move(building.division), building.positions, workers);
  if (meets())
    object.particle_object.prepare_meetings(building.positions, options_.tree, workers);
  else
    object.particle_object.prepare_patches();
}

void Particle_detection::write_maps(Object& object) {
  object.particle_object.mesh().write_maps(object.particle_object.labels(), object.particle_object.particles().at);
}

/// Finds the radii of objects that have not been built yet: how many particles another one gets depends on them.
void Particle_detection::measure_new_radii() {
  if (options_.particles > 0) return;
  for (auto& object : objects_)
    if (object && !object->prepared)
      object->radius =
          object->named([&] { return radius_of(object->particle_object, object->particle_object.read_positions()); });
}

/// The radii of all objects with extent, and the number of all objects.
Radius_range Particle_detection::radii() const {
  std::vector<double> radii;
  std::size_t count = 0;
  for (const auto& object : objects_) {
    if (!object) continue;
    ++count;
    if (object->radius > 0) radii.push_back(object->radius);
  }
  Radius_range range = radii.empty() ? Radius_range() : radius_range(radii);
  range.count = count;
  return range;
}

std::size_t Particle_detection::particles_of(const Object& object, const Positions& positions,
                                             const Radius_range& radii) const {
  if (object.options.particles > 0) return object.options.particles;
  if (options_.particles > 0) return options_.particles;
  const auto& rule = options_.particle_count;
  const std::size_t by_rule = particle_count(object.particle_object.sphere_collection(positions, rule), radii, rule);
  return std::min(std::max(by_rule, options_.least_particles), rule.most_particles);
}

/// Sizes the memory of all stages, so that frames need none. O(objects), so once for all that have changed.
void Particle_detection::make_room() {
  std::vector<std::size_t> counts;
  std::size_t live = 0, faces = 0, vertices = 0;
  for (const auto& object : objects_) {
    counts.push_back(object ? object->particle_object.particles().at.size() : 0);
    if (!object) continue;
    ++live;
    object->vertices_before.reserve(counts.back());
    for (const auto& patch : object->particle_object.patches()) {
      faces = std::max(faces, patch.faces.size());
      vertices = std::max(vertices, patch.vertices.size());
    }
  }
  const std::size_t most = counts.empty() ? 0 : *std::ranges::max_element(counts);
  relaxation_.reserve(counts);
  region_candidates_.reserve(std::min<std::size_t>(most * most, 1 << 16));
  walking_.reserve(live);
  confirmation_.reserve(faces, vertices);
  broad_phase_.reserve(live);
  const std::size_t pairs = std::min<std::size_t>(live * live / 2, 100 * live);
  object_candidates_.reserve(pairs);
  ids_.reserve(live);
  boxes_.resize(objects_.size());
  reach_.resize(objects_.size());
  opponents_.resize(objects_.size());
  pulls_.resize(objects_.size());
  for (std::size_t o = 0; o < objects_.size(); ++o) {
    if (objects_[o]) {
      opponents_[o].reserve(std::min<std::size_t>(live, 1000));
    } else {
      opponents_[o] = {};
      pulls_[o] = {};
    }
  }
  frame_.reserve(pairs, 1024);
  has_room_ = true;
}

void Particle_detection::find_candidates(const Collision_filter& filter) {
  ids_.clear();
  for (Object_id o = 0; o < objects_.size(); ++o) {
    if (!objects_[o]) continue;
    ids_.push_back(o);
    boxes_[o].setEmpty();
    auto& particle_object = objects_[o]->particle_object;
    objects_[o]->named([&] { particle_object.read_particles(); });
    frame_.statistics().vertices_read += particle_object.particles().at.size();
    for (const auto& position : particle_object.particles().positions) boxes_[o].extend(position);
    reach_[o] = std::max(particle_object.particles().effective_radius,
                         options_.collision_distance * particle_object.particles().collision_distance);
  }
  list_object_pairs(filter);
}

void Particle_detection::list_object_pairs(const Collision_filter& filter) {
  object_candidates_.clear();
  for (auto& list : opponents_) list.clear();
  for (const auto& [a, b] : broad_phase_.find(ids_, boxes_, reach_)) {
    if (!filter.may_collide(a, b)) continue;
    object_candidates_.push_back({a, b});
    opponents_[a].push_back(b);
    opponents_[b].push_back(a);
  }
}

void Particle_detection::walk() {
  if (object_candidates_.empty()) return;
  walking_.clear();
  for (std::size_t o = 0; o < objects_.size(); ++o) {
    if (!objects_[o]) {
      walking_.emplace_back();  // without opponents
      continue;
    }
    auto& particle_object = objects_[o]->particle_object;
    walking_.push_back({.particles = &particle_object.particles(),
                        .steps = &particle_object.steps(),
                        .reader = &particle_object.positions(),
                        .shared_reader = particle_object.positions().is_shared(),
                        .opponents = opponents_[o],
                        .siblings_repel = options_.mode == Mode::senin,
                        .pulls = meets() ? std::optional(std::span<const Pull>(pulls_[o])) : std::nullopt});
  }
  const Relaxation relaxation = relax(std::span<const Walking_object<Live_positions>>(walking_), relaxation_, workers_);
  frame_.statistics().iterations = relaxation.iterations;
  frame_.object_iterations().assign(relaxation_.iterations.begin(), relaxation_.iterations.end());
  frame_.statistics().moves = relaxation.moves;
  frame_.statistics().relaxed = relaxation.relaxed;
  frame_.statistics().vertices_read += relaxation.vertices_read;
  if (relaxation.moves == 0) return;
  for (auto& object : objects_)
    if (object) object->particle_object.mesh().move_particles(object->particle_object.particles().at);
}

void Particle_detection::check_regions(Object_pair pair) {
  auto& a = objects_[pair.a]->particle_object;
  auto& b = objects_[pair.b]->particle_object;
  const auto posed_patch = [&](Object_id id, std::size_t particle) -> const Posed_patch& {
    Object& object = *objects_[id];
    return object.named([&]() -> const Posed_patch& {
      const bool is_read = object.particle_object.is_posed(particle, frame_.number());
      const Posed_patch& posed = object.particle_object.posed_patch(particle, frame_.number());
      if (!is_read) frame_.statistics().vertices_read += posed.positions.size();
      return posed;
    });
  };
  Pair_result result = frame_.start_pair(pair);
  timed(frame_.seconds().candidates, [&] {
    const double distance =
        options_.collision_distance * std::max(a.particles().collision_distance, b.particles().collision_distance);
    candidate_pairs(a.particles().positions, b.particles().positions, distance, options_.candidates, region_candidates_,
                    workers_);
  });
  result.candidates = region_candidates_.size();
  frame_.statistics().candidates += region_candidates_.size();
  if (options_.list_candidates) list_candidates(pair);

  timed(frame_.seconds().confirmation, [&] {
    for (const auto& candidate : region_candidates_) {
      result.collides |= confirmation_.confirm(posed_patch(pair.a, candidate.a), posed_patch(pair.b, candidate.b),
                                               options_.contacts, frame_.face_pairs(), workers_);
      if (result.collides && options_.contacts != Contact_query::all) break;
    }
    end_pair(result);
  });
}

void Particle_detection::end_pair(Pair_result& result) {
  sort_contacts(result);
  const auto is_shared = [this](Object_id object) { return objects_[object]->particle_object.positions().is_shared(); };
  const auto triangle_of = [this](Object_id object, std::uint32_t face) {
    const auto& particle_object = objects_[object]->particle_object;
    return face_triangle(particle_object.corners()[face], particle_object.positions());
  };
  frame_.end_pair(result, triangle_of, is_shared(result.a) && is_shared(result.b) ? workers_ : Workers::alone());
}

void Particle_detection::list_candidates(Object_pair pair) {
  for (const auto& candidate : region_candidates_)
    frame_.candidates().push_back({.a = pair.a,
                                   .region_a = candidate.a,
                                   .b = pair.b,
                                   .region_b = candidate.b,
                                   .distance = std::sqrt(candidate.squared_distance)});
}

/// Sorts the face pairs found for one object pair, each once: faces at a seam are found in several regions.
void Particle_detection::sort_contacts(Pair_result& result) {
  const std::size_t first = result.first_contact;
  auto& found = frame_.face_pairs();
  if (options_.contacts == Contact_query::yes_no) found.resize(first);
  const auto begin = found.begin() + static_cast<std::ptrdiff_t>(first);
  std::sort(begin, found.end());
  found.erase(std::unique(begin, found.end()), found.end());
  result.capped = found.size() - first > options_.most_contacts;
  if (result.capped) found.resize(first + options_.most_contacts);
}

}  // namespace lodestone
