// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/closest_faces.h"

#include <queue>
#include <tuple>

#include "lodestone/filter/face_filter.h"
#include "lodestone/queries/leaf_triangle.h"
#include "lodestone/tree/node_pair.h"
#include "lodestone/triangles/triangle_intersection.h"
#include "lodestone/volumes/to_box.h"

namespace lodestone {

namespace {

/// The faces of a leaf, each with its box.
struct Boxed_leaf {
  std::vector<Triangle> triangles;
  std::vector<Box> boxes;

  void fill(const Layout_view& view, std::uint32_t leaf) {
    triangles.clear();
    boxes.clear();
    const Leaf_faces faces = view.leaf(leaf);
    for (std::size_t index = 0; index < faces.corners.size(); ++index) {
      triangles.push_back(triangle_of(leaf_triangle(faces, index)));
      Box box;
      for (const Point& p : triangles.back()) box.extend(Eigen::Vector3d(p.x(), p.y(), p.z()));
      boxes.push_back(box);
    }
  }
};

class Search {
 public:
  Search(const Layout_view& a, const Layout_view& b) : a_(a), b_(b) {
    best_.points.distance = std::numeric_limits<double>::infinity();
    best_.faces = {std::numeric_limits<std::uint32_t>::max(), std::numeric_limits<std::uint32_t>::max()};
    face_filter_.begin(a, b, 0);
  }

  Closest_faces run() {
    push(root_pair);
    while (!queue_.empty() && queue_.top().bound <= best_.points.distance) {
      const Node_pair pair = queue_.top().pair;
      queue_.pop();
      if (a_.layout->is_leaf(pair.a) && b_.layout->is_leaf(pair.b)) {
        try_leaves(a_.layout->node(pair.a).leaf, b_.layout->node(pair.b).leaf);
        continue;
      }
      below_.clear();
      open_pair(*a_.layout, *b_.layout, pair, a_.boxes[pair.a].extent() >= b_.boxes[pair.b].extent(), below_);
      for (const Node_pair next : below_) push(next);
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
    const double bound = distance_lower_bound(to_box(a_.boxes[pair.a]), to_box(b_.boxes[pair.b]));
    if (bound <= best_.points.distance) queue_.push({bound, pair});
  }

  void try_leaves(std::uint32_t leaf_a, std::uint32_t leaf_b) {
    if (best_.points.distance == 0) return look_for_lower(leaf_a, leaf_b);
    faces_a_.fill(a_, leaf_a);
    faces_b_.fill(b_, leaf_b);
    for (std::size_t i = 0; i < faces_a_.boxes.size(); ++i)
      for (std::size_t j = 0; j < faces_b_.boxes.size(); ++j) {
        const Face_pair faces{a_.layout->faces(leaf_a)[i], b_.layout->faces(leaf_b)[j]};
        const double bound = distance_lower_bound(faces_a_.boxes[i], faces_b_.boxes[j]);
        if (std::tie(bound, faces) >= std::tie(best_.points.distance, best_.faces)) continue;
        const Closest_points points = closest_points(faces_a_.triangles[i], faces_b_.triangles[j]);
        if (std::tie(points.distance, faces) < std::tie(best_.points.distance, best_.faces)) best_ = {faces, points};
      }
  }

  /// The objects intersect, so only a lower intersecting face pair can still be the answer.
  void look_for_lower(std::uint32_t leaf_a, std::uint32_t leaf_b) {
    for (const Face_candidate& candidate : face_filter_.face_candidates(leaf_a, leaf_b)) {
      const Face_pair faces{a_.layout->faces(leaf_a)[candidate.a], b_.layout->faces(leaf_b)[candidate.b]};
      if (!(faces < best_.faces)) continue;
      const Triangle_corners a = leaf_triangle(a_.leaf(leaf_a), candidate.a);
      const Triangle_corners b = leaf_triangle(b_.leaf(leaf_b), candidate.b);
      if (!triangles_intersect_given(a, b, candidate.crossing)) continue;
      best_ = {faces, closest_points(triangle_of(a), triangle_of(b))};
    }
  }

  const Layout_view& a_;
  const Layout_view& b_;
  Closest_faces best_;
  std::priority_queue<Candidate> queue_;
  std::vector<Node_pair> below_;
  Boxed_leaf faces_a_, faces_b_;
  Face_filter face_filter_;
};

}  // namespace

Closest_faces closest_faces(const Layout_view& a, const Layout_view& b) { return Search(a, b).run(); }

}  // namespace lodestone
