// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/closest_faces.h"

#include <queue>
#include <tuple>

#include "lodestone/queries/visit_contacts.h"
#include "lodestone/volumes/to_box.h"

namespace lodestone {

namespace {

/// A leaf's faces with their boxes.
struct Boxed_leaf {
  std::vector<Triangle> triangles;
  std::vector<Box> boxes;

  void fill(const Layout_view& posed, std::uint32_t leaf) {
    triangles.clear();
    boxes.clear();
    const Leaf_faces faces = posed.leaf(leaf);
    for (std::size_t place = 0; place < faces.corners.size(); ++place) {
      triangles.push_back(triangle_of(leaf_corners(faces, place)));
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
    leaf_pairs_.begin(a, b, 0);
  }

  Closest_faces run() {
    push({0, 0});
    while (!ahead_.empty() && ahead_.top().bound <= best_.points.distance) {
      const Node_pair pair = ahead_.top().pair;
      ahead_.pop();
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
  struct Ahead {
    double bound;
    Node_pair pair;
    bool operator<(const Ahead& other) const { return bound > other.bound; }  // the nearest on top
  };

  void push(Node_pair pair) {
    const double bound = distance_lower_bound(to_box(a_.boxes[pair.a]), to_box(b_.boxes[pair.b]));
    if (bound <= best_.points.distance) ahead_.push({bound, pair});
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

  /// The objects intersect: what is left is to find the lowest of the face pairs that do.
  void look_for_lower(std::uint32_t leaf_a, std::uint32_t leaf_b) {
    for (const auto& places : leaf_pairs_.face_candidates(leaf_a, leaf_b)) {
      const Face_pair faces{a_.layout->faces(leaf_a)[places.a], b_.layout->faces(leaf_b)[places.b]};
      if (!(faces < best_.faces)) continue;
      const Triangle_corners a = leaf_corners(a_.leaf(leaf_a), places.a), b = leaf_corners(b_.leaf(leaf_b), places.b);
      if (!triangles_intersect_given(a, b, places.crossing)) continue;
      best_ = {faces, closest_points(triangle_of(a), triangle_of(b))};
    }
  }

  const Layout_view& a_;
  const Layout_view& b_;
  Closest_faces best_;
  std::priority_queue<Ahead> ahead_;
  std::vector<Node_pair> below_;
  Boxed_leaf faces_a_, faces_b_;
  Face_filter leaf_pairs_;
};

}  // namespace

Closest_faces closest_faces(const Layout_view& a, const Layout_view& b) { return Search(a, b).run(); }

}  // namespace lodestone
