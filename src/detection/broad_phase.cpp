// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/broad_phase.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace lodestone {

namespace {

bool within_reach(const Box& a, const Box& b, double reach) {
  return ((a.min() - b.max()).array() <= reach).all() && ((b.min() - a.max()).array() <= reach).all();
}

/// Fast where objects have changed places with few others since the last frame. Gives up where they have not.
/// @return whether all are sorted
template <class Begin>
bool insertion_sort(std::span<std::uint32_t> order, const Begin& begin) {
  std::size_t steps_left = 16 * order.size();
  for (std::size_t i = 1; i < order.size(); ++i)
    for (std::size_t j = i; j > 0 && begin(order[j]) < begin(order[j - 1]); --j) {
      if (steps_left-- == 0) return false;
      std::swap(order[j], order[j - 1]);
    }
  return true;
}

}  // namespace

void Broad_phase::reserve(std::size_t objects) {
  for (auto* list : {&ids_, &order_}) list->reserve(objects);
  // Every pair of a few objects; beyond that the list grows to what the scene needs.
  pairs_.reserve(std::min<std::size_t>(objects * (objects + 1) / 2, 100 * objects));
}

/// Forgets objects that have been removed, and puts new ones at the end of the order.
/// @return how many have not changed
std::size_t Broad_phase::take(std::span<const std::uint32_t> ids) {
  if (std::ranges::equal(ids, ids_)) return order_.size();
  for (auto* list : {&ids_, &order_}) list->reserve(ids.size());  // from here on nothing fails
  std::erase_if(order_, [&](std::uint32_t id) { return !std::ranges::binary_search(ids, id); });
  const std::size_t kept = order_.size();
  std::ranges::set_difference(ids, ids_, std::back_inserter(order_));
  ids_.assign(ids.begin(), ids.end());
  return kept;
}

/// Boxes are sorted along the axis along which they are spread most, since there the fewest overlap. Another axis must
/// be twice as good to be worth sorting anew.
/// @return whether it is another axis than before
bool Broad_phase::choose_axis(std::span<const Box> boxes) {
  if (order_.empty()) return false;
  const auto middle = [&](std::uint32_t id) -> Eigen::Array3d { return boxes[id].min() / 2 + boxes[id].max() / 2; };
  const Eigen::Array3d origin = middle(order_.front());  // far from 0 too few digits would be left
  Eigen::Array3d sum = Eigen::Array3d::Zero(), squares = Eigen::Array3d::Zero();
  for (const auto id : order_) {
    const Eigen::Array3d offset = middle(id) - origin;
    sum += offset;
    squares += offset.square();
  }
  const Eigen::Array3d variances = squares - sum.square() / static_cast<double>(order_.size());
  int best = axis_;
  for (int axis = 0; axis < 3; ++axis)
    if (variances[axis] > std::max(4 * variances[axis_], variances[best])) best = axis;
  return std::exchange(axis_, best) != best;
}

std::span<const Object_pair> Broad_phase::find(std::span<const std::uint32_t> ids, std::span<const Box> boxes,
                                               std::span<const double> reach) {
  const std::size_t kept = take(ids);
  const bool turned = choose_axis(boxes);
  const auto begin = [&](std::uint32_t object) { return boxes[object].min()[axis_] - reach[object]; };
  const auto end = [&](std::uint32_t object) { return boxes[object].max()[axis_] + reach[object]; };
  const auto middle = order_.begin() + static_cast<std::ptrdiff_t>(kept);
  if (turned || !insertion_sort({order_.begin(), middle}, begin)) {
    std::ranges::sort(order_, {}, begin);
  } else {
    std::ranges::sort(middle, order_.end(), {}, begin);
    std::ranges::inplace_merge(order_, middle, {}, begin);
  }

  pairs_.clear();
  for (std::size_t i = 0; i < order_.size(); ++i)
    for (std::size_t j = i + 1; j < order_.size() && begin(order_[j]) <= end(order_[i]); ++j) {
      const auto [a, b] = std::minmax(order_[i], order_[j]);
      if (within_reach(boxes[a], boxes[b], std::max(reach[a], reach[b]))) pairs_.push_back({a, b});
    }
  std::ranges::sort(pairs_);
  return pairs_;
}

}  // namespace lodestone
