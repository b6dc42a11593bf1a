// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lodestone/detection/broad_phase.h"
#include "lodestone/detection/busy.h"
#include "lodestone/detection/detection.h"
#include "lodestone/detection/exact_objects.h"
#include "lodestone/detection/exact_pairs.h"
#include "lodestone/detection/frame_builder.h"
#include "lodestone/detection/object_hits.h"
#include "lodestone/detection/object_motion.h"
#include "lodestone/detection/saved_object.h"
#include "lodestone/mesh/arithmetic.h"
#include "lodestone/queries/closest_faces.h"
#include "lodestone/queries/contact_search.h"
#include "lodestone/queries/parting.h"
#include "lodestone/queries/point_search.h"
#include "lodestone/queries/ray_search.h"
#include "lodestone/queries/ray_tree.h"
#include "lodestone/queries/surface_triangle.h"

namespace lodestone {

/// The modes `exact` and `certified` of a Detector: frames, and questions about some objects.
///
/// Every call that answers first reads all positions of the objects that it is about and refits their trees: it cannot
/// answer for where they were before. Positions that are held are read once: see Held_positions. In mode `certified` an
/// object with bounds is read where it is near others. If a bound turns out to be broken, the object is read as a
/// whole, and the call answers anew.
template <Bounding_volume Volume>
class Exact_detection final : public Detection {
 public:
  /// What a refusal tells a user who asks another mode for this one's answers.
  static constexpr const char* needed = " needs the mode exact or certified";

  /// @param options  checked by `make_detection`
  explicit Exact_detection(const Detector_options& options)
      : options_(options),
        workers_(options.threads),
        objects_(options, workers_),
        frame_(options),
        pairs_(options, workers_, objects_, frame_) {}
  // The pairs refer to the workers, the objects and the frame.
  Exact_detection(const Exact_detection&) = delete;
  Exact_detection& operator=(const Exact_detection&) = delete;

  void add(const Watch_mesh& watch, const Object_options& options) override {
    check_not_busy();
    objects_.add(watch, options);
  }
  Watched_mesh& mesh(Object_id object) override { return objects_[object].mesh(); }

  /// The mesh is where positions come from.
  void update(Object_id object) override {
    check_not_busy();
    objects_[object].give({});
  }
  /// These are its positions until the next update.
  void update(Object_id object, const Eigen::Ref<const Positions>& positions);
  void place(Object_id object, const std::optional<Rigid_motion>& placement) override {
    check_not_busy();
    objects_[object].place(placement);
  }
  /// Reads the faces of the mesh anew.
  void rebuild(Object_id object, std::span<const std::uint32_t> file_vertex) override {
    check_not_busy();
    objects_.rebuild(object, file_vertex);
  }
  void rebuild(Object_id object, const Changed_faces& changed) override {
    check_not_busy();
    objects_.rebuild(object, changed);
  }

  void save(Object_id object, State_writer& state) override {
    const Busy busy(busy_);
    check_arithmetic();
    save_origin(origin(object), state);
    objects_.save(object, state);
    const Object_id ids[] = {object};
    objects_.throw_if_broken(ids);
  }
  void load(Object_id object, State_reader& state) override {
    check_not_busy();
    check_origin(origin(object), objects_[object].title(), state);
    objects_.load(object, state);
  }

  std::vector<Region_index> labels(Object_id object) const override { return objects_[object].labels(); }

  void remove(Object_id object) override {
    check_not_busy();
    objects_.remove(object);
    pairs_.forget(object);
  }

