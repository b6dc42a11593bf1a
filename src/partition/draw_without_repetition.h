// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <utility>

namespace lodestone {

/// Draws elements at random and moves them to the front, in the order of the draw: the first steps of a shuffle.
/// It uses remainders, because they are the same on every platform, unlike the distributions of the standard library.
/// @param count  how many to draw; above the number of elements it is reduced to that
/// @return how many were drawn
inline std::size_t draw_without_repetition(std::span<std::uint32_t> elements, std::size_t count,
                                           std::mt19937_64& random) {
  count = std::min(count, elements.size());
  for (std::size_t i = 0; i < count; ++i) std::swap(elements[i], elements[i + random() % (elements.size() - i)]);
  return count;
}

}  // namespace lodestone
