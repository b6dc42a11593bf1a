// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/bounds/bounded_surface.h"

#include <algorithm>
#include <string>
#include <utility>

#include "lodestone/mesh/check_finite.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

/// To pose a vertex with its leaf takes as long as to pose so many in order.
constexpr std::size_t effort_of_vertex = 7;
/// To compute a position takes so many times as long as to read one, so boxes count so many times less.
constexpr std::size_t computed_share = 7;

bool is_empty(const Aabb& box) {
  bool result = false;
  for (int axis = 0; axis < 3; ++axis) result |= box.low[axis] > box.high[axis];
  return result;
}

/// Calls `visit(node)` for the whole and, if all is to be compared, for the leaves, until it returns false.
template <class Visit_node>
void visit_compared(const Tree_layout& layout, bool all, const Visit_node& visit) {
  if (!visit(0) || !all) return;
  for (std::uint32_t leaf = 0; leaf < layout.leaf_count(); ++leaf)
    if (const std::uint32_t node = layout.leaf_node(leaf); node != 0 && !visit(node)) return;
}

void check_nodes(const Node_bound& bound, const Tree_layout& layout) {
  if (bound.node_count() < layout.node_count()) throw Bad_argument("a bound was made for a tree of fewer nodes");
}

}  // namespace

Bounded_surface::Bounded_surface(Tree_surface& tree, std::unique_ptr<const Position_source> positions,
                                 std::vector<std::unique_ptr<Node_bound>> bounds, Workers& workers, std::string title)
    : tree_(&tree),
      positions_(std::move(positions)),
      bounds_(std::move(bounds)),
      workers_(&workers),
      title_(std::move(title)),
      boxes_(tree.volumes_to_fit()),
      boxed_in_(layout().node_count(), 0),
      posed_in_(layout().leaf_count(), 0),
      fitted_in_(layout().node_count(), 0),
      parents_(layout().parents()) {
  check_layout(layout(), positions_->vertex_count());
  for (const auto& bound : bounds_) {
    check_nodes(*bound, layout());
    effort_of_boxes_ += bound->effort();
  }
  start_frame();
}

void Bounded_surface::start_frame() {
  const std::uint64_t pose = positions_->pose_number();
  if (pose > 0 && pose_ == pose) return;
  pose_ = 0;  // if memory runs out, the next call does all of this again
  plan_frame();
  ++frame_;
  all_posed_ = much_was_near_ = false;
  bounded_.clear();
  violations_settled_ = 0;
  violations_ = nodes_bounded_ = leaves_posed_ = vertices_posed_ = 0;
  follow_positions();
  pose_ = pose;
}

/// Positions in memory are read where they are.
void Bounded_surface::follow_positions() {
  const Coordinates there = positions_->in_memory();
  if (there.empty()) posed_.resize(3 * std::size_t{positions_->vertex_count()});
  in_memory_ = !there.empty();
  tree_->follow(in_memory_ ? there : Coordinates(posed_));
}

/// Decides by the last frame whether leaves are posed one by one in this one.
void Bounded_surface::plan_frame() {
  constexpr std::size_t longest_pause = 32;
  if (all_posed_ && !much_was_near_) return;  // for another reason, which says nothing about how much is near
  if (pause_left_ > 0) {
    pause_left_ = much_was_near_ ? pause_left_ - 1 : 0;
    if (!much_was_near_) pause_ = 0;
    return;
  }
  pause_ = much_was_near_ ? std::clamp<std::size_t>(2 * pause_, 1, longest_pause) : 0;
  pause_left_ = pause_;
}

void Bounded_surface::bound(std::uint32_t node) {
  if (bounds_.empty()) return pose_all();
  if (takes_long() || (is_paused() && node != 0)) return give_up();
  if (!take_box(node)) pose_all();  // which names the vertex that is not finite
}

/// @return false if a position that a bound has read is not finite
bool Bounded_surface::take_box(std::uint32_t node) {
  const Aabb box = box_from_bounds(node);
  const auto is_finite = [](const Eigen::Vector3d& position) { return position.allFinite(); };
  if (!std::ranges::all_of(read_by_bounds_, is_finite)) return false;
  const auto lies_within = [&](const Eigen::Vector3d& position) { return contains(box, position); };
  if (is_empty(box) || !std::ranges::all_of(read_by_bounds_, lies_within))  // though vertices must be in it
    ++violations_;
  else
    bounded_.push_back(node);  // first: a box that is in use is also one that is compared with what is read
  boxes_[node] = box;
  boxed_in_[node] = frame_;
  ++nodes_bounded_;
  return true;
}

