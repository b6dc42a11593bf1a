// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/tree/region_anchors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lodestone {

Region_anchors::Region_anchors(Tree_on_demand& tree, std::span<const Corners> corners,
                               std::span<const Region_index> labels, Coordinates rest) {
  const Tree_layout& layout = tree.layout();
  const auto region_of = [&](std::uint32_t leaf) {
    const auto& [a, b, c] = corners[layout.faces(leaf).front()];
    return std::min({labels[a], labels[b], labels[c]});
  };
  // In depth-first order, so the first node with leaves of a single region is the topmost. A region's leaves are
  // consecutive.
  std::vector<bool> listed(std::size_t{std::ranges::max(labels)} + 1);
  for (std::uint32_t n = 0; n < layout.node_count(); ++n) {
    const Region_index region = region_of(layout.node(n).leaf);
    if (listed[region] || region_of(layout.node(n).end_leaf - 1) != region) continue;
    listed[region] = true;
    nodes_.push_back(n);
    regions_.push_back(region);
  }
  for (auto* column : {&x_, &y_, &z_, &radius_}) column->resize(nodes_.size());

  const Eigen::Vector3d middle = mean(tree);
  rest_spread_ = spread(tree, middle);
  for (std::size_t i = 0; i < rest.size(); i += 3)
    rest_radius_ = std::max(rest_radius_, (Eigen::Map<const Eigen::Vector3d>(rest.data() + i) - middle).norm());
}

Eigen::Vector3d Region_anchors::mean(Tree_on_demand& tree) const {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto node : nodes_) mean += tree.anchor(node) / static_cast<double>(nodes_.size());
  return mean;
}

double Region_anchors::spread(Tree_on_demand& tree, const Eigen::Vector3d& mean) const {
  double squared = 0;
  for (const auto node : nodes_) squared += (tree.anchor(node) - mean).squaredNorm();
  return std::sqrt(squared);
}

void Region_anchors::read(Tree_on_demand& tree, double reach) {
  const Eigen::Vector3d middle = mean(tree);
  tree.note_distance(spread(tree, middle), rest_spread_);
  box_.setEmpty();
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Eigen::Vector3d& anchor = tree.anchor(nodes_[i]);
    x_[i] = anchor.x(), y_[i] = anchor.y(), z_[i] = anchor.z();
    radius_[i] = reach * tree.radius(nodes_[i]);
    const Eigen::Vector3d radius = Eigen::Vector3d::Constant(radius_[i]);
    box_.extend(anchor - radius).extend(anchor + radius);
  }
  const Eigen::Vector3d radius = Eigen::Vector3d::Constant(reach * tree.stretch() * rest_radius_);
  box_ = box_.intersection(Box(middle - radius, middle + radius));
}

bool Region_anchors::may_touch(std::uint32_t place, const Box& box) const {
  return box.squaredExteriorDistance(Eigen::Vector3d(x_[place], y_[place], z_[place])) <=
         radius_[place] * radius_[place];
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
