// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/bounds/linear_bound.h"
#include "lodestone/bounds/node_bound.h"
#include "lodestone/bounds/skin_bound.h"

/// The bounds that computed points have by themselves, without a promise of the caller.
namespace lodestone {

/// O(influences log N) for N nodes.
inline Skin_bound own_bound(const Skinned_points& points, const Bounded_object& object) {
  return {points, object.layout};
}
/// O(V + T log N) for T offsets and N nodes.
inline Linear_bound own_bound(const Morphed_points& points, const Bounded_object& object) {
  return {points, object.layout};
}
/// Other points are their own promise, if they are a model of Motion_promise.
template <Motion_promise Points>
auto own_bound(const Points& points, const Bounded_object& object) {
  return points.bound(object);
}

/// Points that tell where their vertices can be.
template <class Points>
concept Bounded_points = requires(const Points& points, const Bounded_object& object) {
  { own_bound(points, object) } -> Motion_bound;
};

}  // namespace lodestone
