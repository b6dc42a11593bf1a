// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/crossing_segment.h"

#include <algorithm>
#include <cmath>

#include "triangles/crossing_kernel.h"
#include "triangles/orientation.h"

namespace lodestone {

namespace {

/// On which side of the plane through p, q and r points lie. Exact: what doubles cannot tell is left to `orientation`.
class Side_test {
 public:
  Side_test(const Point& p, const Point& q, const Point& r) : p_(p), q_(q), r_(r) {
    const auto u = q - p, v = r - p;
    normal_ = CGAL::cross_product(u, v);
    size_ = size(u) * size(v);
  }

  CGAL::Orientation operator()(const Point& s) const {
    const auto w = s - p_;
    const double height = normal_ * w;
    // \cite shewchuk1997: the error is below (7 + 56 e) e times the sum of the six products, each at most `size_` |w|.
    const double bound = 0x1p-47 * size_ * size(w);
    constexpr double tiny = 0x1p-900, huge = 0x1p900;
    if (std::abs(height) > bound && size_ > tiny && bound > tiny && bound < huge && size_ < huge)
      return height > 0 ? CGAL::POSITIVE : CGAL::NEGATIVE;
    return orientation(p_, q_, r_, s);
  }

 private:
  static double size(const Kernel::Vector_3& v) {
    return std::max({std::abs(v.x()), std::abs(v.y()), std::abs(v.z())});
  }

  const Point &p_, &q_, &r_;
  Kernel::Vector_3 normal_;
  double size_;  ///< product of the largest coordinates of q - p and r - p
};

/// The corners of a triangle of which one is on one side of a plane, and the two others on the other.
struct Split_corners {
  const Point* lone;
  std::array<const Point*, 2> others;
};

/// @return none unless the plane of the other triangle passes between the corners
std::optional<Split_corners> split(const Triangle& t, const Triangle& other) {
  const Side_test side_of(other[0], other[1], other[2]);
  const std::array side{side_of(t[0]), side_of(t[1]), side_of(t[2])};
  if (side[0] == CGAL::ZERO || side[1] == CGAL::ZERO || side[2] == CGAL::ZERO) return {};
  if (side[0] == side[1] && side[0] == side[2]) return {};
  const std::size_t lone = side[0] == side[1] ? 2 : side[0] == side[2] ? 1 : 0;
  return Split_corners{&t[lone], {&t[(lone + 1) % 3], &t[(lone + 2) % 3]}};
}

/// The edges of two triangles that end the segment in which they cross.
class Ending_edges {
 public:
  /// Appends the two edges of a pair.
  /// @return false if they do not cross, or if a corner or edge of one touches the other; then nothing is appended
  bool add(const Triangle& a, const Triangle& b) {
    const auto corners_a = split(a, b), corners_b = corners_a ? split(b, a) : std::nullopt;
    if (!corners_b) return false;
    // The edges from a lone corner cross the line in which the planes meet: those of a at P0 and P1, those of b at Q0
    // and Q1. Of i and j, ordered[i][j] tells on which side of Qj Pi lies.
    std::array<std::array<CGAL::Orientation, 2>, 2> ordered;
    for (std::size_t j = 0; j < 2; ++j) {
      const Side_test side_of(*corners_a->lone, *corners_b->lone, *corners_b->others[j]);
      for (std::size_t i = 0; i < 2; ++i) {
        ordered[i][j] = side_of(*corners_a->others[i]);
        if (ordered[i][j] == CGAL::ZERO) return false;
      }
    }
    // The segment ends where one of P0 and P1 lies between Q0 and Q1, or the reverse.
    const std::size_t before = edges_.count;
    for (std::size_t i = 0; i < 2; ++i)
      if (ordered[i][0] != ordered[i][1]) add(*corners_a, i, b);
    for (std::size_t j = 0; j < 2; ++j)
      if (ordered[0][j] != ordered[1][j]) add(*corners_b, j, a);
    return edges_.count > before;  // else the triangles are apart
  }

  const kernel::Edges_and_planes& edges() const { return edges_; }

 private:
  void add(const Split_corners& corners, std::size_t other, const Triangle& plane) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int corner = 0; corner < 3; ++corner) edges_.plane[corner][axis][edges_.count] = plane[corner][axis];
      edges_.from[axis][edges_.count] = (*corners.lone)[axis];
      edges_.to[axis][edges_.count] = (*corners.others[other])[axis];
    }
    ++edges_.count;
  }

  kernel::Edges_and_planes edges_;
};

}  // namespace

void crossing_segments(std::span<const Triangle_pair> pairs, std::span<std::optional<Crossing_segment>> segments) {
  Ending_edges ending;
  std::array<bool, most_crossing_pairs> cross{};
  for (std::size_t pair = 0; pair < pairs.size(); ++pair) cross[pair] = ending.add(pairs[pair].a, pairs[pair].b);

  kernel::Crossing_points points;
  kernel::crossing_points(ending.edges(), points);
  const auto point = [&points](std::size_t edge) {
    const auto& [x, y, z] = points.coordinates;
    return Point(x[edge], y[edge], z[edge]);
  };
  std::size_t edge = 0;
  for (std::size_t pair = 0; pair < pairs.size(); ++pair) {
    segments[pair].reset();
    if (!cross[pair]) continue;
    if (points.proven[edge] && points.proven[edge + 1]) {
      const Point first = point(edge), last = point(edge + 1);
      segments[pair] = last < first ? Crossing_segment{last, first} : Crossing_segment{first, last};
    }
    edge += 2;
  }
}

}  // namespace lodestone
