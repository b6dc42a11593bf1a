// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lodestone/tree/tree_layout.h"
#include "lodestone/volumes/bounding_volume.h"

namespace lodestone {

/// Sums over the leaves that volumes are fitted to.
struct Leaf_sums {
  double coordinates = 0;  ///< of all vertices. Non-finite if any input is; may also overflow
  double extents = 0;      ///< of the leaves' volumes
};

/// Sum of the coordinates of a leaf's vertices. Non-finite if any input is; may also overflow.
double sum_coordinates(const Tree_layout& layout, Coordinates coordinates, std::size_t leaf);

/// Fits the volumes of the leaves in [first, end). A volume type that is fitted faster to many leaves at once has an
/// overload.
/// @param volumes  per node
template <Bounding_volume Volume>
Leaf_sums fit_leaves(const Tree_layout& layout, Coordinates coordinates, std::size_t first, std::size_t end,
                     std::span<Volume> volumes) {
  Leaf_sums sums;
  for (std::size_t leaf = first; leaf < end; ++leaf) {
    sums.coordinates += sum_coordinates(layout, coordinates, leaf);
    Volume& volume = volumes[layout.leaf_node(leaf)];
    volume.enclose(layout.leaf_faces(leaf, coordinates));
    sums.extents += volume.extent();
  }
  return sums;
}
/// The same for boxes, with vector instructions.
Leaf_sums fit_leaves(const Tree_layout& layout, Coordinates coordinates, std::size_t first, std::size_t end,
                     std::span<Aabb> boxes);
/// The boxes of all nodes, fitted to their vertices. O(V).
std::vector<Aabb> fitted_boxes(const Tree_layout& layout, Coordinates coordinates);

/// A hierarchy of bounding volumes over the faces of one object, in the layout of Tree_layout. Built once, refitted in
/// every frame. Nodes have volumes, single faces do not.
///
/// @tparam Volume  see Bounding_volume; axis-aligned boxes (Region_tree) are the fastest to refit
template <Bounding_volume Volume>
class Basic_region_tree : public Tree_layout {
 public:
  Basic_region_tree() = default;

  /// Groups the faces as Tree_layout does, with the same parameters and errors, and fits the volumes to `coordinates`.
  Basic_region_tree(std::span<const Corners> corners, std::span<const Region_index> labels, Coordinates coordinates,
                    const Region_tree_options& options = {}, Workers& workers = Workers::alone())
      : Tree_layout(corners, labels, coordinates, options, workers),
        volumes_(node_count()),
        part_sums_(parts().size()) {
    fit(coordinates, workers);
  }

  /// A tree that has a layout, but no volumes before the first refit.
  explicit Basic_region_tree(Tree_layout layout)
      : Tree_layout(std::move(layout)), volumes_(node_count()), part_sums_(parts().size()) {}

  /// Follows a change of some faces: see `mended`.
  /// @param coordinates  3 V'
  /// @return false if a new tree is better, or if a coordinate that faces use is not finite; this one is then unusable
  bool mend(std::span<const Corners> corners, std::span<const std::uint32_t> changed, Coordinates coordinates,
            const Region_tree_options& options, Workers& workers = Workers::alone()) {
    auto layout = mended(corners, changed, coordinates, options, workers);
    if (!layout) return false;
    static_cast<Tree_layout&>(*this) = std::move(*layout);
    volumes_.assign(node_count(), {});
    part_sums_.assign(parts().size(), {});
    return fit(coordinates, workers);
  }

  /// Fits all volumes to the current coordinates: those of leaves to the leaf's vertices, each of which is read once,
  /// those of other nodes to the volumes of their children. O(V).
  /// @return false if a coordinate is not finite: the volumes are then meaningless until the next refit
  bool refit(Coordinates coordinates) {
    for (std::size_t part = 0; part < part_count(); ++part) refit_part(part, coordinates);
    return finish_refit(coordinates);
  }

  /// A refit in parts. They can be refitted in any order and by several threads. `finish_refit` then fits the nodes
  /// above them and returns what `refit` would. The volumes are the same, too.
  std::size_t part_count() const { return parts().size(); }
  /// Fits the nodes of one part. O(vertices of the part).
  void refit_part(std::size_t part, Coordinates coordinates);
  /// Fits the nodes above all parts.
  /// @return as `refit`
  bool finish_refit(Coordinates coordinates);

  /// Volume of a node.
  const Volume& volume(std::uint32_t n) const { return volumes_[n]; }
  /// Volumes of all nodes, by index.
  std::span<const Volume> volumes() const { return volumes_; }
  /// The same, for callers that fit single nodes.
  std::span<Volume> volumes() { return volumes_; }