/// The box of the whole, and those of all leaves if all is to be compared, where they are not in use yet.
void Bounded_surface::take_boxes_to_compare() {
  if (bounds_.empty()) return;
  visit_compared(layout(), compares_all_,
                 [&](std::uint32_t node) { return boxed_in_[node] == frame_ || take_box(node); });
}

/// What all bounds have in common, cut to the box of the node above, if that is in use. So a position that bounds have
/// read is compared with the boxes of other bounds, and of the nodes through which a query came.
Aabb Bounded_surface::box_from_bounds(std::uint32_t node) {
  read_by_bounds_.clear();
  Aabb box = bounds_.front()->box(node, read_by_bounds_);
  for (std::size_t i = 1; i < bounds_.size(); ++i) box = common_box(box, bounds_[i]->box(node, read_by_bounds_));
  const std::uint32_t above = parents_[node];
  return node != 0 && boxed_in_[above] == frame_ ? common_box(box, boxes_[above]) : box;
}

/// Whether a box, or a position, lies in the boxes of a node and of all nodes above it, where they are in use. A query
/// can begin below the root, so the boxes above need not be in use.
template <class Contained>
bool Bounded_surface::lies_in_boxes_in_use(std::uint32_t node, const Contained& contained) const {
  const auto sticks_out = [&](std::uint32_t n) { return boxed_in_[n] == frame_ && !contains(boxes_[n], contained); };
  for (; node != 0; node = parents_[node])
    if (sticks_out(node)) return false;
  return !sticks_out(0);
}

/// Whether so much has been done as it takes to pose all.
bool Bounded_surface::takes_long() const {
  const std::size_t of_boxes = nodes_bounded_ * effort_of_boxes_ / (in_memory_ ? 1 : computed_share);
  return effort_of_vertex * vertices_posed_ + of_boxes > layout().vertex_begin().back();
}

void Bounded_surface::give_up() {
  much_was_near_ = true;
  pose_all();
}

/// Leaves share vertices, so posing that fails half-way may have overwritten those of leaves that were posed before.
/// Nothing of this frame counts any more, whether or not the caller starts another.
template <class Pose>
auto Bounded_surface::or_start_over(const Pose& pose) {
  try {
    return pose();
  } catch (...) {
    ++frame_;
    bounded_.clear();
    violations_ = violations_settled_ = nodes_bounded_ = leaves_posed_ = vertices_posed_ = 0;
    forget_pose();
    throw;
  }
}

void Bounded_surface::read(std::uint32_t leaf) {
  if (takes_long() || is_paused()) return give_up();
  const std::uint32_t node = layout().leaf_node(leaf);
  box(node), box(0);       // in use from here on: what is read is compared with them
  if (all_posed_) return;  // there were no bounds, or these two were too many
  const auto vertices = layout().vertices(leaf);
  if (!in_memory_) or_start_over([&] { positions_->pose(vertices, posed_); });
  check_finite(leaf);
  Aabb fitted;
  fitted.enclose(layout().leaf_faces(leaf, tree_->coordinates()));
  if (!lies_in_boxes_in_use(node, fitted)) ++violations_;
  boxes_[node] = fitted;
  note_read(leaf);
  posed_in_[leaf] = frame_;
  vertices_posed_ += vertices.size();
  ++leaves_posed_;
  fit_parents_of(node);
}

std::span<const Leaf_vertex> Bounded_surface::component_vertices() {
  if (!component_vertices_.empty()) return component_vertices_;
  std::vector<bool> wanted(positions_->vertex_count());
  for (const auto vertex : tree_->component_vertices()) wanted[vertex] = true;
  std::vector<Leaf_vertex> found;
  for (std::uint32_t leaf = 0; leaf < layout().leaf_count(); ++leaf)
    for (const auto vertex : layout().vertices(leaf)) {
      if (wanted[vertex]) found.push_back({.leaf = leaf, .vertex = vertex});
      wanted[vertex] = false;
    }
  component_vertices_ = std::move(found);
  return component_vertices_;
}

