// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/triangles/clearance.h"

#include <Eigen/Dense>
#include <algorithm>

namespace lodestone {

namespace {

/// The differences y - x of two convex sets, x in a and y in b, form a convex set D. Their clearance is where the line
/// t direction leaves D. For each vector n, D lies between two planes with the normal n, and so does the part of the
/// line in D: each n bounds t. Whatever n is, the bound holds; so n may be rounded. If D is a polytope, the normals of
/// its facets give the exact answer.
///
/// The slack covers rounding. Coordinates are at most X, and the slack is at least 32 roundings of X. With |n| the sum
/// of the absolute components of n: n y - n x has an error of 8 |n| X roundings; n direction has one of 3 |n|
/// roundings, and t is at most 2 X; the quotient of the two is off by two roundings of t at most.
class Passage {
  static constexpr double infinity = std::numeric_limits<double>::infinity();

 public:
  /// @param least  a shorter passage counts as closed
  explicit Passage(const Way& way, double least = -infinity) : way_(way), least_(least) {}

  /// Whether points can be in line, with a clearance that counts.
  bool is_open() const { return first_ <= last_ && last_ >= least_; }
  Clearance clearance() const {
    if (!is_open()) return {};
    return {last_, normal_.dot(way_.direction) < 0 ? Eigen::Vector3d(-normal_) : normal_};
  }
  double length() const { return is_open() ? last_ : Clearance{}.length; }

  /// D lies between `low` and `high` along an axis.
  void cut_along(int axis, double low, double high) {
    const bool nearer = cut(way_.direction[axis], low - way_.slack, high + way_.slack,
                            [&](double x) { return x * way_.inverse[axis]; });
    if (nearer) normal_ = Eigen::Vector3d::Unit(axis);
  }
  /// D is that of two triangles.
  void cut(const Eigen::Vector3d& n, const Boxed_triangle& a, const Boxed_triangle& b) {
    const double size = n.lpNorm<1>();
    if (!(size > 1e-200)) return;  // smaller ones have products that underflow
    const auto [low_a, high_a] = std::minmax({n.dot(a.corners[0]), n.dot(a.corners[1]), n.dot(a.corners[2])});
    const auto [low_b, high_b] = std::minmax({n.dot(b.corners[0]), n.dot(b.corners[1]), n.dot(b.corners[2])});
    const double slack = size * way_.slack;
    const double speed = n.dot(way_.direction);
    if (cut(speed, low_b - high_a - slack, high_b - low_a + slack, [&](double x) { return x / speed; })) normal_ = n;
  }

 private:
  /// Leaves the t with low <= t speed <= high.
  /// @param over_speed  divides by `speed`
  /// @return whether the end of the line in D has come nearer
  template <class Over_speed>
  bool cut(double speed, double low, double high, const Over_speed& over_speed) {
    if (speed == 0) {
      if (low > 0 || high < 0) last_ = -infinity, first_ = infinity;
      return false;
    }
    if (speed < 0) std::swap(low, high);
    first_ = std::max(first_, over_speed(low));
    const double last = over_speed(high);
    if (!(last < last_)) return false;
    last_ = last;
    return true;
  }

  const Way& way_;
  double least_;
  double first_ = -infinity, last_ = infinity;  ///< of t
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();
};

void cut_by_boxes(Passage& passage, const Box& a, const Box& b) {
  for (int axis = 0; axis < 3; ++axis)
    passage.cut_along(axis, b.min()[axis] - a.max()[axis], b.max()[axis] - a.min()[axis]);
}

using Edges = std::array<Eigen::Vector3d, 3>;

Edges edges_of(const Boxed_triangle& t) {
  return {t.corners[1] - t.corners[0], t.corners[2] - t.corners[1], t.corners[0] - t.corners[2]};
}

/// Seen along the direction, the triangles are apart if and only if the normal of one of their edges parts them.
void cut_by_outlines(Passage& passage, const Boxed_triangle& a, const Boxed_triangle& b, const Edges& edges_a,
                     const Edges& edges_b, const Eigen::Vector3d& direction) {
  for (const Edges* edges : {&edges_a, &edges_b})
    for (const Eigen::Vector3d& e : *edges) {
      passage.cut(e.cross(direction), a, b);
      if (!passage.is_open()) return;
    }
}

/// The normals of the two faces, which are those of facets of D.
void cut_by_faces(Passage& passage, const Boxed_triangle& a, const Boxed_triangle& b, const Edges& edges_a,
                  const Edges& edges_b) {
  passage.cut(edges_a[0].cross(edges_a[1]), a, b);
  passage.cut(edges_b[0].cross(edges_b[1]), a, b);
}

/// The normals of the other facets of D: those across an edge of each.
void cut_by_edge_pairs(Passage& passage, const Boxed_triangle& a, const Boxed_triangle& b, const Edges& edges_a,
                       const Edges& edges_b) {
  for (const Eigen::Vector3d& e : edges_a) {
    if (!passage.is_open()) return;
    for (const Eigen::Vector3d& f : edges_b) passage.cut(e.cross(f), a, b);
  }
}

/// D is flat if the triangles are parallel or have no area. Where a flat D holds the line, the line ends at an edge of
/// D, which is an edge of a triangle, or at a corner.
void cut_by_edges_of_flat(Passage& passage, const Boxed_triangle& a, const Boxed_triangle& b, const Edges& edges_a,
                          const Edges& edges_b, const Eigen::Vector3d& direction) {
  passage.cut(direction, a, b);
  for (const Edges* edges : {&edges_a, &edges_b})
    for (const Eigen::Vector3d& e : *edges) passage.cut(direction * e.squaredNorm() - e * e.dot(direction), a, b);
}

}  // namespace

double clearance(const Box& a, const Box& b, const Way& way) {
  Passage passage(way);
  cut_by_boxes(passage, a, b);
  return passage.length();
}

Clearance clearance(const Boxed_triangle& a, const Boxed_triangle& b, const Way& way, double least) {
  Passage passage(way, least);
  cut_by_boxes(passage, a.box, b.box);
  if (!passage.is_open()) return {};
  const Edges edges_a = edges_of(a), edges_b = edges_of(b);
  cut_by_faces(passage, a, b, edges_a, edges_b);
  if (!passage.is_open()) return {};
  cut_by_outlines(passage, a, b, edges_a, edges_b, way.direction);
  if (!passage.is_open()) return {};
  cut_by_edge_pairs(passage, a, b, edges_a, edges_b);
  if (!passage.is_open()) return {};
  cut_by_edges_of_flat(passage, a, b, edges_a, edges_b, way.direction);
  return passage.clearance();
}

}  // namespace lodestone