  /// Mean extent of the leaves' volumes, relative to the extent of the root's. It grows when leaves are pulled apart.
  /// For boxes it stays the same if the mesh is moved, turned by right angles, or scaled. 0 for a point. A few
  /// vertices far from all others hardly count.
  double looseness() const { return looseness_; }

  /// For tests: describes the first violation of the definition above; empty if there is none. O(F log F).
  /// @param corners      of the mesh
  /// @param coordinates  of the last refit
  std::string validate(std::span<const Corners> corners, Coordinates coordinates) const;

 private:
  bool fit(Coordinates coordinates, Workers& workers) {
    workers.run(part_count(), [&](std::size_t part, std::size_t) { refit_part(part, coordinates); });
    return finish_refit(coordinates);
  }
  double looseness_of(double extents);
  void enclose_children(std::uint32_t n) { volumes_[n].enclose(volumes_[n + 1], volumes_[node(n).second_child]); }

  std::vector<Volume> volumes_;       ///< per node
  std::vector<Leaf_sums> part_sums_;  ///< of the last refit
  double looseness_ = 0;
  double spread_ = 0;  ///< extent of the root, in times of the branches' median, in the first refit; 0: none so far
};

/// The tree of the mode `exact`.
using Region_tree = Basic_region_tree<Aabb>;

template <Bounding_volume Volume>
void Basic_region_tree<Volume>::refit_part(std::size_t index, Coordinates coordinates) {
  const Part& part = parts()[index];
  part_sums_[index] = fit_leaves(*this, coordinates, part.first_leaf, part.end_leaf, std::span(volumes_));
  for (std::uint32_t n = part.end_node; n-- > part.first_node;)
    if (!is_leaf(n)) enclose_children(n);
}

template <Bounding_volume Volume>
bool Basic_region_tree<Volume>::finish_refit(Coordinates coordinates) {
  for (std::size_t i = top_nodes().size(); i-- > 0;) enclose_children(top_nodes()[i]);

  Leaf_sums sums;
  for (const Leaf_sums& part : part_sums_) {
    sums.coordinates += part.coordinates;
    sums.extents += part.extents;
  }
  looseness_ = looseness_of(sums.extents);
  if (!std::isfinite(looseness_)) looseness_ = 0;  // the sum overflows beyond 1e306: such trees never count as loose

  // Finite coordinates can have a sum that overflows.
  return std::isfinite(sums.coordinates) || finite(coordinates);
}

/// A vertex that flies off makes the root's volume as large as one likes, and that of a leaf. So the extent of the
/// whole is taken as no larger, in comparison with the median of the branches', than in the first refit; there as no
/// more than eight times the median, which is as much as it is if each level halves the same side. No leaf counts as
/// larger.
/// @param extents  the sum of those of all leaves
template <Bounding_volume Volume>
double Basic_region_tree<Volume>::looseness_of(double extents) {
  double whole = volumes_.front().extent();
  boost::container::static_vector<double, most_branches> sizes;
  for (const auto branch : branches()) sizes.push_back(volumes_[branch].extent());
  std::ranges::sort(sizes);
  const double median = sizes[sizes.size() / 2];
  if (spread_ == 0 && median > 0) spread_ = std::min(whole / median, 8.0);
  const double most = spread_ * median;
  if (sizes.size() >= 4 && most > 0 && most < whole) {
    whole = most;
    extents = 0;
    for (std::size_t leaf = 0; leaf < leaf_count(); ++leaf)
      extents += std::min(volumes_[leaf_node(leaf)].extent(), most);
  }
  return whole > 0 ? extents / static_cast<double>(leaf_count()) / whole : 0;
}

template <Bounding_volume Volume>
std::string Basic_region_tree<Volume>::validate(std::span<const Corners> corners, Coordinates coordinates) const {
  if (std::string wrong = validate_layout(corners, coordinates.size() / 3); !wrong.empty()) return wrong;
  for (std::uint32_t n = 0; n < node_count(); ++n) {
    Volume fitted;
    if (is_leaf(n))
      fitted.enclose(leaf_faces(node(n).leaf, coordinates));
    else
      fitted.enclose(volumes_[n + 1], volumes_[node(n).second_child]);
    if (!(fitted == volumes_[n]))
      return "node " + std::to_string(n) + ": its volume is not that of " +
             (is_leaf(n) ? "its vertices" : "its children");
  }
  return {};
}

extern template class Basic_region_tree<Aabb>;

}  // namespace lodestone
