// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/slab_polytope.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace lodestone {
namespace {

using Vector = Eigen::Vector3d;
using Polygon = std::vector<Vector>;

/// The points p with normal . p <= height; the normal is a unit vector.
struct Half_space {
  Vector normal;
  double height;

  double beyond(const Vector& p) const { return normal.dot(p) - height; }
};

/// The half-spaces of both sides of every bounded slab, in units of `size` relative to `centre`.
std::vector<Half_space> half_spaces(std::span<const Slab> slabs, const Vector& centre, double size) {
  std::vector<Half_space> result;
  for (const auto& slab : slabs) {
    const Vector direction(slab.direction[0], slab.direction[1], slab.direction[2]);
    const double length = direction.norm(), middle = direction.dot(centre);
    const Vector normal = direction / length;
    if (std::isfinite(slab.high)) result.push_back({normal, (slab.high - middle) / size / length});
    if (std::isfinite(slab.low)) result.push_back({-normal, (middle - slab.low) / size / length});
  }
  return result;
}

/// The part of a half-space's boundary plane within 2 of the foot of the perpendicular from the centre.
Polygon square(const Half_space& half_space) {
  const Vector u = half_space.normal.unitOrthogonal(), v = half_space.normal.cross(u);
  const Vector foot = half_space.height * half_space.normal;
  return {foot + 2 * (u + v), foot + 2 * (v - u), foot - 2 * (u + v), foot + 2 * (u - v)};
}

/// The part of a convex polygon that lies in a half-space (Sutherland and Hodgman's clipping).
Polygon clipped(const Polygon& polygon, const Half_space& half_space) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double from = half_space.beyond(p), to = half_space.beyond(q);
    if (from <= 0) result.push_back(p);
    if ((from < 0 && to > 0) || (from > 0 && to < 0)) result.push_back(p + from / (from - to) * (q - p));
  }
  return result;
}

double area(const Polygon& polygon) {
  Vector twice = Vector::Zero();
  for (std::size_t i = 2; i < polygon.size(); ++i)
    twice += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  return twice.norm() / 2;
}

}  // namespace

double polytope_volume(std::span<const Slab> slabs, const Aabb& box) {
  const Vector low(box.low[0], box.low[1], box.low[2]), high(box.high[0], box.high[1], box.high[2]);
  const double size = (high - low).maxCoeff();
  if (!std::isfinite(size)) return std::numeric_limits<double>::infinity();
  if (size == 0) return 0;
  const auto sides = half_spaces(slabs, low / 2 + high / 2, size);
  double volume = 0;  // of the pyramids from the centre to the faces
  for (const auto& side : sides) {
    Polygon face = square(side);
    for (const auto& other : sides)
      if (&other != &side) face = clipped(face, other);
    volume += side.height * area(face) / 3;
  }
  return std::max(volume, 0.0) * size * size * size;
}

}  // namespace lodestone
