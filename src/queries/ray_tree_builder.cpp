// SPDX-License-Identifier: GPL-3.0-or-later
#include "queries/ray_tree_builder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lodestone/mesh/large_pages.h"
#include "queries/ray_fit_kernel.h"
#include "queries/ray_walk_kernel.h"
#include "tree/rank_kernel.h"

namespace lodestone {

namespace {

/// A face of a leaf, and where it comes in the order of faces: its strip, its place in the strip, and in the low bits
/// its index in the leaf.
constexpr std::uint32_t face_bits = 7, face_mask = (1U << face_bits) - 1;
constexpr std::uint32_t along_bits = 20, along_mask = (1U << along_bits) - 1;
constexpr float along_steps = static_cast<float>(along_mask);
static_assert(most_leaf_faces <= 1U << face_bits);
static_assert(most_leaf_faces / ray_tree_width <= 1U << (32 - along_bits - face_bits),
              "a strip has at least one block");

/// The least spread that is told apart.
constexpr float tiny = 0x1p-30F;

/// The two axes along which a box is longest.
std::pair<std::size_t, std::size_t> longest_axes(const std::array<float, 3>& low, const std::array<float, 3>& high) {
  std::array<std::size_t, 3> axes{0, 1, 2};
  const auto is_longer = [&](std::size_t a, std::size_t b) { return high[a] - low[a] > high[b] - low[b]; };
  if (is_longer(axes[1], axes[0])) std::swap(axes[0], axes[1]);
  if (is_longer(axes[2], axes[1])) std::swap(axes[1], axes[2]);
  if (is_longer(axes[1], axes[0])) std::swap(axes[0], axes[1]);
  return {axes[0], axes[1]};
}

constexpr std::size_t leaves_per_task = 64;
constexpr std::size_t blocks_per_task = 512;

constexpr Ray_box no_box{{4, 4, 4}, {-4, -4, -4}};

void extend(Ray_box& box, const Ray_box& other) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::min(box.low[axis], other.low[axis]);
    box.high[axis] = std::max(box.high[axis], other.high[axis]);
  }
}

float half_area(const Ray_box& box) {
  const float x = box.high[0] - box.low[0], y = box.high[1] - box.low[1], z = box.high[2] - box.low[2];
  return x * y + y * z + z * x;
}

}  // namespace

void Ray_tree_builder::build(Workers& workers) {
  if (!place()) return;
  count_blocks();
  std::vector<Leaf_memory> memory(workers.count());
  workers.run((layout_.leaf_count() + leaves_per_task - 1) / leaves_per_task,
              [&](std::size_t task, std::size_t worker) {
                const std::size_t end = std::min((task + 1) * leaves_per_task, layout_.leaf_count());
                for (std::size_t leaf = task * leaves_per_task; leaf < end; ++leaf)
                  pack_leaf(static_cast<std::uint32_t>(leaf), memory[worker]);
              });
  fit_boxes();
  tree_.nodes_.reserve(tree_.blocks_.size() / 3 + 1);
  use_large_pages(tree_.nodes_.data(), tree_.nodes_.capacity() * sizeof(Ray_node));
  add_node(branch_of(0), 0);
  tree_.is_fitted_ = tells_leaves_apart();
}

void Ray_tree_builder::refit(Workers& workers) {
  tree_.is_fitted_ = false;  // a refit that runs out of memory leaves a tree that asks its surface
  if (!place()) return;
  const std::size_t blocks = tree_.blocks_.size();
  workers.run((blocks + blocks_per_task - 1) / blocks_per_task, [&](std::size_t task, std::size_t) {
    fit_blocks(task * blocks_per_task, std::min((task + 1) * blocks_per_task, blocks));
  });
  if (!tells_leaves_apart()) return;
  std::vector<Ray_box> boxes(tree_.nodes_.size());
  for (std::size_t n = boxes.size(); n-- > 0;) boxes[n] = refit_node(n, boxes);  // children come after their parent
  tree_.is_fitted_ = true;
}

/// Whether most leaves are wide beside the error of the walk. Where another face is very far away they are not: a ray
/// would meet all of them, and the surface answers sooner.
bool Ray_tree_builder::tells_leaves_apart() const {
  constexpr std::size_t together = 8;  // blocks next to each other, about a leaf
  const auto& blocks = tree_.block_boxes_;
  std::size_t narrow = 0, count = 0;
  for (std::size_t first = 0; first < blocks.size(); first += together, ++count) {
    Ray_box box = no_box;
    for (std::size_t b = first; b < std::min(first + together, blocks.size()); ++b) extend(box, blocks[b]);
    const float side = std::max({box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]});
    narrow += side < 16 * kernel::walk_error ? 1 : 0;
  }
  return 2 * narrow <= count;
}

