// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/cgal_self_intersections.h"

#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace lodestone {

Cgal_self_intersections cgal_self_intersections(const Surface_mesh& mesh) {
  std::vector<std::pair<Surface_mesh::Face_index, Surface_mesh::Face_index>> reported;
  CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(reported));
  Cgal_self_intersections result;
  for (const auto& [f, g] : reported) {
    if (f == g)
      ++result.zero_area_faces;
    else
      result.pairs.push_back({std::min<std::uint32_t>(f, g), std::max<std::uint32_t>(f, g)});
  }
  std::ranges::sort(result.pairs);
  return result;
}

std::vector<Face_pair> self_intersections_by_cgal(const Surface_mesh& mesh) {
  auto result = cgal_self_intersections(mesh);
  EXPECT_EQ(result.zero_area_faces, 0U);
  return std::move(result.pairs);
}

}  // namespace lodestone
