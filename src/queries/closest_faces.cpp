// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/closest_faces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <tuple>

#include "lodestone/filter/face_filter.h"
#include "lodestone/queries/leaf_triangle.h"
#include "lodestone/queries/surface_on_demand.h"
#include "lodestone/tree/node_pair.h"
#include "lodestone/triangles/triangle_intersection.h"
#include "lodestone/volumes/to_box.h"
#include "triangles/triangle_box.h"

namespace lodestone {

namespace {

/// A direction from one surface to the other, along which faces can be seen to be apart.
class Direction {
 public:
  Direction(const Eigen::Vector3d& from, const Eigen::Vector3d& to) : origin_(from), along_(to - from) {}

  /// How far points of a may reach along the direction.
  double reach_of_a(const auto& points) const { return farthest(points, 1); }
  /// How far points of b may reach against it.
  double reach_of_b(const auto& points) const { return farthest(points, -1); }
  /// Whether reaches prove the points farther apart than a distance that was computed, by more than its error of 2^-30.
  /// Never if a number is not finite.
  bool parts(double reach_a, double reach_b, double distance) const {
    return -(reach_a + reach_b) > distance * along_.stableNorm() * (1 + 0x1p-28);
  }

 private:
  /// A product has three roundings, that of the difference included, and is in two sums: less than 8 of all.
  double farthest(const auto& points, double sense) const {
    constexpr double roundings = 0x1p-49, lost = 1e-300;
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto& p = points[i];
      const Eigen::Vector3d away = Eigen::Vector3d(p[0], p[1], p[2]) - origin_;
      const double error = roundings * along_.cwiseAbs().dot(away.cwiseAbs()) + lost;
      const double reach = sense * along_.dot(away) + error;
      if (std::isnan(reach)) return std::numeric_limits<double>::infinity();  // products overflow: nothing is proved
      most = std::max(most, reach);
    }
    return most;
  }

  Eigen::Vector3d origin_, along_;
};

/// The positions of a leaf's vertices.
struct Leaf_positions {
  const Leaf_faces& leaf;

  std::size_t size() const { return leaf.vertices.size(); }
  const double* operator[](std::size_t i) const { return leaf.position(i); }
};

/// The distance of two vertices, one of each leaf, that are near each other.
double distance_of_near_vertices(const Leaf_faces& a, const Leaf_faces& b) {
  const auto nearest = [](const Leaf_faces& leaf, const Eigen::Vector3d& to) {
    double least = std::numeric_limits<double>::infinity();
    Eigen::Vector3d found = Eigen::Map<const Eigen::Vector3d>(leaf.position(0));
    for (std::size_t i = 0; i < leaf.vertices.size(); ++i) {
      const Eigen::Map<const Eigen::Vector3d> at(leaf.position(i));
      if (const double squared = (at - to).squaredNorm(); squared < least) least = squared, found = at;
    }
    return found;
  };
  const Eigen::Vector3d start = Eigen::Map<const Eigen::Vector3d>(a.position(0)), of_b = nearest(b, start),
                        of_a = nearest(a, of_b);
  const double distance = (of_a - of_b).stableNorm();
  constexpr double largest_number = std::numeric_limits<double>::max();
  return distance < largest_number ? distance : largest_number;  // differences can overflow
}

template <Surface_on_demand Surface>
class Search {
 public:
  Search(Surface& a, Surface& b) : a_(a), b_(b) {
    best_.points.distance = std::numeric_limits<double>::infinity();
    best_.faces = {std::numeric_limits<std::uint32_t>::max(), std::numeric_limits<std::uint32_t>::max()};
  }

  /// @return of no meaning once a surface is broken
  Closest_faces run() {
    push(root_pair);
    while (!queue_.empty() && queue_.top().bound <= best_.points.distance && !is_broken()) {
      const auto [bound, pair] = queue_.top();
      queue_.pop();
      if (!a_.layout().is_leaf(pair.a) || !b_.layout().is_leaf(pair.b))
        open(pair);
      else if (!pose_loosens(pair, bound))
        try_leaves(a_.layout().node(pair.a).leaf, b_.layout().node(pair.b).leaf);
    }
    return best_;
  }

 private:
  struct Candidate {
    double bound;
    Node_pair pair;
    bool operator<(const Candidate& other) const { return bound > other.bound; }  // the nearest is on top
  };

  void push(Node_pair pair) {
    const double bound = distance_lower_bound(to_box(a_.box(pair.a)), to_box(b_.box(pair.b)));
    if (bound <= best_.points.distance) queue_.push({bound, pair});
  }

  void open(Node_pair pair) {
    below_.clear();
    open_pair(a_.layout(), b_.layout(), pair, a_.box(pair.a).extent() >= b_.box(pair.b).extent(), below_);
    for (const Node_pair next : below_) push(next);
  }

  /// Poses the leaves of a pair, one after the other: the fitted box of one can spare posing the other.
  /// @return whether a fitted box puts the pair farther apart: it has been pushed again, or dropped
  bool pose_loosens(Node_pair pair, double bound) {
    const Aabb& box_a = a_.pose(a_.layout().node(pair.a).leaf);
    if (distance_lower_bound(to_box(box_a), to_box(b_.box(pair.b))) > bound) return push(pair), true;
    const Aabb& box_b = b_.pose(b_.layout().node(pair.b).leaf);
    if (distance_lower_bound(to_box(box_a), to_box(box_b)) > bound) return push(pair), true;
    return is_broken();
  }

