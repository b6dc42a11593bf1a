// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "lodestone/detection/broad_phase.h"
#include "lodestone/detection/collision_filter.h"
#include "lodestone/detection/exact_objects.h"
#include "lodestone/detection/frame_builder.h"
#include "lodestone/mesh/stopwatch.h"
#include "lodestone/queries/bounded_search.h"
#include "lodestone/queries/contact_search.h"
#include "lodestone/queries/containment.h"
#include "lodestone/queries/pair_contacts.h"
#include "lodestone/queries/parting.h"
#include "lodestone/queries/small_pairs.h"
#include "lodestone/queries/surface_triangle.h"
#include "lodestone/volumes/to_box.h"

namespace lodestone {

/// From objects to the pairs of a frame, in the modes `exact` and `certified`: candidates by their boxes, then the
/// contacts of each, and what else the options ask of a pair.
template <Bounding_volume Volume>
class Exact_pairs {
 public:
  using Surface = Basic_tree_surface<Volume>;  ///< of an object

  /// @param workers, objects, frame  must outlive this
  Exact_pairs(const Detector_options& options, Workers& workers, Exact_objects<Volume>& objects, Frame_builder& frame)
      : options_(options),
        workers_(workers),
        objects_(objects),
        frame_(frame),
        search_(workers),
        small_pairs_(workers),
        bounded_search_(workers) {}

  /// Replaces the pairs of the frame by those of all objects.
  void find_all(const Collision_filter& filter) {
    begin();
    timed(frame_.seconds().broad_phase, [&] {
      find_candidates(filter);
      forget_places([this](Object_pair pair) { return !std::ranges::binary_search(candidates_, pair); });
    });
    timed(frame_.seconds().confirmation, [&] { check_candidates(); });
  }
  /// The same for a single pair, unless the filter leaves it out.
  void find(const Collision_filter& filter, Object_pair pair) {
    begin();
    if (filter.may_collide(pair.a, pair.b)) candidates_.push_back(pair);
    timed(frame_.seconds().confirmation, [&] { check_candidates(); });
  }

  /// Forgets what was kept of an object. O(pairs in contact).
  void forget(Object_id id) {
    forget_places([id](Object_pair pair) { return pair.a == id || pair.b == id; });
  }

  /// Searches for the contacts of two objects, or within one if both are the same.
  Contact_summary search(Object_pair pair, const Contact_request& request, std::vector<Face_pair>& found);
  /// Shows the contacts of two objects to a visitor: see `Detector::visit`.
  template <Contact_visitor Visitor>
  Visit visit(Object_pair pair, Visitor&& visitor) {
    if constexpr (Exact_objects<Volume>::can_have_bounds)
      if (objects_.on_demand(pair))
        return bounded_search_.visit(objects_.bounded(pair.a), objects_.bounded(pair.b), options_.exact.tolerance,
                                     std::ref(visitor));
    return visit_contacts(objects_.surface(pair.a).view(), objects_.surface(pair.b).view(), options_.exact.tolerance,
                          std::forward<Visitor>(visitor));
  }
  /// Whether one object lies inside another, where their surfaces do not intersect.
  bool encloses(Object_id outer, Object_id inner);

 private:
  void begin() {
    frame_.clear_pairs();
    candidates_.clear();
  }
  void find_candidates(const Collision_filter& filter);
  /// Forgets the remembered leaves of the pairs for which `is_over` returns true.
  template <class Is_over>
  void forget_places(const Is_over& is_over) {
    std::erase_if(contact_places_, [&](const auto& place) { return is_over(place.first.first); });
  }
  void check_candidates();
  void ask_about_small_pairs(std::size_t first);
  void check(std::size_t candidate);
  /// Whether a search may end where there was a contact the last time.
  bool starts_from_place(Object_pair pair, const Contact_request& request) const {
    return request.query == Contact_query::yes_no && pair.a != pair.b && objects_.on_demand(pair);
  }
  Contact_summary search_from_place(Object_pair pair, const Contact_request& request);
  void find_contacts(std::size_t candidate, Pair_result& result);
  Contact_request request(Object_pair pair) const {
    return {
        .query = options_.contacts, .tolerance = tolerance_of(options_.exact, pair), .most = options_.most_contacts};
  }
  void find_containment(Pair_result& result);
  void find_parting(Pair_result& result);

  Detector_options options_;
  Workers& workers_;
  Exact_objects<Volume>& objects_;
  Frame_builder& frame_;
  Basic_contact_search<Volume> search_;
  Small_pairs<Volume> small_pairs_;
  Bounded_search bounded_search_;
  /// Of pairs on demand, with a tolerance (true) or without: where they had a contact the last time.
  std::map<std::pair<Object_pair, bool>, Leaf_pair> contact_places_;

