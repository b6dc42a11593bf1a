// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "lodestone/detection/broad_phase.h"
#include "lodestone/detection/detection.h"
#include "lodestone/detection/frame_builder.h"
#include "lodestone/detection/particle_object.h"
#include "lodestone/mesh/stopwatch.h"
#include "lodestone/particles/candidate_pairs.h"

namespace lodestone {

/// The modes `particles` and `senin` of a Detector: its objects, and what happens to them in a frame.
///
/// In a frame positions are read only where a particle looks and in the regions of candidate pairs; `update` reads a
/// few vertices per region, and all of a region that seems to have grown. After the first frame memory is allocated
/// only where a result is larger than any before, for such a region, and for repartitions; in mode `senin` also for the
/// faces around a particle that has moved. An object with a single particle is felt by others, and feels them, within
/// its diameter.
template <Triangle_mesh Mesh, class Strategy, class Points>
class Particle_detection final : public Detection<Mesh, Points> {
 public:
  /// What a refusal tells a user who asks another mode for this one's answers.
  static constexpr const char* needed = "this needs a mode with particles";

  Particle_detection(const Detector_options& options, Strategy strategy)
      : options_(options), strategy_(std::move(strategy)), frame_(options) {}

  void add(const Mesh& mesh, Points points, const Object_options& options) override {
    const auto id = static_cast<Object_id>(objects_.size());
    timed(since_last_frame_.seconds.build,
          [&] { objects_.push_back(std::make_unique<Object>(id, mesh, points, options)); });
  }
  /// Keeps the property maps of a mesh up to date from the next partition on.
  void write_maps(Object_id object, Mesh& mesh) override { objects_[object]->maps.emplace(mesh); }

  /// Repartitions an object that has outgrown A*.
  void update(Object_id object) override;
  /// Reads the faces of the mesh anew.
  void rebuild(Object_id object, std::span<const std::uint32_t> file_vertex) override;
  void remove(Object_id object) override { objects_[object].reset(); }
  const Frame& detect(const Collision_filter& filter) override;

  const Particle_object<Mesh, Points>& object(Object_id object) const { return objects_[object]->particle_object; }
  const std::optional<Region_maps<Mesh>>& maps(Object_id object) const override { return objects_[object]->maps; }

 private:
  struct Object {
    Object_id id;
    const Mesh* mesh;
    Points points;
    Object_options options;
    Particle_object<Mesh, Points> particle_object;
    double radius = 0;  ///< of the bounding sphere at the last partition
    bool prepared = false;
    std::optional<Region_maps<Mesh>> maps = {};

    Object(Object_id i, const Mesh& m, Points p, const Object_options& o)
        : id(i), mesh(&m), points(p), options(o), particle_object(m, p) {}

    /// Calls `work`, and names the object in the Bad_mesh that it may throw.
    template <class Work>
    decltype(auto) named(const Work& work) const {
      try {
        return work();
      } catch (const Bad_mesh& error) {
        throw Bad_mesh(title_of(id, options) + ": " + error.what());
      }
    }
  };

  void prepare();
  void measure(Object& object) {
    object.radius = object.named([&] { return object.particle_object.bounding_sphere().radius; });
  }
  void partition(Object& object);
  std::size_t particles_of(const Object& object) const;
  void make_room();
  void find_candidates(const Collision_filter& filter);
  void walk();
  void check(Object_pair pair);
  void list_candidates(Object_pair pair);
  void sort_contacts(Pair_result& result);

  Detector_options options_;
  Strategy strategy_;
  std::vector<std::unique_ptr<Object>> objects_;  ///< null: removed
  Frame_builder frame_;
  Frame_statistics since_last_frame_;  ///< what other calls have to tell the next frame

