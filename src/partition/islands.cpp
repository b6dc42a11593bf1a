// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/islands.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

namespace lodestone {

namespace {

/// A connected set of vertices of one label.
struct Label_part {
  Region_index label = 0;
  std::size_t size = 0;
  bool settled = false;  ///< it is the body of its region, or has joined it
};

/// Connected parts of labels in the order of their lowest vertex, and the part of each vertex.
struct Label_parts {
  std::vector<Label_part> parts;
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

Label_parts connected_parts(const Vertex_graph& graph, const std::vector<Region_index>& labels) {
  Label_parts result;
  result.parts.resize(number_parts(
      graph, [&](std::uint32_t v, std::uint32_t w) { return labels[v] == labels[w]; }, result.of_vertex));
  for (std::size_t v = 0; v < labels.size(); ++v) {
    Label_part& part = result.parts[result.of_vertex[v]];
    part.label = labels[v];
    ++part.size;
  }
  return result;
}

/// Whether each part is a vertex without edges.
std::vector<bool> isolated_parts(const Vertex_graph& graph, const Label_parts& all) {
  std::vector<bool> isolated(all.parts.size(), false);
  for (std::uint32_t v = 0; v < num_vertices(graph); ++v)
    if (out_degree(v, graph) == 0) isolated[all.of_vertex[v]] = true;
  return isolated;
}

/// Settles the largest part of each label, the body of the region; the others are its islands.
void settle_largest(std::vector<Label_part>& parts, const std::vector<bool>& isolated, std::size_t regions) {
  std::vector<Label_part*> largest(regions, nullptr);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (isolated[p]) continue;
    Label_part*& best = largest[parts[p].label];
    if (best == nullptr || parts[p].size > best->size) best = &parts[p];
  }
  for (Label_part* part : largest)
    if (part != nullptr) part->settled = true;
}

/// Makes new regions of the largest parts of the connected components that have no settled part, the largest such
/// parts first, until there are `limit` regions.
void settle_unreached(const Vertex_graph& graph, Label_parts& all, const std::vector<bool>& isolated, std::size_t limit,
                      Island_repair& repair) {
  std::vector<std::uint32_t> component;
  const auto count = number_parts(
      graph, [](std::uint32_t, std::uint32_t) { return true; }, component);
  std::vector<Label_part*> largest(count, nullptr);
  std::vector<bool> reached(count, false);
  std::vector<bool> seen(all.parts.size(), false);
  for (std::uint32_t v = 0; v < component.size(); ++v) {
    const std::uint32_t p = all.of_vertex[v];
    if (seen[p] || isolated[p]) continue;
    seen[p] = true;
    Label_part*& best = largest[component[v]];
    if (best == nullptr || all.parts[p].size > best->size) best = &all.parts[p];
    if (all.parts[p].settled) reached[component[v]] = true;
  }
  std::vector<Label_part*> unreached;
  for (std::size_t c = 0; c < largest.size(); ++c)
    if (largest[c] != nullptr && !reached[c]) unreached.push_back(largest[c]);
  std::ranges::stable_sort(unreached, [](const Label_part* a, const Label_part* b) { return a->size > b->size; });
  for (Label_part* part : unreached) {
    if (repair.regions >= limit) return;
    part->label = static_cast<Region_index>(repair.regions++);
    part->settled = true;
    ++repair.regions_added;
  }
}

/// Islands join regions, round by round. A round looks only at those that touch what settled in the round before, so
/// each island is looked at once.
class Island_rounds {
 public:
  Island_rounds(const Vertex_graph& graph, Label_parts& all, const std::vector<std::uint32_t>& loose);
  /// @return how many islands joined
  std::size_t run();

 private:
  std::span<const std::uint32_t> vertices_of(std::uint32_t part) const {
    return std::span(vertices_).subspan(first_[part], first_[part + 1] - first_[part]);
  }
  template <class Visit>
  void for_each_edge_out_of(std::uint32_t part, Visit visit) const;
  bool touches_settled(std::uint32_t part) const;
  Region_index longest_border(std::uint32_t part);

