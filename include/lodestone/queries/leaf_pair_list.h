// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lodestone {

/// A leaf of each of two trees.
struct Leaf_pair {
  std::uint32_t a;  ///< of the first
  std::uint32_t b;  ///< of the second

  /// By the first leaf, then by the second.
  friend auto operator<=>(const Leaf_pair&, const Leaf_pair&) = default;
};

/// Leaf pairs, each once, in the order in which they were added. Keeps its memory: a set of the standard library would
/// allocate for each pair, in every frame.
class Leaf_pair_list {
 public:
  /// Removes all pairs. O(pairs).
  void clear();
  /// Adds a pair, unless it is in the list. O(1) on average.
  /// @return whether it was added
  bool add(Leaf_pair pair);
  /// Whether a pair is in the list. O(1) on average.
  bool contains(Leaf_pair pair) const;
  /// All pairs. Valid until the next change.
  std::span<const Leaf_pair> pairs() const { return pairs_; }

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  std::size_t chain_of(Leaf_pair pair) const;
  void prepend(std::uint32_t index);
  void make_chains(std::size_t count);

  std::vector<Leaf_pair> pairs_;
  // A hash table: pairs with the same hash are a chain of indices.
  std::vector<std::uint32_t> first_;  ///< per hash, of which there are a power of two; or `none`
  std::vector<std::uint32_t> next_;   ///< per pair; or `none`
  unsigned shift_ = 63;               ///< bits of a hash that are dropped
};

}  // namespace lodestone
