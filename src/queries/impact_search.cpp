// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/impact_search.h"

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <compare>
#include <cstdint>
#include <queue>
#include <tuple>
#include <utility>

#include "lodestone/queries/leaf_triangle.h"
#include "lodestone/tree/node_pair.h"
#include "lodestone/tree/region_tree.h"
#include "lodestone/tree/tree_surface.h"
#include "lodestone/triangles/moving_box.h"
#include "lodestone/triangles/triangle_distance.h"
#include "lodestone/volumes/to_box.h"
#include "queries/lowest_contact.h"
#include "tree/shared_vertices.h"

namespace lodestone {

namespace {

/// The triangle at a time, up to a few roundings of the largest coordinate.
Triangle triangle_at(const Moving_triangle& moving, double t) {
  const auto corner = [&](std::size_t i) {
    const Point &from = moving.start[i], &to = moving.end[i];
    return Point(std::lerp(from.x(), to.x(), t), std::lerp(from.y(), to.y(), t), std::lerp(from.z(), to.z(), t));
  };
  return {corner(0), corner(1), corner(2)};
}

/// Where one of two moving boxes is above the other, along an axis: the lower side of the upper box and the upper side
/// of the lower box, at both ends of the motion.
struct Gap {
  double upper_start, upper_end, lower_start, lower_end;
  bool operator==(const Gap&) const = default;
};
using Gaps = boost::container::static_vector<Gap, 3>;

/// The gaps between two boxes, one per axis at most, that close on the way.
Gaps closing_gaps(const Moving_box& a, const Moving_box& b) {
  Gaps gaps;
  for (const auto& [upper, lower] : {std::pair(&a, &b), std::pair(&b, &a)})
    for (int axis = 0; axis < 3; ++axis) {
      const Gap gap{upper->start.min()[axis], upper->end.min()[axis], lower->start.max()[axis], lower->end.max()[axis]};
      if (gap.upper_start > gap.lower_start && gap.upper_end <= gap.lower_end) gaps.push_back(gap);
    }
  return gaps;
}

/// Whether a gap closes at a time. Doubles tell most of those that do not.
bool closes_at(const Gap& gap, const Impact_time& time) {
  const double start = gap.upper_start - gap.lower_start, end = gap.upper_end - gap.lower_end;
  if (!(std::abs(start / (start - end) - time.value()) < 1e-12)) return false;
  const auto moving_point = [](double from, double to) {
    const Point p(from, 0, 0), q(to, 0, 0);
    return Moving_triangle{{p, p, p}, {q, q, q}};
  };
  return first_impact(moving_point(gap.upper_start, gap.upper_end), moving_point(gap.lower_start, gap.lower_end)) ==
         time;
}

/// The earliest impact so far.
class Earliest {
 public:
  /// @param limit  later impacts do not count
  explicit Earliest(double limit) : limit_(limit) {}

  /// A time after the impact, or the impact's; the limit if there is none.
  double latest() const { return found_ ? time_.high() : limit_; }

  /// Whether an impact of two faces at `bound` or later can be earlier, or at the same time that of a lower pair.
  bool can_change(double bound, Face_pair faces) const {
    return bound <= latest() && !(bound >= latest() && found_ && faces > faces_);
  }
  /// Whether an impact inside two moving boxes can be earlier, or at the same time that of a lower pair. None is
  /// earlier where a gap between the boxes closes at the time of the impact: that tells most faces of a block that
  /// falls flat.
  bool can_change(const Moving_box& a, const Moving_box& b, Face_pair faces) const {
    return !gap_ || faces < faces_ || std::ranges::count(closing_gaps(a, b), *gap_) == 0;
  }

  void try_faces(Face_pair faces, const Moving_triangle& a, const Moving_triangle& b) {
    const auto first = [&] {
      if (!found_) return first_impact(a, b, limit_);
      return faces > faces_ ? first_impact_before(time_, a, b) : first_impact_until(time_, a, b);
    };
    offer(faces, a, b, first());
  }
  void offer(Face_pair faces, const Moving_triangle& a, const Moving_triangle& b,
             const std::optional<Impact_time>& time) {
    if (!time || (found_ && std::tie(*time, faces) >= std::tie(time_, faces_))) return;
    found_ = true, time_ = *time, faces_ = faces, a_ = a, b_ = b;
    gap_.reset();
    for (const Gap& gap : closing_gaps(box_around(a), box_around(b)))
      if (closes_at(gap, time_)) gap_ = gap;
  }

  /// The rounded triangles at the rounded time nearly meet, and the closest points of theirs are near both.
  std::optional<Impact> impact() const {
    if (!found_) return std::nullopt;
    const double t = time_.value();
    return Impact{faces_, t, time_, closest_points(triangle_at(a_, t), triangle_at(b_, t)).a};
  }

