// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/region_count.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <map>
#include <numeric>
#include <queue>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/scaled_positions.h"
#include "lodestone/partition/islands.h"
#include "lodestone/partition/nearest_code_vector.h"
#include "partition/eigenvector_sign.h"
#include "partition/islands_of.h"

namespace lodestone {

namespace {

using Vertices = std::vector<std::uint32_t>;

void check(const Vertex_graph& graph, const Positions& positions, const std::vector<Region_index>& labels,
           std::size_t wanted) {
  if (wanted == 0) throw Bad_argument("the number of regions must be at least 1");
  const std::size_t vertices = num_vertices(graph);
  if (labels.size() != vertices || static_cast<std::size_t>(positions.rows()) != vertices)
    throw Bad_argument("there are " + std::to_string(labels.size()) + " labels and " +
                       std::to_string(positions.rows()) + " positions for " + std::to_string(vertices) + " vertices");
}

/// Renumbers the labels of vertices with edges from 0 without gaps, in the order that they had. The other vertices get
/// 0.
/// @return the number of labels
std::size_t close_up(const Vertex_graph& graph, std::vector<Region_index>& labels) {
  std::vector<Region_index> used;
  for (std::uint32_t v = 0; v < labels.size(); ++v)
    if (out_degree(v, graph) > 0) used.push_back(labels[v]);
  std::ranges::sort(used);
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (std::uint32_t v = 0; v < labels.size(); ++v)
    labels[v] = out_degree(v, graph) == 0
                    ? 0
                    : static_cast<Region_index>(std::ranges::lower_bound(used, labels[v]) - used.begin());
  return used.size();
}

std::vector<Vertices> members(const Vertex_graph& graph, const std::vector<Region_index>& labels, std::size_t regions) {
  std::vector<Vertices> result(regions);
  for (std::uint32_t v = 0; v < labels.size(); ++v)
    if (out_degree(v, graph) > 0) result[labels[v]].push_back(v);
  return result;
}

/// `scaled_positions`. Vertices without edges, whose positions mean nothing, are moved to the origin first: there they
/// change neither the scale nor a sum.
Positions scaled_where_edges_are(const Vertex_graph& graph, Positions positions) {
  for (std::uint32_t v = 0; v < num_vertices(graph); ++v)
    if (out_degree(v, graph) == 0) positions.row(v).setZero();
  return scaled_positions(positions);
}

/// Joins the smallest regions to neighbours, one after the other.
class Joining {
 public:
  Joining(const Vertex_graph& graph, const std::vector<Region_index>& labels, std::size_t regions);
  /// @return the number of regions that joined another
  std::size_t run(std::size_t wanted);
  /// Joins the smallest of what `run` has left, which are whole components, to the `most` largest that are kept. Each
  /// goes to the one whose mean position is nearest.
  /// @return how many joined
  std::size_t join_components(std::size_t most, const Vertex_graph& graph, const Positions& positions,
                              const std::vector<Region_index>& labels);
  /// Per region: the region of which it is a part in the end.
  std::vector<Region_index> targets() const;

 private:
  void join(Region_index region, Region_index neighbour);

