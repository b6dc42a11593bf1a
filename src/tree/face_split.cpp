// SPDX-License-Identifier: GPL-3.0-or-later
#include "tree/face_split.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstring>

namespace lodestone {

namespace {

/// Below this number of items a selection in place is faster than counting them.
constexpr std::size_t few_items = 192;
constexpr std::size_t slices = 256;

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
Spread widest_spread(std::span<const Split_item> items) {
  std::array<Eigen::Array4f, 4> low, high;
  low.fill(in_register(items.front()));
  high = low;
  const auto extend = [&](std::size_t bounds, const Split_item& item) {
    const Eigen::Array4f numbers = in_register(item);
    low[bounds] = low[bounds].min(numbers);
    high[bounds] = high[bounds].max(numbers);
  };
  std::size_t i = 0;
  for (; i + 4 <= items.size(); i += 4)
    for (std::size_t bounds = 0; bounds < 4; ++bounds) extend(bounds, items[i + bounds]);
  for (; i < items.size(); ++i) extend(0, items[i]);
  const Eigen::Array4f lowest = low[0].min(low[1]).min(low[2].min(low[3]));
  const Eigen::Array4f highest = high[0].max(high[1]).max(high[2].max(high[3]));
  Eigen::Index axis = 0;
  (highest - lowest).head<3>().maxCoeff(&axis);
  return {.axis = static_cast<std::size_t>(axis), .low = lowest[axis], .high = highest[axis]};
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

/// How many items each slice holds. Neighbours in the list are mostly neighbours in space, so a single list of counts
/// would wait for its own last increment most of the time.
std::array<std::uint32_t, slices> count_slices(std::span<const Split_item> items, const Slices& of) {
  constexpr std::size_t lists = 4;
  std::array<std::array<std::uint32_t, slices>, lists> counts = {};
  std::size_t i = 0;
  for (; i + lists <= items.size(); i += lists)
    for (std::size_t list = 0; list < lists; ++list) ++counts[list][of.slice(items[i + list])];
  for (; i < items.size(); ++i) ++counts[0][of.slice(items[i])];
  for (std::size_t list = 1; list < lists; ++list)
    for (std::size_t slice = 0; slice < slices; ++slice) counts[0][slice] += counts[list][slice];
  return counts[0];
}

}  // namespace

/// Many items are counted by slice. The slice in which the first `first_count` end is the only one whose items have to
/// be told apart. The others are copied before and behind it, without a branch that depends on them.
bool split_items(std::span<Split_item> items, std::span<Split_item> spare, std::size_t first_count) {
  const Spread spread = widest_spread(items);
  const bool flat = !std::isnormal(static_cast<float>(slices) / (spread.high - spread.low));
  if (items.size() < few_items || flat) {
    select(items, first_count, spread.axis);
    return false;
  }
  const Slices of(spread);
  const auto counts = count_slices(items, of);
  std::size_t middle = 0, middle_begin = 0;
  while (middle_begin + counts[middle] <= first_count) middle_begin += counts[middle++];

  std::size_t before = 0, within = middle_begin, behind = middle_begin + counts[middle];
  for (const Split_item& item : items) {
    const std::size_t slice = of.slice(item);
    const bool is_before = slice<middle, is_behind = slice> middle;
    spare[is_before ? before : is_behind ? behind : within] = item;
    before += is_before ? 1 : 0;
    behind += is_behind ? 1 : 0;
    within += is_before || is_behind ? 0 : 1;
  }
  select(spare.subspan(middle_begin, counts[middle]), first_count - middle_begin, spread.axis);
  return true;
}

}  // namespace lodestone