  const Frame& detect(const Collision_filter& filter) override;
  /// Finds the collisions of one pair; a = b: of an object with itself.
  /// @return valid until the next call
  const Frame& detect(const Collision_filter& filter, Object_pair pair);
  /// See `Detector::visit`.
  template <Contact_visitor Visitor>
  Visit visit(Object_pair pair, Visitor&& visitor) {
    const Object_id ids[] = {pair.a, pair.b};
    const Busy busy = refresh(ids);
    return unbroken(ids, pairs_.visit(pair, std::forward<Visitor>(visitor)));
  }
  /// See `Detector::closest`.
  Closest_faces closest(Object_pair pair);
  /// See `Detector::first_impact`.
  std::optional<Impact> first_impact(Object_pair pair, const Eigen::Ref<const Positions>& end_a,
                                     const Eigen::Ref<const Positions>& end_b);
  /// See `Detector::first_impact`.
  std::optional<Object_impact> first_impact(const Collision_filter& filter, std::span<const Positions> ends);
  /// See `Detector::first_impacts`.
  std::vector<Object_impact> first_impacts(const Collision_filter& filter, std::span<const Positions> ends);
  /// See `Detector::first_self_impact`.
  std::optional<Impact> first_self_impact(Object_id object, const Eigen::Ref<const Positions>& end);
  /// See `Detector::within`.
  bool within(Object_pair pair, double distance);
  /// See `Detector::contains`.
  bool contains(Object_id outer, Object_id inner);
  /// Asks the surface of one object, as it is now.
  /// @param question  called with a Layout_view or a Bounded_surface
  /// @param parts     how many rays or points it is about: for many the object is posed as a whole
  template <class Question>
  auto of_surface(Object_id object, const Question& question, std::size_t parts = 1) {
    const Busy busy = refresh({&object, 1});
    return of_refreshed(object, question, parts);
  }
  /// Asks about rays: the Ray_tree of the object where it pays, and else its surface.
  /// @param question  called with a `const Ray_tree&`, a Layout_view or a Bounded_surface
  template <class Question>
  auto of_rays(Object_id object, const Question& question, std::size_t rays = 1) {
    const Busy busy = refresh({&object, 1});
    return rays_of_refreshed(object, question, rays);
  }
  /// See `Detector::ray_tree`.
  const Ray_tree& ray_tree(Object_id object)
    requires std::same_as<Volume, Aabb>
  {
    const Object_id ids[] = {object};
    const Busy busy = refresh(ids);
    objects_.pose_all(ids);
    return objects_[object].ray_tree(workers_);
  }
  /// See `Detector::first_hits`.
  std::vector<std::optional<Ray_hit>> first_hits(Object_id object, std::span<const Ray> rays) {
    const Busy busy = refresh({&object, 1});
    return first_hits_of_refreshed(object, rays);
  }
  /// See `Detector::first_hits`.
  /// @param ids  each once
  std::vector<std::optional<Object_hit>> first_hits(std::span<const Object_id> ids, std::span<const Ray> rays);
  /// The objects that have not been removed, ascending.
  std::span<const Object_id> ids() const { return objects_.ids(); }
  /// The promises that positions stay as they are.
  const std::shared_ptr<Position_hold>& hold() const { return objects_.hold(); }
  /// Who share the work.
  Workers& workers() { return workers_; }
  /// See `Detector::parting`.
  std::optional<Parting> parting(Object_pair pair);

  /// Promises something about the motion of an object: see Motion_promise.
  void promise(Object_id object, Make_bound make) {
    check_not_busy();
    if (options_.mode != Mode::certified) throw Bad_argument("promise needs the mode certified");
    objects_.promise(object, std::move(make));
  }
  /// The surface of an object as one that is bounded; null before the first query, and in mode `exact`.
  const Bounded_surface* bounded(Object_id object) const { return objects_[object].bounded(); }

  /// See `Detector::tree`.
  const Basic_region_tree<Volume>& tree(Object_id object) const { return objects_.surface(object).tree(); }

 private:
  using Motions = std::vector<std::unique_ptr<const Object_motion<Volume>>>;

  /// Positions that are given for the end of a motion, in messages.
  static constexpr const char* at_end = " at the end";

  Motions motions_to(std::span<const Positions> ends);

  void check_not_busy() const { Busy::check(busy_); }
  /// Begins a question about these objects, which lasts as long as the result.
  [[nodiscard]] Busy refresh(std::span<const Object_id> ids) {
    Busy busy(busy_);
    check_arithmetic();
    objects_.refresh(ids);
    return busy;
  }
  Saved_origin origin(Object_id object) {
    return {.mode = std::string("exact with volumes of kind ").append(Volume::name),
            .vertices = objects_[object].mesh().vertex_count(),
            .corners = objects_[object].corners()};
  }
  [[nodiscard]] Busy start_frame(std::span<const Object_id> ids);
  const Frame& finish_frame(std::span<const Object_id> ids);
  /// An answer about these objects, unless a broken bound is to be an error.
  template <class Answer>
  Answer unbroken(std::span<const Object_id> ids, Answer answer) const {
    objects_.throw_if_broken(ids);
    return answer;
  }
  bool collide_or_are_nearer(Object_pair pair, double distance);
  /// See `of_surface`.
  template <class Question>
  auto of_refreshed(Object_id object, const Question& question, std::size_t parts);
  /// See `of_rays`.
  template <class Question>
  auto rays_of_refreshed(Object_id object, const Question& question, std::size_t rays);
  std::vector<std::optional<Ray_hit>> first_hits_of_refreshed(Object_id object, std::span<const Ray> rays);