 private:
  double limit_;
  bool found_ = false;
  Impact_time time_;
  Face_pair faces_;
  Moving_triangle a_, b_;
  std::optional<Gap> gap_;  ///< closes at the time of the impact
};

/// Whether two faces have a corner in common.
bool share_vertex(const Corners& a, const Corners& b) {
  return std::ranges::any_of(a, [&](std::uint32_t vertex) { return std::ranges::count(b, vertex) > 0; });
}

/// A face of a leaf that moves.
struct Moving_face {
  std::uint32_t face;
  Corners corners;
  Moving_triangle triangle;
  Moving_box box;
};

class Impact_search {
 public:
  Impact_search(const Swept_view& a, const Swept_view& b, double latest) : a_(a), b_(b), earliest_(latest) {}
  /// Within one surface: of faces that share no vertex.
  Impact_search(const Swept_view& surface, double latest)
      : a_(surface), b_(surface), is_within_(true), earliest_(latest) {}

  std::optional<Impact> run() {
    if (const auto contact = is_within_ ? lowest_contact_within(a_.start) : lowest_contact(a_.start, b_.start)) {
      earliest_.offer(contact->faces, moving(a_, contact->a), moving(b_, contact->b), Impact_time());
      return earliest_.impact();
    }
    if (is_within_) shared_vertices_ = shared_vertices_of_nodes(*a_.start.layout);
    push(root_pair);
    while (!queue_.empty() && queue_.top().bound <= earliest_.latest()) {
      const Node_pair pair = queue_.top().pair;
      queue_.pop();
      if (!layout_a().is_leaf(pair.a) || !layout_b().is_leaf(pair.b))
        open(pair);
      else
        try_leaves(pair);
    }
    return earliest_.impact();
  }

 private:
  struct Candidate {
    double bound;
    Node_pair pair;
    bool operator<(const Candidate& other) const { return bound > other.bound; }  // the earliest is on top
  };
  struct Impact_candidate {
    double bound;
    Face_pair faces;
    std::uint32_t a, b;  ///< in the lists
    auto operator<=>(const Impact_candidate&) const = default;
  };

  const Tree_layout& layout_a() const { return *a_.start.layout; }
  const Tree_layout& layout_b() const { return *b_.start.layout; }

  /// Whether a node of one surface is to be compared with itself.
  bool is_itself(Node_pair pair) const { return is_within_ && pair.a == pair.b; }

  static Moving_box box(const Swept_view& view, std::uint32_t node) {
    return {to_box(view.start.boxes[node]), to_box(view.end.boxes[node])};
  }

  /// A face at both ends of the motion.
  static Moving_triangle moving(const Swept_view& view, Leaf_face face) {
    return {triangle_of(leaf_triangle(view.start.leaf(face.leaf), face.index)),
            triangle_of(leaf_triangle(view.end.leaf(face.leaf), face.index))};
  }

  /// Whether each face below one node shares a vertex with each below the other, as around the tip of a cone.
  bool share_one_vertex(Node_pair pair) const {
    return is_within_ && have_one_in_common(shared_vertices_[pair.a], shared_vertices_[pair.b]);
  }

  void push(Node_pair pair) {
    if (share_one_vertex(pair)) return;
    const double bound = overlap_time_lower_bound(box(a_, pair.a), box(b_, pair.b));
    if (bound <= earliest_.latest()) queue_.push({bound, pair});
  }

  /// Opens the node that is larger where both ends of the motion are taken together.
  void open(Node_pair pair) {
    const auto extent = [](const Swept_view& view, std::uint32_t node) {
      return view.start.boxes[node].extent() + view.end.boxes[node].extent();
    };
    below_.clear();
    if (is_itself(pair))
      open_with_itself(layout_a(), pair.a, below_);
    else
      open_pair(layout_a(), layout_b(), pair, extent(a_, pair.a) >= extent(b_, pair.b), below_);
    for (const Node_pair next : below_) push(next);
  }

  void try_leaves(Node_pair pair) {
    list_faces_that_come_to(box(b_, pair.b), a_, layout_a().node(pair.a).leaf, faces_a_);
    list_faces_that_come_to(box(a_, pair.a), b_, layout_b().node(pair.b).leaf, faces_b_);
    list_candidates(is_itself(pair));
    for (const Impact_candidate& candidate : candidates_) {
      if (candidate.bound > earliest_.latest()) return;
      const Moving_face *a = &faces_a_[candidate.a], *b = &faces_b_[candidate.b];
      if (a->face != candidate.faces.a) std::swap(a, b);
      if (earliest_.can_change(candidate.bound, candidate.faces) &&
          earliest_.can_change(a->box, b->box, candidate.faces))
        earliest_.try_faces(candidate.faces, a->triangle, b->triangle);
    }
  }

