// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lodestone/detection/broad_phase.h"
#include "lodestone/detection/detection.h"
#include "lodestone/detection/exact_object.h"
#include "lodestone/detection/frame_builder.h"
#include "lodestone/mesh/scaled_positions.h"
#include "lodestone/mesh/stopwatch.h"
#include "lodestone/partition/partition.h"
#include "lodestone/queries/closest_faces.h"
#include "lodestone/queries/contact_search.h"
#include "lodestone/queries/containment.h"
#include "lodestone/volumes/to_box.h"

namespace lodestone {

/// The mode `exact` of a Detector: its objects, and what happens to them in a frame.
///
/// Every call that answers first reads all positions of the objects that it is about and refits their trees: it cannot
/// answer for where they were before.
template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
class Exact_detection final : public Detection<Mesh, Points> {
 public:
  /// What a refusal tells a user who asks another mode for this one's answers.
  static constexpr const char* needed = "this needs the mode exact";

  using Object = Exact_object<Mesh, Points, Volume>;
  using Surface = Basic_tree_surface<Volume>;

  Exact_detection(const Detector_options& options, Strategy strategy)
      : options_(options),
        strategy_(std::move(strategy)),
        workers_(options.exact.threads),
        search_(workers_),
        frame_(options) {}
  // The search refers to the workers.
  Exact_detection(const Exact_detection&) = delete;
  Exact_detection& operator=(const Exact_detection&) = delete;

  void add(const Mesh& mesh, Points points, const Object_options& options) override {
    check_no_visitor();
    timed(since_last_frame_.seconds.build,
          [&] { objects_.push_back(std::make_unique<Object>(mesh, points, options)); });
  }
  void write_maps(Object_id object, Mesh& mesh) override { objects_[object]->maps.emplace(mesh); }

  /// The mesh is where positions come from.
  void update(Object_id object) override {
    check_no_visitor();
    objects_[object]->given.reset();
  }
  /// These are its positions until the next update.
  void update(Object_id object, const Eigen::Ref<const Positions>& positions);
  /// Reads the faces of the mesh anew.
  void rebuild(Object_id object, std::span<const std::uint32_t> file_vertex) override {
    check_no_visitor();
    timed(since_last_frame_.seconds.build, [&] { objects_[object]->rebuild(file_vertex); });
  }

  const Frame& detect(const Collision_filter& filter) override;
  const Frame& detect(const Collision_filter& filter, Object_pair pair);
  template <Contact_visitor Visitor>
  Visit visit(Object_pair pair, Visitor&& visitor) {
    const Object_id ids[] = {pair.a, pair.b};
    refresh(ids);
    const Visiting visiting(visited_);
    return visit_contacts(objects_[pair.a]->surface.view(), objects_[pair.b]->surface.view(), options_.exact.tolerance,
                          std::forward<Visitor>(visitor));
  }
  Closest_faces closest(Object_pair pair);
  bool contains(Object_id outer, Object_id inner);

  const Basic_region_tree<Volume>& tree(Object_id object) const { return objects_[object]->surface.tree(); }
  const std::optional<Region_maps<Mesh>>& maps(Object_id object) const override { return objects_[object]->maps; }

 private:
  /// While a visitor is shown face pairs.
  class Visiting {
   public:
    explicit Visiting(bool& flag) : flag_(flag) { flag_ = true; }
    ~Visiting() { flag_ = false; }
    Visiting(const Visiting&) = delete;

   private:
    bool& flag_;
  };

  /// A visitor's walk reads positions and trees, which no other call may change.
  void check_no_visitor() const {
    if (visited_) throw Bad_argument("a visitor called the detector that shows it face pairs");
  }
  void build(Object_id id, Coordinates coordinates);
  void refresh(std::span<const Object_id> ids);
  void build_new(std::span<const Object_id> ids);
  void refit_built(std::span<const Object_id> ids);
  void rebuild_loose(std::span<const Object_id> ids);
  void start_frame(std::span<const Object_id> ids);
  void find_candidates(const Collision_filter& filter);
  void check(Object_pair pair);
  Containment containment(Object_pair pair, bool found);

  Detector_options options_;
  Strategy strategy_;
  Workers workers_;
  Basic_contact_search<Volume> search_;
  std::vector<std::unique_ptr<Object>> objects_;
  Frame_builder frame_;
  Frame_statistics since_last_frame_;  ///< what other calls have to tell the next frame: they build and rebuild too
  bool visited_ = false;               ///< a visitor is being shown face pairs