  const Vertex_graph& graph_;
  Label_parts& all_;
  std::vector<std::size_t> first_;       ///< per part: its first vertex in `vertices_`
  std::vector<std::uint32_t> vertices_;  ///< of loose parts, part by part
  std::vector<std::uint32_t> front_;     ///< the islands that join in the next round
  std::vector<bool> reached_;            ///< per part: is or was in the front
  std::vector<Region_index> beside_;     ///< the region at the far end of each edge; a buffer
};

Island_rounds::Island_rounds(const Vertex_graph& graph, Label_parts& all, const std::vector<std::uint32_t>& loose)
    : graph_(graph), all_(all), first_(all.parts.size() + 1, 0), reached_(all.parts.size(), false) {
  std::vector<bool> is_loose(all.parts.size(), false);
  for (const auto p : loose) is_loose[p] = true;
  for (std::size_t p = 0; p < all.parts.size(); ++p) first_[p + 1] = first_[p] + (is_loose[p] ? all.parts[p].size : 0);
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

/// Calls `visit` with the part at the far end of each edge that leaves a loose part.
template <class Visit>
void Island_rounds::for_each_edge_out_of(std::uint32_t part, Visit visit) const {
  for (const auto v : vertices_of(part))
    for (const auto w : neighbours(graph_, v))
      if (all_.of_vertex[w] != part) visit(all_.of_vertex[w]);
}

bool Island_rounds::touches_settled(std::uint32_t part) const {
  bool touches = false;
  for_each_edge_out_of(part, [&](std::uint32_t other) { touches = touches || all_.parts[other].settled; });
  return touches;
}

/// The region that shares the longest border with a part that touches one. Ties go to the lowest index.
Region_index Island_rounds::longest_border(std::uint32_t part) {
  beside_.clear();
  for_each_edge_out_of(part, [&](std::uint32_t other) {
    if (all_.parts[other].settled) beside_.push_back(all_.parts[other].label);
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
    for (const auto p : front_) all_.parts[p].label = longest_border(p);
    // Only now, because borders with islands of the same round do not count.
    for (const auto p : front_) all_.parts[p].settled = true;
    joined += front_.size();
    std::vector<std::uint32_t> next;
    for (const auto p : front_)
      for_each_edge_out_of(p, [&](std::uint32_t other) {
        if (all_.parts[other].settled || reached_[other]) return;
        reached_[other] = true;
        next.push_back(other);
      });
    front_ = std::move(next);
  }
  return joined;
}

}  // namespace

std::size_t count_parts(const Vertex_graph& graph, const std::vector<Region_index>& labels) {
  const auto all = connected_parts(graph, labels);
  return all.parts.size() - std::ranges::count(isolated_parts(graph, all), true);
}

Island_repair repair_islands(const Vertex_graph& graph, std::vector<Region_index>& labels, std::size_t regions,
                             std::size_t wanted) {
  Island_repair repair{.regions = regions};
  Label_parts all = connected_parts(graph, labels);
  auto& parts = all.parts;
  const auto isolated = isolated_parts(graph, all);
  repair.parts_before = parts.size() - std::ranges::count(isolated, true);
  settle_largest(parts, isolated, regions);

  std::vector<std::uint32_t> loose;
  for (std::uint32_t p = 0; p < parts.size(); ++p)
    if (!parts[p].settled && !isolated[p]) loose.push_back(p);
  if (loose.empty()) return repair;
  settle_unreached(graph, all, isolated, most_regions(wanted > 0 ? wanted : regions), repair);
  std::erase_if(loose, [&](auto p) { return parts[p].settled; });

  repair.islands_joined = Island_rounds(graph, all, loose).run();
  repair.islands_left = loose.size() - repair.islands_joined;

  for (std::size_t v = 0; v < labels.size(); ++v) labels[v] = parts[all.of_vertex[v]].label;
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
