// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/exact_contacts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

/// Why nothing is missed. Let two triangles be apart at t = 0, and let them meet first at t' > 0. While they are apart,
/// their distance is that of a corner and a triangle or of two edges, also where a triangle is a segment or a point.
/// There are 15 such pairs of features, so one of them is nearest at times that come as near to t' as one likes.
/// Positions are continuous: this pair meets at t'. So t' is the least of the times at which a pair of features meets
/// first.
///
/// Where a pair meets, its four corners are in one plane: t is a root of a polynomial of degree 3, the determinant of
/// three of their differences. If it is the zero polynomial, the four corners always are in one plane, and the features
/// can only begin to meet where a corner comes to an edge:
///  - A corner outside a triangle enters it, in their common plane, over its border.
///  - Two segments that cross in inner points, in their common plane, have crossed before.
///  - If all four corners are in one line at that time, two segments that meet have an end of one in the other.
/// Likewise, if a corner and the ends of an edge always are in one line, the corner can only begin to be on the edge
/// where it is at an end.
namespace lodestone {

namespace {

/// A finite number is m 2^e with an odd integer m, or 0; returns e.
int exponent_of(double number) {
  if (number == 0) return std::numeric_limits<int>::max();
  int exponent = 0;
  const auto mantissa = static_cast<std::uint64_t>(std::ldexp(std::abs(std::frexp(number, &exponent)), 53));
  return exponent - 53 + std::countr_zero(mantissa);
}

/// number / 2^exponent, which must be an integer.
Integer scaled(double number, int exponent) {
  if (number == 0) return 0;
  const int own = exponent_of(number);
  Integer result = Integer(std::ldexp(number, -own));
  result <<= static_cast<unsigned long>(own - exponent);
  return result;
}

Integer_polynomial moving(double start, double end, int exponent) {
  Integer from = scaled(start, exponent), way = scaled(end, exponent) - from;
  return {std::move(from), std::move(way)};
}

/// A component of (q - p) x (r - p): twice the area of the three points, seen along an axis.
Integer_polynomial area(const Moving_vector& p, const Moving_vector& q, const Moving_vector& r, int axis) {
  return cross(q - p, r - p, axis);
}

}  // namespace

Exact_contacts::Exact_contacts(const Moving_triangle& a, const Moving_triangle& b, const Impact_time* before)
    : latest_(before ? before->high() : std::numeric_limits<double>::infinity()) {
  if (before) before_ = before->exact();
  const Triangle* const triangles[]{&a.start, &a.end, &b.start, &b.end};
  int exponent = std::numeric_limits<int>::max();
  for (const Triangle* triangle : triangles)
    for (const Point& p : *triangle)
      for (int axis = 0; axis < 3; ++axis) exponent = std::min(exponent, exponent_of(p[axis]));
  for (std::size_t corner = 0; corner < 6; ++corner) {
    const Moving_triangle& owner = corner < 3 ? a : b;
    for (int axis = 0; axis < 3; ++axis)
      points_[corner][static_cast<std::size_t>(axis)] =
          moving(owner.start[corner % 3][axis], owner.end[corner % 3][axis], exponent);
  }
}

/// Keeps the first root at which a pair of features meets, if it is earlier than what was found before.
/// @param p  not zero
template <class Meets>
void Exact_contacts::try_roots(const Integer_polynomial& p, Meets meets) {
  for (Algebraic_time& root : roots_until_one(p)) {
    if (before_ && root.compare(*before_) >= 0) return;
    if (!meets(root)) continue;
    before_ = root;
    latest_ = root.round_up();
    found_ = true;
    return;
  }
}

void Exact_contacts::try_corner_and_face(int corner, const std::array<int, 3>& face) {
  const Moving_vector u = between(corner, face[0]), v = between(corner, face[1]), w = between(corner, face[2]);
  const Integer_polynomial volume = dot(u, {cross(v, w, 0), cross(v, w, 1), cross(v, w, 2)});
  if (!volume.is_zero()) return try_roots(volume, [&](Algebraic_time& t) { return on_face(corner, face, t); });
  for (std::size_t i = 0; i < 3; ++i) try_corner_and_edge(corner, {face[i], face[(i + 1) % 3]});
}

void Exact_contacts::try_edges(const std::array<int, 2>& first, const std::array<int, 2>& second) {
  const Moving_vector u = between(first[0], first[1]), v = between(first[0], second[0]),
                      w = between(first[0], second[1]);
  const Integer_polynomial volume = dot(u, {cross(v, w, 0), cross(v, w, 1), cross(v, w, 2)});
  if (!volume.is_zero()) return try_roots(volume, [&](Algebraic_time& t) { return edges_meet(first, second, t); });
  for (const int end : first) try_corner_and_edge(end, second);
  for (const int end : second) try_corner_and_edge(end, first);
}

/// The corner and the ends are in one line where three quadratic polynomials are zero.
void Exact_contacts::try_corner_and_edge(int corner, const std::array<int, 2>& edge) {
  Integer_polynomial common;
  for (int axis = 0; axis < 3; ++axis)
    common = greatest_common_divisor(common, area(point(corner), point(edge[0]), point(edge[1]), axis));
  if (!common.is_zero()) return try_roots(common, [&](Algebraic_time& t) { return on_edge(corner, edge, t); });
  for (const int end : edge) try_corners(corner, end);
}

/// Corners that are always at the same place are there at the start.
void Exact_contacts::try_corners(int first, int second) {
  Integer_polynomial common;
  for (const Integer_polynomial& difference : between(first, second))
    common = greatest_common_divisor(common, difference);
  if (!common.is_zero()) try_roots(common, [](Algebraic_time&) { return true; });
}

/// At a time at which all four corners are in one plane: looks at that plane along an axis in which it is not seen from
/// the side.
bool Exact_contacts::on_face(int corner, const std::array<int, 3>& face, Algebraic_time& t) const {
  const auto& p = point(corner);
  const auto edge = [&](std::size_t i) { return std::array{face[i], face[(i + 1) % 3]}; };
  for (int axis = 0; axis < 3; ++axis) {
    const CGAL::Sign side = t.sign_of(area(point(face[0]), point(face[1]), point(face[2]), axis));
    if (side == CGAL::ZERO) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [from, to] = edge(i);
      if (t.sign_of(area(p, point(from), point(to), axis)) == -side) return false;
    }
    return true;
  }
  // The face has no area: it is the union of its edges.
  return on_edge(corner, edge(0), t) || on_edge(corner, edge(1), t) || on_edge(corner, edge(2), t);
}

