// SPDX-License-Identifier: GPL-3.0-or-later
// Two oracles for faces that share a vertex, CGAL's self-intersections and the definition in exact numbers, and what
// Neighbour_check says.
#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/intersections.h>

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <random>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "lodestone/triangles/neighbour_check.h"
#include "support/test_meshes.h"

namespace lodestone {

/// The common vertices of two faces, each once.
inline std::vector<std::uint32_t> common_vertices(const Corners& a, const Corners& b) {
  std::vector<std::uint32_t> common;
  for (const auto v : a)
    if (std::ranges::count(b, v) > 0 && std::ranges::count(common, v) == 0) common.push_back(v);
  return common;
}

/// What CGAL reports: pairs of different faces that share a vertex, sorted, and how many pairs of a face with itself.
struct Reported_by_cgal {
  std::vector<Face_pair> pairs;
  std::size_t faces_without_area = 0;
};

inline Reported_by_cgal reported_by_cgal(const Surface_mesh& mesh, std::span<const Corners> faces) {
  std::vector<std::pair<Surface_mesh::Face_index, Surface_mesh::Face_index>> all;
  CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(all));
  Reported_by_cgal reported;
  for (const auto& [f, g] : all) {
    const std::uint32_t a = std::min(f, g), b = std::max(f, g);
    if (a == b)
      ++reported.faces_without_area;
    else if (!common_vertices(faces[a], faces[b]).empty())
      reported.pairs.push_back({a, b});
  }
  std::ranges::sort(reported.pairs);
  return reported;
}

namespace by_definition {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Shape = std::variant<Exact::Point_3, Exact::Segment_3, Exact::Triangle_3>;

inline Exact::Point_3 point(const Positions& positions, std::uint32_t v) {
  return {positions(v, 0), positions(v, 1), positions(v, 2)};
}

inline Shape hull(const Exact::Point_3& a, const Exact::Point_3& b) {
  if (a == b) return a;
  return Exact::Segment_3(a, b);
}

/// A face as a set of points.
inline Shape face_shape(const Positions& positions, const Corners& corners) {
  const auto a = point(positions, corners[0]), b = point(positions, corners[1]), c = point(positions, corners[2]);
  if (!CGAL::collinear(a, b, c)) return Exact::Triangle_3(a, b, c);
  const auto [low, high] = std::minmax({a, b, c});  // lexicographic: the ends, for collinear points
  return hull(low, high);
}

inline bool contains(const Shape& shape, const Exact::Point_3& p) {
  if (const auto* q = std::get_if<Exact::Point_3>(&shape)) return *q == p;
  const auto& s = std::get<Exact::Segment_3>(shape);
  return CGAL::collinear(s.source(), p, s.target()) &&
         CGAL::collinear_are_ordered_along_line(s.source(), p, s.target());
}

/// The corners of the intersection. Three and more: it has an area.
struct Corners_of_intersection {
  using Result = std::vector<Exact::Point_3>;
  Result operator()(const Exact::Point_3& p) const { return {p}; }
  Result operator()(const Exact::Segment_3& s) const { return {s.source(), s.target()}; }
  Result operator()(const Exact::Triangle_3& t) const { return {t[0], t[1], t[2]}; }
  Result operator()(const Result& polygon) const { return polygon; }

  Result operator()(const Exact::Point_3& a, const Exact::Point_3& b) const { return a == b ? Result{a} : Result{}; }
  template <class A, class B>
  Result operator()(const A& a, const B& b) const {
    const auto result = CGAL::intersection(a, b);
    return result ? boost::apply_visitor(Corners_of_intersection(), *result) : Result{};
  }
};

/// Whether two faces have a common point outside their common vertices and edges. Their intersection is convex, so an
/// intersection without area lies on a common edge if its corners do.
inline bool faces_intersect(const Positions& positions, const Corners& a, const Corners& b) {
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

/// All intersecting pairs of faces that share a vertex, sorted.
inline std::vector<Face_pair> adjacent_pairs(const Positions& positions, std::span<const Corners> faces) {
  std::vector<Face_pair> pairs;
  for (std::uint32_t a = 0; a < faces.size(); ++a)
    for (std::uint32_t b = a + 1; b < faces.size(); ++b)
      if (!common_vertices(faces[a], faces[b]).empty() && faces_intersect(positions, faces[a], faces[b]))
        pairs.push_back({a, b});
  return pairs;
}

}  // namespace by_definition

/// The result of Neighbour_check for a whole mesh; pairs sorted.
struct Neighbour_answer {
  std::vector<Face_pair> pairs;
  std::size_t exact_tests = 0;
};

inline Neighbour_answer answer(const Positions& positions, std::span<const Corners> faces) {
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

inline Neighbour_answer answer(const Surface_mesh& mesh) {
  const Numbered_mesh numbered(mesh);
  return answer(numbered.positions, numbered.faces);
}

/// Compares a mesh without zero-area faces with CGAL; returns the number of pairs.
inline std::size_t expect_equal_to_cgal(const Surface_mesh& mesh) {
  const Numbered_mesh numbered(mesh);
  const auto expected = reported_by_cgal(mesh, numbered.faces);
  EXPECT_EQ(expected.faces_without_area, 0U);
  EXPECT_EQ(answer(numbered.positions, numbered.faces).pairs, expected.pairs);
  return expected.pairs.size();
}

/// Moves every vertex at random, along the first `axes` axes.
inline void crumple(Surface_mesh& mesh, double distance, std::uint64_t seed, int axes = 3) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> step(0, distance);
  deform(mesh, [&](const Point& p) {
    const double x = step(random), y = step(random), z = step(random);
    return Point(p.x() + x, p.y() + (axes > 1 ? y : 0), p.z() + (axes > 2 ? z : 0));
  });
}

/// Rotates a mesh by an angle at which every coordinate is rounded.
inline void turn(Surface_mesh& mesh) {
  const Eigen::Matrix3d rotation(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  deform(mesh, [&](const Point& p) {
    const Eigen::Vector3d q = rotation * coordinates(p);
    return Point(q.x(), q.y(), q.z());
  });
}

}  // namespace lodestone
