// SPDX-License-Identifier: GPL-3.0-or-later
#include "tree/tree_builder.h"

#include <Eigen/Core>
#include <algorithm>

#include "tree/face_region.h"
#include "tree/float_frame.h"
#include "tree/rank_kernel.h"
#include "tree/read_ahead.h"

namespace lodestone {

namespace {

/// How many faces, or leaves, a worker takes at once.
constexpr std::size_t faces_at_once = 16384, leaves_at_once = 256;

}  // namespace

void Tree_builder::build() {
  make_room(corners_.size());
  read_items();
  group_by_region();
  std::size_t leaves = 0;
  for (Region_index region = 0; region + 1 < region_begin_.size(); ++region) leaves += leaves_for(faces_of(region));
  size_lists(leaves);
  auto regions = region_items(), spare = regions;
  std::vector<Branch> branches;
  add_regions(regions, spare, {.leaves = static_cast<std::uint32_t>(leaves)}, branches);
  add_branches(std::move(branches));
  size_vertices();
  workers_.run(leaves / leaves_at_once + 1, [&](std::size_t index, std::size_t) {
    gather_vertices(index * leaves_at_once, std::min((index + 1) * leaves_at_once, leaves));
  });
}

/// @param faces  how many are to be grouped
void Tree_builder::make_room(std::size_t faces) {
  items_.resize(faces);
  spare_.resize(faces);
  vertices_.resize(3 * faces);
}

void Tree_builder::read_items() {
  const Float_frame frame(coordinates_, workers_);
  workers_.run(items_.size() / faces_at_once + 1, [&](std::size_t index, std::size_t) {
    const std::size_t end = std::min((index + 1) * faces_at_once, items_.size());
    for (std::size_t face = index * faces_at_once; face < end; ++face)
      items_[face] = {frame.mean(corners_[face]), static_cast<std::uint32_t>(face)};
  });
}

/// Reads the centres of some faces relative to the box around these faces. Relative to all positions they are nearly
/// one float, if another vertex or face is very far away.
void Tree_builder::read_again(std::span<Split_item> items, Workers& workers) const {
  std::vector<std::uint32_t> faces(items.size());
  std::ranges::transform(items, faces.begin(), &Split_item::index);
  const Float_frame frame(coordinates_, corners_, faces);
  workers.run(items.size() / faces_at_once + 1, [&](std::size_t index, std::size_t) {
    const std::size_t begin = index * faces_at_once;
    for (Split_item& item : items.subspan(begin, std::min(faces_at_once, items.size() - begin)))
      item.centre = frame.mean(corners_[item.index]);
  });
}

void Tree_builder::group_by_region() {
  if (labels_.empty()) {
    region_begin_ = {0, static_cast<std::uint32_t>(items_.size())};
    return;
  }
  if (widest_spread(items_) < narrow_spread) read_again(items_, workers_);  // also for the centres of regions
  const std::size_t regions = std::size_t{std::ranges::max(labels_)} + 1;
  region_begin_.assign(regions + 1, 0);
  for (const auto& item : items_) ++region_begin_[region_of(corners_[item.index], labels_) + 1];
  for (std::size_t region = 0; region < regions; ++region) region_begin_[region + 1] += region_begin_[region];
  auto next = region_begin_;
  for (const auto& item : items_) spare_[next[region_of(corners_[item.index], labels_)]++] = item;
  std::swap(items_, spare_);
}

/// All lists of the tree but that of vertices have their final length from here on.
void Tree_builder::size_lists(std::size_t leaves) {
  tree_.nodes_.resize(2 * leaves - 1);
  tree_.leaf_nodes_.resize(leaves);
  tree_.face_begin_.resize(leaves + 1);
  tree_.face_begin_.back() = static_cast<std::uint32_t>(corners_.size());
  tree_.vertex_begin_.resize(leaves + 1);
  tree_.faces_.resize(corners_.size());
  tree_.corners_.resize(corners_.size() + kernel::faces_ahead);
  std::fill_n(tree_.corners_.end() - kernel::faces_ahead, kernel::faces_ahead, Leaf_corners{});
  item_begin_.resize(leaves);
}

/// The regions that have faces. A single one needs no centre.
std::vector<Split_item> Tree_builder::region_items() const {
  if (labels_.empty()) return {{.centre = {}, .index = 0}};
  std::vector<Split_item> regions;
  for (Region_index region = 0; region + 1 < region_begin_.size(); ++region) {
    const std::uint32_t count = faces_of(region);
    if (count == 0) continue;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& item : std::span(items_).subspan(region_begin_[region], count))
      sum += Eigen::Map<const Eigen::Vector3f>(item.centre.data()).cast<double>();
    Split_item item{.centre = {}, .index = region};
    Eigen::Map<Eigen::Vector3f>(item.centre.data()) = (sum / count).cast<float>();
    regions.push_back(item);
  }
  return regions;
}

