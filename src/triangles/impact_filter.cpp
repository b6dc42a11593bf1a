// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/impact_filter.h"

#include <algorithm>
#include <cmath>

namespace lodestone {

namespace {

Eigen::Vector3d vector(const Point& p) { return {p.x(), p.y(), p.z()}; }

/// The four coefficients of a cubic polynomial in Bernstein's form over [0, 1], then over [0, until]: de Casteljau.
struct Bernstein_cubic {
  double b[4];

  void cut(double until) {
    for (int round = 1; round < 4; ++round)
      for (int i = 3; i >= round; --i) b[i] = (1 - until) * b[i - 1] + until * b[i];
  }
  bool has_sign(double beyond) const {
    const auto [least, most] = std::minmax({b[0], b[1], b[2], b[3]});
    return least > beyond || most < -beyond;
  }
};

}  // namespace

Impact_filter::Impact_filter(const Moving_triangle& a, const Moving_triangle& b, double latest) : latest_(latest) {
  for (Index i = 0; i < 3; ++i) {
    corners_[i] = {vector(a.start[i]), vector(a.end[i])};
    corners_[i + 3] = {vector(b.start[i]), vector(b.end[i])};
  }
  overlap_from_ = overlap_time_lower_bound(box_around(std::array{0, 1, 2}), box_around(std::array{3, 4, 5}));
}

Moving_box Impact_filter::box_around(std::span<const int> corners) const {
  Moving_box box;
  for (const int index : corners) {
    box.start.extend(corner(index).start);
    box.end.extend(corner(index).end);
  }
  return box;
}

bool Impact_filter::boxes_apart(const Moving_box& a, const Moving_box& b) const {
  return !(overlap_time_lower_bound(a, b) <= latest_);
}

Impact_filter::Moving_difference Impact_filter::between(int from, int to) const {
  Moving_difference result{corner(to).start - corner(from).start, corner(to).end - corner(from).end, 0};
  result.size = std::max(result.start.cwiseAbs().maxCoeff(), result.end.cwiseAbs().maxCoeff());
  return result;
}

bool Impact_filter::corner_and_face_apart(int corner, const std::array<int, 3>& face) const {
  return boxes_apart(box_around(std::array{corner}), box_around(face)) ||
         never_in_one_plane(corner, face[0], face[1], face[2]);
}

bool Impact_filter::edges_apart(const std::array<int, 2>& first, const std::array<int, 2>& second) const {
  return boxes_apart(box_around(first), box_around(second)) ||
         never_in_one_plane(first[0], first[1], second[0], second[1]);
}

/// The determinant of three moving differences u, v and w is a cubic polynomial, which has no root where its Bernstein
/// coefficients have one sign. These are means of determinants of u, v and w at the start or the end.
///
/// With eps = 2^-53 and sizes U, V and W, a determinant is a sum of six products of at most U V W. Each product carries
/// three roundings of differences, two of products and at most six of sums; the mean of three, and cutting, add fewer
/// than 20 roundings. So the error is below 6 x 31 eps U V W < 2^-45 U V W. What underflows is below 10^-200, as sizes
/// are below 10^100.
bool Impact_filter::never_in_one_plane(int origin, int p, int q, int r) const {
  const Moving_difference u = between(origin, p), v = between(origin, q), w = between(origin, r);
  if (!(std::max({u.size, v.size, w.size}) < 1e100)) return false;
  const Eigen::Vector3d at_start = v.start.cross(w.start), at_end = v.end.cross(w.end),
                        mixed = v.start.cross(w.end) + v.end.cross(w.start);
  constexpr double third = 1.0 / 3;
  Bernstein_cubic cubic{{u.start.dot(at_start), third * (u.end.dot(at_start) + u.start.dot(mixed)),
                         third * (u.end.dot(mixed) + u.start.dot(at_end)), u.end.dot(at_end)}};
  if (latest_ < 1) cubic.cut(latest_);
  return cubic.has_sign(0x1p-44 * u.size * v.size * w.size + 1e-200);
}

}  // namespace lodestone
