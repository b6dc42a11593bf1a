// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/impact_filter.h"

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <limits>

namespace lodestone {

namespace {

constexpr double no_contact = std::numeric_limits<double>::infinity();

Eigen::Vector3d vector(const Point& p) { return {p.x(), p.y(), p.z()}; }

int next_corner(int corner) { return corner < 3 ? (corner + 1) % 3 : 3 + (corner + 1) % 3; }

/// Cuts a polynomial in Bernstein's form at a part of its interval: de Casteljau.
/// @param low   is left with the coefficients for what lies before
/// @param high  those for what lies after
template <class Coefficient, class Number, std::size_t size>
void cut(const std::array<Coefficient, size>& whole, const Number& part, std::array<Coefficient, size>& low,
         std::array<Coefficient, size>& high) {
  std::array<Coefficient, size> row = whole;
  for (std::size_t length = size; length > 0; --length) {
    low[size - length] = row[0];
    high[length - 1] = row[length - 1];
    for (std::size_t i = 0; i + 1 < length; ++i) row[i] = (Number(1) - part) * row[i] + part * row[i + 1];
  }
}

/// The sign of a polynomial all the time, from its coefficients in Bernstein's form; 0 if it may change.
/// @param error  a bound of that of each coefficient
template <class Number>
int lasting_sign(std::initializer_list<Number> coefficients, double error) {
  if (std::ranges::all_of(coefficients, [error](const Number& c) { return c > error; })) return 1;
  return std::ranges::all_of(coefficients, [error](const Number& c) { return c < -error; }) ? -1 : 0;
}

/// Whether products of three components cannot overflow, nor what double-double multiplies them by.
template <class Differences>
bool are_moderate(const Differences& differences) {
  return std::ranges::all_of(differences, [](const auto& difference) { return difference.size < 1e95; });
}

/// By which power of two the error bounds for double become those for a number type.
template <class Number>
constexpr double finer = 1;
/// 2^-99 is the largest relative error of an operation, where it is 2^-53 in double.
template <>
constexpr double finer<Double_double> = 0x1p-46;

}  // namespace

/// Twice the area that two differences span: a quadratic polynomial in Bernstein's form.
template <class Number>
Impact_filter::Quadratic<Number> Impact_filter::area(const Moving_difference<Number>& p,
                                                     const Moving_difference<Number>& q) {
  return {p.start.cross(q.start), Number(0.5) * (p.start.cross(q.end) + p.end.cross(q.start)), p.end.cross(q.end)};
}

/// Polynomials of a pair of features over an interval of time. Its four corners are o, p, q and r; u, v and w are the
/// differences of the last three from o. The volume is the determinant of u, v and w; areas are u x v, v x w and w x u.
///
/// With eps = 2^-53 and all components of u, v and w at most m, each term of a coefficient is a product of three of
/// these, with a rounding of each difference and two of products. There are at most 18 terms, in a mean of three
/// determinants, which carry at most 10 roundings of sums. A halving adds three roundings of coefficients of at most
/// 6 m^3, each of the first two cuts nine, and there are at most 20 halvings. So the error is below
/// (15 + 78) eps 6 m^3 < 2^-43 m^3.
/// Likewise that of an area is below 2^-45 m^2. What underflows is below 10^-200, as m is below 10^95.
template <class Number>
class Impact_filter::Volume {
 public:
  explicit Volume(const std::array<Moving_difference<Number>, 3>& differences)
      : Volume(differences, area(differences[1], differences[2])) {}
  /// @param a  v x w
  Volume(const std::array<Moving_difference<Number>, 3>& differences, const Quadratic<Number>& a) {
    const auto& [u, v, w] = differences;
    const Number third = Number(1) / Number(3);
    coefficients_ = {u.start.dot(a[0]), third * (u.end.dot(a[0]) + Number(2) * u.start.dot(a[1])),
                     third * (Number(2) * u.end.dot(a[1]) + u.start.dot(a[2])), u.end.dot(a[2])};
    const double size = std::max({u.size, v.size, w.size});
    error_ = finer<Number> * 0x1p-41 * size * size * size + 1e-200;
  }

  void cut_at(const Number& part, Volume& low, Volume& high) const {
    low = high = *this;
    cut(coefficients_, part, low.coefficients_, high.coefficients_);
  }
  /// Whether it is not zero at any time.
  bool keeps_its_sign() const {
    const auto& c = coefficients_;
    return lasting_sign({c[0], c[1], c[2], c[3]}, error_) != 0;
  }

 private:
  std::array<Number, 4> coefficients_;
  double error_;
};

template <class Number>
class Impact_filter::Piece {
 public:
  explicit Piece(const std::array<Moving_difference<Number>, 3>& differences)
      : areas_{area(differences[0], differences[1]), area(differences[1], differences[2]),
               area(differences[2], differences[0])},
        volume_(differences, areas_[1]) {
    const auto& [u, v, w] = differences;
    const double size = std::max({u.size, v.size, w.size});
    area_error_ = finer<Number> * 0x1p-42 * size * size + 1e-200;
  }

  void halve(Piece& low, Piece& high) const { cut_at(Number(0.5), low, high); }
  void cut_at(const Number& part, Piece& low, Piece& high) const {
    low = high = *this;
    volume_.cut_at(part, low.volume_, high.volume_);
    for (Index i = 0; i < 3; ++i) cut(areas_[i], part, low.areas_[i], high.areas_[i]);
  }