  Detector_options options_;
  Workers workers_;
  Exact_objects<Volume> objects_;
  Frame_builder frame_;
  Exact_pairs<Volume> pairs_;
  Broad_phase broad_phase_;  ///< of impacts
  Frame_statistics before_;  ///< `work_on_demand` when the frame began
  bool busy_ = false;        ///< see Busy
};

template <Bounding_volume Volume>
void Exact_detection<Volume>::update(Object_id id, const Eigen::Ref<const Positions>& positions) {
  check_not_busy();
  auto& object = objects_[id];
  object.give(object.checked(positions));
}

template <Bounding_volume Volume>
const Frame& Exact_detection<Volume>::detect(const Collision_filter& filter) {
  const Busy busy = start_frame(objects_.ids());
  objects_.until_settled(objects_.ids(), [&] { pairs_.find_all(filter); });
  return finish_frame(objects_.ids());
}

template <Bounding_volume Volume>
const Frame& Exact_detection<Volume>::detect(const Collision_filter& filter, Object_pair pair) {
  const Object_id both[] = {pair.a, pair.b};
  const auto ids = std::span(both).first(pair.a == pair.b ? 1 : 2);
  const Busy busy = start_frame(ids);
  objects_.until_settled(ids, [&] { pairs_.find(filter, pair); });
  return finish_frame(ids);
}

template <Bounding_volume Volume>
Closest_faces Exact_detection<Volume>::closest(Object_pair pair) {
  const Object_id ids[] = {pair.a, pair.b};
  const Busy busy = refresh(ids);
  if constexpr (Exact_objects<Volume>::can_have_bounds)
    if (objects_.on_demand(pair))
      return unbroken(ids, closest_faces(objects_.bounded(pair.a), objects_.bounded(pair.b)));
  return closest_faces(objects_.surface(pair.a).view(), objects_.surface(pair.b).view());
}

template <Bounding_volume Volume>
std::optional<Impact> Exact_detection<Volume>::first_impact(Object_pair pair, const Eigen::Ref<const Positions>& end_a,
                                                            const Eigen::Ref<const Positions>& end_b) {
  Positions at_end_a = objects_[pair.a].checked(end_a, at_end), at_end_b = objects_[pair.b].checked(end_b, at_end);
  const Object_id ids[] = {pair.a, pair.b};
  const Busy busy = refresh(ids);
  objects_.pose_all(ids);
  const Object_motion<Volume> a(objects_.surface(pair.a), std::move(at_end_a)),
      b(objects_.surface(pair.b), std::move(at_end_b));
  return lodestone::first_impact(a.view(), b.view());
}

template <Bounding_volume Volume>
std::optional<Impact> Exact_detection<Volume>::first_self_impact(Object_id object,
                                                                 const Eigen::Ref<const Positions>& end) {
  Positions end_positions = objects_[object].checked(end, at_end);
  const Object_id ids[] = {object};
  const Busy busy = refresh(ids);
  objects_.pose_all(ids);
  const Object_motion<Volume> motion(objects_.surface(object), std::move(end_positions));
  return lodestone::first_self_impact(motion.view());
}

template <Bounding_volume Volume>
std::optional<Object_impact> Exact_detection<Volume>::first_impact(const Collision_filter& filter,
                                                                   std::span<const Positions> ends) {
  return earliest_impact<Volume>(motions_to(ends), filter, options_.exact.self_collision, broad_phase_);
}

template <Bounding_volume Volume>
std::vector<Object_impact> Exact_detection<Volume>::first_impacts(const Collision_filter& filter,
                                                                  std::span<const Positions> ends) {
  return impacts_of_pairs<Volume>(motions_to(ends), filter, options_.exact.self_collision, broad_phase_, workers_);
}

/// Per object id: from where it is to where it will be; null for removed ones.
template <Bounding_volume Volume>
auto Exact_detection<Volume>::motions_to(std::span<const Positions> ends) -> Motions {
  if (ends.size() != objects_.size())
    throw Bad_argument("expected one entry for each of the " + std::to_string(objects_.size()) +
                       " object ids, but got " + std::to_string(ends.size()));
  const auto ids = objects_.ids();
  std::vector<Positions> checked(objects_.size());
  for (const auto id : ids)
    if (ends[id].rows() > 0) checked[id] = objects_[id].checked(ends[id], at_end);
  const Busy busy = refresh(ids);
  objects_.pose_all(ids);
  Motions motions(objects_.size());
  workers_.run(ids.size(), [&](std::size_t i, std::size_t) {
    const Object_id id = ids[i];
    motions[id] = std::make_unique<const Object_motion<Volume>>(objects_.surface(id), std::move(checked[id]));
  });
  return motions;
}

template <Bounding_volume Volume>
template <class Question>
auto Exact_detection<Volume>::of_refreshed(Object_id object, const Question& question, std::size_t parts) {
  if constexpr (Exact_objects<Volume>::can_have_bounds)
    if (objects_.on_demand(object)) {
      const Object_id ids[] = {object};
      if (Ray_tree::refit_pays(parts, objects_[object].corners().size())) objects_.pose_all(ids);
      if (!objects_.bounded(object).all_posed()) return unbroken(ids, question(objects_.bounded(object)));
      objects_.throw_if_broken(ids);
    }
  const Node_boxes boxes(objects_.surface(object).view());
  return question(boxes.layout());
}

template <Bounding_volume Volume>
template <class Question>
auto Exact_detection<Volume>::rays_of_refreshed(Object_id object, const Question& question, std::size_t rays) {
  const auto of_tree_or_surface = [&](auto& surface) {
    if constexpr (std::same_as<Volume, Aabb> && std::same_as<decltype(surface), const Layout_view&>)
      if (objects_[object].pays_for(rays)) return question(objects_[object].ray_tree(workers_));
    return question(surface);
  };
  return of_refreshed(object, of_tree_or_surface, rays);
}

template <Bounding_volume Volume>
std::vector<std::optional<Ray_hit>> Exact_detection<Volume>::first_hits_of_refreshed(Object_id object,
                                                                                     std::span<const Ray> rays) {
  const auto question = [&](auto& asked) { return lodestone::first_hits(asked, rays, workers_); };
  return rays_of_refreshed(object, question, rays.size());
}

template <Bounding_volume Volume>
std::vector<std::optional<Object_hit>> Exact_detection<Volume>::first_hits(std::span<const Object_id> ids,
                                                                           std::span<const Ray> rays) {
  const Busy busy = refresh(ids);
  std::vector<std::optional<Object_hit>> hits;
  objects_.until_settled(ids, [&] {
    std::vector<Boxed_object> objects;
    for (const auto id : ids) objects.push_back({id, objects_.box(id)});
    hits = first_hits_among(
        rays, objects,
        [this](Object_id id, std::span<const Ray> asked) { return first_hits_of_refreshed(id, asked); },
        [this](Object_id id, std::uint32_t face) { return surface_triangle(objects_.surface(id), face); });
  });
  return hits;
}

template <Bounding_volume Volume>
bool Exact_detection<Volume>::within(Object_pair pair, double distance) {
  const Object_id ids[] = {pair.a, pair.b};
  const Busy busy = refresh(ids);
  bool answer = false;
  objects_.until_settled(ids, [&] { answer = collide_or_are_nearer(pair, distance); });
  return answer;
}

template <Bounding_volume Volume>
std::optional<Parting> Exact_detection<Volume>::parting(Object_pair pair) {
  const Object_id ids[] = {pair.a, pair.b};
  const Busy busy = refresh(ids);
  objects_.pose_all(ids);
  return lodestone::parting(objects_.surface(pair.a), objects_.surface(pair.b), workers_);
}

template <Bounding_volume Volume>
bool Exact_detection<Volume>::contains(Object_id outer, Object_id inner) {
  const Object_id ids[] = {outer, inner};
  const Busy busy = refresh(ids);
  bool answer = false;
  objects_.until_settled(ids, [&] {
    answer = pairs_.encloses(outer, inner) && !collide_or_are_nearer({outer, inner}, 0);
  });
  return answer;
}

template <Bounding_volume Volume>
bool Exact_detection<Volume>::collide_or_are_nearer(Object_pair pair, double distance) {
  std::vector<Face_pair> none;
  return pairs_.search(pair, {.query = Contact_query::yes_no, .tolerance = distance}, none).found;
}

template <Bounding_volume Volume>
Busy Exact_detection<Volume>::start_frame(std::span<const Object_id> ids) {
  Busy busy = refresh(ids);
  frame_.start(objects_.work());
  before_ = objects_.work_on_demand(ids);
  return busy;
}

/// Adds what this frame has done to objects with bounds.
template <Bounding_volume Volume>
const Frame& Exact_detection<Volume>::finish_frame(std::span<const Object_id> ids) {
  Frame_statistics& statistics = frame_.statistics();
  statistics.seconds.refit = objects_.work().seconds.refit;
  objects_.forget_work();
  const Frame_statistics now = objects_.work_on_demand(ids);
  statistics.vertices_read += now.vertices_read - before_.vertices_read;
  statistics.nodes_bounded += now.nodes_bounded - before_.nodes_bounded;
  statistics.leaves_posed += now.leaves_posed - before_.leaves_posed;
  statistics.violations += now.violations - before_.violations;
  return frame_.finish();
}

}  // namespace lodestone
