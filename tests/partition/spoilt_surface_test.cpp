// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces that CGAL does not take as they are: a face without area is left out, and faces are turned.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "lodestone/partition/face_labels.h"
#include "lodestone/partition/region_growing.h"
#include "lodestone/partition/sdf.h"
#include "lodestone/partition/vsa.h"
#include "partition/lathe.h"
#include "partition/surface_soup.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

/// The surface with a face in front that has no area, and every third face reversed: neither is a surface of CGAL's.
Surface_soup spoilt(const Surface_mesh& mesh) {
  Surface_soup soup = surface_soup(mesh);
  for (std::size_t f = 1; f < soup.faces.size(); f += 3) std::swap(soup.faces[f][1], soup.faces[f][2]);
  soup.faces.insert(soup.faces.begin(), Corners{0, 0, 1});
  return soup;
}

Surface_mesh box() {
  auto mesh = cube(8);
  deform(mesh, [](const Point& p) { return Point(3 * p.x(), 2 * p.y(), p.z()); });
  return mesh;
}

/// Labels of faces, with one of no region in front.
std::vector<Region_index> with_none_in_front(std::vector<Region_index> labels) {
  labels.insert(labels.begin(), no_region);
  return labels;
}

TEST(Region_growing, areas_are_those_without_a_face_that_is_left_out_and_with_faces_that_are_turned) {
  EXPECT_EQ(flat_areas(spoilt(box()).surface(), {}), with_none_in_front(flat_areas(surface_soup(box()).surface(), {})));
}

TEST(Sdf, segments_are_those_without_a_face_that_is_left_out_and_with_faces_that_are_turned) {
  const auto mesh = dumbbell(1, 0.6, 0.1);
  const auto expected = sdf_segments(surface_soup(mesh).surface(), {});
  EXPECT_GT(std::ranges::max(expected), 0U);
  EXPECT_EQ(sdf_segments(spoilt(mesh).surface(), {}), with_none_in_front(expected));
}

/// Labels renamed in the order of their first vertices: turned faces may change the order in which regions grow.
std::vector<Region_index> in_order(const std::vector<Region_index>& labels) {
  std::map<Region_index, Region_index> names;
  std::vector<Region_index> result;
  for (const auto label : labels)
    result.push_back(names.emplace(label, static_cast<Region_index>(names.size())).first->second);
  return result;
}

TEST(Vsa, regions_are_those_without_a_face_that_is_left_out_and_with_faces_that_are_turned) {
  const auto expected = in_order(Vsa{}.label(surface_soup(box()).surface(), 6).labels);
  EXPECT_EQ(in_order(Vsa{}.label(spoilt(box()).surface(), 6).labels), expected);
}

}  // namespace
}  // namespace lodestone
