// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

namespace lodestone {

/// Number of letters to insert, remove, replace or swap with their neighbour to make one word the other.
inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> distance(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) distance[i][0] = i;
  std::iota(distance[0].begin(), distance[0].end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      distance[i][j] = std::min({distance[i - 1][j] + 1, distance[i][j - 1] + 1, distance[i - 1][j - 1] + change});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) distance[i][j] = std::min(distance[i][j], distance[i - 2][j - 2] + 1);
    }
  return distance[a.size()][b.size()];
}

/// The word that was probably meant: the nearest one, if at most a third of its letters differ; else empty.
inline std::string suggestion_for(std::string_view word, const std::vector<std::string>& words) {
  std::string best;
  std::size_t least = word.size();
  for (const auto& known : words) {
    const auto distance = edit_distance(word, known);
    if (distance < least && 3 * distance <= std::max<std::size_t>(known.size(), 6)) {
      least = distance;
      best = known;
    }
  }
  return best;
}

}  // namespace lodestone