  // Memory of the stages, kept from frame to frame.
  std::vector<Box> boxes_;
  std::vector<double> reach_;
  Broad_phase broad_phase_;
  std::vector<Object_pair> candidates_;
};

template <Bounding_volume Volume>
void Exact_pairs<Volume>::find_candidates(const Collision_filter& filter) {
  const auto ids = objects_.ids();
  boxes_.resize(objects_.size());
  for (const auto id : ids) boxes_[id] = to_box(objects_.box(id));
  reach_.resize(objects_.size(), options_.exact.tolerance);
  for (const auto pair : broad_phase_.find(ids, boxes_, reach_))
    if (filter.may_collide(pair.a, pair.b)) candidates_.push_back(pair);
  if (!options_.exact.self_collision) return;
  for (const auto id : ids)
    if (filter.may_collide(id, id)) candidates_.push_back({id, id});
  std::ranges::sort(candidates_);
}

/// Begins alone: often that is all there is to do, and waking other threads would take longer.
template <Bounding_volume Volume>
void Exact_pairs<Volume>::check_candidates() {
  constexpr std::size_t tests_alone = 64;  // pairs of objects or of leaves; some 50 microseconds
  small_pairs_.clear();
  std::size_t candidate = 0;
  for (; candidate < candidates_.size() && candidate + frame_.statistics().leaf_tests < tests_alone; ++candidate)
    check(candidate);
  if (workers_.count() > 1) ask_about_small_pairs(candidate);
  for (; candidate < candidates_.size(); ++candidate) check(candidate);
}

/// Searches them side by side, if there are enough. The answers are taken by `check`.
template <Bounding_volume Volume>
void Exact_pairs<Volume>::ask_about_small_pairs(std::size_t first) {
  for (std::size_t candidate = first; candidate < candidates_.size(); ++candidate) {
    const Object_pair pair = candidates_[candidate];
    if (objects_.on_demand(pair)) continue;
    const Surface &a = objects_.surface(pair.a), &b = objects_.surface(pair.b);
    if (small_pairs_.are_small(a, b)) small_pairs_.ask(candidate, a, b, request(pair));
  }
  small_pairs_.answer();
}

template <Bounding_volume Volume>
void Exact_pairs<Volume>::check(std::size_t candidate) {
  const Object_pair pair = candidates_[candidate];
  Pair_result result = frame_.start_pair(pair);
  find_contacts(candidate, result);
  if (pair.a != pair.b) {
    find_containment(result);
    find_parting(result);
  }
  frame_.end_pair(
      result, [this](Object_id id, std::uint32_t face) { return surface_triangle(objects_.surface(id), face); },
      workers_);
  frame_.add_patches(objects_.surface(pair.a), objects_.surface(pair.b), tolerance_of(options_.exact, pair), workers_);
}

/// Containment is found where it is asked for, and where a parting is: that needs it.
template <Bounding_volume Volume>
void Exact_pairs<Volume>::find_containment(Pair_result& result) {
  if (!options_.exact.containment && !options_.exact.parting) return;
  if (result.collides) return;
  if (encloses(result.b, result.a))
    result.containment = Containment::a_in_b;
  else if (encloses(result.a, result.b))
    result.containment = Containment::b_in_a;
}

template <Bounding_volume Volume>
void Exact_pairs<Volume>::find_parting(Pair_result& result) {
  if (!options_.exact.parting || (!result.collides && result.containment == Containment::none)) return;
  for (const auto id : {result.a, result.b}) objects_.pose_all(id);
  result.parting = lodestone::parting(objects_.surface(result.a), objects_.surface(result.b), workers_);
}

template <Bounding_volume Volume>
void Exact_pairs<Volume>::find_contacts(std::size_t candidate, Pair_result& result) {
  const Object_pair pair = candidates_[candidate];
  const Pair_contacts* known = small_pairs_.take(candidate, frame_.face_pairs(), frame_.contact_intersects());
  const auto search_now = [&](const Contact_request& asked, auto& found) {
    return starts_from_place(pair, asked) ? search_from_place(pair, asked) : search(pair, asked, found);
  };
  const Pair_contacts contacts =
      known != nullptr ? *known
                       : pair_contacts(request(pair), search_now, frame_.face_pairs(), frame_.contact_intersects());
  result.collides = contacts.collides;
  result.near = contacts.near;
  result.capped = contacts.capped;
  result.leaf_tests = contacts.leaf_tests;
  frame_.statistics().leaf_tests += contacts.leaf_tests;
  frame_.statistics().exact_tests += contacts.exact_tests;
}

template <Bounding_volume Volume>
Contact_summary Exact_pairs<Volume>::search(Object_pair pair, const Contact_request& request,
                                            std::vector<Face_pair>& found) {
  if (pair.a == pair.b)
    objects_.pose_all(pair.a);
  else if (objects_.on_demand(pair))
    return bounded_search_.run(objects_.bounded(pair.a), objects_.bounded(pair.b), request, found);
  const Surface &a = objects_.surface(pair.a), &b = objects_.surface(pair.b);
  return pair.a == pair.b ? search_.within(a, request, found) : search_.between(a, b, request, found);
}

/// For the query `yes_no`: looks first where there was a contact the last time.
template <Bounding_volume Volume>
Contact_summary Exact_pairs<Volume>::search_from_place(Object_pair pair, const Contact_request& request) {
  const std::pair asked(pair, request.tolerance > 0);
  const auto known = contact_places_.find(asked);
  auto place = known == contact_places_.end() ? std::nullopt : std::optional(known->second);
  std::vector<Face_pair> none;
  const Contact_summary contacts =
      bounded_search_.run(objects_.bounded(pair.a), objects_.bounded(pair.b), request, none, &place);
  if (place)
    contact_places_.insert_or_assign(asked, *place);
  else
    contact_places_.erase(asked);
  return contacts;
}

template <Bounding_volume Volume>
bool Exact_pairs<Volume>::encloses(Object_id outer, Object_id inner) {
  if constexpr (Exact_objects<Volume>::can_have_bounds)
    if (objects_.on_demand({outer, inner}))
      return lodestone::encloses(objects_.bounded(outer), objects_.bounded(inner));
  return lodestone::encloses(objects_.surface(outer), objects_.surface(inner));
}

}  // namespace lodestone