/// Makes the nodes above the regions. Each region is a branch of its own.
void Tree_builder::add_regions(std::span<Split_item> regions, std::span<Split_item> spare, const Branch& whole,
                               std::vector<Branch>& branches) {
  if (regions.size() == 1) {
    Branch branch = whole;
    branch.begin = region_begin_[regions.front().index];
    branch.end = region_begin_[regions.front().index + 1];
    branches.push_back(branch);
    return;
  }
  const std::size_t half = regions.size() / 2;
  if (split_items(regions, spare, half) == Split_result::in_spare) std::swap(regions, spare);
  std::uint32_t faces = 0, leaves = 0;
  for (const auto& region : regions.first(half)) {
    faces += faces_of(region.index);
    leaves += leaves_for(faces_of(region.index));
  }
  const auto [first, second] = add_inner_node(whole, faces, leaves);
  add_regions(regions.first(half), spare.first(half), first, branches);
  add_regions(regions.subspan(half), spare.subspan(half), second, branches);
}

/// Halves branches until there are enough for all workers, which then share them. While there are fewer than workers,
/// these share each.
void Tree_builder::add_branches(std::vector<Branch> branches) {
  const std::size_t enough = workers_.count() == 1 ? 0 : 8 * workers_.count();
  while (branches.size() < enough && std::ranges::any_of(branches, [](const auto& b) { return b.leaves > 1; })) {
    std::vector<std::pair<Branch, Branch>> halves(branches.size());
    const auto halve_one = [&](std::size_t i, Workers& workers) {
      halves[i] = branches[i].leaves > 1 ? halve(branches[i], workers) : std::pair(branches[i], Branch{});
    };
    if (branches.size() < workers_.count())
      for (std::size_t i = 0; i < branches.size(); ++i) halve_one(i, workers_);
    else
      workers_.run(branches.size(), [&](std::size_t i, std::size_t) { halve_one(i, Workers::alone()); });
    branches.clear();
    for (const auto& [first, second] : halves) {
      branches.push_back(first);
      if (second.leaves > 0) branches.push_back(second);
    }
  }
  std::vector<Leaf_numbering> numbers(workers_.count());
  workers_.run(branches.size(), [&](std::size_t i, std::size_t worker) { add_branch(branches[i], numbers[worker]); });
}

void Tree_builder::add_branch(const Branch& branch, Leaf_numbering& numbers) {
  if (branch.leaves == 1) return add_leaf(branch, numbers);
  const auto [first, second] = halve(branch);
  add_branch(first, numbers);
  add_branch(second, numbers);
}

std::pair<Tree_builder::Branch, Tree_builder::Branch> Tree_builder::halve(const Branch& branch, Workers& workers) {
  const std::size_t count = branch.end - branch.begin, leaves = branch.leaves / 2;
  const std::size_t first_count = count * leaves / branch.leaves;
  auto items = std::span(items_).subspan(branch.begin, count), spare = std::span(spare_).subspan(branch.begin, count);
  if (branch.in_spare) std::swap(items, spare);
  auto split = split_items(items, spare, first_count, narrow_spread, workers);
  if (split == Split_result::too_narrow) {
    read_again(items, workers);
    split = split_items(items, spare, first_count, 0, workers);
  }
  auto [first, second] =
      add_inner_node(branch, static_cast<std::uint32_t>(first_count), static_cast<std::uint32_t>(leaves));
  first.end = second.begin = branch.begin + static_cast<std::uint32_t>(first_count);
  first.in_spare = second.in_spare = branch.in_spare != (split == Split_result::in_spare);
  return {first, second};
}

