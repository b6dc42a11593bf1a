// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/triangles/contact_normal.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <algorithm>

#include "triangles/contact_normal_kernel.h"
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

/// For triangles of any shape and size.
Contact_normal careful_normal(const Triangle& a, const Triangle& b) {
  const auto& [differences, exponent] = scaled_differences<double>(a, b);
  const Eigen::Vector3d normal_a = unit_normal(differences.edges_a, a), normal_b = unit_normal(differences.edges_b, b);
  if (normal_a.isZero(0) && normal_b.isZero(0)) return {};
  const Eigen::Vector3d outwards = normal_b - normal_a;
  Contact_normal contact;
  contact.normal = outwards.squaredNorm() > 1e-16 ? outwards.normalized() : normal_b;
  double depth = 0;
  for (const auto& row : differences.between)
    for (const auto& difference : row) depth = std::max(depth, -contact.normal.dot(difference));
  contact.depth = std::ldexp(depth, exponent);
  return contact;
}

void store(const Triangle& t, double (&corners)[3][3][kernel::most_normals], std::size_t pair) {
  for (int corner = 0; corner < 3; ++corner)
    for (int axis = 0; axis < 3; ++axis) corners[corner][axis][pair] = t[corner][axis];
}

}  // namespace

Contact_normal contact_normal(const Triangle& a, const Triangle& b) {
  const Triangle_pair pair{a, b};
  Contact_normal contact;
  contact_normals({&pair, 1}, {&contact, 1});
  return contact;
}

void contact_normals(std::span<const Triangle_pair> pairs, std::span<Contact_normal> normals) {
  kernel::Triangle_pairs faces;
  kernel::Normals_and_depths result;
  for (std::size_t first = 0; first < pairs.size(); first += faces.count) {
    faces.count = std::min(kernel::most_normals, pairs.size() - first);
    const auto batch = pairs.subspan(first, faces.count);
    for (std::size_t i = 0; i < batch.size(); ++i) store(batch[i].a, faces.a, i), store(batch[i].b, faces.b, i);
    kernel::contact_normals(faces, result);
    for (std::size_t i = 0; i < batch.size(); ++i)
      normals[first + i] =
          result.proven[i] ? Contact_normal{.normal = {result.normal[0][i], result.normal[1][i], result.normal[2][i]},
                                            .depth = result.depth[i]}
                           : careful_normal(batch[i].a, batch[i].b);
  }
}

Contact_normal gap_normal(const Closest_points& nearest) {
  return {.normal = nearest.direction, .depth = -nearest.distance};
}

}  // namespace lodestone
