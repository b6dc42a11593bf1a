// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lodestone/errors.h"
#include "lodestone/frame.h"
#include "lodestone/particles/candidate_pairs.h"
#include "lodestone/particles/near_pairs.h"
#include "lodestone/particles/particle_object.h"
#include "lodestone/partition/lbg.h"
#include "lodestone/region_maps.h"

namespace lodestone {

/// Which method answers.
enum class Mode {
  particles,  ///< one particle per region; may miss a collision, never invents one
  senin,      ///< the predecessor: particles scattered over the surface, no regions
};

struct Detector_options {
  Mode mode = Mode::particles;
  std::size_t particles = 0;         ///< per object; 0: as many as the rule of `particle_count` asks for
  std::size_t least_particles = 12;  ///< but at least so many; 1: the rule alone, which can ask for very few
  Particle_count_options particle_count = {};
  Partition_options partition = {};
  double collision_distance = 1;  ///< in multiples of mu, the larger of the two objects'; > 0
  Distance_measure distance_measure = Distance_measure::adjacent_vertices;
  Candidate_choice candidates = Candidate_choice::all;
  Contact_query contacts = Contact_query::all;
  bool contact_points = false;  ///< compute where the face pairs meet; not with yes_no
  double growth = 1;            ///< repartition when a region exceeds so many times A*; > 0; infinity: never
  Senin_options senin = {};
};

/// What one object has of its own.
struct Object_options {
  std::size_t particles = 0;                           ///< 0: as the detector's options say
  std::optional<Eigen::Vector3d> scattered_side = {};  ///< Senin_options::side of this object
};

/// Finds collisions between many deforming meshes, frame after frame.
///
///     Detector<Surface_mesh> detector({.particles = 32});
///     const auto teapot = detector.add(teapot_mesh), sphere = detector.add(sphere_mesh);
///     while (simulate(teapot_mesh, sphere_mesh)) {
///       detector.update(teapot);
///       detector.update(sphere);
///       for (const auto& pair : detector.detect().pairs) ...
///     }
///
/// Meshes stay with the caller, who moves their vertices and keeps their connectivity, and who neither moves nor
/// assigns to the mesh object itself; they must outlive the detector. In a frame positions are read only where a
/// particle looks and in the regions of candidate pairs; `update` reads a few vertices per region, and all of a region
/// that seems to have grown. After the first frame memory is allocated only where a result is larger than any before,
/// for such a region, and for repartitions; in mode `senin` also for the faces around a particle that has moved. An
/// object with a single particle is felt by others, and feels them, within its diameter. One thread at a time.
///
/// @tparam Mesh      any model of Triangle_mesh
/// @tparam Strategy  how surfaces are divided, see Partition_strategy
/// @tparam Points    vertex point map
template <Triangle_mesh Mesh, class Strategy = Lbg,
          class Points = typename boost::property_map<Mesh, CGAL::vertex_point_t>::const_type>
class Detector {
 public:
  /// @throws Bad_argument  an option out of range
  explicit Detector(const Detector_options& options = {}, Strategy strategy = {});

  /// Adds an object and leaves `v:region` and `v:particle` on its mesh.
  /// Another detector that the same mesh is added to writes to the same maps.
  /// @throws Bad_mesh      no face, a face that is no triangle
  /// @throws Bad_argument  the mesh has been added before
  Object_id add(Mesh& mesh, const Object_options& options = {}) {
    const Object_id object = add(std::as_const(mesh), options);
    objects_[object]->maps.emplace(mesh);
    return object;
  }
  /// Adds an object whose mesh cannot be written to.
  Object_id add(const Mesh& mesh, const Object_options& options = {}) {
    for (const auto& other : objects_)
      if (other->mesh == &mesh) throw Bad_argument("the mesh has been added before");
    return add(mesh, CGAL::get_const_property_map(CGAL::vertex_point, mesh), options);
  }
  /// Adds an object whose positions are read through `points`. One mesh may be added several times with other points.
  Object_id add(const Mesh& mesh, Points points, const Object_options& options = {});

