// SPDX-License-Identifier: GPL-3.0-or-later
#include "tree/tree_mender.h"

#include <hwy/contrib/sort/vqsort.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "tree/float_frame.h"

namespace lodestone {

namespace {

/// A tree is built anew if more than one in so many of its faces has changed.
constexpr std::size_t faces_per_changed = 8;

/// A tree is also built anew if finding leaves for new components would take more comparisons than so many per face.
constexpr std::size_t most_compared = 4;

/// A tree is also built anew if it has more than so many levels, twice those of a balanced one and some. One that grows
/// at the same place again and again, such as a rope that is laid out, would otherwise become a list.
std::size_t most_mended_levels(std::size_t leaves) { return 2 * static_cast<std::size_t>(std::bit_width(leaves)) + 32; }

constexpr std::uint32_t not_placed = std::numeric_limits<std::uint32_t>::max();

/// Places of leaves, to find the nearest one.
class Leaf_places {
 public:
  /// Of the leaves that still have faces: each where one of its vertices is.
  Leaf_places(const Tree_layout& tree, std::span<const std::uint32_t> face_count, Coordinates coordinates)
      : coordinates_(coordinates) {
    const auto is_there = [&](std::uint32_t vertex) { return std::size_t{vertex} < coordinates.size() / 3; };
    for (std::uint32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
      if (face_count[leaf] == 0) continue;
      const auto vertices = tree.vertices(leaf);
      const auto vertex = std::ranges::find_if(vertices, is_there);
      if (vertex != vertices.end()) places_.push_back({position(*vertex), leaf});
    }
  }

  std::size_t size() const { return places_.size(); }
  /// O(leaves).
  std::uint32_t nearest(std::uint32_t vertex) const {
    const Eigen::Vector3d here = position(vertex);
    double least = std::numeric_limits<double>::infinity();
    std::uint32_t nearest = places_.front().leaf;
    for (const Place& place : places_) {
      const double squared = (place.position - here).squaredNorm();
      if (squared < least) least = squared, nearest = place.leaf;
    }
    return nearest;
  }

 private:
  struct Place {
    Eigen::Vector3d position;
    std::uint32_t leaf;
  };

  Eigen::Vector3d position(std::uint32_t vertex) const {
    return Eigen::Map<const Eigen::Vector3d>(coordinates_.data() + 3 * std::size_t{vertex});
  }

