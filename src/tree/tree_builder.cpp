// SPDX-License-Identifier: GPL-3.0-or-later
#include "tree/tree_builder.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "tree/read_ahead.h"

namespace lodestone {

void Tree_builder::build() {
  group_by_region(face_items());
  std::vector<Item> regions;
  for (Region_index region = 0; region + 1 < region_begin_.size(); ++region) {
    const std::span<Item> faces(faces_.data() + region_begin_[region], faces_.data() + region_begin_[region + 1]);
    if (faces.empty()) continue;
    Item item{Eigen::Vector3d::Zero(), region};
    for (const Item& face : faces) item.centre += face.centre / static_cast<double>(faces.size());
    regions.push_back(item);
  }
  tree_.face_begin_.push_back(0);
  tree_.vertex_begin_.push_back(0);
  tree_.faces_.reserve(corners_.size());
  tree_.corners_.reserve(corners_.size() + kernel::faces_ahead);
  add_regions(regions);
}

std::vector<Tree_builder::Item> Tree_builder::face_items() const {
  std::vector<Item> items(corners_.size());
  for (std::uint32_t face = 0; face < items.size(); ++face) {
    // Divided before they are added, since the sum of large coordinates may overflow.
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const auto corner : corners_[face])
      centre += Eigen::Map<const Eigen::Vector3d>(coordinates_.data() + 3 * std::size_t{corner}) / 3;
    items[face] = {centre, face};
  }
  return items;
}

Region_index Tree_builder::region_of(std::uint32_t face) const {
  if (labels_.empty()) return 0;
  const auto& [a, b, c] = corners_[face];
  return std::min({labels_[a], labels_[b], labels_[c]});
}

void Tree_builder::group_by_region(const std::vector<Item>& faces) {
  const std::size_t regions = labels_.empty() ? 1 : std::size_t{std::ranges::max(labels_)} + 1;
  region_begin_.assign(regions + 1, 0);
  for (const Item& face : faces) ++region_begin_[region_of(face.index) + 1];
  for (std::size_t region = 0; region < regions; ++region) region_begin_[region + 1] += region_begin_[region];
  faces_.resize(faces.size());
  auto next = region_begin_;
  for (const Item& face : faces) faces_[next[region_of(face.index)]++] = face;
}

void Tree_builder::add_regions(std::span<Item> regions) {
  if (regions.size() > 1)
    return add_parts(regions, regions.size() / 2, [this](std::span<Item> part) { add_regions(part); });
  const Region_index region = regions.front().index;
  add_faces({faces_.data() + region_begin_[region], faces_.data() + region_begin_[region + 1]});
}

void Tree_builder::add_faces(std::span<Item> faces) {
  // As few leaves as possible, of nearly equal size: plain halving would fill them anywhere between half and whole.
  const std::size_t leaves = (faces.size() + options_.leaf_faces - 1) / options_.leaf_faces;
  if (leaves == 1) return add_leaf(faces);
  add_parts(faces, faces.size() * (leaves / 2) / leaves, [this](std::span<Item> part) { add_faces(part); });
}

template <class Add>
void Tree_builder::add_parts(std::span<Item> items, std::size_t first_count, Add add) {
  Eigen::AlignedBox3d box;
  for (const Item& item : items) box.extend(item.centre);
  int axis = 0;
  // Halved, since the difference may overflow.
  (box.max() / 2 - box.min() / 2).maxCoeff(&axis);
  // Ties are broken by index, so that the split does not depend on the sorting routine.
  const auto before = [axis](const Item& a, const Item& b) {
    return a.centre[axis] != b.centre[axis] ? a.centre[axis] < b.centre[axis] : a.index < b.index;
  };
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(first_count), items.end(), before);

  const std::size_t node = tree_.nodes_.size();
  tree_.nodes_.push_back({.leaf = static_cast<std::uint32_t>(tree_.leaf_nodes_.size())});
  add(items.first(first_count));
  tree_.nodes_[node].second_child = static_cast<std::uint32_t>(tree_.nodes_.size());
  add(items.subspan(first_count));
  tree_.nodes_[node].end_leaf = static_cast<std::uint32_t>(tree_.leaf_nodes_.size());
}

void Tree_builder::add_leaf(std::span<Item> items) {
  std::ranges::sort(items, {}, &Item::index);
  const auto first = static_cast<std::ptrdiff_t>(tree_.vertices_.size());
  for (const Item& item : items) {
    tree_.faces_.push_back(item.index);
    tree_.vertices_.insert(tree_.vertices_.end(), corners_[item.index].begin(), corners_[item.index].end());
  }
  const auto begin = tree_.vertices_.begin() + first;
  std::sort(begin, tree_.vertices_.end());
  tree_.vertices_.erase(std::unique(begin, tree_.vertices_.end()), tree_.vertices_.end());

  const auto index_in_leaf = [&](std::uint32_t vertex) {
    return static_cast<std::uint16_t>(std::lower_bound(begin, tree_.vertices_.end(), vertex) - begin);
  };
  for (const Item& item : items) {
    const auto& [a, b, c] = corners_[item.index];
    tree_.corners_.push_back({index_in_leaf(a), index_in_leaf(b), index_in_leaf(c)});
  }
  const auto leaf = static_cast<std::uint32_t>(tree_.leaf_nodes_.size());
  tree_.leaf_nodes_.push_back(static_cast<std::uint32_t>(tree_.nodes_.size()));
  tree_.nodes_.push_back({.leaf = leaf, .end_leaf = leaf + 1});
  tree_.face_begin_.push_back(static_cast<std::uint32_t>(tree_.faces_.size()));
  tree_.vertex_begin_.push_back(static_cast<std::uint32_t>(tree_.vertices_.size()));
}

}  // namespace lodestone
