// SPDX-License-Identifier: GPL-3.0-or-later
#include "tree/face_split.h"

#include <Eigen/Core>
#include <algorithm>
#include <cstring>
#include <vector>

namespace lodestone {

namespace {

/// Below this number of items a selection in place is faster than counting them.
constexpr std::size_t few_items = 192;
constexpr std::size_t slices = 256;

/// How many items a worker takes at once.
constexpr std::size_t items_at_once = 16384;

/// Bounds of the centres.
struct Bounds {
  Eigen::Array4f low, high;  ///< the fourth means nothing

  void extend(const Eigen::Array4f& numbers) {
    low = low.min(numbers);
    high = high.max(numbers);
  }
  void extend(const Bounds& other) {
    low = low.min(other.low);
    high = high.max(other.high);
  }
};

/// The axis on which the centres are spread widest, and where they begin and end on it.
struct Spread {
  std::size_t axis = 0;
  float low = 0, high = 0;
};

/// All four numbers of an item in one vector register; the index means nothing there.
Eigen::Array4f in_register(const Split_item& item) {
  Eigen::Array4f numbers;
  static_assert(sizeof(numbers) == sizeof(item));
  std::memcpy(numbers.data(), &item, sizeof(item));
  return numbers;
}

/// Four pairs of bounds, since each waits for its own last result.
Bounds bounds_of(std::span<const Split_item> items) {
  const Eigen::Array4f first = in_register(items.front());
  std::array<Bounds, 4> bounds;
  bounds.fill({first, first});
  std::size_t i = 0;
  for (; i + 4 <= items.size(); i += 4)
    for (std::size_t b = 0; b < 4; ++b) bounds[b].extend(in_register(items[i + b]));
  for (; i < items.size(); ++i) bounds[0].extend(in_register(items[i]));
  for (std::size_t b = 1; b < 4; ++b) bounds[0].extend(bounds[b]);
  return bounds[0];
}

Spread widest_spread(const Bounds& bounds) {
  Eigen::Index axis = 0;
  (bounds.high - bounds.low).head<3>().maxCoeff(&axis);
  return {.axis = static_cast<std::size_t>(axis), .low = bounds.low[axis], .high = bounds.high[axis]};
}

/// Ties are broken by index, so that a split does not depend on the order of the items.
void select(std::span<Split_item> items, std::size_t first_count, std::size_t axis) {
  const auto before = [axis](const Split_item& a, const Split_item& b) {
    return a.centre[axis] != b.centre[axis] ? a.centre[axis] < b.centre[axis] : a.index < b.index;
  };
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(first_count), items.end(), before);
}

/// Slices of equal width across a spread.
class Slices {
 public:
  explicit Slices(const Spread& spread)
      : axis_(spread.axis), low_(spread.low), per_unit_(static_cast<float>(slices) / (spread.high - spread.low)) {}

  std::size_t slice(const Split_item& item) const {
    return std::min(static_cast<std::size_t>(static_cast<std::uint32_t>((item.centre[axis_] - low_) * per_unit_)),
                    slices - 1);
  }

 private:
  std::size_t axis_;
  float low_, per_unit_;
};

/// How many items each slice holds.
using Counts = std::array<std::uint32_t, slices>;

/// Neighbours in the list are mostly neighbours in space, so a single list of counts would wait for its own last
/// increment most of the time.
Counts count_slices(std::span<const Split_item> items, const Slices& of) {
  constexpr std::size_t lists = 4;
  std::array<Counts, lists> counts = {};
  std::size_t i = 0;
  for (; i + lists <= items.size(); i += lists)
    for (std::size_t list = 0; list < lists; ++list) ++counts[list][of.slice(items[i + list])];
  for (; i < items.size(); ++i) ++counts[0][of.slice(items[i])];
  for (std::size_t list = 1; list < lists; ++list)
    for (std::size_t slice = 0; slice < slices; ++slice) counts[0][slice] += counts[list][slice];
  return counts[0];
}

/// The slice in which the first items end, and how many are in those before.
struct Middle {
  std::size_t slice = 0, begin = 0;
};

Middle find_middle(const Counts& counts, std::size_t first_count) {
  Middle middle;
  while (middle.begin + counts[middle.slice] <= first_count) middle.begin += counts[middle.slice++];
  return middle;
}

/// Where the next item before, within or behind the middle slice goes.
struct Places {
  std::size_t before, within, behind;

