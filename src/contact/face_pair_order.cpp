// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/contact/face_pair_order.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <utility>

namespace lodestone {

namespace {

/// Fewer than this are sorted by comparing them.
constexpr std::size_t few = 48;

constexpr int digit_bits = 8;
using Places = std::array<std::size_t, 1U << digit_bits>;  ///< per value of a digit

std::size_t digit(std::uint64_t key, int place) { return key >> (digit_bits * place) & ((1U << digit_bits) - 1); }

/// Sorts by one digit, keeping the order of keys that agree in it.
/// @param places  how many keys have each value
void sort_by_digit(std::span<const std::uint64_t> keys, int place, Places& places, std::uint64_t* sorted) {
  std::size_t next = 0;
  for (auto& of : places) next += std::exchange(of, next);
  for (const auto key : keys) sorted[places[digit(key, place)]++] = key;
}

}  // namespace

void sort_face_pairs(std::span<Face_pair> pairs) {
  if (pairs.size() < few) {
    std::ranges::sort(pairs);
    return;
  }
  std::uint32_t any_a = 0, any_b = 0;
  for (const auto& [a, b] : pairs) any_a |= a, any_b |= b;
  const int bits_b = std::bit_width(any_b);
  const int digits = (std::bit_width(any_a) + bits_b + digit_bits - 1) / digit_bits;

  const auto memory = std::make_unique_for_overwrite<std::uint64_t[]>(2 * pairs.size());
  std::span<std::uint64_t> keys(memory.get(), pairs.size()), others(memory.get() + pairs.size(), pairs.size());
  std::array<Places, 8> places;
  for (int place = 0; place < digits; ++place) places[place].fill(0);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    keys[i] = std::uint64_t{pairs[i].a} << bits_b | pairs[i].b;
    for (int place = 0; place < digits; ++place) ++places[place][digit(keys[i], place)];
  }
  for (int place = 0; place < digits; ++place) {
    sort_by_digit(keys, place, places[place], others.data());
    std::swap(keys, others);
  }
  const std::uint64_t ones_b = (std::uint64_t{1} << bits_b) - 1;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    pairs[i] = {static_cast<std::uint32_t>(keys[i] >> bits_b), static_cast<std::uint32_t>(keys[i] & ones_b)};
}

}  // namespace lodestone
