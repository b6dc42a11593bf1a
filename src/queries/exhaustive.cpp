// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/exhaustive.h"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>

#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

namespace {

using Face_box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;

Triangle triangle(const Positions& positions, const Corners& corners) {
  return face_triangle(corners, [&](auto vertex) { return positions.row(vertex); });
}

std::vector<Face_box> face_boxes(const Positions& positions, std::span<const Corners> faces) {
  std::vector<Face_box> boxes;
  boxes.reserve(faces.size());
  for (std::uint32_t face = 0; face < faces.size(); ++face) {
    const Triangle t = triangle(positions, faces[face]);
    boxes.emplace_back(t[0].bbox() + t[1].bbox() + t[2].bbox(), face);
  }
  return boxes;
}

}  // namespace

std::vector<Face_pair> exhaustive_numbered(const Positions& positions_a, std::span<const Corners> faces_a,
                                           const Positions& positions_b, std::span<const Corners> faces_b) {
  auto boxes_a = face_boxes(positions_a, faces_a);
  auto boxes_b = face_boxes(positions_b, faces_b);
  std::vector<Face_pair> pairs;
  CGAL::box_intersection_d(
      boxes_a.begin(), boxes_a.end(), boxes_b.begin(), boxes_b.end(), [&](const Face_box& a, const Face_box& b) {
        if (triangles_intersect(triangle(positions_a, faces_a[a.info()]), triangle(positions_b, faces_b[b.info()])))
          pairs.push_back({a.info(), b.info()});
      });
  std::ranges::sort(pairs);
  return pairs;
}

}  // namespace lodestone
