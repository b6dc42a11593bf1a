// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/islands.h"

#include <algorithm>
#include <limits>
#include <map>

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

/// Per piece: the number of edges to each other piece.
std::vector<std::map<std::uint32_t, std::size_t>> piece_borders(const Vertex_graph& graph, const Pieces& pieces) {
  std::vector<std::map<std::uint32_t, std::size_t>> borders(pieces.pieces.size());
  for (std::uint32_t v = 0; v < num_vertices(graph); ++v)
    for (const std::uint32_t w : neighbours(graph, v))
      if (pieces.of_vertex[v] != pieces.of_vertex[w]) ++borders[pieces.of_vertex[v]][pieces.of_vertex[w]];
  return borders;
}

}  // namespace

std::size_t count_pieces(const Vertex_graph& graph, const std::vector<Region_index>& labels) {
  const auto all = connected_pieces(graph, labels);
  return all.pieces.size() - std::ranges::count(isolated_pieces(graph, all), true);
}

Island_repair repair_islands(const Vertex_graph& graph, std::vector<Region_index>& labels, std::size_t regions) {
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
  settle_unreached(graph, all, isolated, regions + std::max<std::size_t>(regions, 64), repair);
  std::erase_if(loose, [&](auto p) { return pieces[p].settled; });

  const auto borders = piece_borders(graph, all);
  const auto join_longest_border = [&](std::uint32_t p) {
    std::map<Region_index, std::size_t> lengths;
    for (const auto& [other, edges] : borders[p])
      if (pieces[other].settled) lengths[pieces[other].label] += edges;
    if (lengths.empty()) return false;
    pieces[p].label = std::ranges::max_element(lengths, {}, [](const auto& entry) { return entry.second; })->first;
    return true;
  };
  for (bool joining = true; joining && !loose.empty();) {
    std::vector<std::uint32_t> joined;
    std::erase_if(loose, [&](auto p) {
      const bool joins = join_longest_border(p);
      if (joins) joined.push_back(p);
      return joins;
    });
    for (const auto p : joined) pieces[p].settled = true;
    repair.islands_joined += joined.size();
    joining = !joined.empty();
  }
  repair.islands_left = loose.size();

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