  Coordinates coordinates_;
  std::vector<Place> places_;
};

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
  left_.resize(corners.size(), false);
  left_.resize(std::max(former_faces, corners.size()), true);
  for (const auto face : moved_) left_.set(face);
}

bool Tree_mender::mend() {
  if (moved_.size() > corners_.size() / faces_per_changed) return false;
  find_left_faces();
  if (!place_faces() || !size_leaves()) return false;
  size_lists(leaf_begin_.back());
  std::vector<Branch> branches;
  add_node(0, 1, branches);
  if (!finite_ || levels_ > most_mended_levels(leaf_begin_.back())) return false;
  add_branches(std::move(branches));
  size_vertices();
  copy_leaves();
  return true;
}

/// Which leaves faces have left, and how many each still has.
void Tree_mender::find_left_faces() {
  const std::size_t leaves = former_.leaf_count();
  touched_.assign(leaves, false);
  face_count_.resize(leaves);
  for (std::uint32_t leaf = 0; leaf < leaves; ++leaf) {
    const auto faces = former_.faces(leaf);
    std::uint32_t left = 0;
    for (const auto face : faces) left += left_.test(face) ? 1 : 0;
    face_count_[leaf] = static_cast<std::uint32_t>(faces.size()) - left;
    touched_[leaf] = left > 0;
  }
}

/// Gives each moved face to a leaf that has one of its vertices, or one of a moved face beside it, and so on. Most find
/// one among the leaves that faces have left, so the others are looked through only for those that do not. A component
/// that is new goes to the leaf that is nearest to one of its vertices.
/// @return false if there are many new components
bool Tree_mender::place_faces() {
  Vertex_leaves leaf_of(coordinates_.size() / 3);
  for (const auto face : moved_)
    for (const auto vertex : corners_[face]) leaf_of[vertex] = not_placed;
  std::vector<std::uint32_t> reached, waiting = moved_;
  for (const bool everywhere : {false, true}) {
    if (waiting.empty()) break;
    find_leaves_of_vertices(waiting, everywhere, leaf_of);
    std::erase_if(waiting, [&](std::uint32_t face) { return place(face, leaf_of, reached); });
  }
  if (!waiting.empty() && !place_waiting_faces(leaf_of, waiting)) return false;
  hwy::Sorter()(placed_.data(), placed_.size(), hwy::SortAscending());
  return true;
}

/// Gives a face to the leaf of one of its vertices, if one has a leaf; then all have.
/// @param reached  the vertices that had none are appended
bool Tree_mender::place(std::uint32_t face, Vertex_leaves& leaf_of, std::vector<std::uint32_t>& reached) {
  const auto& corners = corners_[face];
  const auto with_leaf = std::ranges::find_if(corners, [&](auto vertex) { return leaf_of[vertex] != not_placed; });
  if (with_leaf == corners.end()) return false;
  const std::uint32_t leaf = leaf_of[*with_leaf];
  placed_.push_back(std::uint64_t{leaf} << 32U | face);
  for (const auto vertex : corners)
    if (leaf_of[vertex] == not_placed) {
      leaf_of[vertex] = leaf;
      reached.push_back(vertex);
    }
  return true;
}

/// Faces between new vertices: from the faces that have been placed outwards, then new components.
/// @return false if there are many new components
bool Tree_mender::place_waiting_faces(Vertex_leaves& leaf_of, std::span<const std::uint32_t> waiting) {
  using Vertex_and_face = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<Vertex_and_face> faces_at;  // by their vertices
  for (const auto face : waiting)
    for (const auto vertex : corners_[face]) faces_at.emplace_back(vertex, face);
  std::ranges::sort(faces_at);
  std::vector<bool> waits(corners_.size(), false);
  std::vector<std::uint32_t> queue;
  for (const auto face : waiting) {
    waits[face] = true;
    for (const auto vertex : corners_[face])
      if (leaf_of[vertex] != not_placed) queue.push_back(vertex);  // since a face beside it was placed later
  }
  const auto spread = [&] {
    while (!queue.empty()) {
      const std::uint32_t vertex = queue.back();
      queue.pop_back();
      auto next = std::ranges::lower_bound(faces_at, vertex, {}, &Vertex_and_face::first);
      for (; next != faces_at.end() && next->first == vertex; ++next)
        if (waits[next->second] && place(next->second, leaf_of, queue)) waits[next->second] = false;
    }
  };
  spread();

  const auto in_new_component = [&](std::uint32_t face) { return waits[face]; };
  if (std::ranges::none_of(waiting, in_new_component)) return true;
  const Leaf_places places(former_, face_count_, coordinates_);
  std::size_t compared = 0;
  for (const auto face : waiting) {
    if (!in_new_component(face)) continue;
    compared += places.size();
    if (places.size() == 0 || compared > most_compared * corners_.size()) return false;
    const std::uint32_t vertex = corners_[face][0];
    leaf_of[vertex] = places.nearest(vertex);
    queue.push_back(vertex);
    spread();
  }
  return true;
}

/// The first former leaf of each vertex that has none yet.
/// @param everywhere  not only in leaves that faces have left
void Tree_mender::find_leaves_of_vertices(std::span<const std::uint32_t> faces, bool everywhere,
                                          Vertex_leaves& leaf_of) const {
  boost::dynamic_bitset<> wanted(leaf_of.size());
  for (const auto face : faces)
    for (const auto vertex : corners_[face])
      if (leaf_of[vertex] == not_placed) wanted.set(vertex);
  for (std::uint32_t leaf = 0; leaf < former_.leaf_count(); ++leaf) {
    if (!everywhere && !touched_[leaf]) continue;
    for (const auto vertex : former_.vertices(leaf))
      if (vertex < wanted.size() && wanted.test(vertex)) {
        leaf_of[vertex] = leaf;
        wanted.reset(vertex);
      }
  }
}

/// Finds which leaves are made anew, and how many leaves each becomes.
/// @return false if leaves would be much emptier than in a new tree
bool Tree_mender::size_leaves() {
  const std::size_t leaves = former_.leaf_count();
  for (const auto placed : placed_) {
    ++face_count_[leaf_with(placed)];
    touched_[leaf_with(placed)] = true;
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
  if (leaf_begin_.back() > 2 * leaves_for(corners_.size())) return false;
  std::size_t touched_faces = 0;
  for (std::uint32_t leaf = 0; leaf < leaves; ++leaf)
    if (touched_[leaf]) touched_faces += face_count_[leaf];
  make_room(touched_faces);
  return true;
}

std::uint32_t Tree_mender::leaves_below(std::uint32_t former_node) const {
  const auto& node = former_.node(former_node);
  return leaf_begin_[node.end_leaf] - leaf_begin_[node.leaf];
}

/// Adds what becomes of a former node and all below it. A node of whose children one has no faces left is left out.
/// @param level  of the node; 1 for the root
void Tree_mender::add_node(std::uint32_t former_node, std::size_t level, std::vector<Branch>& branches) {
  const auto& node = former_.node(former_node);
  if (former_.is_leaf(former_node)) {
    Branch branch{.leaves = leaves_below(former_node),
                  .node = next_node_,
                  .leaf = leaf_begin_[node.leaf],
                  .face = face_begin_[node.leaf]};
    next_node_ += 2 * branch.leaves - 1;
    levels_ = std::max(levels_, level + static_cast<std::size_t>(std::bit_width(branch.leaves - 1U)));
    if (!touched_[node.leaf]) return add_leaf_node(branch, former_.vertices(node.leaf).size());
    branch.begin = next_item_;
    next_item_ = branch.end = branch.begin + face_count_[node.leaf];
    fill_items(node.leaf, branch.begin, branch.leaves > 1);
    branches.push_back(branch);
    return;
  }
  const std::uint32_t first = former_node + 1, second = node.second_child;
  if (leaves_below(first) == 0) return add_node(second, level, branches);
  if (leaves_below(second) == 0) return add_node(first, level, branches);
  const std::uint32_t here = next_node_++;
  add_node(first, level + 1, branches);
  tree_.nodes_[here] = {
      .second_child = next_node_, .leaf = leaf_begin_[node.leaf], .end_leaf = leaf_begin_[node.end_leaf]};
  add_node(second, level + 1, branches);
}

/// The lists of untouched leaves, as many at once as follow each other, and the vertices of the others.
void Tree_mender::copy_leaves() {
  const auto copy = [](const auto& from, std::size_t begin, std::size_t end, auto& to, std::size_t at) {
    std::copy(from.data() + begin, from.data() + end, to.data() + at);
  };
  for (std::uint32_t first = 0, end = 0; first < former_.leaf_count(); first = end) {
    end = first + 1;
    while (end < former_.leaf_count() && touched_[end] == touched_[first]) ++end;
    if (touched_[first]) {
      gather_vertices(leaf_begin_[first], leaf_begin_[end]);
      continue;
    }
    const auto faces = former_.face_begin_[first], end_face = former_.face_begin_[end];
    copy(former_.faces_, faces, end_face, tree_.faces_, face_begin_[first]);
    copy(former_.corners_, faces, end_face, tree_.corners_, face_begin_[first]);
    copy(former_.vertices_, former_.vertex_begin_[first], former_.vertex_begin_[end], tree_.vertices_,
         tree_.vertex_begin_[leaf_begin_[first]]);
  }
}

/// The faces that a touched leaf has now; only those that are split need their centres.
void Tree_mender::fill_items(std::uint32_t former_leaf, std::uint32_t begin, bool with_centres) {
  auto* item = items_.data() + begin;
  std::vector<std::uint32_t> faces;
  for (const auto face : former_.faces(former_leaf))
    if (!left_.test(face)) faces.push_back(face);
  auto placed = std::ranges::lower_bound(placed_, former_leaf, {}, leaf_with);
  for (; placed != placed_.end() && leaf_with(*placed) == former_leaf; ++placed)
    faces.push_back(static_cast<std::uint32_t>(*placed));
  if (!with_centres) {
    for (const auto face : faces) *item++ = {{}, face};
    return;
  }
  const Float_frame frame(coordinates_, corners_, faces);
  for (const auto face : faces) {
    *item = {frame.mean(corners_[face]), face};
    for (const float x : item->centre) finite_ = finite_ && std::isfinite(x);
    ++item;
  }
}

}  // namespace lodestone
