// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/islands.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

namespace lodestone {

namespace {

/// A connected set of vertices of one label.
struct Piece {
  Region_index label = 0;
  std::size_t size = 0;
  bool settled = false;  ///< it is the body of its region, or has joined it
};

/// Pieces in the order of their lowest vertex, and the piece of each vertex.
struct Pieces {
  std::vector<Piece> pieces;
  std::vector<std::uint32_t> of_vertex;
};

constexpr std::uint32_t no_part = std::numeric_limits<std::uint32_t>::max();

/// Numbers the connected parts of a graph in the order of their lowest vertices. Only edges whose ends are `joined`
/// count. Takes half the time of Boost's search, which also keeps a colour per vertex and the way back. O(V + E).
/// @param of_vertex  set to V: the part of each vertex
/// @return how many parts there are
template <class Joined>
std::uint32_t number_parts(const Vertex_graph& graph, Joined joined, std::vector<std::uint32_t>& of_vertex) {
  of_vertex.assign(num_vertices(graph), no_part);
  std::vector<std::uint32_t> stack;
  std::uint32_t parts = 0;
  for (std::uint32_t first = 0; first < of_vertex.size(); ++first) {
    if (of_vertex[first] != no_part) continue;
    of_vertex[first] = parts;
    stack.push_back(first);
    while (!stack.empty()) {
      const std::uint32_t v = stack.back();
      stack.pop_back();
      for (const std::uint32_t w : neighbours(graph, v)) {
        if (of_vertex[w] != no_part || !joined(v, w)) continue;
        of_vertex[w] = parts;
        stack.push_back(w);
      }
    }
    ++parts;
  }
  return parts;
}

Pieces connected_pieces(const Vertex_graph& graph, const std::vector<Region_index>& labels) {
  Pieces result;
  result.pieces.resize(number_parts(
      graph, [&](std::uint32_t v, std::uint32_t w) { return labels[v] == labels[w]; }, result.of_vertex));
  for (std::size_t v = 0; v < labels.size(); ++v) {
    Piece& piece = result.pieces[result.of_vertex[v]];
    piece.label = labels[v];
    ++piece.size;
  }
  return result;
}

/// Whether each piece is a vertex without edges.
std::vector<bool> isolated_pieces(const Vertex_graph& graph, const Pieces& all) {
  std::vector<bool> isolated(all.pieces.size(), false);
  for (std::uint32_t v = 0; v < num_vertices(graph); ++v)
    if (out_degree(v, graph) == 0) isolated[all.of_vertex[v]] = true;
  return isolated;
}

/// Settles the largest piece of each label, the body of the region; the others are its islands.
void settle_largest(std::vector<Piece>& pieces, const std::vector<bool>& isolated, std::size_t regions) {
  std::vector<Piece*> largest(regions, nullptr);
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    if (isolated[p]) continue;
    Piece*& best = largest[pieces[p].label];
    if (best == nullptr || pieces[p].size > best->size) best = &pieces[p];
  }
  for (Piece* piece : largest)
    if (piece != nullptr) piece->settled = true;
}

/// Makes new regions of the largest pieces of the connected components that have no settled piece, the largest such
/// pieces first, until there are `limit` regions.
void settle_unreached(const Vertex_graph& graph, Pieces& all, const std::vector<bool>& isolated, std::size_t limit,
                      Island_repair& repair) {
  std::vector<std::uint32_t> component;
  const auto count = number_parts(
      graph, [](std::uint32_t, std::uint32_t) { return true; }, component);
  std::vector<Piece*> largest(count, nullptr);
  std::vector<bool> reached(count, false);
  std::vector<bool> seen(all.pieces.size(), false);
  for (std::uint32_t v = 0; v < component.size(); ++v) {
    const std::uint32_t p = all.of_vertex[v];
    if (seen[p] || isolated[p]) continue;
    seen[p] = true;
    Piece*& best = largest[component[v]];
    if (best == nullptr || all.pieces[p].size > best->size) best = &all.pieces[p];
    if (all.pieces[p].settled) reached[component[v]] = true;
  }
  std::vector<Piece*> unreached;
  for (std::size_t c = 0; c < largest.size(); ++c)
    if (largest[c] != nullptr && !reached[c]) unreached.push_back(largest[c]);
  std::ranges::stable_sort(unreached, [](const Piece* a, const Piece* b) { return a->size > b->size; });
  for (Piece* piece : unreached) {
    if (repair.regions >= limit) return;
    piece->label = static_cast<Region_index>(repair.regions++);
    piece->settled = true;
    ++repair.regions_added;
  }
}

/// Islands join regions, round by round. A round looks only at those that touch what settled in the round before, so
/// each island is looked at once.
class Island_rounds {
 public:
  Island_rounds(const Vertex_graph& graph, Pieces& all, const std::vector<std::uint32_t>& loose);
  /// @return how many islands joined
  std::size_t run();

 private:
  std::span<const std::uint32_t> vertices_of(std::uint32_t piece) const {
    return std::span(vertices_).subspan(first_[piece], first_[piece + 1] - first_[piece]);
  }
  template <class Visit>
  void for_each_edge_out_of(std::uint32_t piece, Visit visit) const;
  bool touches_settled(std::uint32_t piece) const;
  Region_index longest_border(std::uint32_t piece);

