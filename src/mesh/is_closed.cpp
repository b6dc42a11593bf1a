// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/is_closed.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace lodestone {

bool is_closed(std::uint32_t vertex_count, std::span<const Corners> corners) {
  const auto for_edges = [&](const auto& visit) {
    for (const auto& face : corners)
      for (int i = 0; i < 3; ++i)
        if (face[i] != face[(i + 1) % 3]) visit(std::minmax(face[i], face[(i + 1) % 3]));
  };
  // Per vertex, in compressed rows: the other ends of its edges to vertices of higher index.
  std::vector<std::size_t> first(std::size_t{vertex_count} + 1, 0);
  for_edges([&](const auto& edge) { ++first[edge.first]; });
  std::exclusive_scan(first.begin(), first.end(), first.begin(), std::size_t{0});
  std::vector<std::uint32_t> ends(first.back());
  auto next = first;
  for_edges([&](const auto& edge) { ends[next[edge.first]++] = edge.second; });

  for (std::uint32_t vertex = 0; vertex < vertex_count; ++vertex) {
    const auto list = std::span(ends).subspan(first[vertex], first[vertex + 1] - first[vertex]);
    if (list.size() % 2 != 0) return false;
    std::ranges::sort(list);
    for (std::size_t i = 0; i < list.size(); i += 2)
      if (list[i] != list[i + 1]) return false;
  }
  return true;
}

}  // namespace lodestone
