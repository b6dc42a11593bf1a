// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/shared_corners.h"

#include <algorithm>
#include <array>
#include <boost/container/static_vector.hpp>
#include <cmath>

#include "triangles/crossing_kernel.h"
#include "triangles/exact_crossing.h"
#include "triangles/orientation.h"

namespace lodestone {

namespace {

constexpr std::size_t after(std::size_t corner) { return (corner + 1) % 3; }
constexpr std::size_t before(std::size_t corner) { return (corner + 2) % 3; }

/// A triangle without one of its coordinates. Edge i leads from corner i to the next.
class Projected_triangle {
 public:
  /// Leaves out a coordinate such that the projection has an area.
  explicit Projected_triangle(const Triangle& t) : triangle_(t) {
    const auto normal = CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
    for (int axis = 1; axis < 3; ++axis)
      if (std::abs(normal[axis]) > std::abs(normal[axis_])) axis_ = axis;
    // The normal is rounded, and may overflow, so this axis may be a bad choice.
    for (int tried = 0; tried < 3 && !project(); ++tried) axis_ = (axis_ + 1) % 3;
  }

  /// On which side of the line of edge i a point of the plane lies: positive within.
  CGAL::Sign side(std::size_t i, const Point& p) const {
    return orientation_ * CGAL::orientation(corners_[i], corners_[after(i)], projected(p));
  }
  /// Whether the triangle contains a point of its plane.
  bool contains(const Point& p) const {
    return side(0, p) != CGAL::NEGATIVE && side(1, p) != CGAL::NEGATIVE && side(2, p) != CGAL::NEGATIVE;
  }
  /// A triangle that has edge i in common with this one and stands on it: the third corner is outside its plane.
  Triangle standing_on(std::size_t i) const {
    const Point& corner = triangle_[i];
    std::array shifted{corner.x(), corner.y(), corner.z()};
    double& x = shifted[static_cast<std::size_t>(axis_)];
    x = std::abs(x) < 1 ? (x > 0 ? -1.0 : 1.0) : -x;
    return {corner, triangle_[after(i)], Point(shifted[0], shifted[1], shifted[2])};
  }

 private:
  Kernel::Point_2 projected(const Point& p) const { return {p[(axis_ + 1) % 3], p[(axis_ + 2) % 3]}; }
  bool project() {
    for (std::size_t i = 0; i < 3; ++i) corners_[i] = projected(triangle_[i]);
    orientation_ = CGAL::orientation(corners_[0], corners_[1], corners_[2]);
    return orientation_ != CGAL::ZERO;
  }

  const Triangle& triangle_;
  int axis_ = 0;  ///< left out
  std::array<Kernel::Point_2, 3> corners_;
  CGAL::Sign orientation_ = CGAL::ZERO;
};

/// Collects corners of an intersection, each once.
class Collected_corners {
 public:
  /// The lines of edges that a corner lies on: a bit per edge of a, and then per edge of b.
  using Lines = unsigned;

  void add_corner(const Point& p, Lines lines = 0) {
    // Adding zero makes -0 zero.
    points_.emplace_back(p.x() + 0.0, p.y() + 0.0, p.z() + 0.0);
    lines_.push_back(lines);
  }
  /// @param plane  the ends of the edge lie on different sides of it
  void add_crossing(const Point& from, const Point& to, const Triangle& plane, Lines lines = 0) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int corner = 0; corner < 3; ++corner)
        crossings_.plane[corner][axis][crossings_.count] = plane[static_cast<std::size_t>(corner)][axis];
      crossings_.from[axis][crossings_.count] = from[axis];
      crossings_.to[axis][crossings_.count] = to[axis];
    }
    crossing_at_[crossings_.count++] = points_.size();
    points_.emplace_back();
    lines_.push_back(lines);
  }

  Intersection_points in_order() {
    round_crossings();
    if (points_.size() > 3) go_round();
    put_in_order(points_);
    return points_;
  }

 private:
  void round_crossings() {
    if (crossings_.count == 0) return;
    kernel::Crossing_points rounded;
    kernel::crossing_points(crossings_, rounded);
    for (std::size_t i = 0; i < crossings_.count; ++i) {
      const auto vector = [i](const double(&of)[3][kernel::most_planes]) {
        return Point(of[0][i], of[1][i], of[2][i]);
      };
      points_[crossing_at_[i]] =
          rounded.proven[i]
              ? vector(rounded.coordinates)
              : exact_crossing(vector(crossings_.from), vector(crossings_.to),
                               {vector(crossings_.plane[0]), vector(crossings_.plane[1]), vector(crossings_.plane[2])});
    }
  }

  /// Two corners of a polygon are neighbours if and only if a line passes through both.
  void go_round() {
    for (std::size_t i = 0; i + 2 < points_.size(); ++i) {
      std::size_t next = i + 1;
      while ((lines_[i] & lines_[next]) == 0) ++next;
      std::swap(points_[i + 1], points_[next]);
      std::swap(lines_[i + 1], lines_[next]);
    }
  }

  Intersection_points points_;
  boost::container::static_vector<Lines, 6> lines_;
  kernel::Edges_and_planes crossings_;
  std::array<std::size_t, kernel::most_planes> crossing_at_;  ///< per crossing: its place in `points_`
};

constexpr unsigned line(std::size_t triangle, std::size_t edge) { return 1U << (3 * triangle + edge); }

using Triangles = std::array<const Triangle*, 2>;

/// Which corner of triangle 0 corner j of triangle 1 equals; 3 if none.
std::size_t equal_corner(const Triangles& triangles, std::size_t j) {
  return static_cast<std::size_t>(std::ranges::find(*triangles[0], (*triangles[1])[j]) - triangles[0]->begin());
}

