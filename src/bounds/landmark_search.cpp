// SPDX-License-Identifier: GPL-3.0-or-later
#include "bounds/landmark_search.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

namespace lodestone {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t of_no_part = std::numeric_limits<std::uint32_t>::max();

/// How many vertices a search may reach for each vertex of the node, and besides. With twice as many, a closely folded
/// cloth takes twice as long and has hardly smaller boxes.
constexpr std::size_t reached_per_vertex = 8, reached_besides = 512;

std::vector<Corners> faces_of(const Tree_layout& layout) {
  std::vector<Corners> faces;
  for (std::size_t leaf = 0; leaf < layout.leaf_count(); ++leaf) {
    const auto vertices = layout.vertices(leaf);
    for (const auto& [a, b, c] : layout.corners(leaf)) faces.push_back({vertices[a], vertices[b], vertices[c]});
  }
  return faces;
}

}  // namespace

Landmark_search::Landmark_search(const Tree_layout& layout, Coordinates rest)
    : layout_(layout),
      rest_(rest),
      graph_(vertex_graph(static_cast<std::uint32_t>(rest.size() / 3), faces_of(layout))) {
  constexpr double smallest = 1e-150;  // squares of shorter lengths underflow
  const std::size_t vertices = rest.size() / 3;
  lengths_.reserve(num_edges(graph_));
  for (std::uint32_t v = 0; v < vertices; ++v)
    for (const auto w : neighbours(graph_, v)) lengths_.push_back((this->rest(v) - this->rest(w)).norm() + smallest);
  listed_for_.assign(vertices, 0);
  reached_for_.assign(vertices, 0);
  distance_.resize(vertices);
  joined_.resize(vertices);
  part_of_.resize(vertices);
}

std::span<const Landmark> Landmark_search::find(std::uint32_t node) {
  node_ = node;
  list_vertices(node);
  join_faces(node);
  measure_parts();
  choose_centres();
  const bool is_root = node == 0;
  if (measure_radii(is_root ? rest_.size() : reached_per_vertex * vertices_.size() + reached_besides))
    return landmarks_;
  if (!is_root) return {};
  landmarks_.front().radius = infinity;
  return landmarks_;
}

void Landmark_search::list_vertices(std::uint32_t node) {
  vertices_.clear();
  for (auto leaf = layout_.node(node).leaf; leaf < layout_.node(node).end_leaf; ++leaf)
    for (const auto vertex : layout_.vertices(leaf)) {
      if (listed_for_[vertex] == node + 1) continue;
      listed_for_[vertex] = node + 1;
      vertices_.push_back(vertex);
    }
}

/// Makes a union-find forest with a tree for each part.
void Landmark_search::join_faces(std::uint32_t node) {
  for (const auto vertex : vertices_) joined_[vertex] = vertex;
  for (auto leaf = layout_.node(node).leaf; leaf < layout_.node(node).end_leaf; ++leaf) {
    const auto vertices = layout_.vertices(leaf);
    for (const auto& corners : layout_.corners(leaf)) {
      const std::uint32_t root = root_of(vertices[corners[0]]);
      joined_[root_of(vertices[corners[1]])] = root;
      joined_[root_of(vertices[corners[2]])] = root;
    }
  }
}

std::uint32_t Landmark_search::root_of(std::uint32_t vertex) {
  while (joined_[vertex] != vertex) vertex = joined_[vertex] = joined_[joined_[vertex]];
  return vertex;
}

void Landmark_search::measure_parts() {
  parts_.clear();
  for (const auto vertex : vertices_) part_of_[vertex] = of_no_part;
  for (const auto vertex : vertices_) {
    auto& part = part_of_[root_of(vertex)];
    if (part == of_no_part) {
      part = static_cast<std::uint32_t>(parts_.size());
      parts_.emplace_back();
    }
    ++parts_[part].size;
    parts_[part].box.extend(rest(vertex));
  }
}

/// The vertex nearest to the centre of its box, for each of the largest parts.
void Landmark_search::choose_centres() {
  for (const auto vertex : vertices_) {
    Part& part = parts_[part_of_[root_of(vertex)]];
    const double squared = (rest(vertex) - part.box.center()).squaredNorm();
    if (squared < part.squared_distance) part.squared_distance = squared, part.centre.vertex = vertex;
    if (part.squared_distance == infinity) part.centre.vertex = vertex;  // overflow
  }
  const auto count = std::min(most_landmarks, parts_.size());
  std::ranges::partial_sort(parts_, parts_.begin() + static_cast<std::ptrdiff_t>(count), std::greater(),
                            [](const Part& part) { return std::pair(part.size, part.centre.vertex); });
  landmarks_.clear();
  for (std::size_t i = 0; i < count; ++i) landmarks_.push_back(parts_[i].centre);
}

/// Dijkstra's algorithm from all landmarks at once, until all vertices of the node are reached.
/// @return false: they are not
bool Landmark_search::measure_radii(std::size_t budget) {
  heap_.clear();
  for (std::uint32_t i = 0; i < landmarks_.size(); ++i) {
    const auto vertex = landmarks_[i].vertex;
    heap_.push_back({.distance = 0, .vertex = vertex, .landmark = i});
    distance_[vertex] = 0;
    reached_for_[vertex] = node_ + 1;
  }
  std::size_t left = vertices_.size();
  while (!heap_.empty() && left > 0) {
    const Reached nearest = heap_.front();
    std::ranges::pop_heap(heap_, std::greater());
    heap_.pop_back();
    if (nearest.distance > distance_[nearest.vertex]) continue;  // a shorter path has been found
    if (budget-- == 0) return false;
    if (listed_for_[nearest.vertex] == node_ + 1) {
      landmarks_[nearest.landmark].radius = nearest.distance;
      --left;
    }
    relax_edges_of(nearest);
  }
  return left == 0;
}

void Landmark_search::relax_edges_of(const Reached& from) {
  for (const auto edge : boost::make_iterator_range(out_edges(from.vertex, graph_))) {
    const auto to = static_cast<std::uint32_t>(target(edge, graph_));
    const double distance = from.distance + lengths_[get(boost::edge_index, graph_, edge)];
    if (reached_for_[to] == node_ + 1 && distance_[to] <= distance) continue;
    reached_for_[to] = node_ + 1;
    distance_[to] = distance;
    heap_.push_back({.distance = distance, .vertex = to, .landmark = from.landmark});
    std::ranges::push_heap(heap_, std::greater());
  }
}

}  // namespace lodestone
