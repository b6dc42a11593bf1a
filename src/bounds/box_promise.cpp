// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/bounds/box_promise.h"

#include <fmt/format.h>

#include <utility>

#include "lodestone/mesh/errors.h"
#include "lodestone/tree/region_tree.h"

namespace lodestone {

Promised_boxes::Promised_boxes(const Box_promise& promise, const Bounded_object& object) : promise_(&promise) {
  check_object(object);
  rest_ = fitted_boxes(object.layout, object.rest);
  regions_ = node_regions(object.layout, object.labels);
}

Aabb Promised_boxes::box(std::uint32_t node) const {
  Aabb box = promise_->box(regions_[node], rest_[node]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (box.low[axis] > box.high[axis])
      throw Bad_argument(fmt::format(
          "the box that a Box_promise gave {} has a lower end, {}, above its upper one, {}",
          regions_[node] == several_regions ? "for several regions" : fmt::format("for region {}", regions_[node]),
          box.low[axis], box.high[axis]));
    open_if_not_finite(box, axis);
  }
  return box;
}

Box_promise::Box_promise(Function box) : box_(std::move(box)) {
  if (!box_) throw Bad_argument("a promise of boxes needs a function that gives them");
}

}  // namespace lodestone