/// @return its children, at their indices; their items are those of the branch
std::pair<Tree_builder::Branch, Tree_builder::Branch> Tree_builder::add_inner_node(const Branch& branch,
                                                                                   std::uint32_t first_faces,
                                                                                   std::uint32_t first_leaves) {
  Branch first = branch, second = branch;
  first.node = branch.node + 1;
  first.leaves = first_leaves;
  second.node = branch.node + 2 * first_leaves;  // a branch has one node less than twice its leaves
  second.leaf = branch.leaf + first_leaves;
  second.leaves = branch.leaves - first_leaves;
  second.face = branch.face + first_faces;
  tree_.nodes_[branch.node] = {
      .second_child = second.node, .leaf = branch.leaf, .end_leaf = branch.leaf + branch.leaves};
  return {first, second};
}

void Tree_builder::add_leaf(const Branch& branch, Leaf_numbering& numbers) {
  const std::size_t count = branch.end - branch.begin;
  const auto faces = std::span(tree_.faces_).subspan(branch.face, count);
  const auto items = std::span(branch.in_spare ? spare_ : items_).subspan(branch.begin, count);
  std::ranges::transform(items, faces.begin(), &Split_item::index);
  kernel::sort_few(faces);

  numbers.start_leaf();
  const auto corners = std::span(tree_.corners_).subspan(branch.face, count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [a, b, c] = corners_[faces[i]];
    corners[i] = {numbers[a], numbers[b], numbers[c]};
  }
  const auto numbered = numbers.vertices();
  kernel::Ranks places;  // by number
  kernel::find_ranks(numbered, places);
  const auto vertices = vertices_.begin() + 3 * static_cast<std::ptrdiff_t>(branch.begin);
  for (std::size_t number = 0; number < numbered.size(); ++number) vertices[places[number]] = numbered[number];
  const auto place = [&](std::uint16_t number) { return static_cast<std::uint16_t>(places[number]); };
  for (auto& [a, b, c] : corners) a = place(a), b = place(b), c = place(c);
  item_begin_[branch.leaf] = branch.begin;
  add_leaf_node(branch, numbered.size());
}

/// All of a leaf but its lists.
void Tree_builder::add_leaf_node(const Branch& branch, std::size_t vertex_count) {
  tree_.nodes_[branch.node] = {.leaf = branch.leaf, .end_leaf = branch.leaf + 1};
  tree_.leaf_nodes_[branch.leaf] = branch.node;
  tree_.face_begin_[branch.leaf] = branch.face;
  tree_.vertex_begin_[branch.leaf + 1] = static_cast<std::uint32_t>(vertex_count);
}

/// All leaves are there and know how many vertices they have.
void Tree_builder::size_vertices() {
  auto& begin = tree_.vertex_begin_;
  for (std::size_t leaf = 0; leaf + 1 < begin.size(); ++leaf) begin[leaf + 1] += begin[leaf];
  tree_.vertices_.reserve(begin.back() + kernel::vertices_ahead + 4);
  tree_.vertices_.resize(begin.back());
}

/// Moves the vertices of leaves that were made here to the list of the tree.
void Tree_builder::gather_vertices(std::size_t first_leaf, std::size_t end_leaf) {
  for (std::size_t leaf = first_leaf; leaf < end_leaf; ++leaf) {
    const auto begin = tree_.vertex_begin_[leaf], end = tree_.vertex_begin_[leaf + 1];
    std::copy_n(vertices_.begin() + 3 * static_cast<std::ptrdiff_t>(item_begin_[leaf]), end - begin,
                tree_.vertices_.begin() + begin);
  }
}

}  // namespace lodestone
