// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/adjacent_pairs.h"

namespace lodestone {

std::vector<std::uint32_t> common_vertices(const Corners& a, const Corners& b) {
  std::vector<std::uint32_t> common;
  for (const auto v : a)
    if (std::ranges::count(b, v) > 0 && std::ranges::count(common, v) == 0) common.push_back(v);
  return common;
}

Cgal_self_intersections reported_by_cgal(const Surface_mesh& mesh, std::span<const Corners> faces) {
  auto reported = cgal_self_intersections(mesh);
  std::erase_if(reported.pairs,
                [&](const Face_pair& pair) { return common_vertices(faces[pair.a], faces[pair.b]).empty(); });
  return reported;
}

}  // namespace lodestone

namespace lodestone {
namespace by_definition {

Exact::Point_3 point(const Positions& positions, std::uint32_t v) {
  return {positions(v, 0), positions(v, 1), positions(v, 2)};
}

Shape hull(const Exact::Point_3& a, const Exact::Point_3& b) {
  if (a == b) return a;
  return Exact::Segment_3(a, b);
}

Shape face_shape(const Positions& positions, const Corners& corners) {
  const auto a = point(positions, corners[0]), b = point(positions, corners[1]), c = point(positions, corners[2]);
  if (!CGAL::collinear(a, b, c)) return Exact::Triangle_3(a, b, c);
  const auto [low, high] = std::minmax({a, b, c});  // lexicographic: the ends, for collinear points
  return hull(low, high);
}

bool contains(const Shape& shape, const Exact::Point_3& p) {
  if (const auto* q = std::get_if<Exact::Point_3>(&shape)) return *q == p;
  const auto& s = std::get<Exact::Segment_3>(shape);
  return CGAL::collinear(s.source(), p, s.target()) &&
         CGAL::collinear_are_ordered_along_line(s.source(), p, s.target());
}

bool faces_intersect(const Positions& positions, const Corners& a, const Corners& b) {
  const auto meeting = std::visit(Corners_of_intersection(), face_shape(positions, a), face_shape(positions, b));
  if (meeting.size() > 2) return true;
  const auto common = common_vertices(a, b);
  const auto allowed = [&](const Exact::Point_3& p) {
    for (const auto v : common)
      for (const auto w : common)
        if (contains(hull(point(positions, v), point(positions, w)), p)) return true;
    return false;
  };
  return !std::ranges::all_of(meeting, allowed);
}

std::vector<Face_pair> adjacent_pairs(const Positions& positions, std::span<const Corners> faces) {
  std::vector<Face_pair> pairs;
  for (std::uint32_t a = 0; a < faces.size(); ++a)
    for (std::uint32_t b = a + 1; b < faces.size(); ++b)
      if (!common_vertices(faces[a], faces[b]).empty() && faces_intersect(positions, faces[a], faces[b]))
        pairs.push_back({a, b});
  return pairs;
}

}  // namespace by_definition
}  // namespace lodestone

namespace lodestone {

Neighbour_answer answer(const Positions& positions, std::span<const Corners> faces) {
  const auto vertex_count = static_cast<std::uint32_t>(positions.rows());
  const Vertex_fans fans(vertex_count, faces);
  Neighbour_check check;
  Neighbour_answer result;
  check.check(fans, faces, {positions.data(), static_cast<std::size_t>(positions.size())}, 0, vertex_count,
              result.pairs);
  result.exact_tests = check.exact_tests();
  std::ranges::sort(result.pairs);
  return result;
}

Neighbour_answer answer(const Surface_mesh& mesh) {
  const Numbered_mesh numbered(mesh);
  return answer(numbered.positions, numbered.faces);
}

std::size_t expect_equal_to_cgal(const Surface_mesh& mesh) {
  const Numbered_mesh numbered(mesh);
  const auto expected = reported_by_cgal(mesh, numbered.faces);
  EXPECT_EQ(expected.zero_area_faces, 0U);
  EXPECT_EQ(answer(numbered.positions, numbered.faces).pairs, expected.pairs);
  return expected.pairs.size();
}

void turn(Surface_mesh& mesh) {
  const Eigen::Matrix3d rotation(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  deform(mesh, [&](const Point& p) {
    const Eigen::Vector3d q = rotation * coordinates(p);
    return Point(q.x(), q.y(), q.z());
  });
}

}  // namespace lodestone