/// @param node_boxes  of all nodes that come later
Ray_box Ray_tree_builder::refit_node(std::size_t index, std::span<const Ray_box> node_boxes) {
  Ray_node& node = tree_.nodes_[index];
  Ray_box all = no_box;
  for (std::size_t i = 0; i < ray_tree_width; ++i) {
    const std::uint32_t child = node.children[i], block = child & ~is_ray_block;
    if (child == 0) continue;
    const Ray_box& box = child == block ? node_boxes[child] : tree_.block_boxes_[block];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      node.sides[0][axis][i] = box.low[axis];
      node.sides[1][axis][i] = box.high[axis];
    }
    extend(all, box);
  }
  return all;
}

void Ray_tree_builder::fit_blocks(std::size_t first, std::size_t end) {
  const auto& middle = tree_.middle_;
  kernel::fit_blocks(tree_.surface_.coordinates.data(), {{middle[0], middle[1], middle[2]}, tree_.scale_},
                     std::span(tree_.blocks_.data() + first, end - first), tree_.block_boxes_.data() + first);
}

/// @return false if there is no fitting scale
bool Ray_tree_builder::place() {
  const Aabb& bounds = tree_.surface_.bounds;
  double half_width = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double middle = tree_.middle_[axis] = bounds.low[axis] / 2 + bounds.high[axis] / 2;
    // Far from the origin, the middle is rounded to one side.
    half_width = std::max({half_width, bounds.high[axis] - middle, middle - bounds.low[axis]});
  }
  if (!(half_width > 0x1p-500 && half_width < 0x1p500)) return false;
  tree_.scale_ = std::ldexp(1.0, -std::ilogb(half_width * (1 + 0x1p-40)) - 1);
  return true;
}

void Ray_tree_builder::count_blocks() {
  first_block_.resize(layout_.leaf_count() + 1);
  for (std::size_t leaf = 0; leaf < layout_.leaf_count(); ++leaf)
    first_block_[leaf + 1] =
        first_block_[leaf] +
        static_cast<std::uint32_t>((layout_.faces(leaf).size() + ray_tree_width - 1) / ray_tree_width);
  tree_.blocks_.resize(first_block_.back());
  use_large_pages(tree_.blocks_.data(), first_block_.back() * sizeof(Ray_block));
  tree_.block_boxes_.resize(first_block_.back());
}

std::array<float, 3> Ray_tree_builder::relative(const double* position) const {
  std::array<float, 3> result;
  for (std::size_t axis = 0; axis < 3; ++axis)
    result[axis] = static_cast<float>((position[axis] - tree_.middle_[axis]) * tree_.scale_);
  return result;
}

/// Sorts the faces into strips across the longest axis of the leaf, and within a strip along its second longest axis,
/// there and back again; eight in a row are a block \cite leutenegger1997.
void Ray_tree_builder::pack_leaf(std::uint32_t leaf, Leaf_memory& memory) {
  read_leaf(leaf, memory);
  const std::uint32_t first = first_block_[leaf], blocks = first_block_[leaf + 1] - first;
  const auto [across, along] = longest_axes(memory.around.low, memory.around.high);
  const auto spread = [&](std::size_t axis) { return memory.around.high[axis] - memory.around.low[axis]; };
  const float wanted = std::sqrt(static_cast<float>(blocks) * spread(across) / std::max(spread(along), tiny));
  const float strips = std::clamp(std::round(wanted), 1.0F, static_cast<float>(blocks));
  const float strips_per_unit = strips / std::max(spread(across), tiny),
              steps_per_unit = along_steps / std::max(spread(along), tiny);
  for (std::uint32_t face = 0; face < memory.sums.size(); ++face) {
    const auto& sum = memory.sums[face];
    const auto strip =
        static_cast<std::uint32_t>(std::min((sum[across] - memory.around.low[across]) * strips_per_unit, strips - 1));
    const auto place = static_cast<std::uint32_t>((sum[along] - memory.around.low[along]) * steps_per_unit);
    memory.order[face] = (strip << along_bits | (strip % 2 == 0 ? place : along_mask - place)) << face_bits | face;
  }
  kernel::sort_few(memory.order);
  for (std::size_t begin = 0; begin < memory.order.size(); begin += ray_tree_width)
    add_block(leaf, first + static_cast<std::uint32_t>(begin / ray_tree_width),
              std::span(memory.order).subspan(begin, std::min(ray_tree_width, memory.order.size() - begin)));
  fit_blocks(first, first + blocks);
}