  // Memory of the stages, kept from frame to frame.
  std::vector<Box> boxes_;
  std::vector<double> reach_;
  Broad_phase broad_phase_;
  std::vector<Object_pair> object_candidates_;
  std::vector<std::vector<std::uint32_t>> opponents_;  ///< per object: those it may meet
  std::vector<Walking_object<Point_reader<Mesh, Points>>> walking_;
  Relaxation_scratch relaxation_;
  std::vector<Candidate_pair> region_candidates_;
  Confirmation confirmation_;
};

template <Triangle_mesh Mesh, class Strategy, class Points>
void Particle_detection<Mesh, Strategy, Points>::update(Object_id id) {
  Object& object = *objects_[id];
  if (!object.prepared || options_.mode != Mode::particles) return;
  timed(since_last_frame_.seconds.repartition, [&] {
    if (!object.named([&] { return object.particle_object.has_outgrown(options_.growth); })) return;
    measure(object);
    partition(object);
    make_room();
    ++since_last_frame_.repartitions;
  });
}

template <Triangle_mesh Mesh, class Strategy, class Points>
void Particle_detection<Mesh, Strategy, Points>::rebuild(Object_id id, std::span<const std::uint32_t> /*file_vertex*/) {
  timed(since_last_frame_.seconds.build, [&] {
    const Object& old = *objects_[id];
    auto anew = std::make_unique<Object>(id, *old.mesh, old.points, old.options);
    anew->maps = old.maps;
    if (anew->maps) anew->maps->renew();
    objects_[id] = std::move(anew);
  });
}

template <Triangle_mesh Mesh, class Strategy, class Points>
const Frame& Particle_detection<Mesh, Strategy, Points>::detect(const Collision_filter& filter) {
  prepare();
  frame_.start(std::exchange(since_last_frame_, {}));
  confirmation_.reset_count();

  timed(frame_.seconds().broad_phase, [&] { find_candidates(filter); });
  timed(frame_.seconds().relaxation, [&] { walk(); });
  for (const auto pair : object_candidates_) check(pair);

  frame_.statistics().exact_tests = confirmation_.exact_tests();
  return frame_.finish();
}

/// Partitions the objects that are new. The radii of all must be known first: particle counts depend on them.
template <Triangle_mesh Mesh, class Strategy, class Points>
void Particle_detection<Mesh, Strategy, Points>::prepare() {
  std::vector<Object*> fresh;
  for (auto& object : objects_)
    if (object && !object->prepared) fresh.push_back(object.get());
  if (fresh.empty()) return;
  timed(since_last_frame_.seconds.build, [&] {
    for (Object* object : fresh) measure(*object);
    for (Object* object : fresh) partition(*object);
    make_room();
  });
  since_last_frame_.builds += fresh.size();
}

template <Triangle_mesh Mesh, class Strategy, class Points>
void Particle_detection<Mesh, Strategy, Points>::partition(Object& object) {
  if (options_.mode == Mode::senin) {
    Senin_options scattering = options_.senin;
    scattering.seed += object.id;  // objects of one shape must not start alike
    if (object.options.scattered_side) scattering.side = object.options.scattered_side;
    object.named([&] {
      object.particle_object.scatter(particles_of(object), scattering, options_.distance_measure);
    });
  } else {
    object.named([&] {
      object.particle_object.partition(strategy_, particles_of(object), options_.partition, options_.distance_measure);
    });
  }
  object.prepared = true;
  if (object.maps)
    object.maps->write(object.particle_object.numbering(), object.particle_object.labels(),
                       object.particle_object.particles().at);
}

template <Triangle_mesh Mesh, class Strategy, class Points>
std::size_t Particle_detection<Mesh, Strategy, Points>::particles_of(const Object& object) const {
  if (object.options.particles > 0) return object.options.particles;
  if (options_.particles > 0) return options_.particles;
  std::vector<double> radii;
  for (const auto& other : objects_)
    if (other) radii.push_back(other->radius);
  const auto& rule = options_.particle_count;
  const std::size_t by_rule = particle_count(object.particle_object.sphere_collection(rule), radii, rule);
  return std::min(std::max(by_rule, options_.least_particles), rule.most_particles);
}

/// Sizes the memory of all stages, so that frames need none.
template <Triangle_mesh Mesh, class Strategy, class Points>
void Particle_detection<Mesh, Strategy, Points>::make_room() {
  std::vector<std::size_t> counts;
  std::size_t faces = 0, vertices = 0;
  for (const auto& object : objects_) {
    counts.push_back(object ? object->particle_object.particles().at.size() : 0);
    if (!object) continue;
    for (const auto& patch : object->particle_object.patches()) {
      faces = std::max(faces, patch.faces.size());
      vertices = std::max(vertices, patch.vertices.size());
    }
  }
  const std::size_t most = counts.empty() ? 0 : *std::ranges::max_element(counts);
  relaxation_.reserve(counts);
  region_candidates_.reserve(std::min<std::size_t>(most * most, 1 << 16));
  walking_.reserve(objects_.size());
  confirmation_.reserve(faces, vertices);
  broad_phase_.reserve(objects_.size());
  object_candidates_.reserve(std::min<std::size_t>(objects_.size() * objects_.size() / 2, 100 * objects_.size()));
  boxes_.resize(objects_.size());
  reach_.resize(objects_.size());
  opponents_.resize(objects_.size());
  for (auto& list : opponents_) list.reserve(std::min<std::size_t>(objects_.size(), 1000));
  frame_.reserve(std::min<std::size_t>(objects_.size() * objects_.size() / 2, 100 * objects_.size()), 1024);
}

template <Triangle_mesh Mesh, class Strategy, class Points>
void Particle_detection<Mesh, Strategy, Points>::find_candidates(const Collision_filter& filter) {
  for (std::size_t o = 0; o < objects_.size(); ++o) {
    boxes_[o].setEmpty();
    reach_[o] = 0;
    opponents_[o].clear();
    if (!objects_[o]) continue;
    auto& particle_object = objects_[o]->particle_object;
    objects_[o]->named([&] { particle_object.read_particles(); });
    for (const auto& position : particle_object.particles().positions) boxes_[o].extend(position);
    reach_[o] = std::max(particle_object.particles().effective_radius,
                         options_.collision_distance * particle_object.particles().collision_distance);
  }
  object_candidates_.clear();
  for (const auto& [a, b] : broad_phase_.find(boxes_, reach_)) {
    if (!filter.may_collide(a, b)) continue;
    object_candidates_.push_back({a, b});
    opponents_[a].push_back(b);
    opponents_[b].push_back(a);
  }
}

template <Triangle_mesh Mesh, class Strategy, class Points>
void Particle_detection<Mesh, Strategy, Points>::walk() {
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
                        .reader = &particle_object.reader(),
                        .opponents = opponents_[o],
                        .siblings_repel = options_.mode == Mode::senin});
  }
  const Relaxation relaxation =
      relax(std::span<const Walking_object<Point_reader<Mesh, Points>>>(walking_), relaxation_);
  frame_.statistics().iterations = relaxation.iterations;
  frame_.statistics().moves = relaxation.moves;
  frame_.statistics().relaxed = relaxation.relaxed;
  if (relaxation.moves == 0) return;
  for (auto& object : objects_)
    if (object && object->maps)
      object->maps->move_particles(object->particle_object.numbering(), object->particle_object.particles().at);
}

