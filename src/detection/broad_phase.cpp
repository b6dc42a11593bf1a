// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/broad_phase.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <numeric>

namespace lodestone {

namespace {

bool within_reach(const Box& a, const Box& b, double reach) {
  return ((a.min() - b.max()).array() <= reach).all() && ((b.min() - a.max()).array() <= reach).all();
}

/// Fast where objects have changed places with few others since the last frame. Gives up where they have not.
/// @return whether all are sorted
template <class Begin>
bool insertion_sort(std::span<std::uint32_t> order, const Begin& begin) {
  std::size_t steps_left = 8 * order.size();
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
  in_strips_.reserve(4 * objects);
  ends_.reserve(objects / 16 + 2);
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

Broad_phase::Interval Broad_phase::grown(const Box& box, double reach, int axis) {
  return {box.min()[axis] - reach, box.max()[axis] + reach};
}

/// Boxes are sorted along the axis along which the fewest of a sample overlap. Another axis must be twice as good to be
/// worth sorting anew. Few boxes are not worth the sample.
void Broad_phase::choose_axes(std::span<const Box> boxes, std::span<const double> reach) {
  constexpr std::size_t few = 64, sampled = 32, sampled_pairs = sampled * (sampled - 1) / 2;
  divides_ = false;
  if (order_.size() < few) return;
  std::array<std::size_t, 3> overlaps{};
  for (int axis = 0; axis < 3; ++axis) {
    std::array<Interval, sampled> sample;
    for (std::size_t i = 0; i < sampled; ++i) {
      const auto id = order_[i * order_.size() / sampled];
      sample[i] = grown(boxes[id], reach[id], axis);
      for (std::size_t j = 0; j < i; ++j) overlaps[axis] += overlap(sample[i], sample[j]) ? 1 : 0;
    }
  }
  int best = axis_;
  for (int axis = 0; axis < 3; ++axis)
    if (2 * overlaps[axis] < overlaps[axis_] && overlaps[axis] < overlaps[best]) best = axis;
  const int second = (best + 1) % 3, third = (best + 2) % 3;
  across_ = overlaps[third] < overlaps[second] ? third : second;
  divides_ = 4 * overlaps[across_] < sampled_pairs;
  axis_ = best;
}

void Broad_phase::sort(std::span<const std::uint32_t> ids, std::span<const Box> boxes, std::span<const double> reach) {
  const std::size_t kept = take(ids);
  choose_axes(boxes, reach);
  const auto begin = [&](std::uint32_t object) { return boxes[object].min()[axis_] - reach[object]; };
  const auto middle = order_.begin() + static_cast<std::ptrdiff_t>(kept);
  if (insertion_sort({order_.begin(), middle}, begin)) {
    std::ranges::sort(middle, order_.end(), {}, begin);
    std::ranges::inplace_merge(order_, middle, {}, begin);
  } else {
    std::ranges::sort(order_, {}, begin);
  }
}

/// Twice the median of some boxes' grown extents across the axis.
double Broad_phase::strip_width(std::span<const Box> boxes, std::span<const double> reach) const {
  constexpr std::size_t sampled = 63;
  std::array<double, sampled> extents;
  for (std::size_t i = 0; i < sampled; ++i) {
    const auto id = order_[i * order_.size() / sampled];
    const auto [begin, end] = grown(boxes[id], reach[id], across_);
    extents[i] = std::max(0.0, end - begin);
  }
  const auto middle = extents.begin() + sampled / 2;
  std::ranges::nth_element(extents, middle);
  return 2 * *middle;
}

/// How many strips there are across the axis, and how wide: as two usual boxes. Strips repeat: of k of them, place p
/// belongs to strip p modulo k. So a few boxes far away need no more strips.
void Broad_phase::choose_strips(std::span<const Box> boxes, std::span<const double> reach) {
  strips_ = 1;
  width_ = divides_ ? strip_width(boxes, reach) : 0;
  if (width_ > 0 && std::isfinite(width_)) strips_ = std::bit_floor(order_.size() / 16);
  while (!count_in_strips(boxes, reach)) {
    width_ *= 4;  // many boxes are wider than usual
    if (!std::isfinite(width_)) strips_ = 1;
  }
}

/// Afterwards `ends_` has per strip where its boxes begin. `divide` moves that to where they end.
/// @return false: they would be more than four for each box
bool Broad_phase::count_in_strips(std::span<const Box> boxes, std::span<const double> reach) {
  ends_.assign(strips_ + 1, 0);
  std::size_t total = 0;
  for (const auto id : order_) {
    visit_strips(grown(boxes[id], reach[id], across_), [&](std::size_t strip) {
      ++ends_[strip + 1];
      ++total;
    });
    if (total > 4 * order_.size()) return false;
  }
  std::partial_sum(ends_.begin(), ends_.end(), ends_.begin());
  return true;
}

/// Lists the boxes of each strip in their order along the axis.
void Broad_phase::divide(std::span<const Box> boxes, std::span<const double> reach) {
  choose_strips(boxes, reach);
  in_strips_.resize(ends_.back());
  const int third = 3 - axis_ - across_;
  for (const auto id : order_) {
    const auto interval = [&](int axis) { return grown(boxes[id], reach[id], axis); };
    const Grown_box box{interval(axis_), interval(across_), interval(third), id};
    visit_strips(box.across, [&](std::size_t strip) { in_strips_[ends_[strip]++] = box; });
  }
}

std::int64_t Broad_phase::place_across(double coordinate) const {
  return static_cast<std::int64_t>(std::clamp(std::floor(coordinate / width_), -0x1p60, 0x1p60));
}

template <class Visit>
void Broad_phase::visit_strips(const Interval& across, const Visit& visit) const {
  if (strips_ == 1) return visit(0);
  const auto first = place_across(across.begin), last = place_across(across.end);
  for (auto place = first; place <= last && place < first + static_cast<std::int64_t>(strips_); ++place)
    visit(strip_at(place));
}

/// Two boxes can have several strips in common: they meet in the one where the second of them begins.
bool Broad_phase::meet_in(std::size_t strip, const Interval& a, const Interval& b) const {
  return strips_ == 1 || strip_at(place_across(std::max(a.begin, b.begin))) == strip;
}

std::span<const Object_pair> Broad_phase::find(std::span<const std::uint32_t> ids, std::span<const Box> boxes,
                                               std::span<const double> reach) {
  sort(ids, boxes, reach);
  divide(boxes, reach);
  pairs_.clear();
  for (std::size_t strip = 0; strip < strips_; ++strip) {
    const std::size_t end = ends_[strip];
    for (std::size_t i = strip > 0 ? ends_[strip - 1] : 0; i < end; ++i) {
      const Grown_box& a = in_strips_[i];
      for (std::size_t j = i + 1; j < end && in_strips_[j].along.begin <= a.along.end; ++j) {
        const Grown_box& b = in_strips_[j];
        if ((int{overlap(a.across, b.across)} & int{overlap(a.third, b.third)}) == 0) continue;
        if (!within_reach(boxes[a.id], boxes[b.id], std::max(reach[a.id], reach[b.id]))) continue;
        if (meet_in(strip, a.across, b.across)) pairs_.push_back({std::min(a.id, b.id), std::max(a.id, b.id)});
      }
    }
  }
  std::ranges::sort(pairs_);
  return pairs_;
}

}  // namespace lodestone
