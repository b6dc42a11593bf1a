// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/contact/tree_object.h"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <numeric>

#include "lodestone/contact/ray_crossing.h"

namespace lodestone {

void Tree_object::build(std::span<const Region_index> labels, Coordinates coordinates,
                        const Region_tree_options& options) {
  coordinates_ = coordinates;
  tree_ = Region_tree(corners_, labels, coordinates, options);
  built_looseness_ = tree_.looseness();
  finite_ = true;
}

const Vertex_fans& Tree_object::fans() const {
  if (!fans_) fans_.emplace(static_cast<std::uint32_t>(vertex_count()), corners_);
  return *fans_;
}

bool Tree_object::closed() const {
  if (!closed_) closed_ = is_closed(static_cast<std::uint32_t>(vertex_count()), corners_);
  return *closed_;
}

std::span<const std::uint32_t> Tree_object::piece_vertices() const {
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

namespace {

/// Fewer parts take one thread less time than waking others.
constexpr std::size_t shared_parts = 8;

}  // namespace

void refit(std::span<Tree_object* const> objects, std::span<const Coordinates> coordinates, Workers& workers) {
  // The parts of all trees are one list of tasks, so that many small objects are shared as well as a large one.
  std::vector<std::size_t> first_part{0};
  for (std::size_t o = 0; o < objects.size(); ++o) {
    objects[o]->coordinates_ = coordinates[o];
    first_part.push_back(first_part.back() + objects[o]->tree_.part_count());
  }
  const auto refit_part = [&](std::size_t task, std::size_t) {
    const auto o = static_cast<std::size_t>(std::ranges::upper_bound(first_part, task) - first_part.begin()) - 1;
    objects[o]->tree_.refit_part(task - first_part[o], coordinates[o]);
  };
  if (first_part.back() < shared_parts)
    for (std::size_t task = 0; task < first_part.back(); ++task) refit_part(task, 0);
  else
    workers.run(first_part.back(), refit_part);
  for (std::size_t o = 0; o < objects.size(); ++o) objects[o]->finite_ = objects[o]->tree_.finish_refit(coordinates[o]);
}

}  // namespace lodestone
