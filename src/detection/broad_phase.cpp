// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/broad_phase.h"

#include <algorithm>
#include <numeric>

namespace lodestone {

namespace {

bool within_reach(const Box& a, const Box& b, double reach) {
  return ((a.min() - b.max()).array() <= reach).all() && ((b.min() - a.max()).array() <= reach).all();
}

}  // namespace

void Broad_phase::reserve(std::size_t objects) {
  order_.reserve(objects);
  // Every pair of a few objects; beyond that the list grows to what the scene needs.
  pairs_.reserve(std::min<std::size_t>(objects * (objects + 1) / 2, 100 * objects));
}

std::span<const Object_pair> Broad_phase::find(std::span<const Box> boxes, std::span<const double> reach) {
  if (order_.size() != boxes.size()) {
    order_.resize(boxes.size());
    std::iota(order_.begin(), order_.end(), 0);
  }
  const auto begin = [&](std::uint32_t object) { return boxes[object].min().x() - reach[object]; };
  const auto end = [&](std::uint32_t object) { return boxes[object].max().x() + reach[object]; };
  // Insertion sort: objects change places with few others from one frame to the next.
  for (std::size_t i = 1; i < order_.size(); ++i)
    for (std::size_t j = i; j > 0 && begin(order_[j]) < begin(order_[j - 1]); --j) std::swap(order_[j], order_[j - 1]);

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