void Ray_tree_builder::read_leaf(std::uint32_t leaf, Leaf_memory& memory) const {
  const Leaf_faces faces = tree_.surface_.leaf(leaf);
  const std::size_t count = faces.corners.size();
  memory.sums.resize(count);
  memory.order.resize(count);
  memory.around = no_box;
  for (std::size_t f = 0; f < count; ++f) {
    std::array<float, 3>& sum = memory.sums[f] = {};
    for (const auto corner : faces.corners[f]) {
      const auto p = relative(faces.position(corner));
      for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += p[axis];
    }
    extend(memory.around, {sum, sum});
  }
}

/// Beyond the last face, it is repeated.
void Ray_tree_builder::add_block(std::uint32_t leaf, std::uint32_t index, std::span<const std::uint32_t> faces) {
  Ray_block& block = tree_.blocks_[index];
  const auto corners = layout_.corners(leaf);
  const auto vertices = layout_.vertices(leaf);
  block.count = static_cast<std::uint32_t>(faces.size());
  for (std::size_t lane = 0; lane < ray_tree_width; ++lane) {
    const std::uint32_t face = faces[std::min(lane, faces.size() - 1)] & face_mask;
    block.faces[lane] = layout_.faces(leaf)[face];
    for (std::size_t c = 0; c < 3; ++c) block.vertices[c][lane] = vertices[corners[face][c]];
  }
}

/// Those of the layout's nodes, from the blocks up.
void Ray_tree_builder::fit_boxes() {
  node_boxes_.resize(layout_.node_count());
  for (auto n = static_cast<std::uint32_t>(layout_.node_count()); n-- > 0;) {
    const auto& node = layout_.node(n);
    if (node.second_child == 0) {
      node_boxes_[n] = around_blocks(first_block_[node.leaf], first_block_[node.leaf + 1]);
    } else {
      node_boxes_[n] = node_boxes_[n + 1];
      extend(node_boxes_[n], node_boxes_[node.second_child]);
    }
  }
}

Ray_tree_builder::Branch Ray_tree_builder::branch_of(std::uint32_t n) const {
  const auto& node = layout_.node(n);
  return {node_boxes_[n], n, first_block_[node.leaf], first_block_[node.end_leaf]};
}

Ray_tree_builder::Branch Ray_tree_builder::branch_of(std::uint32_t n, std::uint32_t first, std::uint32_t end) const {
  return {around_blocks(first, end), n, first, end};
}

Ray_box Ray_tree_builder::around_blocks(std::uint32_t first, std::uint32_t end) const {
  Ray_box box = no_box;
  for (std::uint32_t b = first; b < end; ++b) extend(box, tree_.block_boxes_[b]);
  return box;
}

std::pair<Ray_tree_builder::Branch, Ray_tree_builder::Branch> Ray_tree_builder::children(const Branch& branch) const {
  const auto& node = layout_.node(branch.node);
  if (node.second_child != 0) return {branch_of(branch.node + 1), branch_of(node.second_child)};
  const std::uint32_t middle = branch.first + (branch.end - branch.first) / 2;
  return {branch_of(branch.node, branch.first, middle), branch_of(branch.node, middle, branch.end)};
}

/// Opens branches, those with the largest surface first, until the node is full or all of them fit into nodes of the
/// next level. So the nodes just above the blocks, which are the most, are nearly full.
/// @param waiting  most that can wait while a ray is in this node, without its children
std::uint32_t Ray_tree_builder::add_node(const Branch& branch, std::size_t waiting) {
  std::array<Branch, ray_tree_width> open{branch};
  std::size_t count = 1, most = 1;
  for (std::size_t next = ray_tree_width; next < branch.size(); next *= ray_tree_width) most = next;
  while (count < ray_tree_width) {
    std::size_t largest = count;
    for (std::size_t i = 0; i < count; ++i)
      if (open[i].size() > most && (largest == count || half_area(open[i].box) > half_area(open[largest].box)))
        largest = i;
    if (largest == count) break;
    const auto [first, second] = children(open[largest]);
    open[largest] = first;
    open[count++] = second;
  }
  tree_.most_waiting_ = std::max(tree_.most_waiting_, waiting + count);
  const auto index = static_cast<std::uint32_t>(tree_.nodes_.size());
  tree_.nodes_.emplace_back();
  Ray_node& node = tree_.nodes_.back();
  for (std::size_t i = 0; i < ray_tree_width; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      node.sides[0][axis][i] = i < count ? open[i].box.low[axis] : std::numeric_limits<float>::infinity();
      node.sides[1][axis][i] = i < count ? open[i].box.high[axis] : -std::numeric_limits<float>::infinity();
    }
  for (std::size_t i = 0; i < ray_tree_width; ++i) {
    std::uint32_t child = 0;
    if (i < count) child = open[i].size() == 1 ? open[i].first | is_ray_block : add_node(open[i], waiting + count - 1);
    tree_.nodes_[index].children[i] = child;
  }
  return index;
}

}  // namespace lodestone