Intersection_points coplanar_corners(const Triangles& triangles) {
  const std::array projected{Projected_triangle(*triangles[0]), Projected_triangle(*triangles[1])};
  // side[t][i][j] tells on which side of edge j of the other triangle corner i of triangle t lies.
  std::array<std::array<std::array<CGAL::Sign, 3>, 3>, 2> side;
  for (std::size_t t = 0; t < 2; ++t)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) side[t][i][j] = projected[1 - t].side(j, (*triangles[t])[i]);

  Collected_corners corners;
  for (std::size_t t = 0; t < 2; ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      if (std::ranges::count(side[t][i], CGAL::NEGATIVE) > 0 || (t == 1 && equal_corner(triangles, i) < 3)) continue;
      unsigned lines = line(t, i) | line(t, before(i));
      for (std::size_t j = 0; j < 3; ++j)
        if (side[t][i][j] == CGAL::ZERO) lines |= line(1 - t, j);
      corners.add_corner((*triangles[t])[i], lines);
    }
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (side[0][i][j] * side[0][after(i)][j] == CGAL::NEGATIVE &&
          side[1][j][i] * side[1][after(j)][i] == CGAL::NEGATIVE)
        corners.add_crossing((*triangles[0])[i], (*triangles[0])[after(i)], projected[1].standing_on(j),
                             line(0, i) | line(1, j));
  return corners.in_order();
}

/// On which side of the plane of the other triangle the corners of a triangle lie.
using Sides = std::array<CGAL::Sign, 3>;

Sides sides_of(const Triangle& t, const Triangle& plane) {
  const auto beside = [&](std::size_t i) { return Point_quadruple{&plane[0], &plane[1], &plane[2], &t[i]}; };
  return orientations(std::array{beside(0), beside(1), beside(2)});
}

bool all_are(const Sides& sides, CGAL::Sign sign) { return std::ranges::count(sides, sign) == 3; }

/// How a line passes a triangle whose plane it crosses.
struct Way_past {
  bool through_face;     ///< at a point in the inside
  std::size_t edge = 3;  ///< the edge that it crosses between its ends; 3 if none
};

Way_past way_past(const Point& from, const Point& to, const Triangle& t) {
  const auto beside = [&](std::size_t j) { return Point_quadruple{&from, &to, &t[j], &t[after(j)]}; };
  const Sides of_edge = orientations(std::array{beside(0), beside(1), beside(2)});
  if (all_are(of_edge, CGAL::POSITIVE) || all_are(of_edge, CGAL::NEGATIVE)) return {.through_face = true};
  const auto zero = static_cast<std::size_t>(std::ranges::find(of_edge, CGAL::ZERO) - of_edge.begin());
  if (zero < 3 && of_edge[after(zero)] * of_edge[before(zero)] == CGAL::POSITIVE)
    return {.through_face = false, .edge = zero};
  return {.through_face = false};
}

/// Of triangles in different planes.
class Transversal_corners {
 public:
  Transversal_corners(const Triangles& triangles, const std::array<Sides, 2>& sides)
      : triangles_(triangles), sides_(sides) {}

  Intersection_points operator()() {
    for (std::size_t t = 0; t < 2; ++t) {
      add_corners(t);
      add_crossings(t);
    }
    return corners_.in_order();
  }

 private:
  void add_corners(std::size_t t) {
    if (std::ranges::count(sides_[t], CGAL::ZERO) == 0) return;
    const Projected_triangle other(*triangles_[1 - t]);
    for (std::size_t i = 0; i < 3; ++i) {
      const Point& corner = (*triangles_[t])[i];
      if (sides_[t][i] == CGAL::ZERO && other.contains(corner) && (t == 0 || equal_corner(triangles_, i) == 3))
        corners_.add_corner(corner);
    }
  }

  void add_crossings(std::size_t t) {
    const Triangle& other = *triangles_[1 - t];
    for (std::size_t i = 0; i < 3; ++i) {
      if (!changes_side(t, i)) continue;
      const Point &from = (*triangles_[t])[i], &to = (*triangles_[t])[after(i)];
      const auto [through_face, edge] = way_past(from, to, other);
      // The crossing of two edges that both change sides is added with the first triangle.
      if (through_face || (edge < 3 && (t == 0 || !changes_side(0, edge)))) corners_.add_crossing(from, to, other);
    }
  }

  /// Whether edge i of triangle t leads from one side of the other plane to the other.
  bool changes_side(std::size_t t, std::size_t i) const { return sides_[t][i] * sides_[t][after(i)] == CGAL::NEGATIVE; }

  const Triangles& triangles_;
  const std::array<Sides, 2>& sides_;
  Collected_corners corners_;
};

}  // namespace

Intersection_points shared_corners(const Triangle& a, const Triangle& b) {
  const Triangles triangles{&a, &b};
  std::array<Sides, 2> sides;
  for (std::size_t t = 0; t < 2; ++t) {
    sides[t] = sides_of(*triangles[t], *triangles[1 - t]);
    if (all_are(sides[t], CGAL::POSITIVE) || all_are(sides[t], CGAL::NEGATIVE)) return {};
    if (all_are(sides[t], CGAL::ZERO)) return coplanar_corners(triangles);
  }
  return Transversal_corners(triangles, sides)();
}

void put_in_order(Intersection_points& corners) {
  // Of all ways to go round, the one that comes first in lexicographic order.
  Intersection_points way = corners, first = corners;
  for (int direction = 0; direction < 2; ++direction) {
    for (std::size_t start = 0; start < way.size(); ++start) {
      std::rotate(way.begin(), way.begin() + 1, way.end());
      if (way < first) first = way;
    }
    std::ranges::reverse(way);
  }
  corners = first;
}

}  // namespace lodestone
