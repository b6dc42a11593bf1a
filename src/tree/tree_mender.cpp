// SPDX-License-Identifier: GPL-3.0-or-later
#include "tree/tree_mender.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "tree/float_frame.h"

namespace lodestone {

namespace {

/// With more than this share of its faces changed, a tree is built anew.
constexpr std::size_t most_changed = 8;

constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();  // asks for the leaf of a vertex
constexpr std::uint32_t unknown = nobody - 1;

}  // namespace

Tree_mender::Tree_mender(const Tree_layout& former, Tree_layout& tree, std::span<const Corners> corners,
                         std::span<const std::uint32_t> changed, Coordinates coordinates,
                         const Region_tree_options& options, Workers& workers)
    : Tree_builder(tree, corners, {}, coordinates, options, workers), former_(former) {
  const std::size_t former_faces = former.face_begin_.back();
  moved_.assign(changed.begin(), changed.end());
  for (std::size_t face = former_faces; face < corners.size(); ++face)
    moved_.push_back(static_cast<std::uint32_t>(face));
  std::ranges::sort(moved_);
  moved_.erase(std::unique(moved_.begin(), moved_.end()), moved_.end());
  left_.assign(std::max(former_faces, corners.size()), 0);
  std::fill(left_.begin() + static_cast<std::ptrdiff_t>(corners.size()), left_.end(), std::uint8_t{1});
  for (const auto face : moved_) left_[face] = 1;
}

bool Tree_mender::mend() {
  if (moved_.size() > corners_.size() / most_changed || !place_faces() || !size_leaves()) return false;
  size_lists(leaf_begin_.back());
  std::vector<Branch> branches;
  add_node(0, branches);
  add_branches(std::move(branches));
  std::vector<std::span<const std::uint32_t>> copied(tree_.leaf_count());
  for (std::uint32_t leaf = 0; leaf < former_.leaf_count(); ++leaf)
    if (!touched_[leaf]) copied[leaf_begin_[leaf]] = former_.vertices(leaf);
  list_vertices(copied);
  return true;
}

/// Gives each moved face to a leaf that has one of its vertices, or one of a moved face beside it, and so on.
/// @return false if there is none: the face belongs to a piece that is new
bool Tree_mender::place_faces() {
  std::vector<std::uint32_t> leaf_of(coordinates_.size() / 3, unknown);
  for (const auto face : moved_)
    for (const auto vertex : corners_[face]) leaf_of[vertex] = nobody;
  find_leaves_of_vertices(leaf_of);
  std::vector<std::uint32_t> reached, waiting;
  for (const auto face : moved_)
    if (!place(face, leaf_of, reached)) waiting.push_back(face);
  if (!waiting.empty() && !place_waiting_faces(leaf_of, std::move(waiting))) return false;
  std::ranges::sort(placed_, {},
                    [](const Placed_face& placed) { return std::uint64_t{placed.leaf} << 32U | placed.face; });
  return true;
}

/// Gives a face to the leaf of one of its vertices, if one has a leaf; then all have.
/// @param reached  the vertices that had none are appended
bool Tree_mender::place(std::uint32_t face, std::vector<std::uint32_t>& leaf_of, std::vector<std::uint32_t>& reached) {
  const auto& corners = corners_[face];
  const auto with_leaf = std::ranges::find_if(corners, [&](auto vertex) { return leaf_of[vertex] < unknown; });
  if (with_leaf == corners.end()) return false;
  const std::uint32_t leaf = leaf_of[*with_leaf];
  placed_.push_back({leaf, face});
  for (const auto vertex : corners)
    if (leaf_of[vertex] >= unknown) {
      leaf_of[vertex] = leaf;
      reached.push_back(vertex);
    }
  return true;
}

/// Faces between new vertices: from the faces that have been placed outwards.
/// @return whether all have been placed
bool Tree_mender::place_waiting_faces(std::vector<std::uint32_t>& leaf_of, std::vector<std::uint32_t> waiting) {
  using Vertex_and_face = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<Vertex_and_face> faces_at;  // by their vertices
  for (const auto face : waiting)
    for (const auto vertex : corners_[face]) faces_at.emplace_back(vertex, face);
  std::ranges::sort(faces_at);
  std::vector<bool> waits(corners_.size(), false);
  std::size_t left = waiting.size();
  std::vector<std::uint32_t> queue;
  for (const auto face : waiting) {
    waits[face] = true;
    for (const auto vertex : corners_[face])
      if (leaf_of[vertex] < unknown) queue.push_back(vertex);  // since a face beside it was placed later
  }
  while (!queue.empty()) {
    const std::uint32_t vertex = queue.back();
    queue.pop_back();
    for (const auto& [at, face] : std::ranges::equal_range(faces_at, vertex, {}, &Vertex_and_face::first))
      if (waits[face] && place(face, leaf_of, queue)) {
        waits[face] = false;
        --left;
      }
  }
  return left == 0;
}

void Tree_mender::find_leaves_of_vertices(std::vector<std::uint32_t>& leaf_of) const {
  for (std::uint32_t leaf = 0; leaf < former_.leaf_count(); ++leaf)
    for (const auto vertex : former_.vertices(leaf))
      if (vertex < leaf_of.size() && leaf_of[vertex] == nobody) leaf_of[vertex] = leaf;
}

/// Finds which leaves are made anew, and how many leaves each becomes.
/// @return false if leaves would be much emptier than in a new tree
bool Tree_mender::size_leaves() {
  const std::size_t leaves = former_.leaf_count();
  touched_.assign(leaves, false);
  face_count_.resize(leaves);
  for (std::uint32_t leaf = 0; leaf < leaves; ++leaf) {
    const auto faces = former_.faces(leaf);
    std::uint32_t left = 0;
    for (const auto face : faces) left += left_[face];
    face_count_[leaf] = static_cast<std::uint32_t>(faces.size()) - left;
    touched_[leaf] = left > 0;
  }
  for (const auto& [leaf, face] : placed_) {
    ++face_count_[leaf];
    touched_[leaf] = true;
  }
  leaf_begin_ = {0};
  face_begin_ = {0};
  for (std::uint32_t leaf = 0; leaf < leaves; ++leaf) {
    // A leaf that has grown a little stays whole.
    const std::size_t most = std::min(leaf_faces_ + leaf_faces_ / 3, most_leaf_faces);
    const std::uint32_t count = face_count_[leaf];
    const std::uint32_t becomes = count > 0 && count <= most ? 1 : leaves_for(count);
    if (becomes > 1) touched_[leaf] = true;  // even without a change: leaves may have held more when it was made
    leaf_begin_.push_back(leaf_begin_.back() + becomes);
    face_begin_.push_back(face_begin_.back() + count);
  }
  return leaf_begin_.back() <= 2 * leaves_for(corners_.size());
}

std::uint32_t Tree_mender::leaves_below(std::uint32_t former_node) const {
  const auto& node = former_.node(former_node);
  return leaf_begin_[node.end_leaf] - leaf_begin_[node.leaf];
}

/// Adds what becomes of a former node and all below it. A node of whose children one has no faces left is left out.
void Tree_mender::add_node(std::uint32_t former_node, std::vector<Branch>& branches) {
  const auto& node = former_.node(former_node);
  if (former_.is_leaf(former_node)) {
    const Branch branch{.begin = face_begin_[node.leaf],
                        .end = face_begin_[node.leaf + 1],
                        .leaves = leaves_below(former_node),
                        .node = next_node_,
                        .leaf = leaf_begin_[node.leaf],
                        .face = face_begin_[node.leaf]};
    next_node_ += 2 * branch.leaves - 1;
    if (touched_[node.leaf]) {
      fill_items(node.leaf, branch.leaves > 1);
      branches.push_back(branch);
    } else {
      copy_leaf(node.leaf, branch);
    }
    return;
  }
  const std::uint32_t first = former_node + 1, second = node.second_child;
  if (leaves_below(first) == 0) return add_node(second, branches);
  if (leaves_below(second) == 0) return add_node(first, branches);
  const std::uint32_t here = next_node_++;
  add_node(first, branches);
  tree_.nodes_[here] = {
      .second_child = next_node_, .leaf = leaf_begin_[node.leaf], .end_leaf = leaf_begin_[node.end_leaf]};
  add_node(second, branches);
}

void Tree_mender::copy_leaf(std::uint32_t former_leaf, const Branch& branch) {
  const auto copy = [](const auto& from, auto to) { std::copy(from.begin(), from.end(), to); };
  copy(former_.faces(former_leaf), tree_.faces_.begin() + branch.face);
  copy(former_.corners(former_leaf), tree_.corners_.begin() + branch.face);
  add_leaf_node(branch, former_.vertices(former_leaf).size());
}

/// The faces that a touched leaf has now; only those that are split need their centres.
void Tree_mender::fill_items(std::uint32_t former_leaf, bool with_centres) {
  auto* item = items_.data() + face_begin_[former_leaf];
  std::vector<std::uint32_t> faces;
  for (const auto face : former_.faces(former_leaf))
    if (left_[face] == 0) faces.push_back(face);
  for (const auto& placed : std::ranges::equal_range(placed_, former_leaf, {}, &Placed_face::leaf))
    faces.push_back(placed.face);
  if (!with_centres) {
    for (const auto face : faces) *item++ = {{}, face};
    return;
  }
  const Float_frame frame(coordinates_, corners_, faces);
  for (const auto face : faces) *item++ = {frame.mean(corners_[face]), face};
}

}  // namespace lodestone
