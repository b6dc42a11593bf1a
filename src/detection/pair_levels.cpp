// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/pair_levels.h"

#include <algorithm>
#include <numeric>

namespace lodestone {

void Pair_levels::assign(std::span<const Object_pair> pairs) {
  free_.clear();
  levels_.clear();
  begin_.assign(1, 0);
  for (const auto [a, b] : pairs) {
    free_.resize(std::max<std::size_t>(free_.size(), std::max(a, b) + std::size_t{1}));
    const std::uint32_t level = std::max(free_[a], free_[b]);
    free_[a] = free_[b] = level + 1;
    levels_.push_back(level);
    begin_.resize(std::max<std::size_t>(begin_.size(), level + std::size_t{2}));
    ++begin_[level + 1];  // a count, for now
  }
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  order_.resize(pairs.size());
  next_.assign(begin_.begin(), begin_.end());
  for (std::uint32_t pair = 0; pair < pairs.size(); ++pair) order_[next_[levels_[pair]]++] = pair;
}

}  // namespace lodestone