Eigen::Vector3d Bounded_surface::position(const Leaf_vertex& at) {
  if (is_posed(at.leaf))
    return Eigen::Map<const Eigen::Vector3d>(tree_->coordinates().data() + 3 * std::size_t{at.vertex});
  const Eigen::Vector3d position = (*positions_)(at.vertex);
  if (!position.allFinite()) fail_not_finite(at.vertex, title_);
  if (!lies_in_boxes_in_use(layout().leaf_node(at.leaf), position)) ++violations_;
  ++vertices_posed_;
  return position;
}

/// As far up as all leaves have been posed: boxes from bounds are larger.
void Bounded_surface::fit_parents_of(std::uint32_t node) {
  fitted_in_[node] = frame_;
  while (node != 0) {
    node = parents_[node];
    const std::uint32_t first = node + 1, second = layout().node(node).second_child;
    if (fitted_in_[first] != frame_ || fitted_in_[second] != frame_) return;
    Aabb fitted;
    fitted.enclose(boxes_[first], boxes_[second]);
    if (boxed_in_[node] == frame_ && !contains(boxes_[node], fitted)) ++violations_;
    boxes_[node] = fitted;
    boxed_in_[node] = fitted_in_[node] = frame_;
  }
}

void Bounded_surface::pose_all() {
  if (all_posed_) return;
  take_boxes_to_compare();
  const Coordinates coordinates =
      in_memory_ ? tree_->coordinates() : or_start_over([&] { return positions_->all(posed_); });
  std::vector<Aabb> promised;
  promised.reserve(bounded_.size());
  for (const std::uint32_t node : bounded_) promised.push_back(boxes_[node]);
  Tree_surface* const tree[] = {tree_};
  refit(tree, std::span(&coordinates, 1), *workers_);
  if (!tree_->finite()) {
    forget_pose();  // no box means anything
    for (std::uint32_t leaf = 0; leaf < layout().leaf_count(); ++leaf) check_finite(leaf);
  }
  for (std::size_t i = 0; i < bounded_.size(); ++i)
    if (!contains(promised[i], boxes_[bounded_[i]])) ++violations_;
  note_refitted();
}

void Bounded_surface::take_refitted() {
  const Coordinates now = tree_->coordinates();
  start_frame();
  tree_->follow(now);
  note_refitted();
  violations_settled_ = violations_;
}

void Bounded_surface::compare_refitted() {
  if (bounds_.empty()) return;
  visit_compared(layout(), compares_all_, [&](std::uint32_t node) {
    if (!contains(box_from_bounds(node), boxes_[node])) ++violations_;
    return true;
  });
  violations_settled_ = violations_;  // all boxes are fitted
}

void Bounded_surface::note_refitted() {
  for (const auto& bound : bounds_)
    if (!note_all(*bound)) ++violations_;
  std::ranges::fill(boxed_in_, frame_);
  std::ranges::fill(posed_in_, frame_);
  all_posed_ = true;
  leaves_posed_ = layout().leaf_count();
  vertices_posed_ = layout().vertex_begin().back();
}

void Bounded_surface::settle() {
  pose_all();
  violations_settled_ = violations_;
}

void Bounded_surface::note_read(std::uint32_t leaf) {
  for (const auto& bound : bounds_)
    if (!note_read(*bound, leaf)) ++violations_;
}

bool Bounded_surface::note_read(Node_bound& bound, std::uint32_t leaf) const {
  return bound.note_read(leaf, boxes_[layout().leaf_node(leaf)], tree_->coordinates());
}

/// Leaf by leaf only those that have not been shown.
bool Bounded_surface::note_all(Node_bound& bound) const {
  if (bound.notes_all()) return bound.note_all(boxes_, tree_->coordinates(), compares_all_);
  bool kept = true;
  if (bound.watches())
    for (std::uint32_t leaf = 0; leaf < layout().leaf_count(); ++leaf)
      if (posed_in_[leaf] != frame_) kept &= note_read(bound, leaf);
  return kept;
}

void Bounded_surface::check_finite(std::uint32_t leaf) const {
  const double* const coordinates = tree_->coordinates().data();
  double zero = 0;  // no number as soon as one is not finite
  for (const auto vertex : layout().vertices(leaf)) {
    const double* const p = coordinates + 3 * std::size_t{vertex};
    zero += (0 * p[0] + 0 * p[1]) + 0 * p[2];
  }
  if (zero != 0) lodestone::check_finite(tree_->coordinates(), layout().vertices(leaf), title_);
}

}  // namespace lodestone
