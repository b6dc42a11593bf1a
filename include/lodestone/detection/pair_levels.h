// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/mesh/pairs.h"

namespace lodestone {

/// Object pairs in levels: no two pairs of a level have an object in common, and of pairs that have, the earlier one is
/// in an earlier level. So the pairs of a level can be searched side by side, level after level, and each object meets
/// the others in the order of the list. Keeps its memory.
class Pair_levels {
 public:
  /// Puts each pair into the first level that it can be in. O(pairs + objects).
  /// @param pairs  of two different objects each
  void assign(std::span<const Object_pair> pairs);

  /// Number of levels.
  std::size_t size() const { return begin_.empty() ? 0 : begin_.size() - 1; }
  /// The pairs of a level, as indices in the list, ascending.
  std::span<const std::uint32_t> level(std::size_t index) const {
    return std::span(order_).subspan(begin_[index], begin_[index + 1] - begin_[index]);
  }

 private:
  std::vector<std::uint32_t> order_;  ///< the pairs, level by level
  std::vector<std::uint32_t> begin_;  ///< per level, and at the end: index in `order_`
  // Memory.
  std::vector<std::uint32_t> free_;    ///< per object: the first level after its pairs so far
  std::vector<std::uint32_t> levels_;  ///< per pair
  std::vector<std::uint32_t> next_;    ///< per level: the place in `order_` of its next pair
};

}  // namespace lodestone
