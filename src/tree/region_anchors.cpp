// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/tree/region_anchors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lodestone/volumes/to_box.h"
#include "tree/face_region.h"

namespace lodestone {

namespace {

/// To read all of such a surface takes less time than a pair of objects that boxes around anchors would let pass.
bool is_small(const Tree_on_demand& tree) { return tree.vertex_count() <= 256; }

}  // namespace

Region_anchors::Region_anchors(Tree_on_demand& tree, std::span<const Corners> corners,
                               std::span<const Region_index> labels, Coordinates rest) {
  const Tree_layout& layout = tree.layout();
  const auto region_of_leaf = [&](std::uint32_t leaf) {
    return region_of(corners[layout.faces(leaf).front()], labels);
  };
  // In depth-first order, so the first node with leaves of a single region is the topmost. A region's leaves are
  // consecutive.
  std::vector<bool> listed(std::size_t{std::ranges::max(labels)} + 1);
  for (std::uint32_t n = 0; n < layout.node_count(); ++n) {
    const Region_index region = region_of_leaf(layout.node(n).leaf);
    if (listed[region] || region_of_leaf(layout.node(n).end_leaf - 1) != region) continue;
    listed[region] = true;
    nodes_.push_back(n);
    regions_.push_back(region);
  }
  make_room();
  probes_ = probes(layout, rest);
  const Eigen::Vector3d middle = mean(tree);
  for (const auto node : probes_) rest_distances_.push_back((tree.anchor(node) - middle).norm());
  // What rounding leaves of a distance would tell nothing.
  constexpr double least = 0x1p-20;
  if (std::ranges::max(rest_distances_) <= least * tree.radius(0)) std::ranges::fill(rest_distances_, 0.0);
}

void Region_anchors::make_room() {
  for (auto* column : {&x_, &y_, &z_, &radius_}) column->resize(nodes_.size());
}

void Region_anchors::save(State_writer& state) const {
  state.list(nodes_);
  state.list(regions_);
  state.list(probes_);
  state.list(rest_distances_);
}

Region_anchors Region_anchors::load(State_reader& state, const Tree_layout& layout, std::size_t regions) {
  Region_anchors loaded;
  loaded.nodes_ = state.list<std::uint32_t>();
  loaded.regions_ = state.list<Region_index>();
  loaded.probes_ = state.list<std::uint32_t>();
  loaded.rest_distances_ = state.list<double>();
  const auto below = [](std::size_t count) { return [count](std::size_t index) { return index < count; }; };
  State_reader::require(loaded.nodes_.size() == loaded.regions_.size() &&
                            std::ranges::all_of(loaded.nodes_, below(layout.node_count())) &&
                            std::ranges::all_of(loaded.regions_, below(regions)),
                        "a region has no node of the tree");
  loaded.check_apart(layout, regions);
  State_reader::require(!loaded.probes_.empty() && loaded.probes_.size() == loaded.rest_distances_.size() &&
                            std::ranges::all_of(loaded.probes_, below(layout.node_count())),
                        "the nodes that tell its stretch are not in the tree");
  State_reader::require(all_finite(loaded.rest_distances_), "a number is not finite");
  loaded.make_room();
  return loaded;
}

/// Nodes are as the constructor lists them: in depth-first order, none of them below another, one for each region.
void Region_anchors::check_apart(const Tree_layout& layout, std::size_t regions) const {
  std::uint32_t end_leaf = 0;
  std::vector<bool> listed(regions);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const auto& node = layout.node(nodes_[i]);
    State_reader::require(node.leaf >= end_leaf && !listed[regions_[i]], "two of its regions share faces");
    end_leaf = node.end_leaf;
    listed[regions_[i]] = true;
  }
}

/// The regions, and the leaves that reach farthest along an axis: where a pull shows most.
std::vector<std::uint32_t> Region_anchors::probes(const Tree_layout& layout, Coordinates rest) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Eigen::Array3d least = Eigen::Array3d::Constant(infinity), largest = Eigen::Array3d::Constant(-infinity);
  std::array<std::uint32_t, 6> tips{};
  for (std::uint32_t leaf = 0; leaf < layout.leaf_count(); ++leaf) {
    Box box;
    for (const auto vertex : layout.vertices(leaf))
      box.extend(Eigen::Map<const Eigen::Vector3d>(rest.data() + 3 * std::size_t{vertex}));
    for (int axis = 0; axis < 3; ++axis) {
      if (box.min()[axis] < least[axis]) least[axis] = box.min()[axis], tips[axis] = leaf;
      if (box.max()[axis] > largest[axis]) largest[axis] = box.max()[axis], tips[axis + 3] = leaf;
    }
  }
  std::vector<std::uint32_t> nodes = nodes_;
  for (const auto leaf : tips) nodes.push_back(layout.leaf_node(leaf));
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

