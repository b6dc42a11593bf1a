// SPDX-License-Identifier: GPL-3.0-or-later
#include "contract/volume_pairs.h"

namespace lodestone {

std::string text(const Face_soup& soup) {
  std::ostringstream out;
  out << std::hexfloat;
  for (std::size_t f = 0; f < std::min<std::size_t>(soup.faces.size(), 4); ++f)
    for (const auto& p : soup.triangle(f)) out << '{' << p.x() << ", " << p.y() << ", " << p.z() << "} ";
  return out.str();
}

Triangle placed(const Triangle& t, const Placement& place) {
  Triangle result;
  for (int i = 0; i < 3; ++i) {
    const Point& p = t[i];
    result[i] = Point(place.scale * (p.x() + place.offset[0]), place.scale * (p.y() + place.offset[1]),
                      place.scale * (p.z() + place.offset[2]));
  }
  return result;
}

bool finite(const Triangle& t) {
  return std::ranges::all_of(
      t, [](const Point& p) { return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z()); });
}

Placement any_placement(std::mt19937_64& random) {
  static const std::vector<Placement> others = [] {
    std::vector<Placement> all = far_places();
    for (const double scale : {0x1p-300, 0x1p300, 0x1p-537, 0x1p-1070, 1e154, 0x1p1015}) all.push_back({scale, {}});
    return all;
  }();
  return random() % 2 == 0 ? Placement{} : others[random() % others.size()];
}

Face_soup mirrored(Face_soup soup, std::uint32_t vertex) {
  const Point centre = soup.point(vertex);
  for (std::size_t i = 0; i < soup.coordinates.size(); ++i)
    if (i / 3 != vertex)
      soup.coordinates[i] = centre[static_cast<int>(i % 3)] + (centre[static_cast<int>(i % 3)] - soup.coordinates[i]);
  return soup;
}

Triangle any_triangle(std::mt19937_64& random) {
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

bool soups_meet(const Face_soup& a, const Face_soup& b) {
  for (std::size_t f = 0; f < a.faces.size(); ++f)
    for (std::size_t g = 0; g < b.faces.size(); ++g)
      if (triangles_intersect(a.triangle(f), b.triangle(g))) return true;
  return false;
}

bool within_margin(const Triangle& a, const Triangle& b, double margin) {
  // Rational numbers only where the last digit decides.
  if (!triangles_nearer_than(a, b, std::nextafter(margin, std::numeric_limits<double>::infinity()))) return false;
  if (triangles_nearer_than(a, b, std::nextafter(margin, 0))) return true;
  return exact_squared_distance(a, b) <= Rational(margin) * Rational(margin);
}

bool within_margin(const Face_soup& a, const Face_soup& b, double margin) {
  for (std::size_t f = 0; f < a.faces.size(); ++f)
    for (std::size_t g = 0; g < b.faces.size(); ++g)
      if (within_margin(a.triangle(f), b.triangle(g), margin)) return true;
  return false;
}

double distance_rounded_up(const Point& p, const Point& q) {
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
