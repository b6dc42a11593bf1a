// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/impact_filter.h"

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <limits>

namespace lodestone {

namespace {

constexpr double no_contact = std::numeric_limits<double>::infinity();

Eigen::Vector3d vector(const Point& p) { return {p.x(), p.y(), p.z()}; }

int next_corner(int corner) { return corner < 3 ? (corner + 1) % 3 : 3 + (corner + 1) % 3; }

/// Cuts a polynomial in Bernstein's form at a part of its interval: de Casteljau.
/// @param low   is left with the coefficients for what lies before
/// @param high  those for what lies after
template <class Coefficient, std::size_t size>
void cut(const std::array<Coefficient, size>& whole, double part, std::array<Coefficient, size>& low,
         std::array<Coefficient, size>& high) {
  std::array<Coefficient, size> row = whole;
  for (std::size_t length = size; length > 0; --length) {
    low[size - length] = row[0];
    high[length - 1] = row[length - 1];
    for (std::size_t i = 0; i + 1 < length; ++i) row[i] = (1 - part) * row[i] + part * row[i + 1];
  }
}

}  // namespace

/// Polynomials of a pair of features over an interval of time. Its four corners are o, p, q and r; u, v and w are the
/// differences of the last three from o. The volume is the determinant of u, v and w; areas are u x v, v x w and w x u.
///
/// With eps = 2^-53 and all components of u, v and w at most m, each term of a coefficient is a product of three of
/// these, with a rounding of each difference and two of products. There are at most 18 terms, in a mean of three
/// determinants, which carry at most 10 roundings of sums. A halving adds three roundings of coefficients of at most
/// 6 m^3, the first cut nine, and there are at most 20 halvings. So the error is below (15 + 69) eps 6 m^3 < 2^-43 m^3.
/// Likewise that of an area is below 2^-45 m^2. What underflows is below 10^-200, as m is below 10^100.
class Impact_filter::Piece {
 public:
  Piece(const Moving_difference& u, const Moving_difference& v, const Moving_difference& w) {
    areas_ = {area(u, v), area(v, w), area(w, u)};
    const auto& a = areas_[1];
    constexpr double third = 1.0 / 3;
    volume_ = {u.start.dot(a[0]), third * (u.end.dot(a[0]) + 2 * u.start.dot(a[1])),
               third * (2 * u.end.dot(a[1]) + u.start.dot(a[2])), u.end.dot(a[2])};
    const double size = std::max({u.size, v.size, w.size});
    area_error_ = 0x1p-42 * size * size + 1e-200;
    volume_error_ = 0x1p-41 * size * size * size + 1e-200;
  }

  void halve(Piece& low, Piece& high) const { cut_at(0.5, low, high); }
  void cut_at(double part, Piece& low, Piece& high) const {
    low = high = *this;
    cut(volume_, part, low.volume_, high.volume_);
    for (Index i = 0; i < 3; ++i) cut(areas_[i], part, low.areas_[i], high.areas_[i]);
  }

  /// Whether the features are apart all the time: if they meet, the volume is zero, and they also meet as seen along
  /// each axis.
  bool apart(Features features) const {
    if (sign(volume_[0], volume_[1], volume_[2], volume_[3], volume_error_) != 0) return true;
    for (int axis = 0; axis < 3; ++axis)
      if (features == Features::edges ? edges_apart(axis) : corner_outside(axis)) return true;
    return false;
  }

 private:
  using Quadratic = std::array<Eigen::Vector3d, 3>;

  static Quadratic area(const Moving_difference& p, const Moving_difference& q) {
    return {p.start.cross(q.start), 0.5 * (p.start.cross(q.end) + p.end.cross(q.start)), p.end.cross(q.end)};
  }
  static int sign(double a, double b, double c, double d, double error) {
    if (std::min({a, b, c, d}) > error) return 1;
    return std::max({a, b, c, d}) < -error ? -1 : 0;
  }
  int sign_of_area(Index index, int axis) const {
    const Quadratic& a = areas_[index];
    return sign(a[0][axis], a[1][axis], a[2][axis], a[2][axis], area_error_);
  }

