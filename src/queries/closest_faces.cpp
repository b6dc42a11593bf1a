// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/closest_faces.h"

#include <algorithm>
#include <queue>
#include <tuple>

#include "lodestone/filter/face_filter.h"
#include "lodestone/queries/leaf_triangle.h"
#include "lodestone/queries/surface_on_demand.h"
#include "lodestone/tree/node_pair.h"
#include "lodestone/triangles/triangle_intersection.h"
#include "lodestone/volumes/to_box.h"

namespace lodestone {

namespace {

/// A face of a leaf, with its box.
struct Boxed_face {
  std::uint32_t face;
  Triangle triangle;
  Box box;
  double reach = 0;  ///< towards the other leaf: see Gap_direction
};

/// The direction across the gap between the closest faces so far. Along it nearly all other faces are farther apart.
class Gap_direction {
 public:
  explicit Gap_direction(const Closest_points& across)
      : origin_(coordinates(across.a)), along_(coordinates(across.b) - origin_) {
    // The distances that are compared have relative errors of 2^-30.
    least_gap_ = across.distance * along_.stableNorm() * (1 + 0x1p-28);
  }

  /// How far a face of a may reach along the direction.
  double reach_of_a(const Triangle& t) const {
    const auto [p, q, r] = t;
    return std::max({most(p), most(q), most(r)});
  }
  /// The same for a face of b, against the direction.
  double reach_of_b(const Triangle& t) const {
    const auto [p, q, r] = t;
    return std::max({-least(p), -least(q), -least(r)});
  }
  /// Whether two faces with these reaches are farther apart than the closest faces so far. Never if a number is not
  /// finite.
  bool parts(double reach_a, double reach_b) const { return -(reach_a + reach_b) > least_gap_; }

 private:
  // Three differences, three products and two sums: less than 8 roundings of the sum of the absolute products.
  static constexpr double roundings = 0x1p-49, underflow = 1e-300;

  double most(const Point& p) const { return sum(p) + error(p); }
  double least(const Point& p) const { return sum(p) - error(p); }
  double sum(const Point& p) const { return along_.dot(coordinates(p) - origin_); }
  double error(const Point& p) const {
    return roundings * along_.cwiseAbs().dot((coordinates(p) - origin_).cwiseAbs()) + underflow;
  }

  Eigen::Vector3d origin_, along_;
  double least_gap_;
};

/// Lists the faces of a leaf that can be as near to a box as some distance.
void list_near_faces(const Layout_view& view, std::uint32_t leaf, const Box& other, double distance,
                     std::vector<Boxed_face>& near) {
  near.clear();
  const Leaf_faces faces = view.leaf(leaf);
  const auto indices = view.layout->faces(leaf);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const Triangle triangle = triangle_of(leaf_triangle(faces, i));
    Box box;
    for (const Point& p : triangle) box.extend(Eigen::Vector3d(p.x(), p.y(), p.z()));
    if (distance_lower_bound(box, other) <= distance) near.push_back({indices[i], triangle, box});
  }
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
    list_near_faces(a_.view(), leaf_a, to_box(b_.pose(leaf_b)), best_.points.distance, near_a_);
    list_near_faces(b_.view(), leaf_b, to_box(a_.pose(leaf_a)), best_.points.distance, near_b_);
    Gap_direction direction = point_across_gap();
    for (const Boxed_face& a : near_a_) {
      if (direction.parts(a.reach, reach_of_b_)) continue;
      for (const Boxed_face& b : near_b_) {
        if (direction.parts(a.reach, b.reach)) continue;
        const Face_pair faces{a.face, b.face};
        const double bound = distance_lower_bound(a.box, b.box);
        if (std::tie(bound, faces) >= std::tie(best_.points.distance, best_.faces)) continue;
        const Closest_points points = closest_points(a.triangle, b.triangle);
        if (std::tie(points.distance, faces) >= std::tie(best_.points.distance, best_.faces)) continue;
        best_ = {faces, points};
        direction = point_across_gap();
      }
    }
  }

  /// Measures the reaches of the near faces along the gap.
  Gap_direction point_across_gap() {
    const Gap_direction direction(best_.points);
    for (Boxed_face& a : near_a_) a.reach = direction.reach_of_a(a.triangle);
    reach_of_b_ = -std::numeric_limits<double>::infinity();
    for (Boxed_face& b : near_b_) {
      b.reach = direction.reach_of_b(b.triangle);
      reach_of_b_ = std::max(reach_of_b_, b.reach);
    }
    return direction;
  }

  /// The objects intersect, so only a lower intersecting face pair can still be the answer.
  void look_for_lower(std::uint32_t leaf_a, std::uint32_t leaf_b) {
    begin_filter();
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

  /// Once for the positions in each memory: a surface that is posed as a whole can have them elsewhere.
  void begin_filter() {
    const Layout_view a = a_.view(), b = b_.view();
    if (a.coordinates.data() == filter_of_a_ && b.coordinates.data() == filter_of_b_) return;
    face_filter_.begin(a, b, 0);
    filter_of_a_ = a.coordinates.data(), filter_of_b_ = b.coordinates.data();
  }

  Surface& a_;
  Surface& b_;
  Closest_faces best_;
  std::priority_queue<Candidate> queue_;
  std::vector<Node_pair> below_;
  std::vector<Boxed_face> near_a_, near_b_;
  double reach_of_b_ = 0;  ///< the greatest of `near_b_`
  Face_filter face_filter_;
  const double* filter_of_a_ = nullptr;  ///< which positions the filter has been told of; null: none
  const double* filter_of_b_ = nullptr;
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