  /// Says that the vertices of an object have moved: an object whose regions have outgrown A* is repartitioned, with
  /// its number of particles computed afresh. O(N) while nothing has grown.
  /// @throws Bad_argument  no such object
  /// @throws Bad_mesh      as `detect`
  void update(Object_id object);
  /// The same for all objects.
  void update();

  /// Lets the particles walk and checks where they have come near each other. The first call, and any after an `add`,
  /// partitions the new objects.
  /// @return valid until the next call, and as long as the detector
  /// @throws Bad_mesh  a coordinate that is read is not finite or beyond 1e150, or a mesh has another number of
  /// vertices
  ///                   or faces than when it was added
  const Frame& detect();

  std::size_t size() const { return objects_.size(); }
  /// The state of one object: regions, particles, patches. Valid as long as the detector.
  /// @throws Bad_argument  no such object
  const Particle_object<Mesh, Points>& object(Object_id object) const { return checked(object).surface; }
  /// Its property maps.
  /// @throws Bad_argument  no such object, or one whose mesh could not be written to when it was added
  const Region_maps<Mesh>& maps(Object_id object) const {
    if (!checked(object).maps) throw Bad_argument("object " + std::to_string(object) + " carries no property maps");
    return *checked(object).maps;
  }

 private:
  using Clock = std::chrono::steady_clock;

  struct Object {
    Object_id id;
    const Mesh* mesh;
    Particle_object<Mesh, Points> surface;
    Object_options options;
    double radius = 0;  ///< of the bounding sphere at the last partition
    bool prepared = false;
    std::optional<Region_maps<Mesh>> maps = {};
  };

  Object& checked(Object_id object) const {
    if (object >= objects_.size()) throw Bad_argument("there is no object " + std::to_string(object));
    return *objects_[object];
  }
  void prepare();
  void partition(Object& object);
  std::size_t particles_of(const Object& object) const;
  void make_room();
  void find_near_pairs();
  void walk();
  void check(Object_pair pair);
  void add_contacts(Pair_result& result, std::size_t first);

  /// Adds the time that `stage` takes to `seconds`.
  template <class Stage>
  static void timed(double& seconds, Stage stage) {
    const auto start = Clock::now();
    stage();
    seconds += std::chrono::duration<double>(Clock::now() - start).count();
  }

  Detector_options options_;
  Strategy strategy_;
  std::vector<std::unique_ptr<Object>> objects_;
  Frame frame_;
  Frame_statistics since_last_frame_;  ///< what `update` has to tell the next frame

