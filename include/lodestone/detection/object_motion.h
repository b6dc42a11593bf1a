// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "lodestone/detection/broad_phase.h"
#include "lodestone/detection/collision_filter.h"
#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/mesh/workers.h"
#include "lodestone/queries/impact_search.h"
#include "lodestone/queries/node_boxes.h"
#include "lodestone/tree/tree_surface.h"
#include "lodestone/volumes/to_box.h"

namespace lodestone {

/// An object on its way from where it is to where it will be, in mode `exact`.
template <Bounding_volume Volume>
class Object_motion {
 public:
  /// @param surface  as it is now; must outlive this, and stay as it is
  /// @param end      V x 3 positions; empty: it stays where it is
  Object_motion(const Basic_tree_surface<Volume>& surface, Positions end)
      : end_(std::move(end)), start_(surface.view()), swept_(start_.layout(), end_coordinates()) {}
  Object_motion(const Object_motion&) = delete;
  Object_motion& operator=(const Object_motion&) = delete;

  /// Its tree at both ends of the motion.
  const Swept_view& view() const { return swept_.view(); }
  /// Around the whole motion.
  Box box() const {
    Box box = to_box(view().start.boxes[0]);
    box.extend(to_box(view().end.boxes[0]));
    return box;
  }

 private:
  Coordinates end_coordinates() const {
    if (end_.rows() == 0) return start_.layout().coordinates;
    return {end_.data(), static_cast<std::size_t>(end_.size())};
  }

  Positions end_;
  Node_boxes<Volume> start_;
  Swept_boxes swept_;
};

/// The pairs of objects whose boxes around the whole motion meet, sorted.
template <Bounding_volume Volume>
std::span<const Object_pair> pairs_near(std::span<const std::unique_ptr<const Object_motion<Volume>>> motions,
                                        Broad_phase& broad_phase) {
  std::vector<std::uint32_t> ids;
  std::vector<Box> boxes(motions.size());
  for (std::uint32_t id = 0; id < motions.size(); ++id) {
    if (!motions[id]) continue;
    ids.push_back(id);
    boxes[id] = motions[id]->box();
  }
  const std::vector<double> no_reach(motions.size());
  return broad_phase.find(ids, boxes, no_reach);
}

/// The pairs of objects that can meet and may collide, sorted.
/// @param motions      by id; null: the object has been removed
/// @param with_itself  also each object with itself
template <Bounding_volume Volume>
std::vector<Object_pair> pairs_to_search(std::span<const std::unique_ptr<const Object_motion<Volume>>> motions,
                                         const Collision_filter& filter, bool with_itself, Broad_phase& broad_phase) {
  std::vector<Object_pair> pairs;
  for (const auto pair : pairs_near(motions, broad_phase))
    if (filter.may_collide(pair.a, pair.b)) pairs.push_back(pair);
  for (std::uint32_t id = 0; with_itself && id < motions.size(); ++id)
    if (motions[id] && filter.may_collide(id, id)) pairs.push_back({id, id});
  std::ranges::sort(pairs);
  return pairs;
}

/// The first impact of a pair; of an object with itself, that of faces that share no vertex.
template <Bounding_volume Volume>
std::optional<Impact> impact_of(std::span<const std::unique_ptr<const Object_motion<Volume>>> motions, Object_pair pair,
                                double latest = 1) {
  if (pair.a == pair.b) return first_self_impact(motions[pair.a]->view(), latest);
  return first_impact(motions[pair.a]->view(), motions[pair.b]->view(), latest);
}

/// The first impact of each pair of objects that meet and may collide, in the order of the pairs.
/// @param motions, with_itself  as of `pairs_to_search`
template <Bounding_volume Volume>
std::vector<Object_impact> impacts_of_pairs(std::span<const std::unique_ptr<const Object_motion<Volume>>> motions,
                                            const Collision_filter& filter, bool with_itself, Broad_phase& broad_phase,
                                            Workers& workers) {
  const auto pairs = pairs_to_search(motions, filter, with_itself, broad_phase);
  std::vector<std::optional<Impact>> found(pairs.size());
  workers.run(pairs.size(), [&](std::size_t i, std::size_t) { found[i] = impact_of(motions, pairs[i]); });
  std::vector<Object_impact> impacts;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (found[i]) impacts.push_back({pairs[i], *found[i]});
  return impacts;
}

/// The earliest impact of objects that may collide. Pairs are sorted, so of several at exactly the same time it is the
/// lowest.
/// @param motions, with_itself  as of `pairs_to_search`
template <Bounding_volume Volume>
std::optional<Object_impact> earliest_impact(std::span<const std::unique_ptr<const Object_motion<Volume>>> motions,
                                             const Collision_filter& filter, bool with_itself,
                                             Broad_phase& broad_phase) {
  std::optional<Object_impact> first;
  for (const auto pair : pairs_to_search(motions, filter, with_itself, broad_phase)) {
    if (first && first->impact.exact_time == Impact_time()) break;  // nothing is earlier than the start
    const double latest = first ? first->impact.exact_time.high() : 1;
    const auto impact = impact_of(motions, pair, latest);
    if (impact && (!first || impact->exact_time < first->impact.exact_time)) first = {pair, *impact};
  }
  return first;
}

}  // namespace lodestone
