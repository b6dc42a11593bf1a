// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/hop_metric.h"

#include <algorithm>
#include <boost/graph/breadth_first_search.hpp>
#include <boost/graph/visitors.hpp>
#include <boost/property_map/property_map.hpp>
#include <numeric>
#include <utility>

namespace lodestone {

namespace {

/// Breadth-first searches over one graph, which share their memory. Gives the hops of `breadth_first_hops` in half the
/// time: Boost's search also keeps a colour per vertex, and its queue is no array. A search costs its component alone.
class Hop_search {
 public:
  explicit Hop_search(const Vertex_graph& graph)
      : graph_(graph), hops_(num_vertices(graph), unreached), reached_(num_vertices(graph)) {}

  /// @param targets  in the component of `source`
  /// @return per target: hops from `source`
  std::vector<std::uint32_t> hops_from(std::uint32_t source, std::span<const std::uint32_t> targets) {
    const auto reached = search(source);
    std::vector<std::uint32_t> result;
    result.reserve(targets.size());
    for (const auto target : targets) result.push_back(hops_[target]);
    for (const auto vertex : reached) hops_[vertex] = unreached;
    return result;
  }

  /// The largest number of hops from `source`.
  std::size_t eccentricity(std::uint32_t source) {
    const auto reached = search(source);
    const std::size_t farthest = hops_[reached.back()];
    for (const auto vertex : reached) hops_[vertex] = unreached;
    return farthest;
  }

  /// Of one search in a graph of one component: what it visits.
  std::size_t cost() const { return num_vertices(graph_) + num_edges(graph_); }

  /// The targets by component, in their order; components in the order of their first targets. O(V + E).
  std::vector<std::vector<std::uint32_t>> by_component(std::span<const std::uint32_t> targets) {
    std::vector<std::vector<std::uint32_t>> groups;
    constexpr std::uint32_t none = unreached;
    std::vector<std::uint32_t> group_of(hops_.size(), none);
    for (const auto target : targets) {
      if (group_of[target] == none) {
        for (const auto vertex : search(target)) {
          group_of[vertex] = static_cast<std::uint32_t>(groups.size());
          hops_[vertex] = unreached;
        }
        groups.emplace_back();
      }
      groups[group_of[target]].push_back(target);
    }
    return groups;
  }

 private:
  /// @return the vertices that were reached, whose hops are to be forgotten before the next search
  std::span<const std::uint32_t> search(std::uint32_t source) {
    hops_[source] = 0;
    reached_[0] = source;
    std::size_t count = 1;
    for (std::size_t next = 0; next < count; ++next) {
      const std::uint32_t beyond = hops_[reached_[next]] + 1;
      for (const std::uint32_t w : neighbours(graph_, reached_[next])) {
        if (hops_[w] != unreached) continue;
        hops_[w] = beyond;
        reached_[count++] = w;
      }
    }
    return std::span(reached_).first(count);
  }

  const Vertex_graph& graph_;
  std::vector<std::uint32_t> hops_;     ///< V: `unreached` between searches
  std::vector<std::uint32_t> reached_;  ///< V: in the order in which they were reached
};

/// Hops between targets of one component, as far as searches from some of them tell.
class Known_hops {
 public:
  /// Adds what a search tells.
  /// @param hops  per target, from one of them
  void add(std::vector<std::uint32_t> hops) { rows_.push_back(std::move(hops)); }

  /// How many of the others may be farther than `most` from a target; counts up to 64.
  std::size_t count_undecided(std::size_t target, std::span<const std::size_t> others, std::size_t most) {
    std::size_t count = 0;
    for (const auto other : others) {
      if (other != target && may_exceed(target, other, most)) ++count;
      if (count == 64) break;
    }
    return count;
  }

  /// Sums of hops that have been compared so far.
  std::size_t comparisons() const { return comparisons_; }

 private:
  /// Whether the hops between two targets can be more than `most`. By the triangle inequality they cannot if there are
  /// at most so many by way of the source of a search.
  bool may_exceed(std::size_t a, std::size_t b, std::size_t most) {
    return std::ranges::all_of(rows_, [&](const auto& hops) {
      ++comparisons_;
      return std::size_t{hops[a]} + hops[b] > most;
    });
  }

  std::vector<std::vector<std::uint32_t>> rows_;  ///< per search, per target
  std::size_t comparisons_ = 0;
};

}  // namespace

std::vector<std::uint32_t> breadth_first_hops(const Vertex_graph& graph, std::uint32_t source) {
  std::vector<std::uint32_t> hops(num_vertices(graph), unreached);
  hops[source] = 0;
  const auto hop_map = boost::make_iterator_property_map(hops.begin(), get(boost::vertex_index, graph));
  boost::breadth_first_search(
      graph, source, boost::visitor(boost::make_bfs_visitor(boost::record_distances(hop_map, boost::on_tree_edge()))));
  return hops;
}

namespace {

/// The largest hop distance of targets of one component, or `diameter` if none is larger.
///
/// On a torus many pairs are nearly the farthest, and searches decide little about others. Once it has taken as long to
/// compare as to search from all targets that are left, these are searched from.
std::size_t larger_diameter(Hop_search& search, std::span<const std::uint32_t> targets, std::size_t diameter) {
  if (targets.size() < 2) return diameter;
  Known_hops known;
  std::vector<std::size_t> undecided(targets.size());  // may be farther from another one than the diameter so far
  std::iota(undecided.begin(), undecided.end(), 0);
  const auto search_from = [&](std::size_t source) {
    auto hops = search.hops_from(targets[source], targets);
    diameter = std::max<std::size_t>(diameter, std::ranges::max(hops));
    return hops;
  };
  for (std::size_t source = 0; !undecided.empty();) {
    known.add(search_from(source));
    std::erase(undecided, source);
    if (known.comparisons() > undecided.size() * search.cost()) {
      for (const auto target : undecided) search_from(target);
      break;
    }

    // Next comes the target that may be far from the most others.
    std::vector<std::size_t> still_undecided;
    std::size_t most = 0;
    for (const auto target : undecided) {
      const std::size_t count = known.count_undecided(target, undecided, diameter);
      if (count > 0) still_undecided.push_back(target);
      if (count > most) most = count, source = target;
    }
    undecided = std::move(still_undecided);
  }
  return diameter;
}

}  // namespace

std::size_t hop_diameter(const Vertex_graph& graph, std::span<const std::uint32_t> targets) {
  std::size_t diameter = 0;
  if (targets.size() < 2) return diameter;
  Hop_search search(graph);
  for (const auto& group : search.by_component(targets)) diameter = larger_diameter(search, group, diameter);
  return diameter;
}

std::size_t hop_reach(const Vertex_graph& graph, std::span<const std::uint32_t> targets) {
  std::size_t reach = 0;
  Hop_search search(graph);
  for (const auto& group : search.by_component(targets))
    reach =
        group.size() == 1 ? std::max(reach, search.eccentricity(group.front())) : larger_diameter(search, group, reach);
  return reach;
}

}  // namespace lodestone