  // Memory of the stages, kept from frame to frame.
  std::vector<Box> boxes_;
  std::vector<double> reach_;
  Near_pairs broad_phase_;
  std::span<const Object_pair> near_pairs_;
  std::vector<std::vector<std::uint32_t>> near_;
  std::vector<Walking_object<Point_reader<Mesh, Points>>> walking_;
  Relaxation_scratch relaxation_;
  std::vector<Candidate_pair> candidates_;
  Confirmation confirmation_;
};

template <Triangle_mesh Mesh, class Strategy, class Points>
Detector<Mesh, Strategy, Points>::Detector(const Detector_options& options, Strategy strategy)
    : options_(options), strategy_(std::move(strategy)) {
  if (!(options.collision_distance > 0) || !std::isfinite(options.collision_distance))
    throw Bad_argument("the collision distance must be finite and > 0");
  if (!(options.growth > 0)) throw Bad_argument("the growth limit must be > 0");
  if (options.contact_points && options.contacts == Contact_query::yes_no)
    throw Bad_argument("contact points need the contacts `first` or `all`");
}

template <Triangle_mesh Mesh, class Strategy, class Points>
Object_id Detector<Mesh, Strategy, Points>::add(const Mesh& mesh, Points points, const Object_options& options) {
  const auto id = static_cast<Object_id>(objects_.size());
  objects_.emplace_back(new Object{.id = id, .mesh = &mesh, .surface = {mesh, points}, .options = options});
  return id;
}

template <Triangle_mesh Mesh, class Strategy, class Points>
void Detector<Mesh, Strategy, Points>::update(Object_id id) {
  Object& object = checked(id);
  if (!object.prepared || options_.mode != Mode::particles) return;
  timed(since_last_frame_.seconds.repartition, [&] {
    if (!object.surface.has_outgrown(options_.growth)) return;
    object.radius = object.surface.bounding_sphere().radius;
    partition(object);
    make_room();
    ++since_last_frame_.repartitions;
  });
}

template <Triangle_mesh Mesh, class Strategy, class Points>
void Detector<Mesh, Strategy, Points>::update() {
  for (Object_id id = 0; id < objects_.size(); ++id) update(id);
}

template <Triangle_mesh Mesh, class Strategy, class Points>
const Frame& Detector<Mesh, Strategy, Points>::detect() {
  prepare();
  ++frame_.number;
  frame_.pairs.clear();
  frame_.face_pairs.clear();
  frame_.contact_points.clear();
  frame_.statistics = std::exchange(since_last_frame_, {});
  confirmation_.reset_count();

  timed(frame_.statistics.seconds.broad_phase, [&] { find_near_pairs(); });
  timed(frame_.statistics.seconds.relaxation, [&] { walk(); });
  for (const auto pair : near_pairs_) check(pair);

  frame_.statistics.near_pairs = near_pairs_.size();
  frame_.statistics.contacts = frame_.face_pairs.size();
  frame_.statistics.exact_tests = confirmation_.exact_tests();
  return frame_;
}

/// Partitions the objects that are new. The radii of all must be known first: particle counts depend on them.
template <Triangle_mesh Mesh, class Strategy, class Points>
void Detector<Mesh, Strategy, Points>::prepare() {
  std::vector<Object*> fresh;
  for (auto& object : objects_)
    if (!object->prepared) fresh.push_back(object.get());
  if (fresh.empty()) return;
  for (Object* object : fresh) object->radius = object->surface.bounding_sphere().radius;
  for (Object* object : fresh) partition(*object);
  make_room();
}

template <Triangle_mesh Mesh, class Strategy, class Points>
void Detector<Mesh, Strategy, Points>::partition(Object& object) {
  if (options_.mode == Mode::senin) {
    Senin_options scattering = options_.senin;
    scattering.seed += object.id;  // objects of one shape must not start alike
    if (object.options.scattered_side) scattering.side = object.options.scattered_side;
    object.surface.scatter(particles_of(object), scattering, options_.distance_measure);
  } else {
    object.surface.partition(strategy_, particles_of(object), options_.partition, options_.distance_measure);
  }
  object.prepared = true;
  if (object.maps)
    object.maps->write(object.surface.numbering(), object.surface.labels(), object.surface.particles().at);
}

template <Triangle_mesh Mesh, class Strategy, class Points>
std::size_t Detector<Mesh, Strategy, Points>::particles_of(const Object& object) const {
  if (object.options.particles > 0) return object.options.particles;
  if (options_.particles > 0) return options_.particles;
  std::vector<double> radii;
  for (const auto& other : objects_) radii.push_back(other->radius);
  const auto& rule = options_.particle_count;
  const std::size_t by_rule = particle_count(object.surface.sphere_collection(rule), radii, rule);
  return std::min(std::max(by_rule, options_.least_particles), rule.most_particles);
}

/// Sizes the memory of all stages, so that frames need none.
template <Triangle_mesh Mesh, class Strategy, class Points>
void Detector<Mesh, Strategy, Points>::make_room() {
  std::vector<std::size_t> counts;
  std::size_t faces = 0, vertices = 0;
  for (const auto& object : objects_) {
    counts.push_back(object->surface.particles().at.size());
    for (const auto& patch : object->surface.patches()) {
      faces = std::max(faces, patch.faces.size());
      vertices = std::max(vertices, patch.vertices.size());
    }
  }
  const std::size_t most = counts.empty() ? 0 : *std::ranges::max_element(counts);
  relaxation_.reserve(counts);
  candidates_.reserve(std::min<std::size_t>(most * most, 1 << 16));
  walking_.reserve(objects_.size());
  confirmation_.reserve(faces, vertices);
  broad_phase_.reserve(objects_.size());
  boxes_.resize(objects_.size());
  reach_.resize(objects_.size());
  near_.resize(objects_.size());
  for (auto& list : near_) list.reserve(std::min<std::size_t>(objects_.size(), 1000));
  frame_.pairs.reserve(std::min<std::size_t>(objects_.size() * objects_.size() / 2, 100 * objects_.size()));
  frame_.face_pairs.reserve(1024);
}

template <Triangle_mesh Mesh, class Strategy, class Points>
void Detector<Mesh, Strategy, Points>::find_near_pairs() {
  for (std::size_t o = 0; o < objects_.size(); ++o) {
    auto& surface = objects_[o]->surface;
    surface.read_particles();
    boxes_[o].setEmpty();
    for (const auto& position : surface.particles().positions) boxes_[o].extend(position);
    reach_[o] = std::max(surface.particles().effective_radius,
                         options_.collision_distance * surface.particles().collision_distance);
    near_[o].clear();
  }
  near_pairs_ = broad_phase_.find(boxes_, reach_);
  for (const auto& [a, b] : near_pairs_) {
    near_[a].push_back(b);
    near_[b].push_back(a);
  }
}

template <Triangle_mesh Mesh, class Strategy, class Points>
void Detector<Mesh, Strategy, Points>::walk() {
  if (near_pairs_.empty()) return;
  walking_.clear();
  for (std::size_t o = 0; o < objects_.size(); ++o) {
    auto& surface = objects_[o]->surface;
    walking_.push_back({.particles = &surface.particles(),
                        .steps = &surface.steps(),
                        .reader = &surface.reader(),
                        .near = near_[o],
                        .siblings_repel = options_.mode == Mode::senin});
  }
  const Relaxation relaxation =
      relax(std::span<const Walking_object<Point_reader<Mesh, Points>>>(walking_), relaxation_);
  frame_.statistics.iterations = relaxation.iterations;
  frame_.statistics.moves = relaxation.moves;
  frame_.statistics.relaxed = relaxation.relaxed;
  if (relaxation.moves == 0) return;
  for (auto& object : objects_)
    if (object->maps) object->maps->move_particles(object->surface.numbering(), object->surface.particles().at);
}

template <Triangle_mesh Mesh, class Strategy, class Points>
void Detector<Mesh, Strategy, Points>::check(Object_pair pair) {
  auto& a = objects_[pair.a]->surface;
  auto& b = objects_[pair.b]->surface;
  Pair_result result{.a = pair.a, .b = pair.b, .first_contact = frame_.face_pairs.size()};
  timed(frame_.statistics.seconds.candidates, [&] {
    const double distance =
        options_.collision_distance * std::max(a.particles().collision_distance, b.particles().collision_distance);
    candidate_pairs(a.particles().positions, b.particles().positions, distance, options_.candidates, candidates_);
  });
  result.candidates = candidates_.size();
  frame_.statistics.candidates += candidates_.size();

  timed(frame_.statistics.seconds.confirmation, [&] {
    for (const auto& candidate : candidates_) {
      result.collides |=
          confirmation_.confirm(a.posed_patch(candidate.a, frame_.number), b.posed_patch(candidate.b, frame_.number),
                                options_.contacts, frame_.face_pairs);
      if (result.collides && options_.contacts != Contact_query::all) break;
    }
    add_contacts(result, result.first_contact);
  });
  frame_.pairs.push_back(result);
}

/// Sorts the face pairs found for one object pair, each once: faces at a seam are found in several regions.
template <Triangle_mesh Mesh, class Strategy, class Points>
void Detector<Mesh, Strategy, Points>::add_contacts(Pair_result& result, std::size_t first) {
  auto& found = frame_.face_pairs;
  if (options_.contacts == Contact_query::yes_no) found.resize(first);
  const auto begin = found.begin() + static_cast<std::ptrdiff_t>(first);
  std::sort(begin, found.end());
  found.erase(std::unique(begin, found.end()), found.end());
  result.contacts = found.size() - first;
  if (!options_.contact_points) return;

  const auto triangle = [](const auto& surface, std::uint32_t face) {
    return face_triangle(surface.numbering().corners()[face], surface.reader());
  };
  for (std::size_t i = first; i < found.size(); ++i)
    frame_.contact_points.push_back(triangle_intersection(triangle(objects_[result.a]->surface, found[i].a),
                                                          triangle(objects_[result.b]->surface, found[i].b)));
}

extern template class Detector<Surface_mesh>;

}  // namespace lodestone