  /// If o is in the triangle p q r, no two of the areas have opposite signs.
  bool corner_outside(int axis) const {
    const auto [least, most] = std::minmax({sign_of_area(0, axis), sign_of_area(1, axis), sign_of_area(2, axis)});
    return least * most < 0;
  }
  /// Whether q and r are on one side of the line through o and p, or these two on one side of that through q and r.
  bool edges_apart(int axis) const {
    if (sign_of_area(0, axis) * sign_of_area(2, axis) < 0) return true;
    const int side = sign_of_area(1, axis);
    if (side == 0) return false;
    const auto sum = [&](Index i) { return areas_[0][i][axis] + areas_[1][i][axis] + areas_[2][i][axis]; };
    return side * sign(sum(0), sum(1), sum(2), sum(2), 4 * area_error_) > 0;
  }

  std::array<double, 4> volume_;
  std::array<Quadratic, 3> areas_;  ///< u x v, v x w, w x u
  double volume_error_, area_error_;
};

Impact_filter::Impact_filter(const Moving_triangle& a, const Moving_triangle& b, double latest)
    : latest_(latest), face_boxes_{lodestone::box_around(a), lodestone::box_around(b)} {
  for (Index i = 0; i < 3; ++i) {
    corners_[i] = {vector(a.start[i]), vector(a.end[i])};
    corners_[i + 3] = {vector(b.start[i]), vector(b.end[i])};
  }
  for (int i = 0; i < 6; ++i) edge_boxes_[static_cast<Index>(i)] = box_around(i, next_corner(i));
}

Moving_box Impact_filter::box_around(int first, int second) const {
  const Moving_corner &p = corners_[static_cast<Index>(first)], &q = corners_[static_cast<Index>(second)];
  return {{p.start.cwiseMin(q.start), p.start.cwiseMax(q.start)}, {p.end.cwiseMin(q.end), p.end.cwiseMax(q.end)}};
}

Impact_filter::Moving_difference Impact_filter::between(int from, int to) const {
  const Moving_corner &p = corners_[static_cast<Index>(from)], &q = corners_[static_cast<Index>(to)];
  Moving_difference result{q.start - p.start, q.end - p.end, 0};
  result.size = std::max(result.start.cwiseAbs().maxCoeff(), result.end.cwiseAbs().maxCoeff());
  return result;
}

double Impact_filter::corner_and_face(int corner) const {
  const int other = corner < 3 ? 3 : 0;
  const Moving_box& face_box = face_boxes_[corner < 3 ? 1 : 0];
  if (!(overlap_time_lower_bound(box_around(corner, corner), face_box) <= latest_)) return no_contact;
  return first_possible(Features::corner_and_face, corner, other, other + 1, other + 2);
}

double Impact_filter::edges(int first, int second) const {
  if (!(overlap_time_lower_bound(edge_boxes_[static_cast<Index>(first)], edge_boxes_[static_cast<Index>(second)]) <=
        latest_))
    return no_contact;
  return first_possible(Features::edges, first, next_corner(first), second, next_corner(second));
}

/// Halves the time again and again, and drops the halves in which the features are apart, until one is short.
double Impact_filter::first_possible(Features features, int origin, int p, int q, int r) const {
  constexpr int most_halvings = 20;
  const Moving_difference u = between(origin, p), v = between(origin, q), w = between(origin, r);
  if (!(std::max({u.size, v.size, w.size}) < 1e100)) return 0;
  struct Open {
    Piece piece;
    double low, width;
  };
  Piece whole(u, v, w), rest = whole;
  // If `latest` is rounded up here, so is the interval.
  if (latest_ < 1) whole.cut_at(latest_, whole, rest);
  boost::container::static_vector<Open, most_halvings + 2> open{{whole, 0, latest_}};
  while (!open.empty()) {
    const Open now = open.back();
    open.pop_back();
    if (now.piece.apart(features)) continue;
    if (now.width <= 0x1p-20 * latest_) return (1 - 0x1p-48) * now.low;  // at most 20 roundings of sums
    const double half = 0.5 * now.width;
    open.push_back({now.piece, now.low + half, half});
    open.push_back({now.piece, now.low, half});
    now.piece.halve(open.back().piece, open[open.size() - 2].piece);
  }
  return no_contact;
}

}  // namespace lodestone
