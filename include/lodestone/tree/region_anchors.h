// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/mesh/box.h"
#include "lodestone/tree/tree_on_demand.h"

namespace lodestone {

/// Two regions that may touch, by their indices in two lists of Region_anchors.
struct Near_regions {
  std::uint32_t a = 0;  ///< index in the list of the first object
  std::uint32_t b = 0;  ///< index in the list of the second
  double distance = 0;  ///< of the anchors, in units of the coordinates
  float order = 0;      ///< its square, relative to that of the sum of the radii
};

/// Where the regions of one object are in a frame, as far as their anchors tell.
///
/// A region is a node of the tree: the faces that the tree groups with it. Regions without such faces are not listed.
class Region_anchors {
 public:
  Region_anchors() = default;
  /// O(F + nodes + V).
  /// @param tree             must have read the positions at rest; the same one as in all other calls
  /// @param corners, labels  those that the tree was made of, labels not empty
  /// @param rest             3 V, the positions at rest
  Region_anchors(Tree_on_demand& tree, std::span<const Corners> corners, std::span<const Region_index> labels,
                 Coordinates rest);

  /// Writes what cannot be told from the tree. O(regions).
  void save(State_writer& state) const;
  /// Reads what `save` has written. O(regions).
  /// @param regions            how many the surface is divided into
  /// @throws Bad_saved_object  the bytes are no regions of this tree
  static Region_anchors load(State_reader& state, const Tree_layout& layout, std::size_t regions);

  /// Reads the anchors in the current frame of the tree, and tells it how far the surface is stretched: by how far
  /// they have spread from their mean, or, where all are at one point, by the vertices of some leaves. O(regions).
  /// @param reach      a region is taken to lie within so many times its radius of its anchor
  /// @throws Bad_mesh  a coordinate is not finite
  void read(Tree_on_demand& tree, double reach);
  /// Reads where the surface is. If it is small, at most 256 vertices, all of it is read, since the radii of anchors
  /// would make its box several times too wide. Otherwise the same as `read`. O(V) for a small one, else O(regions).
  /// @throws Bad_mesh  a coordinate is not finite
  void find(Tree_on_demand& tree, double reach);
  /// Reads the anchors of a small surface as well, after `find`.
  void find_regions(Tree_on_demand& tree, double reach);

  /// Number of regions that are listed.
  std::size_t size() const { return nodes_.size(); }
  /// The node of the region at an index of the list.
  std::uint32_t node(std::uint32_t index) const { return nodes_[index]; }
  /// The region at an index of the list.
  Region_index region(std::uint32_t index) const { return regions_[index]; }
  /// Encloses the surface: after `find` a small one closely, otherwise as far as the anchors tell.
  const Box& box() const { return box_; }

  /// Appends the pairs of regions of two objects that may touch. O(n m) for those that may touch the other's box.
  friend void list_near_regions(const Region_anchors& a, const Region_anchors& b, std::vector<Near_regions>& pairs);

 private:
  void check_apart(const Tree_layout& layout, std::size_t regions) const;
  void make_room();
  Eigen::Vector3d mean(Tree_on_demand& tree) const;
  void note_farthest(Tree_on_demand& tree) const;
  void note_stretch(Tree_on_demand& tree, const Eigen::Vector3d& mean) const;
  std::vector<std::uint32_t> probes(const Tree_layout& layout, Coordinates rest) const;
  bool may_touch(std::uint32_t index, const Box& box) const;

  std::vector<std::uint32_t> nodes_;        ///< ascending: neighbours in the list are mostly neighbours in space
  std::vector<Region_index> regions_;       ///< parallel
  std::vector<double> x_, y_, z_, radius_;  ///< parallel: anchors in this frame, radii with reach and stretch
  Box box_;
  std::vector<std::uint32_t> probes_;   ///< nodes whose anchors tell the stretch: regions, and the tips
  std::vector<double> rest_distances_;  ///< parallel: of their anchors from the mean, at rest; 0: all at one point
};

/// Appends the pairs of regions of two objects that may touch. O(n m) for those that may touch the other's box.
void list_near_regions(const Region_anchors& a, const Region_anchors& b, std::vector<Near_regions>& pairs);

}  // namespace lodestone