  std::vector<std::size_t> sizes_;
  std::vector<std::map<Region_index, std::size_t>> borders_;  ///< per region: edges to each neighbour
  std::vector<Region_index> joined_;                          ///< the neighbour joined, or itself
  std::set<std::pair<std::size_t, Region_index>> by_size_;
};

Joining::Joining(const Vertex_graph& graph, const std::vector<Region_index>& labels, std::size_t regions)
    : sizes_(regions, 0), borders_(regions), joined_(regions) {
  std::iota(joined_.begin(), joined_.end(), 0);
  for (std::uint32_t v = 0; v < labels.size(); ++v) {
    if (out_degree(v, graph) == 0) continue;
    ++sizes_[labels[v]];
    for (const auto w : neighbours(graph, v))
      if (labels[w] != labels[v]) ++borders_[labels[v]][labels[w]];
  }
  for (Region_index region = 0; region < regions; ++region) by_size_.insert({sizes_[region], region});
}

void Joining::join(Region_index region, Region_index neighbour) {
  by_size_.erase({sizes_[neighbour], neighbour});
  sizes_[neighbour] += sizes_[region];
  by_size_.insert({sizes_[neighbour], neighbour});
  for (const auto& [other, edges] : borders_[region]) {
    borders_[other].erase(region);
    if (other == neighbour) continue;
    borders_[other][neighbour] += edges;
    borders_[neighbour][other] += edges;
  }
  borders_[region].clear();
  joined_[region] = neighbour;
}

std::size_t Joining::run(std::size_t wanted) {
  std::size_t joined = 0;
  while (sizes_.size() - joined > wanted && !by_size_.empty()) {
    const Region_index smallest = by_size_.begin()->second;
    by_size_.erase(by_size_.begin());
    const auto& borders = borders_[smallest];
    if (borders.empty()) continue;  // a component of its own
    join(smallest, std::ranges::max_element(borders, {}, [](const auto& border) { return border.second; })->first);
    ++joined;
  }
  return joined;
}

std::size_t Joining::join_components(std::size_t most, const Vertex_graph& graph, const Positions& positions,
                                     const std::vector<Region_index>& labels) {
  const auto parts = targets();
  std::vector<Region_index> by_size;
  for (Region_index region = 0; region < parts.size(); ++region)
    if (parts[region] == region) by_size.push_back(region);
  if (by_size.size() <= most) return 0;
  std::ranges::stable_sort(by_size, std::ranges::greater(), [this](Region_index region) { return sizes_[region]; });

  Feature_vectors means = Feature_vectors::Zero(static_cast<Eigen::Index>(parts.size()), 3);
  const Positions scaled = scaled_where_edges_are(graph, positions);
  for (std::uint32_t v = 0; v < labels.size(); ++v) means.row(parts[labels[v]]) += scaled.row(v);
  for (const auto region : by_size) means.row(region) /= static_cast<double>(sizes_[region]);
  const std::span kept = std::span(by_size).first(most), others = std::span(by_size).subspan(most);
  const Feature_vectors codes = means(kept, Eigen::all), vectors = means(others, Eigen::all);
  Assignment nearest;
  Bounded_assignment(vectors).assign(codes, nearest);
  for (std::size_t i = 0; i < others.size(); ++i) joined_[others[i]] = kept[nearest.labels[i]];
  return others.size();
}

std::vector<Region_index> Joining::targets() const {
  std::vector<Region_index> result = joined_;
  for (auto& target : result)
    while (target != joined_[target]) target = joined_[target];
  return result;
}

/// A region that is cut: its islands, of which a connected region is the only one. The largest is the last; of equally
/// large ones, the one with the lowest vertex.
class Islands_of_region {
 public:
  explicit Islands_of_region(std::vector<Vertices> islands);

  std::size_t size() const { return size_; }
  const std::vector<Vertices>& islands() const { return islands_; }
  /// Whether the largest island holds the lowest vertex of the region.
  bool largest_is_lowest() const { return lowest_.back() == islands_.back().front(); }
  /// Takes the largest island out.
  Vertices take_largest();

 private:
  std::vector<Vertices> islands_;      ///< each in ascending order
  std::vector<std::uint32_t> lowest_;  ///< per island: the lowest vertex of this and all smaller islands
  std::size_t size_ = 0;
};

Islands_of_region::Islands_of_region(std::vector<Vertices> islands) : islands_(std::move(islands)) {
  std::ranges::sort(islands_, [](const Vertices& a, const Vertices& b) {
    return std::pair(a.size(), b.front()) < std::pair(b.size(), a.front());
  });
  for (const auto& island : islands_) {
    size_ += island.size();
    lowest_.push_back(lowest_.empty() ? island.front() : std::min(lowest_.back(), island.front()));
  }
}

Vertices Islands_of_region::take_largest() {
  Vertices largest = std::move(islands_.back());
  islands_.pop_back();
  lowest_.pop_back();
  size_ -= largest.size();
  return largest;
}

/// Cuts the largest regions in two, one after the other.
class Splitting {
 public:
  Splitting(const Vertex_graph& graph, const Positions& positions, std::vector<Region_index>& labels,
            std::size_t regions);
  /// @return the number of cuts
  std::size_t run(std::size_t wanted);

 private:
  Islands_of_region cut_off(Islands_of_region& region);
  std::pair<Vertices, Vertices> halves(const Vertices& region);
  Vertices grown_half(const Vertices& region);
  Eigen::Vector3d longest_axis(const Vertices& region) const;

