// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/seams.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace lodestone {

namespace {

auto place_of(const Positions& positions, std::uint32_t v) {
  return std::tuple(positions(v, 0), positions(v, 1), positions(v, 2));
}

/// Per vertex: the lowest vertex on an open border at its place; itself for all others.
std::vector<std::uint32_t> lowest_at_each_place(const std::vector<bool>& on_border, const Positions& positions) {
  std::vector<std::uint32_t> lowest(on_border.size()), by_place;
  for (std::uint32_t v = 0; v < lowest.size(); ++v) {
    lowest[v] = v;
    if (on_border[v]) by_place.push_back(v);
  }
  std::ranges::sort(by_place, {}, [&](std::uint32_t v) { return std::pair(place_of(positions, v), v); });
  for (std::size_t i = 1; i < by_place.size(); ++i)
    if (place_of(positions, by_place[i - 1]) == place_of(positions, by_place[i]))
      lowest[by_place[i]] = lowest[by_place[i - 1]];
  return lowest;
}

/// Takes back what would join two corners of a face, and everything else at their place.
void keep_corners_apart(std::span<const Corners> faces, std::vector<std::uint32_t>& lowest) {
  std::vector<bool> refused(lowest.size(), false);
  for (const auto& [a, b, c] : faces) {
    if (lowest[a] == lowest[b] || lowest[a] == lowest[c]) refused[lowest[a]] = true;
    if (lowest[b] == lowest[c]) refused[lowest[b]] = true;
  }
  for (std::uint32_t v = 0; v < lowest.size(); ++v)
    if (refused[lowest[v]]) lowest[v] = v;
}

/// @param lowest  V: per vertex the lowest of those that are joined
Closed_seams join(std::span<const Corners> faces, std::span<const std::uint32_t> lowest) {
  Closed_seams seams;
  seams.index.resize(lowest.size());
  for (std::uint32_t v = 0; v < lowest.size(); ++v) {
    if (lowest[v] == v) seams.vertices.push_back(v);
    // The lowest comes first, so it has its index already.
    seams.index[v] = lowest[v] == v ? static_cast<std::uint32_t>(seams.vertices.size() - 1) : seams.index[lowest[v]];
  }
  seams.corners.reserve(faces.size());
  for (const auto& [a, b, c] : faces) seams.corners.push_back({seams.index[a], seams.index[b], seams.index[c]});
  return seams;
}

}  // namespace

std::optional<Closed_seams> close_seams(std::span<const Corners> faces, const std::vector<bool>& on_border,
                                        const Positions& positions) {
  if (std::ranges::find(on_border, true) == on_border.end()) return std::nullopt;
  std::vector<std::uint32_t> lowest = lowest_at_each_place(on_border, positions);
  keep_corners_apart(faces, lowest);

  Closed_seams seams = join(faces, lowest);
  if (seams.joined_count() == 0) return std::nullopt;
  return seams;
}

std::optional<Closed_seams> seams_of(std::span<const Corners> faces, std::span<const std::uint32_t> joined) {
  for (std::uint32_t v = 0; v < joined.size(); ++v)
    if (joined[v] > v || joined[joined[v]] != joined[v]) return std::nullopt;
  const auto join_corners = [&](std::uint32_t v, std::uint32_t w) { return v != w && joined[v] == joined[w]; };
  for (const auto& [a, b, c] : faces)
    if (join_corners(a, b) || join_corners(b, c) || join_corners(c, a)) return std::nullopt;
  return join(faces, joined);
}

}  // namespace lodestone