Eigen::Vector3d Region_anchors::mean(Tree_on_demand& tree) const {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto node : probes_) mean += tree.anchor(node) / static_cast<double>(probes_.size());
  return mean;
}

/// The anchors' root mean square distance from their mean follows the size of the object, whatever it does otherwise.
/// Where one distance has grown much more, the object is stretched in that direction; a little does not count, since
/// radii are seldom needed to their end. An anchor near the mean tells little: a small shift of the mean is a large
/// share of its distance.
void Region_anchors::note_stretch(Tree_on_demand& tree, const Eigen::Vector3d& mean) const {
  constexpr double much = 1.15;
  const double farthest = std::ranges::max(rest_distances_);
  double squares = 0, rest_squares = 0;
  for (std::size_t i = 0; i < probes_.size(); ++i) {
    const double distance = (tree.anchor(probes_[i]) - mean).norm(), rest = rest_distances_[i];
    squares += distance * distance;
    rest_squares += rest * rest;
    if (2 * rest >= farthest && distance > much * rest) tree.note_distance(distance, rest);
  }
  tree.note_distance(std::sqrt(squares), std::sqrt(rest_squares));
}

/// Anchors at one point tell nothing: where there is one leaf, and where all faces have a vertex in common. Then some
/// leaves are read.
void Region_anchors::note_farthest(Tree_on_demand& tree) const {
  for (const auto probe : probes_) {
    const std::uint32_t leaf = tree.layout().node(probe).leaf, node = tree.layout().leaf_node(leaf);
    tree.pose(leaf);
    const Leaf_faces faces = tree.view().leaf(leaf);
    const Eigen::Vector3d& anchor = tree.anchor(node);
    double farthest = 0;
    for (std::size_t i = 0; i < faces.vertices.size(); ++i)
      farthest = std::max(farthest, (Eigen::Map<const Eigen::Vector3d>(faces.position(i)) - anchor).squaredNorm());
    tree.note_distance(std::sqrt(farthest), tree.radius(node) / tree.stretch());
  }
}

void Region_anchors::read(Tree_on_demand& tree, double reach) {
  if (std::ranges::max(rest_distances_) == 0)
    note_farthest(tree);
  else
    note_stretch(tree, mean(tree));
  box_.setEmpty();
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Eigen::Vector3d& anchor = tree.anchor(nodes_[i]);
    x_[i] = anchor.x(), y_[i] = anchor.y(), z_[i] = anchor.z();
    radius_[i] = reach * tree.radius(nodes_[i]);
    const Eigen::Vector3d radius = Eigen::Vector3d::Constant(radius_[i]);
    box_.extend(anchor - radius).extend(anchor + radius);
  }
}

void Region_anchors::find(Tree_on_demand& tree, double reach) {
  if (!is_small(tree)) return read(tree, reach);
  tree.pose_below(0);
  box_ = to_box(tree.box(0));
}

void Region_anchors::find_regions(Tree_on_demand& tree, double reach) {
  if (!is_small(tree)) return;
  const Box fitted = box_;
  read(tree, reach);
  box_ = fitted;
}

bool Region_anchors::may_touch(std::uint32_t index, const Box& box) const {
  return box.squaredExteriorDistance(Eigen::Vector3d(x_[index], y_[index], z_[index])) <=
         radius_[index] * radius_[index];
}

void list_near_regions(const Region_anchors& a, const Region_anchors& b, std::vector<Near_regions>& pairs) {
  if (a.box_.intersection(b.box_).isEmpty()) return;
  for (std::uint32_t i = 0; i < a.size(); ++i) {
    if (!a.may_touch(i, b.box_)) continue;
    for (std::uint32_t j = 0; j < b.size(); ++j) {
      const double x = a.x_[i] - b.x_[j], y = a.y_[i] - b.y_[j], z = a.z_[i] - b.z_[j];
      const double squared = x * x + y * y + z * z, radii = a.radius_[i] + b.radius_[j];
      if (squared > radii * radii) continue;
      pairs.push_back({i, j, std::sqrt(squared), static_cast<float>(radii > 0 ? squared / (radii * radii) : 0)});
    }
  }
}

}  // namespace lodestone
