// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/bounds/lipschitz_bound.h"

#include "bounds/grown_box.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {

Lipschitz_bound::Lipschitz_bound(const Lipschitz_promise& promise, const Bounded_object& object)
    : promise_(&promise), positions_(&object.positions) {
  check_object(object);
  anchors_ = find_anchors(object.layout, object.rest);
}

Aabb Lipschitz_bound::box_around_anchor(std::uint32_t node, const Eigen::Vector3d& anchor) const {
  constexpr double smallest = 1e-150, rounding = 1 + 1e-9;
  return box_around(anchor,
                    promise_->constant() * (anchors_[node].radius + smallest) + 2 * rounding * promise_->error());
}

void Lipschitz_promise::set_constant(double constant, double error) {
  if (!(constant >= 0)) throw Bad_argument("a Lipschitz constant must be >= 0");
  if (!(error >= 0)) throw Bad_argument("the error of positions must be >= 0");
  constant_ = constant;
  error_ = error;
}

}  // namespace lodestone