  const Vertex_graph& graph_;
  const Positions positions_;
  std::vector<Region_index>& labels_;
  std::vector<bool> open_;  ///< per vertex: the search has yet to reach it; false between searches
  std::vector<Islands_of_region> regions_;
};

Splitting::Splitting(const Vertex_graph& graph, const Positions& positions, std::vector<Region_index>& labels,
                     std::size_t regions)
    : graph_(graph), positions_(scaled_positions(positions)), labels_(labels), open_(labels.size(), false) {
  for (const auto& region : members(graph, labels, regions)) regions_.emplace_back(islands_of(graph_, region, open_));
}

Eigen::Vector3d Splitting::longest_axis(const Vertices& region) const {
  Eigen::RowVector3d mean = Eigen::RowVector3d::Zero();
  for (const auto v : region) mean += positions_.row(v);
  mean /= static_cast<double>(region.size());
  double extent = 0;
  for (const auto v : region) extent = std::max(extent, (positions_.row(v) - mean).cwiseAbs().maxCoeff());
  if (extent == 0) return Eigen::Vector3d::UnitX();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const auto v : region) {
    const Eigen::RowVector3d offset = (positions_.row(v) - mean) / extent;
    scatter += offset.transpose() * offset;
  }
  Eigen::Vector3d axis = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors().col(2);
  make_largest_component_positive(axis);
  return axis;
}

/// Half of a connected region, grown from its end along the longest axis.
Vertices Splitting::grown_half(const Vertices& region) {
  const Eigen::Vector3d axis = longest_axis(region);
  using Entry = std::pair<double, std::uint32_t>;
  const auto entry = [&](std::uint32_t v) { return Entry(positions_.row(v).dot(axis), v); };
  for (const auto v : region) open_[v] = true;

  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  const auto reach = [&](std::uint32_t v) {
    open_[v] = false;
    front.push(entry(v));
  };
  reach(*std::ranges::min_element(region, {}, entry));
  Vertices half;
  while (half.size() < region.size() / 2) {
    half.push_back(front.top().second);
    front.pop();
    for (const auto w : neighbours(graph_, half.back()))
      if (open_[w]) reach(w);
  }
  for (const auto v : region) open_[v] = false;
  std::ranges::sort(half);
  return half;
}

Vertices without(const Vertices& all, const Vertices& some) {
  Vertices rest;
  std::ranges::set_difference(all, some, std::back_inserter(rest));
  return rest;
}

/// Two sides of a connected region of two or more vertices, both connected; the lowest vertex is in the first.
std::pair<Vertices, Vertices> Splitting::halves(const Vertices& region) {
  const auto parts = islands_of(graph_, without(region, grown_half(region)), open_);
  Vertices side = *std::ranges::max_element(parts, {}, &Vertices::size);
  Vertices rest = without(region, side);
  if (side.front() == region.front()) std::swap(side, rest);
  return {std::move(rest), std::move(side)};
}

/// What leaves a region of two or more vertices. The lowest vertex always stays.
Islands_of_region Splitting::cut_off(Islands_of_region& region) {
  const bool stays = region.largest_is_lowest(), is_connected = region.islands().size() == 1;
  Vertices largest = region.take_largest();
  if (is_connected) {
    auto [staying, leaving] = halves(largest);
    region = Islands_of_region({std::move(staying)});
    return Islands_of_region({std::move(leaving)});
  }
  if (!stays) return Islands_of_region({std::move(largest)});
  return std::exchange(region, Islands_of_region({std::move(largest)}));
}

std::size_t Splitting::run(std::size_t wanted) {
  const auto smaller = [this](Region_index a, Region_index b) {
    return std::pair(regions_[a].size(), b) < std::pair(regions_[b].size(), a);
  };
  std::priority_queue<Region_index, Vertices, decltype(smaller)> by_size(smaller);
  for (Region_index region = 0; region < regions_.size(); ++region) by_size.push(region);
  std::size_t cuts = 0;
  while (regions_.size() < wanted && !by_size.empty()) {
    const Region_index largest = by_size.top();
    if (regions_[largest].size() < 2) break;
    by_size.pop();
    const auto fresh = static_cast<Region_index>(regions_.size());
    regions_.push_back(cut_off(regions_[largest]));
    by_size.push(largest);
    by_size.push(fresh);
    ++cuts;
  }
  for (Region_index region = 0; region < regions_.size(); ++region)
    for (const auto& island : regions_[region].islands())
      for (const auto v : island) labels_[v] = region;
  return cuts;
}

}  // namespace

Region_adjustment adjust_region_count(const Vertex_graph& graph, const Positions& positions,
                                      std::vector<Region_index>& labels, std::size_t wanted) {
  check(graph, positions, labels, wanted);
  Region_adjustment result{.regions = close_up(graph, labels)};
  if (result.regions > wanted) {
    Joining joining(graph, labels, result.regions);
    result.joined = joining.run(wanted);
    result.joined += joining.join_components(most_regions(wanted), graph, positions, labels);
    const auto targets = joining.targets();
    for (auto& label : labels) label = targets[label];
    result.regions = close_up(graph, labels);
  } else if (result.regions < wanted) {
    result.split = Splitting(graph, positions, labels, result.regions).run(wanted);
    result.regions += result.split;
  }
  return result;
}

}  // namespace lodestone
