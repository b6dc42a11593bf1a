// SPDX-License-Identifier: GPL-3.0-or-later
// What a Particle_detection does with meetings.
#include <algorithm>
#include <functional>
#include <span>
#include <tuple>
#include <utility>

#include "lodestone/detection/particle_detection.h"
#include "lodestone/mesh/stopwatch.h"

namespace lodestone {

void Particle_detection::detect_by_meetings(const Collision_filter& filter) {
  meeting_search_.start_frame();
  try {
    timed(frame_.seconds().broad_phase, [&] { find_near_objects(filter); });
    search_near_objects();
    move_to_meetings();
  } catch (...) {
    meeting_search_.undo_frame();
    throw;
  }
  add_counts();
}

void Particle_detection::search_near_objects() {
  try {
    timed(frame_.seconds().confirmation, [&] { meeting_search_.look(met_pairs_); });
    timed(frame_.seconds().relaxation, [&] { walk_undecided_particles(); });
    timed(frame_.seconds().confirmation, [&] {
      meeting_search_.follow_shared_curves(met_pairs_);
      for (auto& pair : met_pairs_) report(pair);
    });
  } catch (const Bad_mesh&) {
    name_the_bad_object();
    throw;
  }
}

void Particle_detection::add_counts() {
  const Meeting_counts counts = meeting_search_.counts();
  auto& statistics = frame_.statistics();
  statistics.exact_tests = counts.exact_tests;
  statistics.meetings = counts.meetings;
  statistics.leaf_tests = counts.leaf_tests;
  statistics.vertices_read += counts.vertices_read;
  for (auto& object : objects_)
    if (object) statistics.vertices_read += object->particle_object.tree().vertices_read();
}

/// A search reads two objects at once. Its error tells the vertex, not the object.
/// @throws Bad_mesh  an object of a near pair has a coordinate that is not finite
void Particle_detection::name_the_bad_object() {
  for (const auto& pair : met_pairs_)
    for (const auto id : {pair.ids.a, pair.ids.b})
      objects_[id]->named([&] { objects_[id]->particle_object.read_positions(); });
}

void Particle_detection::find_near_objects(const Collision_filter& filter) {
  find_objects();
  list_object_pairs(filter);
  find_near_regions();
  met_pairs_.clear();
  for (const auto pair : object_candidates_)
    met_pairs_.push_back(
        {.ids = pair, .a = &objects_[pair.a]->particle_object, .b = &objects_[pair.b]->particle_object});
}

void Particle_detection::find_objects() {
  ids_.clear();
  for (Object_id o = 0; o < objects_.size(); ++o) {
    if (!objects_[o]) continue;
    ids_.push_back(o);
    reach_[o] = 0;
  }
  try {
    read_objects();
  } catch (const Bad_mesh&) {
    // Of several objects that are broken the first is named.
    for (const Object_id o : ids_)
      objects_[o]->named([&] {
        objects_[o]->particle_object.start_frame();
        objects_[o]->particle_object.find(options_.opening_reach);
      });
    throw;
  }
}

/// Does what reads an object for each of them, side by side. What a mesh computes when it is read, only this thread may
/// read.
template <class Read>
void Particle_detection::read_each(const Read& read) {
  constexpr std::size_t objects_per_task = 16;  // some ten microseconds
  const auto read_if = [&](Object_id o, bool shared) {
    if (objects_[o]->particle_object.positions().is_shared() == shared) objects_[o]->named([&] { read(o); });
  };
  const auto read_some = [&](std::size_t task, std::size_t) {
    const std::size_t first = task * objects_per_task, count = std::min(objects_per_task, ids_.size() - first);
    for (const Object_id o : std::span(ids_).subspan(first, count)) read_if(o, true);
  };
  workers_.run((ids_.size() + objects_per_task - 1) / objects_per_task, std::cref(read_some));
  for (const Object_id o : ids_) read_if(o, false);
}

/// Reads where all objects are.
void Particle_detection::read_objects() {
  for (const Object_id o : ids_) objects_[o]->named([&] { objects_[o]->particle_object.start_frame(); });
  read_each([this](Object_id o) {
    auto& object = objects_[o]->particle_object;
    object.find(options_.opening_reach);
    boxes_[o] = object.region_anchors().box();
  });
}

/// Those of small objects are read only where another object is near.
void Particle_detection::find_near_regions() {
  read_each([this](Object_id o) {
    if (!opponents_[o].empty()) objects_[o]->particle_object.find_regions(options_.opening_reach);
  });
}

/// Where the budget has ended the openings, lets the particles walk whose regions may touch one of the other object;
/// then the nearest meet.
void Particle_detection::walk_undecided_particles() {
  const auto undecided = [this](const Met_pair& pair) { return pair.out_of_budget && !meeting_search_.decided(pair); };
  if (std::ranges::none_of(met_pairs_, undecided)) return;
  for (auto& list : pulls_) list.clear();
  for (auto& list : opponents_) list.clear();
  for (const auto& pair : met_pairs_)
    if (undecided(pair)) add_pulls(pair);
  for (std::size_t o = 0; o < objects_.size(); ++o) {
    if (opponents_[o].empty()) continue;
    std::ranges::sort(pulls_[o]);
    objects_[o]->named([&] { objects_[o]->particle_object.read_particles(); });
    frame_.statistics().vertices_read += objects_[o]->particle_object.particles().at.size();
  }
  walk();
  for (auto& pair : met_pairs_)
    if (undecided(pair)) meeting_search_.meet_nearest(pair);
}

/// The particles of regions that may touch feel each other.
void Particle_detection::add_pulls(const Met_pair& pair) {
  opponents_[pair.ids.a].push_back(pair.ids.b);
  opponents_[pair.ids.b].push_back(pair.ids.a);
  for (const auto& near : pair.near_regions()) {
    const Region_index a = pair.a->region_anchors().region(near.a), b = pair.b->region_anchors().region(near.b);
    pulls_[pair.ids.a].push_back({a, pair.ids.b, b});
    pulls_[pair.ids.b].push_back({b, pair.ids.a, a});
  }
}

void Particle_detection::report(Met_pair& pair) {
  Pair_result result = frame_.start_pair(pair.ids);
  result.collides = !pair.seeds().empty();
  result.unfinished = pair.out_of_budget && !meeting_search_.decided(pair);
  const std::size_t near = pair.near_regions().size();
  result.candidates = near > 0 ? near : std::min<std::size_t>(pair.seeds().size(), 1);
  frame_.statistics().candidates += result.candidates;
  meeting_search_.report(pair, frame_.face_pairs());
  result.leaf_tests = pair.leaf_tests;
  if (options_.list_candidates) list_near_regions(pair);
  end_pair(result);
}

/// Lists the regions that may touch, the nearest first; if they were not needed, those in which the particles met.
void Particle_detection::list_near_regions(const Met_pair& pair) {
  const auto list = [&](Region_index a, Region_index b, double distance) {
    frame_.candidates().push_back(
        {.a = pair.ids.a, .region_a = a, .b = pair.ids.b, .region_b = b, .distance = distance});
  };
  const std::size_t first = frame_.candidates().size();
  for (const auto& near : pair.near_regions())
    list(pair.a->region_anchors().region(near.a), pair.b->region_anchors().region(near.b), near.distance);
  std::ranges::sort(std::span(frame_.candidates()).subspan(first), {}, [](const Candidate_regions& candidate) {
    return std::tuple(candidate.distance, candidate.region_a, candidate.region_b);
  });
  if (!pair.near_regions().empty() || pair.seeds().empty()) return;
  const Meeting at = pair.seeds().front().at;
  list(pair.a->labels()[at.a], pair.b->labels()[at.b], (pair.a->positions()(at.a) - pair.b->positions()(at.b)).norm());
}

/// Moves the particles of the regions in which particles met to the place where they did.
void Particle_detection::move_to_meetings() {
  for (const auto& pair : met_pairs_) {
    if (pair.seeds().empty()) continue;
    const Meeting at = pair.seeds().front().at;
    for (const auto& [object, vertex] : {std::pair{pair.a, at.a}, std::pair{pair.b, at.b}}) {
      if (!object->move_particle(vertex)) continue;
      ++frame_.statistics().vertices_read;
      object->mesh().move_particles(object->particles().at);
    }
  }
}

}  // namespace lodestone