  // Memory of the stages, kept from frame to frame.
  std::vector<Object_id> all_;
  std::vector<Surface*> surfaces_;
  std::vector<Coordinates> coordinates_;
  std::vector<Box> boxes_;
  std::vector<double> reach_;
  Broad_phase broad_phase_;
  std::vector<Object_pair> candidates_;
};

template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
void Exact_detection<Mesh, Strategy, Points, Volume>::update(Object_id id,
                                                             const Eigen::Ref<const Positions>& positions) {
  check_no_visitor();
  Object& object = *objects_[id];
  if (positions.rows() != object.numbering().vertex_count())
    throw Bad_mesh("object " + std::to_string(id) + " has " + std::to_string(object.numbering().vertex_count()) +
                   " vertices, but got " + std::to_string(positions.rows()) + " positions");
  Positions copy = positions;
  check_finite({copy.data(), static_cast<std::size_t>(copy.size())}, id);
  object.given = std::move(copy);
}

template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
const Frame& Exact_detection<Mesh, Strategy, Points, Volume>::detect(const Collision_filter& filter) {
  for (auto id = static_cast<Object_id>(all_.size()); id < objects_.size(); ++id) all_.push_back(id);
  start_frame(all_);
  timed(frame_.seconds().broad_phase, [&] { find_candidates(filter); });
  timed(frame_.seconds().confirmation, [&] {
    for (const auto pair : candidates_) check(pair);
  });
  return frame_.finish();
}

template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
const Frame& Exact_detection<Mesh, Strategy, Points, Volume>::detect(const Collision_filter& filter, Object_pair pair) {
  const Object_id ids[] = {pair.a, pair.b};
  start_frame(std::span(ids).first(pair.a == pair.b ? 1 : 2));
  if (filter.may_collide(pair.a, pair.b)) timed(frame_.seconds().confirmation, [&] { check(pair); });
  return frame_.finish();
}

template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
Closest_faces Exact_detection<Mesh, Strategy, Points, Volume>::closest(Object_pair pair) {
  const Object_id ids[] = {pair.a, pair.b};
  refresh(ids);
  return closest_faces(objects_[pair.a]->surface.view(), objects_[pair.b]->surface.view());
}

template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
bool Exact_detection<Mesh, Strategy, Points, Volume>::contains(Object_id outer, Object_id inner) {
  const Object_id ids[] = {outer, inner};
  refresh(ids);
  std::vector<Face_pair> none;
  const auto& out = objects_[outer]->surface;
  const auto& in = objects_[inner]->surface;
  return encloses(out, in) && !search_.between(out, in, {.query = Contact_query::yes_no}, none).found;
}

template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
void Exact_detection<Mesh, Strategy, Points, Volume>::start_frame(std::span<const Object_id> ids) {
  since_last_frame_.seconds.refit = 0;  // that of other calls is no part of the frame
  refresh(ids);
  frame_.start(std::exchange(since_last_frame_, {}));
  candidates_.clear();
}

/// Divides the surface into regions, and builds a tree over them.
template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
void Exact_detection<Mesh, Strategy, Points, Volume>::build(Object_id id, Coordinates coordinates) {
  Object& object = *objects_[id];
  check_finite(coordinates, id);
  const auto& numbering = object.numbering();
  const Vertex_graph graph = vertex_graph(numbering.vertex_count(), numbering.corners());
  const Positions positions = scaled_positions(coordinates);
  std::size_t regions = options_.least_particles;
  if (options_.particles > 0) regions = options_.particles;
  if (object.particles > 0) regions = object.particles;
  const auto partition = partition_numbered(Partition_input<Mesh>{object.mesh(), numbering, graph, positions},
                                            std::max<std::size_t>(1, regions), strategy_, options_.partition);
  object.surface.build(partition.labels, coordinates, options_.exact.tree);
  object.built = true;
  if (object.maps) object.maps->write(numbering, partition.labels, partition.particles);
}

/// Everything that depends on positions.
template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
void Exact_detection<Mesh, Strategy, Points, Volume>::refresh(std::span<const Object_id> ids) {
  check_no_visitor();
  // Refitted first: a tree that is built now holds the current positions.
  timed(since_last_frame_.seconds.refit, [&] { refit_built(ids); });
  build_new(ids);
  rebuild_loose(ids);
}

template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
void Exact_detection<Mesh, Strategy, Points, Volume>::refit_built(std::span<const Object_id> ids) {
  surfaces_.clear();
  coordinates_.clear();
  for (const auto id : ids) {
    if (!objects_[id]->built) continue;
    surfaces_.push_back(&objects_[id]->surface);
    coordinates_.push_back(objects_[id]->read(id));
  }
  refit<Volume>(surfaces_, coordinates_, workers_);
  for (const auto id : ids) {
    const Surface& surface = objects_[id]->surface;
    if (!objects_[id]->built) continue;
    if (!surface.finite()) check_finite(surface.coordinates(), id);
    check_finite(surface.coordinates(), objects_[id]->unused(), id);
  }
}

template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
void Exact_detection<Mesh, Strategy, Points, Volume>::build_new(std::span<const Object_id> ids) {
  for (const auto id : ids) {
    if (objects_[id]->built) continue;
    timed(since_last_frame_.seconds.build, [&] { build(id, objects_[id]->read(id)); });
    ++since_last_frame_.builds;
  }
}

/// New trees for objects whose leaves have grown too much in comparison with the whole.
template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
void Exact_detection<Mesh, Strategy, Points, Volume>::rebuild_loose(std::span<const Object_id> ids) {
  for (const auto id : ids) {
    const Surface& surface = objects_[id]->surface;
    if (!surface.looser_than(options_.exact.loosest)) continue;
    timed(since_last_frame_.seconds.repartition, [&] { build(id, surface.coordinates()); });
    ++since_last_frame_.repartitions;
  }
}

template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
void Exact_detection<Mesh, Strategy, Points, Volume>::find_candidates(const Collision_filter& filter) {
  boxes_.clear();
  for (const auto& object : objects_) boxes_.push_back(to_box(object->surface.tree().volume(0).bounds()));
  reach_.assign(objects_.size(), options_.exact.tolerance);
  for (const auto pair : broad_phase_.find(boxes_, reach_))
    if (filter.may_collide(pair.a, pair.b)) candidates_.push_back(pair);
  if (!options_.exact.self_collision) return;
  for (Object_id id = 0; id < objects_.size(); ++id)
    if (filter.may_collide(id, id)) candidates_.push_back({id, id});
  std::ranges::sort(candidates_);
}

template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
void Exact_detection<Mesh, Strategy, Points, Volume>::check(Object_pair pair) {
  const Surface& a = objects_[pair.a]->surface;
  const Surface& b = objects_[pair.b]->surface;
  const Contact_request request{
      .query = options_.contacts, .tolerance = options_.exact.tolerance, .most = options_.most_contacts};
  Pair_result result = frame_.start_pair(pair);
  const Contact_summary summary = pair.a == pair.b ? search_.within(a, request, frame_.face_pairs())
                                                   : search_.between(a, b, request, frame_.face_pairs());
  result.collides = summary.found;
  result.capped = summary.capped;
  result.candidates = summary.leaf_tests;
  if (options_.exact.containment && pair.a != pair.b) result.containment = containment(pair, summary.found);
  frame_.statistics().candidates += summary.leaf_tests;
  frame_.statistics().exact_tests += summary.exact_tests;
  frame_.end_pair(result, [this](Object_id id, std::uint32_t face) {
    const Surface& surface = objects_[id]->surface;
    return face_triangle(surface.corners()[face],
                         [&](auto vertex) { return surface.coordinates().data() + 3 * std::size_t{vertex}; });
  });
}

template <Triangle_mesh Mesh, class Strategy, class Points, Bounding_volume Volume>
Containment Exact_detection<Mesh, Strategy, Points, Volume>::containment(Object_pair pair, bool found) {
  const Surface& a = objects_[pair.a]->surface;
  const Surface& b = objects_[pair.b]->surface;
  const bool a_in_b = encloses(b, a);
  if (!a_in_b && !encloses(a, b)) return Containment::none;
  // What was found may be near without intersecting.
  std::vector<Face_pair> none;
  if (found && (options_.exact.tolerance == 0 || search_.between(a, b, {.query = Contact_query::yes_no}, none).found))
    return Containment::none;
  return a_in_b ? Containment::a_in_b : Containment::b_in_a;
}

}  // namespace lodestone