  /// Whether the features are apart all the time: if they meet, the volume is zero, and they also meet as seen along
  /// each axis.
  bool apart(const Features& features) const {
    if (volume_.keeps_its_sign()) return true;
    for (int axis = 0; axis < 3; ++axis)
      if (features.are_edges ? edges_apart(axis) : corner_outside(axis)) return true;
    return false;
  }

 private:
  int sign_of_area(Index index, int axis) const {
    const Quadratic<Number>& a = areas_[index];
    return lasting_sign({a[0][axis], a[1][axis], a[2][axis]}, area_error_);
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
    return side * lasting_sign<Number>({sum(0), sum(1), sum(2)}, 4 * area_error_) > 0;
  }

  std::array<Quadratic<Number>, 3> areas_;  ///< u x v, v x w, w x u
  Volume<Number> volume_;
  double area_error_;
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

template <class Number>
Impact_filter::Moving_difference<Number> Impact_filter::between(int from, int to) const {
  const auto difference = [](const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
    return Eigen::Matrix<Number, 3, 1>(Number(q[0]) - Number(p[0]), Number(q[1]) - Number(p[1]),
                                       Number(q[2]) - Number(p[2]));
  };
  const Moving_corner &p = corners_[static_cast<Index>(from)], &q = corners_[static_cast<Index>(to)];
  const Eigen::Vector3d start = q.start - p.start, end = q.end - p.end;
  return {difference(p.start, q.start), difference(p.end, q.end),
          std::max(start.cwiseAbs().maxCoeff(), end.cwiseAbs().maxCoeff())};
}

template <class Number>
std::array<Impact_filter::Moving_difference<Number>, 3> Impact_filter::differences(const Features& features) const {
  const auto [o, p, q, r] = features.corners;
  return {between<Number>(o, p), between<Number>(o, q), between<Number>(o, r)};
}

Impact_filter::Features Impact_filter::features_of_corner(int corner) {
  const int other = corner < 3 ? 3 : 0;
  return {.are_edges = false, .corners = {corner, other, other + 1, other + 2}};
}

Impact_filter::Features Impact_filter::features_of_edges(int first, int second) {
  return {.are_edges = true, .corners = {first, next_corner(first), second, next_corner(second)}};
}

double Impact_filter::corner_and_face(int corner) const {
  const Moving_box& face_box = face_boxes_[corner < 3 ? 1 : 0];
  if (!(overlap_time_lower_bound(box_around(corner, corner), face_box) <= latest_)) return no_contact;
  return first_possible(features_of_corner(corner));
}

double Impact_filter::edges(int first, int second) const {
  if (!(overlap_time_lower_bound(edge_boxes_[static_cast<Index>(first)], edge_boxes_[static_cast<Index>(second)]) <=
        latest_))
    return no_contact;
  return first_possible(features_of_edges(first, second));
}

bool Impact_filter::corner_and_face_apart(int corner, double bound, const Double_double& until) const {
  return apart(features_of_corner(corner), bound, until);
}

bool Impact_filter::edges_apart(int first, int second, double bound, const Double_double& until) const {
  return apart(features_of_edges(first, second), bound, until);
}

/// Halves the time again and again, and drops the halves in which the features are apart, until one is short.
double Impact_filter::first_possible(const Features& features) const {
  constexpr int most_halvings = 20;
  constexpr double shortest = 0x1p-20;
  const auto differences = this->differences<double>(features);
  if (!are_moderate(differences)) return 0;
  struct Open {
    Piece<double> piece;
    double low, width;
  };
  Piece<double> whole(differences), rest = whole;
  // If `latest` is rounded up here, so is the interval.
  if (latest_ < 1) whole.cut_at(latest_, whole, rest);
  if (whole.apart(features)) return no_contact;
  // Features that can meet only near `latest` take two pieces instead of halvings.
  const double end = (1 - shortest) * latest_;
  boost::container::static_vector<Open, most_halvings + 3> open{{whole, end, shortest * latest_}, {whole, 0, end}};
  whole.cut_at(1 - shortest, open[1].piece, open[0].piece);
  while (!open.empty()) {
    const Open now = open.back();
    open.pop_back();
    if (now.piece.apart(features)) continue;
    if (now.width <= shortest * latest_) return (1 - 0x1p-48) * now.low;  // at most 20 roundings of sums
    const double half = 0.5 * now.width;
    open.push_back({now.piece, now.low + half, half});
    open.push_back({now.piece, now.low, half});
    now.piece.halve(open.back().piece, open[open.size() - 2].piece);
  }
  return no_contact;
}

bool Impact_filter::apart(const Features& features, double from, const Double_double& until) const {
  if (Double_double(from) >= until) return true;
  const auto differences = this->differences<Double_double>(features);
  if (!are_moderate(differences)) return false;
  const auto is_apart = [&](auto piece, const auto& apart_in) {
    auto rest = piece;
    piece.cut_at(until, piece, rest);
    // If the quotient is rounded up, the piece begins later by a factor of 1 + 2^-99 at most, which is less than
    // `first_possible` has rounded down by. The quotient of tiny numbers could have a larger error.
    if (from > 0x1p-500) piece.cut_at(Double_double(from) / until, rest, piece);
    return apart_in(piece);
  };
  return is_apart(Volume(differences), [](const auto& volume) { return volume.keeps_its_sign(); }) ||
         is_apart(Piece(differences), [&](const auto& piece) { return piece.apart(features); });
}

}  // namespace lodestone
