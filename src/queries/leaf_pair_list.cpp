// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/leaf_pair_list.h"

#include <algorithm>
#include <bit>

namespace lodestone {

void Leaf_pair_list::clear() {
  for (const Leaf_pair pair : pairs_) first_[chain_of(pair)] = none;
  pairs_.clear();
  next_.clear();
}

bool Leaf_pair_list::add(Leaf_pair pair) {
  if (contains(pair)) return false;
  if (pairs_.size() == first_.size()) make_chains(std::max<std::size_t>(256, 2 * first_.size()));
  pairs_.push_back(pair);
  prepend(static_cast<std::uint32_t>(pairs_.size() - 1));
  return true;
}

bool Leaf_pair_list::contains(Leaf_pair pair) const {
  if (pairs_.empty()) return false;
  std::uint32_t index = first_[chain_of(pair)];
  while (index != none && pairs_[index] != pair) index = next_[index];
  return index != none;
}

/// By multiplication with the golden ratio (Knuth, The Art of Computer Programming, volume 3, section 6.4).
std::size_t Leaf_pair_list::chain_of(Leaf_pair pair) const {
  const std::uint64_t both = std::uint64_t{pair.a} << 32U | pair.b;
  return static_cast<std::size_t>(both * 0x9E3779B97F4A7C15U >> shift_);
}

void Leaf_pair_list::prepend(std::uint32_t index) {
  std::uint32_t& first = first_[chain_of(pairs_[index])];
  next_.push_back(first);
  first = index;
}

/// @param count  a power of two
void Leaf_pair_list::make_chains(std::size_t count) {
  first_.assign(count, none);
  shift_ = static_cast<unsigned>(64 - std::countr_zero(count));
  next_.clear();
  for (std::uint32_t index = 0; index < pairs_.size(); ++index) prepend(index);
}

}  // namespace lodestone
