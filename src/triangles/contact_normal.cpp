// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/triangles/contact_normal.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include "triangles/corner_differences.h"

namespace lodestone {

namespace {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;

/// Unit normal of a triangle whose cross product may have no correct digit in double. It is rounded only after it has
/// been scaled to a largest coordinate of 1.
Eigen::Vector3d exact_normal(const Triangle& t) {
  const auto point = [](const Point& p) { return Exact::Point_3(p.x(), p.y(), p.z()); };
  const auto corner = point(t[0]);
  const auto n = CGAL::cross_product(point(t[1]) - corner, point(t[2]) - corner);
  Exact::FT greatest = 0;
  for (int axis = 0; axis < 3; ++axis) greatest = std::max(greatest, CGAL::abs(n[axis]));
  if (greatest == 0) return Eigen::Vector3d::Zero();
  const auto part = [&](int axis) { return CGAL::to_double(CGAL::exact(n[axis] / greatest)); };
  return Eigen::Vector3d(part(0), part(1), part(2)).normalized();
}

/// Unit normal of a triangle, from its scaled edges; zero if it has no area.
Eigen::Vector3d unit_normal(const std::array<Eigen::Vector3d, 3>& edges, const Triangle& t) {
  const Eigen::Vector3d n = edges[0].cross(edges[1]);
  // Each coordinate of the product has an error below 2^-51 |e||f|. If squares may underflow, exact numbers decide.
  const double bound = edges[0].squaredNorm() * edges[1].squaredNorm(), squared = n.squaredNorm();
  constexpr double thin = 0x1p-20;
  return squared > thin * thin * bound && squared > 1e-280 ? n / std::sqrt(squared) : exact_normal(t);
}

}  // namespace

Contact_normal contact_normal(const Triangle& a, const Triangle& b) {
  const auto& [differences, exponent] = scaled_differences(a, b);
  const Eigen::Vector3d normal_a = unit_normal(differences.edges_a, a), normal_b = unit_normal(differences.edges_b, b);
  if (normal_a.isZero(0) && normal_b.isZero(0)) return {};
  const Eigen::Vector3d outwards = normal_b - normal_a;
  Contact_normal contact;
  contact.normal = outwards.norm() > 1e-8 ? outwards.normalized() : normal_b;
  double depth = 0;
  for (const auto& row : differences.between)
    for (const auto& difference : row) depth = std::max(depth, -contact.normal.dot(difference));
  contact.depth = std::ldexp(depth, exponent);
  return contact;
}

Contact_normal gap_normal(const Closest_points& nearest) {
  return {.normal = nearest.direction, .depth = -nearest.distance};
}

}  // namespace lodestone
