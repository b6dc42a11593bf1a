// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/triangles/neighbour_check.h"

#include <CGAL/Intersections_3/Segment_3_Segment_3.h>
#include <CGAL/Intersections_3/Segment_3_Triangle_3.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "triangles/fan_projection.h"
#include "triangles/orientation.h"

namespace lodestone {

namespace {

using Segment = Kernel::Segment_3;
using Kernel_triangle = Kernel::Triangle_3;

/// Whether p and q lie in the same direction from `origin`; false if one of them equals it.
bool same_direction(const Point& origin, const Point& p, const Point& q) {
  return p != origin && q != origin && CGAL::collinear(origin, p, q) &&
         !CGAL::collinear_are_strictly_ordered_along_line(p, origin, q);
}

/// Whether the segment from `origin` to `end` meets the face `origin` p q in more than `origin`. The face has an area.
bool arm_meets(const Point& origin, const Point& end, const Point& p, const Point& q) {
  return end != origin &&
         (Kernel_triangle(origin, p, q).has_on(end) || CGAL::do_intersect(Segment(origin, end), Segment(p, q)));
}

/// Whether the faces `origin` a b and `origin` c d meet in more than `origin`.
bool meet_beyond_vertex(const Point& origin, const Point& a, const Point& b, const Point& c, const Point& d) {
  const bool flat = CGAL::collinear(origin, a, b), other_flat = CGAL::collinear(origin, c, d);
  // If they share more than the vertex, what they share reaches the edge opposite to it in one of them.
  if (!flat && !other_flat)
    return CGAL::do_intersect(Kernel_triangle(origin, a, b), Segment(c, d)) ||
           CGAL::do_intersect(Kernel_triangle(origin, c, d), Segment(a, b));
  // A face without an area is the union of the two segments from the vertex.
  if (!other_flat) return arm_meets(origin, a, c, d) || arm_meets(origin, b, c, d);
  if (!flat) return arm_meets(origin, c, a, b) || arm_meets(origin, d, a, b);
  return same_direction(origin, a, c) || same_direction(origin, a, d) || same_direction(origin, b, c) ||
         same_direction(origin, b, d);
}

/// Whether the faces p q a and p q b meet outside of the edge p q.
bool meet_beyond_edge(const Point& p, const Point& q, const Point& a, const Point& b) {
  const bool flat = CGAL::collinear(p, q, a), other_flat = CGAL::collinear(p, q, b);
  if (!flat && !other_flat)
    return orientation(p, q, a, b) == CGAL::ZERO && CGAL::coplanar_orientation(p, q, a, b) == CGAL::POSITIVE;
  // A face with an area meets the line of its edge in that edge only.
  if (!flat || !other_flat) return false;
  if (p == q) return same_direction(p, a, b);
  const auto both_beyond = [&](const Point& from, const Point& end) {
    return CGAL::collinear_are_strictly_ordered_along_line(from, end, a) &&
           CGAL::collinear_are_strictly_ordered_along_line(from, end, b);
  };
  return both_beyond(p, q) || both_beyond(q, p);
}

/// 1 or -1 if the sign of a value is certain, 0 otherwise.
/// @param error  of the value; not negative
int sure_sign(double value, double error) { return std::abs(value) > error ? (value > 0 ? 1 : -1) : 0; }

}  // namespace

bool faces_intersect(const Corners& corners_a, const Triangle& a, const Corners& corners_b, const Triangle& b) {
  /// Per common vertex: its corner of either face.
  boost::container::static_vector<std::pair<int, int>, 3> common;
  for (int i = 0; i < 3; ++i) {
    const auto seen = std::find(corners_a.begin(), corners_a.begin() + i, corners_a[i]);
    const auto match = std::ranges::find(corners_b, corners_a[i]);
    if (seen == corners_a.begin() + i && match != corners_b.end())
      common.emplace_back(i, static_cast<int>(match - corners_b.begin()));
  }

  if (common.empty()) return triangles_intersect(a, b);
  if (common.size() == 3) return !CGAL::collinear(a[0], a[1], a[2]);
  const auto [i, j] = common[0];
  if (common.size() == 1)
    return meet_beyond_vertex(a[i], a[(i + 1) % 3], a[(i + 2) % 3], b[(j + 1) % 3], b[(j + 2) % 3]);
  const auto [k, l] = common[1];
  return meet_beyond_edge(a[i], a[k], a[3 - i - k], b[3 - j - l]);
}

Neighbour_check::Wing Neighbour_check::make_wing(const double* positions, const Corners& corners, std::uint32_t face,
                                                 std::uint32_t vertex) {
  const auto point = [&](std::uint32_t v) { return Eigen::Map<const Eigen::Vector3d>(positions + std::size_t{3} * v); };
  const auto corner = std::ranges::find(corners, vertex) - corners.begin();
  Wing wing{};
  wing.face = face;
  for (int i = 0; i < 2; ++i) {
    wing.ends[i] = corners[(corner + 1 + i) % 3];
    wing.arms[i] = point(wing.ends[i]) - point(vertex);
    wing.reach[i] = wing.arms[i].lpNorm<Eigen::Infinity>();
  }
  wing.normal = wing.arms[0].cross(wing.arms[1]);
  wing.area = wing.reach[0] * wing.reach[1];
  if (!measurable(wing.area)) wing.area = std::numeric_limits<double>::infinity();
  return wing;
}

/// Tries to prove that two faces meet in their common vertex only.
///
/// They do if one lies on one side of the other's plane. Otherwise each has its arms a, b or c, d on both sides of the
/// other's plane, so each meets the line of the two planes in a ray. With the normals m and n these rays have the
/// directions (n.a) b - (n.b) a = m x n, up to the sign of n.a, and (m.c) d - (m.d) c = -m x n, up to the sign of m.c.
/// If the signs are equal, the rays are opposite.
bool Neighbour_check::surely_beside(const Wing& a, const Wing& b) {
  const auto side = [](const Wing& wing, const Wing& other, int arm) {
    const double bound = wing.area * other.reach[arm];
    return measurable(bound) ? sure_sign(wing.normal.dot(other.arms[arm]), volume_error * bound) : 0;
  };
  const int c = side(a, b, 0), d = side(a, b, 1);
  if (c != 0 && c == d) return true;
  const int e = side(b, a, 0), f = side(b, a, 1);
  if (e != 0 && e == f) return true;
  return c != 0 && d != 0 && e != 0 && f != 0 && c == e;
}

/// Tries to prove the same of faces that may be coplanar. Seen along an axis in which neither is edge-on, the line of
/// an arm parts them: both arms of the other face lie strictly on one side, its own face on the other. Then the
/// projections, and so the faces, meet in the vertex only.
bool Neighbour_check::surely_beside_along_an_axis(const Wing& a, const Wing& b) {
  for (int axis = 0; axis < 3; ++axis) {
    const int turn_a = sure_sign(a.normal[axis], cross_error * a.area);
    const int turn_b = sure_sign(b.normal[axis], cross_error * b.area);
    if (turn_a == 0 || turn_b == 0) continue;
    const int x = (axis + 1) % 3, y = (axis + 2) % 3;
    const auto turn = [&](int i, int j) {
      const double bound = a.reach[i] * b.reach[j];
      const double product = a.arms[i][x] * b.arms[j][y] - a.arms[i][y] * b.arms[j][x];
      return measurable(bound) ? sure_sign(product, cross_error * bound) : 0;
    };
    const int turns[2][2] = {{turn(0, 0), turn(0, 1)}, {turn(1, 0), turn(1, 1)}};
    for (int arm = 0; arm < 2; ++arm) {
      // A face turns from its first arm to its second: what lies beyond the first is on the other side.
      const int beyond_a = arm == 0 ? -turn_a : turn_a, beyond_b = arm == 0 ? turn_b : -turn_b;
      if (turns[arm][0] == beyond_a && turns[arm][1] == beyond_a) return true;
      if (turns[0][arm] == beyond_b && turns[1][arm] == beyond_b) return true;
    }
  }
  return false;
}

/// Tries to prove that two faces with a common edge meet in it only: they are not coplanar, or they lie on different
/// sides of the edge as seen along some axis.
/// @param other_of_a, other_of_b  the arms that are not on the edge
bool Neighbour_check::surely_hinged(const Wing& a, const Wing& b, int other_of_a, int other_of_b) {
  const double bound = a.area * b.reach[other_of_b];
  if (measurable(bound) && std::abs(a.normal.dot(b.arms[other_of_b])) > volume_error * bound) return true;
  for (int axis = 0; axis < 3; ++axis) {
    const int turn_a = sure_sign(a.normal[axis], cross_error * a.area);
    const int turn_b = sure_sign(b.normal[axis], cross_error * b.area);
    if (turn_a == 0 || turn_b == 0) continue;
    if ((turn_a == turn_b) != (other_of_a == other_of_b)) return true;
  }
  return false;
}

void Neighbour_check::check_pairs(std::uint32_t vertex, std::span<const std::uint32_t> fan,
                                  std::span<const Corners> faces, const double* positions,
                                  std::vector<Face_pair>& found) {
  wings_.clear();
  for (const auto face : fan) wings_.push_back(make_wing(positions, faces[face], face, vertex));

  const auto triangle = [&](std::uint32_t face) {
    return face_triangle(faces[face], [&](std::uint32_t v) { return positions + std::size_t{3} * v; });
  };
  for (std::size_t i = 0; i < wings_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Wing &a = wings_[i], &b = wings_[j];
      int common_ends = 0, end_of_a = 0, end_of_b = 0;
      bool least_vertex = true;
      for (int k = 0; k < 2; ++k)
        for (int l = 0; l < 2; ++l)
          if (a.ends[k] == b.ends[l]) {
            ++common_ends, end_of_a = k, end_of_b = l;
            least_vertex = least_vertex && a.ends[k] >= vertex;
          }
      if (!least_vertex) continue;
      if (common_ends == 0 && (surely_beside(a, b) || surely_beside_along_an_axis(a, b))) continue;
      if (common_ends == 1 && surely_hinged(a, b, 1 - end_of_a, 1 - end_of_b)) continue;
      ++exact_tests_;
      if (faces_intersect(faces[a.face], triangle(a.face), faces[b.face], triangle(b.face)))
        found.push_back({std::min(a.face, b.face), std::max(a.face, b.face)});
    }
}

void Neighbour_check::check(const Vertex_fans& fans, std::span<const Corners> faces, std::span<const double> positions,
                            std::uint32_t first, std::uint32_t last, std::vector<Face_pair>& found) {
  for (std::uint32_t vertex = first; vertex < last; ++vertex) {
    const auto fan = fans.faces(vertex);
    if (fan.size() < 2) continue;
    const auto rim = fans.rim(vertex);
    if (!rim.empty() && surely_spread(positions.data(), vertex, rim)) continue;
    check_pairs(vertex, fan, faces, positions.data(), found);
  }
}

}  // namespace lodestone