  const Vertex_graph& graph_;
  Pieces& all_;
  std::vector<std::size_t> first_;       ///< per piece: its first vertex in `vertices_`
  std::vector<std::uint32_t> vertices_;  ///< of loose pieces, piece by piece
  std::vector<std::uint32_t> front_;     ///< the islands that join in the next round
  std::vector<bool> reached_;            ///< per piece: is or was in the front
  std::vector<Region_index> beside_;     ///< the region at the far end of each edge; a buffer
};

Island_rounds::Island_rounds(const Vertex_graph& graph, Pieces& all, const std::vector<std::uint32_t>& loose)
    : graph_(graph), all_(all), first_(all.pieces.size() + 1, 0), reached_(all.pieces.size(), false) {
  std::vector<bool> is_loose(all.pieces.size(), false);
  for (const auto p : loose) is_loose[p] = true;
  for (std::size_t p = 0; p < all.pieces.size(); ++p)
    first_[p + 1] = first_[p] + (is_loose[p] ? all.pieces[p].size : 0);
  vertices_.resize(first_.back());
  auto next = first_;
  for (std::uint32_t v = 0; v < all.of_vertex.size(); ++v)
    if (const auto p = all.of_vertex[v]; is_loose[p]) vertices_[next[p]++] = v;
  for (const auto p : loose)
    if (touches_settled(p)) {
      reached_[p] = true;
      front_.push_back(p);
    }
}

/// Calls `visit` with the piece at the far end of each edge that leaves a loose piece.
template <class Visit>
void Island_rounds::for_each_edge_out_of(std::uint32_t piece, Visit visit) const {
  for (const auto v : vertices_of(piece))
    for (const auto w : neighbours(graph_, v))
      if (all_.of_vertex[w] != piece) visit(all_.of_vertex[w]);
}

bool Island_rounds::touches_settled(std::uint32_t piece) const {
  bool touches = false;
  for_each_edge_out_of(piece, [&](std::uint32_t other) { touches = touches || all_.pieces[other].settled; });
  return touches;
}

/// The region that shares the longest border with a piece that touches one. Ties go to the lowest index.
Region_index Island_rounds::longest_border(std::uint32_t piece) {
  beside_.clear();
  for_each_edge_out_of(piece, [&](std::uint32_t other) {
    if (all_.pieces[other].settled) beside_.push_back(all_.pieces[other].label);
  });
  std::ranges::sort(beside_);
  Region_index best = 0;
  std::ptrdiff_t longest = 0;
  for (auto begin = beside_.begin(); begin != beside_.end();) {
    const auto end = std::ranges::upper_bound(begin, beside_.end(), *begin);
    if (end - begin > longest) {
      longest = end - begin;
      best = *begin;
    }
    begin = end;
  }
  return best;
}

std::size_t Island_rounds::run() {
  std::size_t joined = 0;
  while (!front_.empty()) {
    for (const auto p : front_) all_.pieces[p].label = longest_border(p);
    // Only now, because borders with islands of the same round do not count.
    for (const auto p : front_) all_.pieces[p].settled = true;
    joined += front_.size();
    std::vector<std::uint32_t> next;
    for (const auto p : front_)
      for_each_edge_out_of(p, [&](std::uint32_t other) {
        if (all_.pieces[other].settled || reached_[other]) return;
        reached_[other] = true;
        next.push_back(other);
      });
    front_ = std::move(next);
  }
  return joined;
}

}  // namespace

std::size_t count_pieces(const Vertex_graph& graph, const std::vector<Region_index>& labels) {
  const auto all = connected_pieces(graph, labels);
  return all.pieces.size() - std::ranges::count(isolated_pieces(graph, all), true);
}

Island_repair repair_islands(const Vertex_graph& graph, std::vector<Region_index>& labels, std::size_t regions,
                             std::size_t wanted) {
  Island_repair repair{.regions = regions};
  Pieces all = connected_pieces(graph, labels);
  auto& pieces = all.pieces;
  const auto isolated = isolated_pieces(graph, all);
  repair.pieces_before = pieces.size() - std::ranges::count(isolated, true);
  settle_largest(pieces, isolated, regions);

  std::vector<std::uint32_t> loose;
  for (std::uint32_t p = 0; p < pieces.size(); ++p)
    if (!pieces[p].settled && !isolated[p]) loose.push_back(p);
  if (loose.empty()) return repair;
  settle_unreached(graph, all, isolated, most_regions(wanted > 0 ? wanted : regions), repair);
  std::erase_if(loose, [&](auto p) { return pieces[p].settled; });

  repair.islands_joined = Island_rounds(graph, all, loose).run();
  repair.islands_left = loose.size() - repair.islands_joined;

  for (std::size_t v = 0; v < labels.size(); ++v) labels[v] = pieces[all.of_vertex[v]].label;
  return repair;
}

std::size_t drop_regions_without_edges(const Vertex_graph& graph, std::vector<Region_index>& labels,
                                       std::size_t regions) {
  std::vector<bool> used(regions, false);
  for (std::uint32_t v = 0; v < num_vertices(graph); ++v)
    if (out_degree(v, graph) > 0) used[labels[v]] = true;
  std::vector<Region_index> renumbered(regions, 0);
  Region_index kept = 0;
  for (std::size_t region = 0; region < regions; ++region)
    if (used[region]) renumbered[region] = kept++;
  for (auto& label : labels) label = renumbered[label];
  return std::max<std::size_t>(kept, 1);
}

}  // namespace lodestone