/// At a time at which all four ends are in one plane.
bool Exact_contacts::edges_meet(const std::array<int, 2>& first, const std::array<int, 2>& second,
                                Algebraic_time& t) const {
  const auto separates = [&](const std::array<int, 2>& edge, const std::array<int, 2>& ends, int axis) {
    const auto side = [&](int end) { return t.sign_of(area(point(edge[0]), point(edge[1]), point(end), axis)); };
    return side(ends[0]) * side(ends[1]) <= 0;
  };
  for (int axis = 0; axis < 3; ++axis) {
    if (t.sign_of(cross(between(first[0], first[1]), between(second[0], second[1]), axis)) == CGAL::ZERO) continue;
    return separates(first, second, axis) && separates(second, first, axis);
  }
  // The edges are parallel, or one is a point: if they meet, an end of one is on the other.
  return on_edge(first[0], second, t) || on_edge(first[1], second, t) || on_edge(second[0], first, t) ||
         on_edge(second[1], first, t);
}

/// Whether the corner is in line with the ends of an edge and between them.
bool Exact_contacts::on_edge(int corner, const std::array<int, 2>& edge, Algebraic_time& t) const {
  const Moving_vector& p = point(corner);
  for (int axis = 0; axis < 3; ++axis)
    if (t.sign_of(area(p, point(edge[0]), point(edge[1]), axis)) != CGAL::ZERO) return false;
  return t.sign_of(dot(between(corner, edge[0]), between(corner, edge[1]))) != CGAL::POSITIVE;
}

}  // namespace lodestone