  bool is_broken() const { return a_.is_broken() || b_.is_broken(); }

  void try_leaves(std::uint32_t leaf_a, std::uint32_t leaf_b) {
    if (best_.points.distance == 0) return look_for_lower(leaf_a, leaf_b);
    const Leaf_faces all_a = a_.view().leaf(leaf_a), all_b = b_.view().leaf(leaf_b);
    const auto indices_a = a_.layout().faces(leaf_a), indices_b = b_.layout().faces(leaf_b);
    const auto offer_pair = [&](std::size_t a, std::size_t b) {
      offer({indices_a[a], indices_b[b]}, triangle_of(leaf_triangle(all_a, a)), triangle_of(leaf_triangle(all_b, b)));
    };
    const Aabb &box_a = a_.pose(leaf_a), &box_b = b_.pose(leaf_b);
    const Face_pair lowest{*std::min_element(indices_a.begin(), indices_a.end()),
                           *std::min_element(indices_b.begin(), indices_b.end())};
    if (!can_be_closer(to_box(box_a), to_box(box_b), lowest)) return;
    double most = best_.points.distance;
    if (!std::isfinite(most)) most = distance_of_near_vertices(all_a, all_b);
    const Direction between(centre_of(box_a), centre_of(box_b));
    if (between.parts(between.reach_of_a(Leaf_positions{all_a}), between.reach_of_b(Leaf_positions{all_b}), most))
      return;
    begin_filter(most);
    for (const Face_candidate& candidate : face_filter_.face_candidates(leaf_a, leaf_b))
      offer_pair(candidate.a, candidate.b);
  }

  /// Whether boxes do not prove that faces are farther apart than the closest so far, or as far and not lower.
  bool can_be_closer(const Box& a, const Box& b, const Face_pair& faces) const {
    const double bound = distance_lower_bound(a, b);
    return std::tie(bound, faces) < std::tie(best_.points.distance, best_.faces);
  }

  void offer(const Face_pair& faces, const Triangle& a, const Triangle& b) {
    // Along the gap between the closest faces so far nearly all others are farther apart.
    if (across_gap_ &&
        across_gap_->parts(across_gap_->reach_of_a(a), across_gap_->reach_of_b(b), best_.points.distance))
      return;
    if (!can_be_closer(box_of(a), box_of(b), faces)) return;
    const Closest_points points = closest_points(a, b);
    if (std::tie(points.distance, faces) >= std::tie(best_.points.distance, best_.faces)) return;
    best_ = {faces, points};
    across_gap_.emplace(coordinates(points.a), coordinates(points.b));
  }

  /// The objects intersect, so only a lower intersecting face pair can still be the answer.
  void look_for_lower(std::uint32_t leaf_a, std::uint32_t leaf_b) {
    begin_filter(0);
    const Leaf_faces all_a = a_.view().leaf(leaf_a), all_b = b_.view().leaf(leaf_b);
    const auto indices_a = a_.layout().faces(leaf_a), indices_b = b_.layout().faces(leaf_b);
    for (const Face_candidate& candidate : face_filter_.face_candidates(leaf_a, leaf_b)) {
      const Face_pair faces{indices_a[candidate.a], indices_b[candidate.b]};
      if (!(faces < best_.faces)) continue;
      const Triangle_corners a = leaf_triangle(all_a, candidate.a), b = leaf_triangle(all_b, candidate.b);
      if (!triangles_intersect_given(a, b, candidate.crossing)) continue;
      best_ = {faces, closest_points(triangle_of(a), triangle_of(b))};
    }
  }

  /// Lets the filter keep what may be within a distance. Once for the positions in each memory: a surface that is posed
  /// as a whole can have them elsewhere. A filter that keeps a little more will do.
  void begin_filter(double distance) {
    const Layout_view a = a_.view(), b = b_.view();
    const double margin = distance * (1 + 0x1p-28);
    const bool same_positions = a.coordinates.data() == filter_of_a_ && b.coordinates.data() == filter_of_b_;
    if (same_positions && margin <= margin_ && margin_ <= 1.001 * margin) return;
    face_filter_.begin(a, b, margin);
    filter_of_a_ = a.coordinates.data(), filter_of_b_ = b.coordinates.data(), margin_ = margin;
  }

  Surface& a_;
  Surface& b_;
  Closest_faces best_;
  std::priority_queue<Candidate> queue_;
  std::vector<Node_pair> below_;
  std::optional<Direction> across_gap_;
  Face_filter face_filter_;
  const double* filter_of_a_ = nullptr;  ///< which positions the filter has been told of; null: none
  const double* filter_of_b_ = nullptr;
  double margin_ = 0;
};

template <Surface_on_demand Surface>
Closest_faces find_closest(Surface& a, Surface& b) {
  return ask_until_settled([&] { return Search(a, b).run(); }, a, b);
}

}  // namespace

Closest_faces closest_faces(const Layout_view& a, const Layout_view& b) {
  Fitted_surface fitted_a(a), fitted_b(b);
  return find_closest(fitted_a, fitted_b);
}

Closest_faces closest_faces(Bounded_surface& a, Bounded_surface& b) { return find_closest(a, b); }

}  // namespace lodestone
