// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/fan_projection.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

// Let the arms d_0, d_1, ... go from the vertex to its rim, and look along a direction n. Suppose that all
// det(n, d_i, d_i+1) have one sign, say above zero. Then the projected arms turn counter-clockwise, each step by an
// angle within (0, pi), and no face is seen edge-on. If they turn by less than a whole turn from first to last, or by
// exactly one around a closed rim, then the projected faces are wedges side by side: two of them meet in the projected
// vertex only, or, if they are neighbours, in the ray of their common arm. Over that ray each face has only the arm
// itself. So the faces meet only in the vertex and in common edges.
//
// To count turns, take a line through the projected vertex; arms on the line count as above it. A step below pi skips
// neither the closed half-plane above nor the open one below, so the arms change sides once per half turn.
//  - At most one change: from first to last the arms turn by less than a whole turn.
//  - Two changes around a closed rim: they turn by exactly a whole turn.
//  - Two changes along an open rim: both more and less than a whole turn are possible, unless the step from the last
//    arm to the first is within (0, pi) too. Then the rim can be treated as closed: closing it adds no change, since
//    the number of changes around a closed rim is even.

namespace lodestone {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// What one pass along a rim finds.
struct Turns {
  double least = infinity, most = -infinity;  ///< of det(n, d_i, d_i+1)
  int changes = 0;                            ///< of side

  void step(double determinant, bool changes_side) {
    least = std::min(least, determinant);
    most = std::max(most, determinant);
    changes += changes_side ? 1 : 0;
  }

  /// Whether the projected faces are proven to lie side by side.
  /// @param closing  det(n, last arm, first arm) of an open rim
  /// @param error    of each determinant
  bool side_by_side(double error, bool closed, double closing) const {
    if (!(least > error || most < -error)) return false;
    return changes < 2 || (changes == 2 && (closed || (least > 0 ? closing > error : closing < -error)));
  }
};

/// The axis nearest to the direction in which the rim is seen: along the cross product of its two diagonals.
int likely_axis(const double* positions, std::span<const std::uint32_t> rim) {
  const std::size_t faces = rim.size() - 1;
  const double* a = positions + std::size_t{3} * rim[0];
  const double* b = positions + std::size_t{3} * rim[faces / 4];
  const double* c = positions + std::size_t{3} * rim[faces / 2];
  const double* d = positions + std::size_t{3} * rim[3 * faces / 4];
  const double ux = c[0] - a[0], uy = c[1] - a[1], uz = c[2] - a[2];
  const double vx = d[0] - b[0], vy = d[1] - b[1], vz = d[2] - b[2];
  const double x = std::abs(uy * vz - uz * vy), y = std::abs(uz * vx - ux * vz), z = std::abs(ux * vy - uy * vx);
  const bool beyond_x = std::max(y, z) > x;
  return beyond_x ? (z > y ? 2 : 1) : 0;
}

/// Projects along an axis: det(n, d_i, d_i+1) is one component of a cross product, and sides are signs of a coordinate.
bool spread_along_axis(const double* positions, std::uint32_t vertex, std::span<const std::uint32_t> rim) {
  const int axis = likely_axis(positions, rim);
  const double* xs = positions + (axis + 1) % 3;
  const double* ys = positions + (axis + 2) % 3;
  const double x = xs[std::size_t{3} * vertex], y = ys[std::size_t{3} * vertex];

  const double first_x = xs[std::size_t{3} * rim[0]] - x, first_y = ys[std::size_t{3} * rim[0]] - y;
  double from_x = first_x, from_y = first_y;
  double reach_x = std::abs(from_x), reach_y = std::abs(from_y);
  Turns turns;
  for (const auto neighbour : rim.subspan(1)) {
    const double to_x = xs[std::size_t{3} * neighbour] - x, to_y = ys[std::size_t{3} * neighbour] - y;
    turns.step(from_x * to_y - from_y * to_x, (from_y < 0) != (to_y < 0));
    reach_x = std::max(reach_x, std::abs(to_x));
    reach_y = std::max(reach_y, std::abs(to_y));
    from_x = to_x, from_y = to_y;
  }
  const double size = reach_x * reach_y;
  return measurable(size) &&
         turns.side_by_side(cross_error * size, rim.front() == rim.back(), from_x * first_y - from_y * first_x);
}

/// Projects along the sum n of all normals, divided by its largest coordinate. However n was rounded, the line has the
/// direction g = n_a e_b - n_b e_a, which is perpendicular to n; a is the axis of the largest coordinate, b the next
/// axis.
bool spread_along_normal(const double* positions, std::uint32_t vertex, std::span<const std::uint32_t> rim) {
  using Eigen::Vector3d;
  const auto point = [&](std::uint32_t v) { return Eigen::Map<const Vector3d>(positions + std::size_t{3} * v); };
  const Vector3d origin = point(vertex);
  const auto arm = [&](std::uint32_t neighbour) { return Vector3d(point(neighbour) - origin); };

  const Vector3d first = arm(rim.front());
  Vector3d n = Vector3d::Zero(), from = first;
  double reach = from.lpNorm<Eigen::Infinity>();
  for (const auto neighbour : rim.subspan(1)) {
    const Vector3d to = arm(neighbour);
    n += from.cross(to);
    reach = std::max(reach, to.lpNorm<Eigen::Infinity>());
    from = to;
  }
  int a = 0;
  const double largest = n.cwiseAbs().maxCoeff(&a);
  const double size = reach * reach;
  if (!measurable(size) || !measurable(largest)) return false;
  n /= largest;  // now |n_a| is 1 and no coordinate is larger
  const int b = (a + 1) % 3;

  // Whether the side of an arm is certain. Each of its two products has a relative error below 4 u.
  const auto has_side = [&](const Vector3d& d) {
    const double p = n[a] * d[b], q = n[b] * d[a], size_of_both = std::abs(p) + std::abs(q);
    if (d[b] == 0 && (d[a] == 0 || n[b] == 0)) return true;  // on the line
    return measurable(size_of_both) && std::abs(p - q) > cross_error * size_of_both;
  };
  const auto below = [&](const Vector3d& d) { return n[a] * d[b] - n[b] * d[a] < 0; };

  from = first;
  if (!has_side(from)) return false;
  Turns turns;
  for (const auto neighbour : rim.subspan(1)) {
    const Vector3d to = arm(neighbour);
    if (!has_side(to)) return false;
    turns.step(n.dot(from.cross(to)), below(from) != below(to));
    from = to;
  }
  return turns.side_by_side(volume_error * size, rim.front() == rim.back(), n.dot(from.cross(first)));
}

}  // namespace

bool surely_spread(const double* positions, std::uint32_t vertex, std::span<const std::uint32_t> rim) {
  return spread_along_axis(positions, vertex, rim) || spread_along_normal(positions, vertex, rim);
}

}  // namespace lodestone