  void list_faces_that_come_to(const Moving_box& other, const Swept_view& view, std::uint32_t leaf,
                               std::vector<Moving_face>& faces) const {
    faces.clear();
    const Leaf_faces at_start = view.start.leaf(leaf), at_end = view.end.leaf(leaf);
    const auto indices = view.start.layout->faces(leaf);
    for (std::size_t i = 0; i < indices.size(); ++i) {
      const Moving_triangle triangle{triangle_of(leaf_triangle(at_start, i)), triangle_of(leaf_triangle(at_end, i))};
      const Moving_box box = box_around(triangle);
      if (!(overlap_time_lower_bound(box, other) <= earliest_.latest())) continue;
      const auto [p, q, r] = at_start.corners[i];
      const Corners corners{at_start.vertices[p], at_start.vertices[q], at_start.vertices[r]};
      faces.push_back({indices[i], corners, triangle, box});
    }
  }

  /// Pairs of the listed faces that may meet, the earliest first.
  /// @param of_one_leaf  both lists are the same: each pair once
  void list_candidates(bool of_one_leaf) {
    candidates_.clear();
    for (std::uint32_t i = 0; i < faces_a_.size(); ++i)
      for (std::uint32_t j = of_one_leaf ? i + 1 : 0; j < faces_b_.size(); ++j) {
        const Moving_face &a = faces_a_[i], &b = faces_b_[j];
        const double bound = overlap_time_lower_bound(a.box, b.box);
        const Face_pair faces =
            is_within_ ? Face_pair{std::min(a.face, b.face), std::max(a.face, b.face)} : Face_pair{a.face, b.face};
        if (earliest_.can_change(bound, faces) && !(is_within_ && share_vertex(a.corners, b.corners)))
          candidates_.push_back({bound, faces, i, j});
      }
    std::ranges::sort(candidates_);
  }

  const Swept_view& a_;
  const Swept_view& b_;
  bool is_within_ = false;                        ///< both are the same surface
  std::vector<Shared_vertices> shared_vertices_;  ///< per node, within one surface
  Earliest earliest_;
  std::priority_queue<Candidate> queue_;
  std::vector<Node_pair> below_;
  std::vector<Moving_face> faces_a_, faces_b_;
  std::vector<Impact_candidate> candidates_;
};

Moving_triangle moving_face(const Moving_surface& surface, std::uint32_t face) {
  const auto at = [&](Coordinates coordinates) {
    return face_triangle(surface.faces[face],
                         [&](auto vertex) { return coordinates.data() + 3 * std::size_t{vertex}; });
  };
  return {at(surface.start), at(surface.end)};
}

}  // namespace

Swept_boxes::Swept_boxes(const Layout_view& start, Coordinates end)
    : boxes_(fitted_boxes(*start.layout, end)), view_{start, {start.layout, end, boxes_[0], boxes_}} {}

std::optional<Impact> first_impact(const Swept_view& a, const Swept_view& b, double latest) {
  return Impact_search(a, b, latest).run();
}

std::optional<Impact> first_self_impact(const Swept_view& surface, double latest) {
  return Impact_search(surface, latest).run();
}

std::optional<Impact> first_self_impact(const Moving_surface& surface) {
  const Tree_surface tree(surface.faces, surface.start);
  return first_self_impact(Swept_boxes(tree.view(), surface.end).view());
}

std::optional<Impact> first_impact(const Moving_surface& a, const Moving_surface& b) {
  const Tree_surface tree_a(a.faces, a.start), tree_b(b.faces, b.start);
  const Swept_boxes boxes_a(tree_a.view(), a.end), boxes_b(tree_b.view(), b.end);
  return first_impact(boxes_a.view(), boxes_b.view());
}

std::optional<Impact> exhaustive_first_impact(const Moving_surface& a, const Moving_surface& b) {
  Earliest earliest(1);
  for (std::uint32_t i = 0; i < a.faces.size(); ++i)
    for (std::uint32_t j = 0; j < b.faces.size(); ++j) {
      const Moving_triangle face_a = moving_face(a, i), face_b = moving_face(b, j);
      earliest.offer({i, j}, face_a, face_b, first_impact(face_a, face_b));
    }
  return earliest.impact();
}

std::optional<Impact> exhaustive_first_self_impact(const Moving_surface& surface) {
  Earliest earliest(1);
  for (std::uint32_t i = 0; i < surface.faces.size(); ++i)
    for (std::uint32_t j = i + 1; j < surface.faces.size(); ++j) {
      if (share_vertex(surface.faces[i], surface.faces[j])) continue;
      const Moving_triangle face_i = moving_face(surface, i), face_j = moving_face(surface, j);
      earliest.offer({i, j}, face_i, face_j, first_impact(face_i, face_j));
    }
  return earliest.impact();
}

}  // namespace lodestone
