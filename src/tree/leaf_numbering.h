// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "lodestone/volumes/leaf_faces.h"

namespace lodestone {

/// Numbers the vertices of one leaf in the order in which they are met, by a hash table with linear probing. It stays
/// in the innermost cache, where a number per vertex of the mesh would not.
class Leaf_numbering {
 public:
  /// Forgets all vertices. O(1), but for once in 2^32 leaves.
  void start_leaf() {
    count_ = 0;
    if (++leaf_ > 0) return;
    slots_ = {};
    leaf_ = 1;
  }
  /// The number of a vertex; at most 3 `most_leaf_faces` vertices per leaf.
  std::uint16_t operator[](std::uint32_t vertex) {
    // Multiplicative hashing: Knuth, The Art of Computer Programming, vol. 3, section 6.4.
    std::uint32_t index = (vertex * 2654435769U) >> (32 - bits);
    while (slots_[index].leaf == leaf_) {
      if (slots_[index].vertex == vertex) return slots_[index].number;
      index = (index + 1) % slots_.size();
    }
    slots_[index] = {.vertex = vertex, .leaf = leaf_, .number = count_};
    vertices_[count_] = vertex;
    return count_++;
  }
  /// In the order of their numbers.
  std::span<const std::uint32_t> vertices() const { return {vertices_.data(), count_}; }

 private:
  struct Slot {
    std::uint32_t vertex = 0;
    std::uint32_t leaf = 0;
    std::uint16_t number = 0;
  };
  static constexpr int bits = 10;
  static_assert(3 * most_leaf_faces < (1U << bits) / 2, "a search is short while at least half of the slots are free");

  std::array<Slot, 1U << bits> slots_{};
  std::uint32_t leaf_ = 0;
  std::array<std::uint32_t, 3 * most_leaf_faces> vertices_;
  std::uint16_t count_ = 0;
};

}  // namespace lodestone
