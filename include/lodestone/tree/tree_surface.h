// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "lodestone/mesh/object_surface.h"
#include "lodestone/mesh/workers.h"
#include "lodestone/tree/tree_view.h"

namespace lodestone {

template <Bounding_volume Volume>
class Basic_tree_surface;

template <Bounding_volume Volume>
void refit(std::span<Basic_tree_surface<Volume>* const> objects, std::span<const Coordinates> coordinates,
           Workers& workers);

/// The surface of one object and a tree over it, kept from frame to frame.
template <Bounding_volume Volume>
class Basic_tree_surface : public Object_surface {
 public:
  /// As those of Object_surface: a surface without a tree.
  using Object_surface::Object_surface;

  /// A surface with a tree, without regions: see `build`.
  Basic_tree_surface(std::span<const Corners> corners, Coordinates coordinates, const Region_tree_options& options = {})
      : Object_surface(corners) {
    build({}, coordinates, options);
  }

  /// Builds the tree, or rebuilds it. O(F log F), shared among the workers.
  /// @param labels       V: region of each vertex; empty: a single region
  /// @param coordinates  3 V, all finite; must stay unchanged until the next refit
  void build(std::span<const Region_index> labels, Coordinates coordinates, const Region_tree_options& options,
             Workers& workers = Workers::alone()) {
    coordinates_ = coordinates;
    tree_ = Basic_region_tree<Volume>(corners(), labels, coordinates, options, workers);
    built_looseness_ = tree_.looseness();
    finite_ = true;
  }

  /// Takes the tree of a surface of which some faces have changed since, and mends it: see `Tree_layout::mended`.
  /// @param coordinates  3 V; must stay unchanged until the next refit
  /// @return false if a new tree is better, or if a coordinate that faces use is not finite; the former tree is gone
  bool mend(Basic_tree_surface&& former, std::span<const std::uint32_t> changed, Coordinates coordinates,
            const Region_tree_options& options, Workers& workers = Workers::alone()) {
    tree_ = std::move(former.tree_);
    built_looseness_ = former.built_looseness_;
    coordinates_ = coordinates;
    finite_ = true;
    return tree_.mend(corners(), changed, coordinates, options, workers);
  }

  /// Writes the tree, how loose it was when it was built, and the positions at rest if kept. O(V + F).
  void save(State_writer& state) const {
    state.value(built_looseness_);
    state.list(rest());
    tree_.save(state);
  }
  /// Reads what `save` has written for a surface of the same faces. Has no volumes and no positions before the next
  /// refit. O(V + F).
  /// @throws Bad_saved_object  the surface stays as it was
  void load(State_reader& state, std::size_t vertex_count) {
    const double looseness = state.finite();
    auto rest = state.list<double>();
    State_reader::require(rest.empty() || rest.size() == 3 * vertex_count, "it has other positions than vertices");
    State_reader::require(all_finite(rest), "a coordinate is not finite");
    tree_ = Basic_region_tree<Volume>(Tree_layout::load(state, corners(), vertex_count));
    built_looseness_ = looseness;
    set_rest(std::move(rest));
  }

  /// The tree, with the volumes of the last refit.
  const Basic_region_tree<Volume>& tree() const { return tree_; }
  /// The tree with the current positions.
  Basic_tree_view<Volume> view() const { return {&tree_, coordinates_}; }

  /// Volumes of all nodes, for a Bounded_surface, which fits single nodes instead of refitting the tree.
  std::span<Volume> volumes_to_fit() { return tree_.volumes(); }
  /// Takes other coordinates without refitting the tree.
  /// @param coordinates  3 V; must stay where they are until the next refit
  void follow(Coordinates coordinates) { coordinates_ = coordinates; }

  /// Whether all coordinates that faces use are finite. Every query requires it.
  bool finite() const { return finite_; }
  /// Whether the looseness of the tree has grown by more than `factor` since it was built.
  bool looser_than(double factor) const { return tree_.looseness() > factor * built_looseness_; }

 private:
  // One specialisation: Clang 16 takes a friend that is a template with a concept for another function.
  friend void refit<Volume>(std::span<Basic_tree_surface* const> objects, std::span<const Coordinates> coordinates,
                            Workers& workers);

  Basic_region_tree<Volume> tree_;
  bool finite_ = true;
  double built_looseness_ = 0;
};

/// An object of the mode `exact`.
using Tree_surface = Basic_tree_surface<Aabb>;

/// Refits the trees of several objects to the current positions. O(V), shared among the workers.
/// @param coordinates  per object: 3 V; must stay unchanged until the next refit
template <Bounding_volume Volume>
void refit(std::span<Basic_tree_surface<Volume>* const> objects, std::span<const Coordinates> coordinates,
           Workers& workers) {
  constexpr std::size_t shared_parts = 8;  // with fewer, waking other threads takes longer than refitting
  // The parts of all trees are one list of tasks, so that many small objects are shared as evenly as a large one.
  std::vector<std::size_t> first_part{0};
  for (std::size_t o = 0; o < objects.size(); ++o) {
    objects[o]->coordinates_ = coordinates[o];
    first_part.push_back(first_part.back() + objects[o]->tree_.part_count());
  }
  // In reverse: callers usually write vertices in ascending order, so the last are still in this thread's cache.
  const auto refit_part = [&](std::size_t index, std::size_t) {
    const std::size_t task = first_part.back() - 1 - index;
    const auto o = static_cast<std::size_t>(std::ranges::upper_bound(first_part, task) - first_part.begin()) - 1;
    objects[o]->tree_.refit_part(task - first_part[o], coordinates[o]);
  };
  if (first_part.back() < shared_parts)
    for (std::size_t index = 0; index < first_part.back(); ++index) refit_part(index, 0);
  else
    workers.run(first_part.back(), refit_part);
  for (std::size_t o = 0; o < objects.size(); ++o) objects[o]->finite_ = objects[o]->tree_.finish_refit(coordinates[o]);
}
/// The same for boxes, where the volume cannot be deduced from the arguments.
inline void refit(std::span<Tree_surface* const> objects, std::span<const Coordinates> coordinates, Workers& workers) {
  refit<Aabb>(objects, coordinates, workers);
}

}  // namespace lodestone
