// SPDX-License-Identifier: GPL-3.0-or-later
// Whether two triangles have a point in common, by the definition of segments and triangles, in exact numbers. It
// shares no code with the library.
#pragma once

#include <algorithm>
#include <array>

namespace lodestone::fuzz {

/// The test for points of exact numbers: integers that do not overflow.
template <class Number>
class Exact_triangles {
 public:
  using Point = std::array<Number, 3>;
  using Triangle = std::array<Point, 3>;

  /// Triangles meet exactly if an edge of one meets the other: where neither is in the plane of the other, the ends of
  /// what they have in common are on edges; in one plane, edges cross or one triangle holds the other.
  static bool meet(const Triangle& a, const Triangle& b) {
    const bool flat_a = is_zero(normal_of(a)), flat_b = is_zero(normal_of(b));
    for (int i = 0; i < 3; ++i) {
      if (meets_segment(b, flat_b, a[i], a[(i + 1) % 3])) return true;
      if (meets_segment(a, flat_a, b[i], b[(i + 1) % 3])) return true;
    }
    return false;
  }

 private:
  using Point_2 = std::array<Number, 2>;

  static int sign(const Number& n) { return n < 0 ? -1 : n > 0 ? 1 : 0; }
  static Point minus(const Point& p, const Point& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }
  static Point cross(const Point& p, const Point& q) {
    return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
  }
  static Number dot(const Point& p, const Point& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }
  static bool is_zero(const Point& p) { return p[0] == 0 && p[1] == 0 && p[2] == 0; }
  static Point normal_of(const Triangle& t) { return cross(minus(t[1], t[0]), minus(t[2], t[0])); }
  /// On which side of the plane of p, q and r the point s is.
  static int side(const Point& p, const Point& q, const Point& r, const Point& s) {
    return sign(dot(cross(minus(q, p), minus(r, p)), minus(s, p)));
  }

  // ---- In space ----

  /// @param is_flat  the triangle has no area: it is its three edges
  static bool meets_segment(const Triangle& t, bool is_flat, const Point& p, const Point& q) {
    if (is_flat) return meets_edges(t, p, q);
    const int side_p = side(t[0], t[1], t[2], p), side_q = side(t[0], t[1], t[2], q);
    if (side_p * side_q > 0) return false;
    if (side_p == 0 && side_q == 0) return meets_in_plane(t, p, q);
    int least = 1, most = -1;  // the line through p and q passes the edges all on one side, or on them
    for (int i = 0; i < 3; ++i) {
      const int passes = side(p, q, t[i], t[(i + 1) % 3]);
      least = std::min(least, passes), most = std::max(most, passes);
    }
    return least >= 0 || most <= 0;
  }
  static bool meets_edges(const Triangle& t, const Point& p, const Point& q) {
    for (int i = 0; i < 3; ++i)
      if (segments_meet(t[i], t[(i + 1) % 3], p, q)) return true;
    return false;
  }
  static bool segments_meet(const Point& p, const Point& q, const Point& r, const Point& s) {
    if (side(p, q, r, s) != 0) return false;
    // In one plane, or on one line: they meet if their shadows do on all three coordinate planes. The shadow on one of
    // the planes is a map without loss, and the others lose only what is equal anyway.
    for (int axis = 0; axis < 3; ++axis)
      if (!segments_meet_2(flat(p, axis), flat(q, axis), flat(r, axis), flat(s, axis))) return false;
    return true;
  }

  // ---- In a plane ----

  static Point_2 flat(const Point& p, int along) { return {p[(along + 1) % 3], p[(along + 2) % 3]}; }
  static int turn(const Point_2& p, const Point_2& q, const Point_2& r) {
    return sign((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
  }
  static bool in_box(const Point_2& p, const Point_2& q, const Point_2& r) {
    for (int axis = 0; axis < 2; ++axis)
      if (r[axis] < std::min(p[axis], q[axis]) || std::max(p[axis], q[axis]) < r[axis]) return false;
    return true;
  }
  static bool segments_meet_2(const Point_2& p, const Point_2& q, const Point_2& r, const Point_2& s) {
    const int pqr = turn(p, q, r), pqs = turn(p, q, s), rsp = turn(r, s, p), rsq = turn(r, s, q);
    if (pqr * pqs < 0 && rsp * rsq < 0) return true;
    return (pqr == 0 && in_box(p, q, r)) || (pqs == 0 && in_box(p, q, s)) || (rsp == 0 && in_box(r, s, p)) ||
           (rsq == 0 && in_box(r, s, q));
  }
  /// A triangle with an area, and a segment in its plane.
  static bool meets_in_plane(const Triangle& t, const Point& p, const Point& q) {
    const Point normal = normal_of(t);
    int along = 0;
    while (normal[along] == 0) ++along;
    const Point_2 a = flat(t[0], along), b = flat(t[1], along), c = flat(t[2], along);
    const Point_2 u = flat(p, along), v = flat(q, along);
    const int turns[] = {turn(a, b, u), turn(b, c, u), turn(c, a, u)};
    const bool holds_end = std::ranges::min(turns) >= 0 || std::ranges::max(turns) <= 0;
    return holds_end || segments_meet_2(a, b, u, v) || segments_meet_2(b, c, u, v) || segments_meet_2(c, a, u, v);
  }
};

}  // namespace lodestone::fuzz