template <Triangle_mesh Mesh, class Strategy, class Points>
void Particle_detection<Mesh, Strategy, Points>::check(Object_pair pair) {
  auto& a = objects_[pair.a]->particle_object;
  auto& b = objects_[pair.b]->particle_object;
  const auto posed_patch = [&](Object_id id, std::size_t particle) -> const Posed_patch& {
    Object& object = *objects_[id];
    return object.named([&]() -> const Posed_patch& {
      return object.particle_object.posed_patch(particle, frame_.number());
    });
  };
  Pair_result result = frame_.start_pair(pair);
  timed(frame_.seconds().candidates, [&] {
    const double distance =
        options_.collision_distance * std::max(a.particles().collision_distance, b.particles().collision_distance);
    candidate_pairs(a.particles().positions, b.particles().positions, distance, options_.candidates,
                    region_candidates_);
  });
  result.candidates = region_candidates_.size();
  frame_.statistics().candidates += region_candidates_.size();
  if (options_.list_candidates) list_candidates(pair);

  timed(frame_.seconds().confirmation, [&] {
    for (const auto& candidate : region_candidates_) {
      result.collides |=
          confirmation_.confirm(posed_patch(pair.a, candidate.a), posed_patch(pair.b, candidate.b), options_.contacts,
                                frame_.face_pairs());
      if (result.collides && options_.contacts != Contact_query::all) break;
    }
    sort_contacts(result);
    frame_.end_pair(result, [this](Object_id object, std::uint32_t face) {
      const auto& particle_object = objects_[object]->particle_object;
      return face_triangle(particle_object.numbering().corners()[face], particle_object.reader());
    });
  });
}

template <Triangle_mesh Mesh, class Strategy, class Points>
void Particle_detection<Mesh, Strategy, Points>::list_candidates(Object_pair pair) {
  for (const auto& candidate : region_candidates_)
    frame_.candidates().push_back({.a = pair.a,
                                   .region_a = candidate.a,
                                   .b = pair.b,
                                   .region_b = candidate.b,
                                   .distance = std::sqrt(candidate.squared_distance)});
}

/// Sorts the face pairs found for one object pair, each once: faces at a seam are found in several regions.
template <Triangle_mesh Mesh, class Strategy, class Points>
void Particle_detection<Mesh, Strategy, Points>::sort_contacts(Pair_result& result) {
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
