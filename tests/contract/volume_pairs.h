// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs of leaves that just meet or are just apart.
#pragma once

#include <cmath>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "contract/volume_leaves.h"
#include "lodestone/triangles/triangle_distance.h"
#include "support/distance_oracle.h"
#include "support/hard_pairs.h"

namespace lodestone {

inline std::string text(const Face_soup& soup) {
  std::ostringstream out;
  out << std::hexfloat;
  for (std::size_t f = 0; f < std::min<std::size_t>(soup.faces.size(), 4); ++f)
    for (const auto& p : soup.triangle(f)) out << '{' << p.x() << ", " << p.y() << ", " << p.z() << "} ";
  return out.str();
}

inline Triangle placed(const Triangle& t, const Placement& place) {
  Triangle result;
  for (int i = 0; i < 3; ++i) {
    const Point& p = t[i];
    result[i] = Point(place.scale * (p.x() + place.offset[0]), place.scale * (p.y() + place.offset[1]),
                      place.scale * (p.z() + place.offset[2]));
  }
  return result;
}

inline bool finite(const Triangle& t) {
  return std::ranges::all_of(
      t, [](const Point& p) { return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z()); });
}

/// Mostly unchanged; sometimes far from the origin, or in units where squares overflow or underflow.
inline Placement any_placement(std::mt19937_64& random) {
  static const std::vector<Placement> others = [] {
    std::vector<Placement> all = far_places();
    for (const double scale : {0x1p-300, 0x1p300, 0x1p-537, 0x1p-1070, 1e154, 0x1p1015}) all.push_back({scale, {}});
    return all;
  }();
  return random() % 2 == 0 ? Placement{} : others[random() % others.size()];
}

/// The image of a soup under point reflection in one of its vertices, which both share. At a corner of the convex hull,
/// a tight volume around one of them ends there or just beyond.
inline Face_soup mirrored(Face_soup soup, std::uint32_t vertex) {
  const Point centre = soup.point(vertex);
  for (std::size_t i = 0; i < soup.coordinates.size(); ++i)
    if (i / 3 != vertex)
      soup.coordinates[i] = centre[static_cast<int>(i % 3)] + (centre[static_cast<int>(i % 3)] - soup.coordinates[i]);
  return soup;
}

/// A triangle of any shape within [-1, 1]^3.
inline Triangle any_triangle(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto point = [&](double size) {
    const double x = size * unit(random), y = size * unit(random), z = size * unit(random);
    return Point(x, y, z);
  };
  Triangle t{point(1), point(1), point(1)};
  if (random() % 4 == 0) {  // a sliver or a small one
    const Point step = point(std::pow(10, -16 * std::abs(unit(random))));
    t[1] = Point(t[0].x() + step.x(), t[0].y() + step.y(), t[0].z() + step.z());
  }
  if (random() % 4 == 0) {  // parallel to axes or diagonals
    for (auto& p : t) p = Point(std::round(4 * p.x()) / 4, std::round(4 * p.y()) / 4, std::round(4 * p.z()) / 4);
  }
  return t;
}

/// 2 to 30 neighbouring faces of several kinds of surfaces, randomly rotated, within about [-1, 1]^3; no other
/// vertices.
class Face_groups {
 public:
  Face_soup operator()(std::mt19937_64& random) const {
    const Face_soup& source = sources_[random() % sources_.size()];
    const std::size_t count = 2 + random() % 29, first = random() % (source.faces.size() - count);
    std::vector<Triangle> triangles;
    for (std::size_t f = first; f < first + count; ++f) triangles.push_back(source.triangle(f));
    const auto group = soup_of(triangles);
    return random() % 3 == 0 ? group : posed_at_random(group, 0, random);
  }

 private:
  std::vector<Face_soup> sources_{
      icosphere(4),
      placed(icosphere(2), 0.4),
      crumpled(icosphere(3), 0.1, 1),
      placed(cloth(9, 8), 1, -0.5),
      bent(cloth(9, 8), [](const Point& p) { return Point(p.x() - 0.5, p.y() - 0.5, p.x() * p.y()); }),
      placed(lattice_soup(200, 60, 5, 2), 0.25, -0.5),
      loose_triangles(60, 0.3, 3),
      placed(cube(4), 1, -0.5)};
};

/// Whether two soups have faces that intersect, and whether they have faces no farther apart than `margin`: exact.
inline bool soups_meet(const Face_soup& a, const Face_soup& b) {
  for (std::size_t f = 0; f < a.faces.size(); ++f)
    for (std::size_t g = 0; g < b.faces.size(); ++g)
      if (triangles_intersect(a.triangle(f), b.triangle(g))) return true;
  return false;
}
inline bool within_margin(const Triangle& a, const Triangle& b, double margin) {
  if (!triangles_nearer_than(a, b, std::nextafter(margin, std::numeric_limits<double>::infinity()))) return false;
  return exact_squared_distance(a, b) <= Rational(margin) * Rational(margin);
}
inline bool within_margin(const Face_soup& a, const Face_soup& b, double margin) {
  for (std::size_t f = 0; f < a.faces.size(); ++f)
    for (std::size_t g = 0; g < b.faces.size(); ++g)
      if (within_margin(a.triangle(f), b.triangle(g), margin)) return true;
  return false;
}

/// An upper bound of the distance of two points, at most a few units in the last place above it.
inline double distance_rounded_up(const Point& p, const Point& q) {
  Rational squared = 0;
  double rounded[3];
  for (int axis = 0; axis < 3; ++axis) {
    const Rational difference = Rational(p[axis]) - Rational(q[axis]);
    squared += difference * difference;
    rounded[axis] = CGAL::to_double(difference);
  }
  double distance = std::hypot(rounded[0], rounded[1], rounded[2]) * (1 - 0x1p-50);
  while (std::isfinite(distance) && Rational(distance) * Rational(distance) < squared)
    distance = std::nextafter(distance, std::numeric_limits<double>::infinity());
  return distance;
}

}  // namespace lodestone
