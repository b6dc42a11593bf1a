// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lodestone/io/results/page.h"
#include "lodestone/triangles/triangle_distance.h"
#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

/// Where two triangles meet; of two that are apart the nearest point of each.
inline Intersection_points meeting_points(const Triangle& a, const Triangle& b) {
  if (triangles_intersect(a, b)) return triangle_intersection(a, b);
  const Closest_points nearest = closest_points(a, b);
  return {nearest.a, nearest.b};
}

/// Adds two faces in contact to those of a page: an entry per side of a polygon, or one for a segment or a point.
/// @param faces  which they are, without ends
/// @param a, b   their triangles
inline void add_page_contacts(std::vector<Page_contact>& contacts, const Page_contact& faces, const Triangle& a,
                              const Triangle& b) {
  const Intersection_points points = meeting_points(a, b);
  const std::size_t sides = points.size() > 2 ? points.size() : 1;
  for (std::size_t i = 0; i < sides; ++i) {
    const Point &from = points[i], &to = points[(i + 1) % points.size()];
    contacts.push_back(faces);
    contacts.back().ends = {from.x(), from.y(), from.z(), to.x(), to.y(), to.z()};
  }
}

}  // namespace lodestone
