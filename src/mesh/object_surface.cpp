// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/object_surface.h"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <numeric>

#include "lodestone/mesh/is_closed.h"

namespace lodestone {

const Vertex_fans& Object_surface::fans() const {
  if (!fans_) fans_.emplace(static_cast<std::uint32_t>(vertex_count()), corners_);
  return *fans_;
}

bool Object_surface::closed() const {
  if (!closed_) closed_ = is_closed(static_cast<std::uint32_t>(vertex_count()), corners_);
  return *closed_;
}

std::span<const std::uint32_t> Object_surface::piece_vertices() const {
  if (!piece_vertices_.empty()) return piece_vertices_;
  std::vector<std::uint32_t> rank(vertex_count(), 0), parent(vertex_count());
  std::iota(parent.begin(), parent.end(), 0);
  boost::disjoint_sets pieces(rank.data(), parent.data());
  for (const auto& [a, b, c] : corners_) {
    pieces.union_set(a, b);
    pieces.union_set(a, c);
  }
  std::vector<bool> seen(vertex_count(), false);
  std::vector<std::uint32_t> found;
  for (const auto& face : corners_) {
    const std::uint32_t piece = pieces.find_set(face[0]);
    if (!seen[piece]) found.push_back(face[0]);
    seen[piece] = true;
  }
  piece_vertices_ = std::move(found);
  return piece_vertices_;
}

}  // namespace lodestone
