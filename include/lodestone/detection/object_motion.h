// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <utility>

#include "lodestone/mesh/mesh_numbering.h"
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

/// Replaces the first impact by that of two objects if theirs is earlier; at the same time, if their ids are lower.
template <Bounding_volume Volume>
void keep_earlier(const Object_motion<Volume>& a, const Object_motion<Volume>& b, Object_pair pair,
                  std::optional<Object_impact>& first) {
  const double latest = first ? first->impact.exact_time.high() : 1;
  const auto impact = first_impact(a.view(), b.view(), latest);
  if (!impact) return;
  if (first && (impact->exact_time > first->impact.exact_time ||
                (impact->exact_time == first->impact.exact_time && pair > first->objects)))
    return;
  first = {pair, *impact};
}

}  // namespace lodestone
