// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/opening_search.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <optional>
#include <span>

#include "lodestone/queries/leaf_triangle.h"
#include "lodestone/triangles/triangle_intersection.h"
#include "queries/face_pair_order.h"
#include "queries/leaf_distance.h"

namespace lodestone {

namespace {

/// Leaf pairs of one task: some 50 microseconds.
constexpr std::size_t pairs_per_task = 32;
/// So much of the budget openings have in any case: however long the curves are that were followed, new ones can be
/// found.
constexpr std::size_t least_share(std::size_t budget) { return budget / 2; }
/// One contact is searched for by openings that read one vertex in so many of both surfaces, before regions are read as
/// a whole. To read vertices in order takes a small fraction of the time that openings take for as many. So the search
/// does not take much longer than either way alone.
constexpr std::size_t first_share = 2, least_first = 256;
/// Pairs of nodes that count as much as one vertex that is read: where anchors are known, as of the slivers of a long
/// pipe, pairs take all the time.
constexpr std::size_t pairs_per_vertex = 4;
/// A leaf whose radius is so many times that of the other node is looked at face by face: the ball around a wall, or
/// around the floor of a room, holds all that is in the room. Beside a leaf that is only some times as large its ball
/// decides: that is slack for what has been stretched, which a larger reach makes larger.
constexpr double wide = 16;

}  // namespace

void Opening_search::Waiting::clear() {
  for (std::size_t beyond = 0; beyond < 2; ++beyond)
    for (std::uint64_t& filled = filled_[beyond]; filled != 0; filled &= filled - 1)
      stacks_[beyond][static_cast<std::size_t>(std::countr_zero(filled))].clear();
}

void Opening_search::Waiting::push(Node_pair nodes, double order) {
  constexpr double count = 64;
  const bool beyond = order > 1;
  // Where squares overflow, or vanish, the order is no number.
  const double part = beyond ? 1 - 1 / order : order > 0 ? order : 0;
  const auto stack = static_cast<std::size_t>(std::min(part * count, count - 1));
  stacks_[beyond][stack].push_back(nodes);
  filled_[beyond] |= std::uint64_t{1} << stack;
}

Node_pair Opening_search::Waiting::pop() {
  const bool beyond = filled_[0] == 0;
  std::uint64_t& filled = filled_[beyond];
  auto& stack = stacks_[beyond][static_cast<std::size_t>(std::countr_zero(filled))];
  const Node_pair nodes = stack.back();
  stack.pop_back();
  if (stack.empty()) filled &= filled - 1;
  return nodes;
}

void Opening_search::begin(Tree_on_demand& a, Tree_on_demand& b, const Opening_request& request,
                           std::span<const Opening_start> starts) {
  a_ = &a, b_ = &b;
  request_ = request;
  given_starts_.assign(starts.begin(), starts.end());
  whole_ = request.all && may_read_whole();
  in_order_ = request.budget < a.vertex_count() + b.vertex_count();
  begun_ = 0;
  considered_ = 0;
  read_before_ = a.vertices_read() + b.vertices_read();
  out_of_budget_ = false;
  leaf_tests_ = exact_tests_ = 0;
  compared_.clear();
  beside_.clear();
  opened_.clear();
}

bool Opening_search::open(std::vector<Face_pair>& found, Workers& workers) {
  const std::size_t before = found.size();
  if (whole_)
    begin_whole();
  else
    begin_openings();
  if (request_.all)
    open_for_all(found, workers);
  else
    open_for_one(found);
  return found.size() > before;
}

/// Whether there are few enough vertices below the starts. Prepares that they are read.
bool Opening_search::may_read_whole() {
  starts_.begin(a_->layout(), b_->layout(), given_starts_, request_.most_whole);
  return starts_.are_whole();
}

void Opening_search::begin_openings() {
  waiting_.clear();
  limit_ = in_order_ ? std::max(request_.budget, spent() + least_share(request_.budget))
                     : std::numeric_limits<std::size_t>::max();
  const double unit = request_.reach * request_.reach;
  for (const auto& start : given_starts_) waiting_.push(start.nodes, in_order_ ? unit * start.order : 0);
}

void Opening_search::begin_whole() {
  waiting_.clear();
  pose_starts();
  for (const auto& start : starts_.pairs()) push_if_near(start.nodes);
}

void Opening_search::pose_starts() {
  for (const auto& start : starts_.pairs()) {
    a_->pose_below(start.nodes.a);
    b_->pose_below(start.nodes.b);
  }
}

/// By openings; if these take long, by reading the regions as a whole; if that is too much, by openings until the
/// budget is used up.
void Opening_search::open_for_one(std::vector<Face_pair>& found) {
  const std::size_t share = (a_->vertex_count() + b_->vertex_count()) / first_share, most = limit_;
  limit_ = std::min(limit_, spent() + std::max(share, least_first));
  if (find_one(found) || !out_of_budget_) return;
  limit_ = most;
  if (request_.most_whole > 0 && may_read_whole()) {
    whole_ = true;
    out_of_budget_ = false;
    std::ranges::sort(opened_);
    begin_whole();
  }
  find_one(found);
}

/// @return whether a contact was found below the pairs of nodes that wait
bool Opening_search::find_one(std::vector<Face_pair>& found) {
  tested_.resize(std::max<std::size_t>(tested_.size(), 1));
  Tested& tested = tested_.front();
  tested.found.clear();
  Leaf_pair leaves;
  while (tested.found.empty() && next(leaves)) {
    if (whole_ && std::ranges::binary_search(opened_, leaves)) continue;
    if (!whole_) opened_.push_back(leaves);
    begin_filters(1);
    tested.exact_tests = 0;
    test(leaves, filters_.front(), tested);
    ++leaf_tests_;
    exact_tests_ += tested.exact_tests;
  }
  found.insert(found.end(), tested.found.begin(), tested.found.end());
  return !tested.found.empty();
}

/// Lists leaf pairs, then tests them. So leaves are read one after the other, and then each is prepared once.
void Opening_search::open_for_all(std::vector<Face_pair>& found, Workers& workers) {
  listed_.clear();
  for (Leaf_pair leaves; next(leaves);)
    if (compared_.add(leaves)) listed_.push_back(leaves);
  std::ranges::sort(listed_);
  test_listed(found, workers);
}

void Opening_search::follow(Leaf_neighbours& a, Leaf_neighbours& b, const Curve_starts& starts,
                            std::vector<Face_pair>& found, Workers& workers) {
  for (const Leaf_pair leaves : starts.compared) compared_.add(leaves);
  const std::size_t first = found.size();
  for (std::size_t i = 0; i < starts.contacts.size(); ++i) {
    const Face_pair contact = starts.contacts[i];
    const Leaf_pair leaves{a.leaf_of(contact.a), b.leaf_of(contact.b)};
    if (!was_opened(leaves) && !compared_.contains(leaves)) {
      beside_.push_back(leaves);
      continue;
    }
    found.push_back(contact);
    if (i >= starts.followed) follow_contact(a, b, contact);
  }
  sort_face_pairs(std::span(found).subspan(first));
  found.erase(std::unique(found.begin() + static_cast<std::ptrdiff_t>(first), found.end()), found.end());
  for (std::size_t followed = found.size(); !beside_.empty();) {
    compare_beside(found, workers);
    for (; followed < found.size(); ++followed) follow_contact(a, b, found[followed]);
  }
}

/// Lists the leaf pairs beside a contact.
void Opening_search::follow_contact(Leaf_neighbours& a, Leaf_neighbours& b, Face_pair contact) {
  const auto list = [this](Leaf_pair leaves) {
    if (!was_opened(leaves)) beside_.push_back(leaves);
  };
  const Leaf_pair at{a.leaf_of(contact.a), b.leaf_of(contact.b)};
  for (const auto leaf : a.beside(contact.a)) list({leaf, at.b});
  for (const auto leaf : b.beside(contact.b)) list({at.a, leaf});
}

/// Compares the leaf pairs that were listed, unless they have been compared.
void Opening_search::compare_beside(std::vector<Face_pair>& found, Workers& workers) {
  std::erase_if(beside_, [this](Leaf_pair leaves) { return !compared_.add(leaves); });
  std::ranges::sort(beside_);
  listed_.clear();
  for (const Leaf_pair leaves : beside_)
    if (near(a_->pose(leaves.a), b_->pose(leaves.b), 0)) listed_.push_back(leaves);
  beside_.clear();
  test_listed(found, workers);
}

std::size_t Opening_search::spent() const {
  return a_->vertices_read() + b_->vertices_read() - read_before_ + considered_ / pairs_per_vertex;
}

/// The next pair of leaves whose boxes meet, below nodes that have been posed.
/// @return false if there is none
bool Opening_search::next_by_boxes(Leaf_pair& leaves) {
  const Tree_layout &a = a_->layout(), &b = b_->layout();
  while (!waiting_.empty()) {
    const Node_pair pair = waiting_.pop();
    if (a.is_leaf(pair.a) && b.is_leaf(pair.b)) {
      leaves = {a.node(pair.a).leaf, b.node(pair.b).leaf};
      return true;
    }
    const bool a_is_larger = a_->box(pair.a).extent() >= b_->box(pair.b).extent();
    for (const Node_pair below : pairs_below(a, b, pair, a_is_larger)) push_if_near(below);
  }
  return false;
}

void Opening_search::push_if_near(Node_pair pair) {
  if (near(a_->box(pair.a), b_->box(pair.b), 0)) waiting_.push(pair, 0);
}

/// The next pair of leaves that may meet, as far as anchors tell.
/// @return false if there is none, or the budget is used up
bool Opening_search::next_by_anchors(Leaf_pair& leaves) {
  const Tree_layout &a = a_->layout(), &b = b_->layout();
  out_of_budget_ = false;
  while (!waiting_.empty()) {
    if (spent() >= limit_) {
      out_of_budget_ = true;
      return false;
    }
    const Node_pair pair = waiting_.pop();
    if (!a.is_leaf(pair.a) || !b.is_leaf(pair.b)) {
      consider_children(pair);
      continue;
    }
    leaves = {a.node(pair.a).leaf, b.node(pair.b).leaf};
    if (near_leaves(leaves)) return true;
  }
  return false;
}

/// Puts a pair of nodes on the list unless they are taken to be apart.
void Opening_search::consider(Node_pair pair) {
  ++considered_;
  const double radius_a = a_->radius(pair.a), radius_b = b_->radius(pair.b);
  const double squared = (a_->anchor(pair.a) - b_->anchor(pair.b)).squaredNorm();
  const double radii = radius_a + radius_b, far = request_.reach * radii;
  if (squared > far * far) return;
  std::optional<double> order = in_order_ ? squared / (radii * radii) : 0;
  if (radius_a > wide * radius_b && a_->layout().is_leaf(pair.a))
    order = order_beside(*a_, pair.a, *b_, pair.b);
  else if (radius_b > wide * radius_a && b_->layout().is_leaf(pair.b))
    order = order_beside(*b_, pair.b, *a_, pair.a);
  if (order) waiting_.push(pair, *order);
}

/// The order of a wide leaf and another node: how far the anchor of that is from the faces of the leaf.
/// @return none if they are taken to be apart
std::optional<double> Opening_search::order_beside(Tree_on_demand& tree, std::uint32_t leaf, Tree_on_demand& other,
                                                   std::uint32_t node) {
  const double reach = request_.reach;
  const std::uint32_t index = tree.layout().node(leaf).leaf;
  const Aabb& box = tree.pose(index);
  if (is_apart(box, other, node, reach)) return std::nullopt;
  const double radius = reach * other.radius(node);
  if (!(radius > 0)) return 0;
  const double squared = relative_squared_distance(tree.view().leaf(index), box, other.anchor(node), radius);
  if (squared == std::numeric_limits<double>::infinity()) return std::nullopt;
  return reach * reach * squared;
}

/// Opens the node with the larger radius, since that separates most.
void Opening_search::consider_children(Node_pair pair) {
  const bool a_is_larger = a_->radius(pair.a) >= b_->radius(pair.b);
  for (const Node_pair below : pairs_below(a_->layout(), b_->layout(), pair, a_is_larger)) consider(below);
}

/// The box of a leaf that has been read can spare reading the other.
bool Opening_search::near_leaves(Leaf_pair leaves) {
  const bool a_first = a_->is_posed(leaves.a) || !b_->is_posed(leaves.b);
  const bool apart = a_first ? is_apart(a_->pose(leaves.a), *b_, b_->layout().leaf_node(leaves.b), request_.reach)
                             : is_apart(b_->pose(leaves.b), *a_, a_->layout().leaf_node(leaves.a), request_.reach);
  return !apart && near(a_->pose(leaves.a), b_->pose(leaves.b), 0);
}

/// Whether a node is taken to be apart from a box.
bool Opening_search::is_apart(const Aabb& box, Tree_on_demand& tree, std::uint32_t node, double reach) {
  const Eigen::Vector3d& anchor = tree.anchor(node);
  const double radius = reach * tree.radius(node);
  double squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double beyond = std::max({box.low[axis] - anchor[axis], anchor[axis] - box.high[axis], 0.0});
    squared += beyond * beyond;
  }
  return squared > radius * radius;
}