  /// Past items of which so many are in each slice.
  void skip(const Counts& counts, std::size_t middle) {
    for (std::size_t slice = 0; slice < slices; ++slice)
      (slice < middle ? before : slice > middle ? behind : within) += counts[slice];
  }
};

/// Without a branch that depends on an item.
void move_items(std::span<const Split_item> items, const Slices& of, std::size_t middle, Places places,
                std::span<Split_item> to) {
  for (const Split_item& item : items) {
    const std::size_t slice = of.slice(item);
    const bool is_before = slice<middle, is_behind = slice> middle;
    to[is_before ? places.before : is_behind ? places.behind : places.within] = item;
    places.before += is_before ? 1 : 0;
    places.behind += is_behind ? 1 : 0;
    places.within += is_before || is_behind ? 0 : 1;
  }
}

/// Equal parts of many items, which workers share.
class Parts {
 public:
  Parts(std::span<const Split_item> items, Workers& workers)
      : items_(items), workers_(workers), count_((items.size() + items_at_once - 1) / items_at_once) {}

  std::size_t count() const { return count_; }
  /// Calls `task(index, items)` for each part.
  template <class Task>
  void each(const Task& task) const {
    workers_.run(count_, [&](std::size_t part, std::size_t) {
      const std::size_t begin = part * items_at_once;
      task(part, items_.subspan(begin, std::min(items_at_once, items_.size() - begin)));
    });
  }

 private:
  std::span<const Split_item> items_;
  Workers& workers_;
  std::size_t count_;
};

Bounds bounds_of(const Parts& parts) {
  std::vector<Bounds> bounds(parts.count());
  parts.each([&](std::size_t part, auto items) { bounds[part] = bounds_of(items); });
  for (const auto& other : bounds) bounds.front().extend(other);
  return bounds.front();
}

/// Each part counts, then moves its items behind those of the parts before it: the same places as by one worker.
Middle move_items(const Parts& parts, const Slices& of, std::size_t first_count, std::span<Split_item> to,
                  Counts& counts) {
  std::vector<Counts> of_part(parts.count());
  parts.each([&](std::size_t part, auto items) { of_part[part] = count_slices(items, of); });
  counts = {};
  for (const auto& others : of_part)
    for (std::size_t slice = 0; slice < slices; ++slice) counts[slice] += others[slice];
  const Middle middle = find_middle(counts, first_count);
  std::vector<Places> places{{0, middle.begin, middle.begin + counts[middle.slice]}};
  for (std::size_t part = 0; part + 1 < parts.count(); ++part) {
    places.push_back(places.back());
    places.back().skip(of_part[part], middle.slice);
  }
  parts.each([&](std::size_t part, auto items) { move_items(items, of, middle.slice, places[part], to); });
  return middle;
}

Middle move_items(std::span<const Split_item> items, const Slices& of, std::size_t first_count,
                  std::span<Split_item> to, Counts& counts) {
  counts = count_slices(items, of);
  const Middle middle = find_middle(counts, first_count);
  move_items(items, of, middle.slice, {0, middle.begin, middle.begin + counts[middle.slice]}, to);
  return middle;
}

}  // namespace

float widest_spread(std::span<const Split_item> items) {
  const Spread spread = widest_spread(bounds_of(items));
  return spread.high - spread.low;
}

/// Many items are counted by slice. The slice in which the first `first_count` end is the only one whose items have to
/// be told apart. The others are copied before and behind it.
Split_result split_items(std::span<Split_item> items, std::span<Split_item> spare, std::size_t first_count, float least,
                         Workers& workers) {
  const bool shared = workers.count() > 1 && items.size() > 2 * items_at_once;
  const Parts parts(items, workers);
  const Spread spread = widest_spread(shared ? bounds_of(parts) : bounds_of(items));
  if (spread.high - spread.low < least) return Split_result::too_narrow;
  const bool flat = !std::isnormal(static_cast<float>(slices) / (spread.high - spread.low));
  if (items.size() < few_items || flat) {
    select(items, first_count, spread.axis);
    return Split_result::in_place;
  }
  const Slices of(spread);
  Counts counts;
  const Middle middle =
      shared ? move_items(parts, of, first_count, spare, counts) : move_items(items, of, first_count, spare, counts);
  select(spare.subspan(middle.begin, counts[middle.slice]), first_count - middle.begin, spread.axis);
  return Split_result::in_spare;
}

}  // namespace lodestone
