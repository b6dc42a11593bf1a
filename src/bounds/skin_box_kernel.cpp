// SPDX-License-Identifier: GPL-3.0-or-later
#include "bounds/skin_box_kernel.h"

#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bounds/skin_box_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE Position_vector load(const double* numbers, std::size_t k) {
  return hn::LoadU(Position_lanes(), numbers + k * position_lanes);
}
HWY_INLINE void store(Position_vector vector, double* numbers, std::size_t k) {
  hn::StoreU(vector, Position_lanes(), numbers + k * position_lanes);
}

/// The box that a joint moves, widened by what morphing adds. The fourth numbers mean nothing.
HWY_INLINE void widen(const Morph_shift& by, const Joint_range& range, Moved_range& moved) {
  const Position_lanes d;
  const auto by_half = hn::Set(d, 0.5);
  for (std::size_t k = 0; k < position_vectors; ++k) {
    // What follows in the range fills the fourth lane.
    static_assert(offsetof(Joint_range, high) == 3 * sizeof(double) &&
                  offsetof(Joint_range, least) == 6 * sizeof(double));
    const auto rest_low = load(range.low.data(), k), rest_high = load(range.high.data(), k);
    const auto greatest = hn::Add(hn::Max(hn::Abs(rest_low), hn::Abs(rest_high)), load(by.magnitude.data(), k));
    const auto margin = hn::Add(hn::Mul(hn::Set(d, by.rounding), greatest), hn::Set(d, by.underflow));
    const auto from = hn::Sub(hn::Add(rest_low, load(by.low.data(), k)), margin);
    const auto to = hn::Add(hn::Add(rest_high, load(by.high.data(), k)), margin);
    const auto low = hn::Mul(from, by_half), high = hn::Mul(to, by_half);
    const auto centre = hn::Add(low, high);
    const auto half = hn::Add(hn::Sub(high, low), hn::Set(d, 0x1p-960));  // halves of the smallest numbers are rounded
    store(centre, moved.centre, k);
    store(half, moved.half, k);
    store(hn::Add(hn::Abs(centre), half), moved.reach, k);
  }
}

/// Takes the ends of a box to where the joint does, along the axes of vector `k`.
/// @return an upper bound of |T_j| (|x|, |y|, |z|, 1) in the box
HWY_INLINE Position_vector move(const double* columns, std::size_t k, Moved_range& moved) {
  const Position_lanes d;
  auto middle = load(columns + 12, k), half = hn::Zero(d), magnitude = hn::Abs(middle);
  for (std::size_t column = 0; column < 3; ++column) {
    const auto factor = load(columns + 4 * column, k), absolute = hn::Abs(factor);
    middle = hn::Add(middle, hn::Mul(factor, hn::Set(d, moved.centre[column])));
    half = hn::Add(half, hn::Mul(absolute, hn::Set(d, moved.half[column])));
    magnitude = hn::Add(magnitude, hn::Mul(absolute, hn::Set(d, moved.reach[column])));
  }
  store(hn::Add(middle, half), moved.high, k);
  store(hn::Sub(half, middle), moved.low, k);
  return magnitude;
}

/// max sum_j w_j M_j along the axes of vector `k`: the weight that is not yet given away goes to the greatest ends
/// first. Overwrites the ends.
/// @param end          M_j of a joint
/// @param free_weight  per axis: what the least weights leave of 1
template <class End>
HWY_INLINE Position_vector greatest_mean(const Skinned_node& node, const double* free_weight, std::size_t k,
                                         const End& end) {
  const Position_lanes d;
  const auto nothing = hn::Zero(d);
  auto sum = nothing, left = load(free_weight, k), greatest = nothing;
  for (std::size_t j = 0; j < node.joint_count; ++j)
    sum = hn::Add(sum, hn::Mul(hn::Set(d, node.ranges[j].least), load(end(j), k)));
  for (std::size_t turn = 0; turn < node.joint_count && !hn::AllFalse(d, hn::Gt(left, nothing)); ++turn) {
    auto best = load(end(0), k), best_joint = nothing;
    auto room = hn::Set(d, node.ranges[0].greatest - node.ranges[0].least);
    for (std::size_t j = 1; j < node.joint_count; ++j) {
      const auto other = load(end(j), k);
      const auto better = hn::Gt(other, best);
      best = hn::IfThenElse(better, other, best);
      best_joint = hn::IfThenElse(better, hn::Set(d, static_cast<double>(j)), best_joint);
      room = hn::IfThenElse(better, hn::Set(d, node.ranges[j].greatest - node.ranges[j].least), room);
    }
    if (turn == 0) greatest = best;
    const auto given = hn::Max(hn::Min(room, left), nothing);
    sum = hn::Add(sum, hn::Mul(given, best));
    left = hn::Sub(left, given);
    for (std::size_t j = 0; j < node.joint_count; ++j) {
      const auto is_best = hn::Eq(best_joint, hn::Set(d, static_cast<double>(j)));
      store(hn::IfThenElse(is_best, hn::Neg(hn::Inf(d)), load(end(j), k)), end(j), k);
    }
  }
  // Weights are rounded, so a little can be left.
  return hn::Add(sum, hn::Mul(hn::Max(left, nothing), greatest));
}

Aabb skin_box_kernel(const Skinned_node& node, Moved_range* moved) {
  const Position_lanes d;
  const auto infinite = hn::Inf(d);
  const auto count = static_cast<double>(node.joint_count + node.most_influences);
  double reach[3] = {0, 0, 0};
  double free_weight[4] = {1, 1, 1, 0};  // nothing is to be given away in the fourth lane
  for (std::size_t j = 0; j < node.joint_count; ++j) {
    for (int axis = 0; axis < 3; ++axis) free_weight[axis] -= node.ranges[j].least;
    widen(node.shift, node.ranges[j], moved[j]);
    for (int axis = 0; axis < 3; ++axis)
      reach[axis] = reach[axis] > moved[j].reach[axis] ? reach[axis] : moved[j].reach[axis];
  }
  const double underflow = (count + 4) * 0x1p-1020 * (((1 + reach[0]) + reach[1]) + reach[2]);
  Aabb box;
  for (std::size_t k = 0; k < position_vectors; ++k) {
    auto magnitude = hn::Zero(d);  // R
    for (std::size_t j = 0; j < node.joint_count; ++j) {
      const auto of_joint = move(node.columns + 16 * std::size_t{node.ranges[j].joint}, k, moved[j]);
      // A maximum alone leaves out what is no number.
      magnitude = hn::IfThenElse(hn::Lt(of_joint, infinite), hn::Max(magnitude, of_joint), infinite);
    }
    const auto margin = hn::Add(hn::Mul(hn::Set(d, (16 * count + 64) * 0x1p-53), magnitude), hn::Set(d, underflow));
    const auto high = greatest_mean(node, free_weight, k, [&](std::size_t j) { return moved[j].high; });
    const auto mirrored_low = greatest_mean(node, free_weight, k, [&](std::size_t j) { return moved[j].low; });
    const auto is_finite = hn::Lt(magnitude, infinite);
    store(hn::IfThenElse(is_finite, hn::Add(high, margin), infinite), box.high, k);
    store(hn::Neg(hn::IfThenElse(is_finite, hn::Add(mirrored_low, margin), infinite)), box.low, k);
  }
  return box;
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(skin_box_kernel);

Aabb skin_box(const Skinned_node& node, Moved_range* moved) {
  return HWY_DYNAMIC_DISPATCH(skin_box_kernel)(node, moved);
}

}  // namespace lodestone::kernel
#endif