/// A filter keeps what it has read of leaves for as long as the bounds hold.
void Opening_search::begin_filters(std::size_t count) {
  if (bounds_a_ != a_->bounds() || bounds_b_ != b_->bounds()) begun_ = 0;
  bounds_a_ = a_->bounds(), bounds_b_ = b_->bounds();
  filters_.resize(std::max(filters_.size(), count));
  for (; begun_ < count; ++begun_) filters_[begun_].begin(a_->view(), b_->view(), 0);
}

void Opening_search::test(Leaf_pair leaves, Face_filter& filter, Tested& tested) const {
  const Layout_view a = a_->view(), b = b_->view();
  const Leaf_faces faces_a = a.leaf(leaves.a), faces_b = b.leaf(leaves.b);
  for (const Face_candidate& candidate : filter.face_candidates(leaves.a, leaves.b)) {
    ++tested.exact_tests;
    if (!triangles_intersect_given(leaf_triangle(faces_a, candidate.a), leaf_triangle(faces_b, candidate.b),
                                   candidate.crossing))
      continue;
    tested.found.push_back({a.layout->faces(leaves.a)[candidate.a], b.layout->faces(leaves.b)[candidate.b]});
    if (!request_.all) return;
  }
}

void Opening_search::test_listed(std::vector<Face_pair>& found, Workers& workers) {
  if (listed_.empty()) return;
  const std::size_t tasks = (listed_.size() + pairs_per_task - 1) / pairs_per_task;
  begin_filters(tasks == 1 ? 1 : workers.count());
  tested_.resize(std::max(tested_.size(), tasks));
  workers.run(tasks, [&](std::size_t task, std::size_t worker) {
    Tested& tested = tested_[task];
    tested.found.clear();
    tested.exact_tests = 0;
    const std::size_t first = task * pairs_per_task;
    for (const Leaf_pair leaves : std::span(listed_).subspan(first, std::min(pairs_per_task, listed_.size() - first)))
      test(leaves, filters_[worker], tested);
  });
  leaf_tests_ += listed_.size();
  for (const Tested& tested : std::span(tested_).first(tasks)) {
    exact_tests_ += tested.exact_tests;
    found.insert(found.end(), tested.found.begin(), tested.found.end());
  }
}

}  // namespace lodestone
