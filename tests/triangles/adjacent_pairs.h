// SPDX-License-Identifier: GPL-3.0-or-later
// Two oracles for faces that share a vertex, CGAL's self-intersections and the definition in exact numbers, and what
// Neighbour_check says.
#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
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
#include "support/cgal_self_intersections.h"
#include "support/test_meshes.h"

namespace lodestone {

/// The common vertices of two faces, each once.
std::vector<std::uint32_t> common_vertices(const Corners& a, const Corners& b);

/// What CGAL reports, pairs of faces that share a vertex only.
Cgal_self_intersections reported_by_cgal(const Surface_mesh& mesh, std::span<const Corners> faces);

namespace by_definition {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Shape = std::variant<Exact::Point_3, Exact::Segment_3, Exact::Triangle_3>;

Exact::Point_3 point(const Positions& positions, std::uint32_t v);

Shape hull(const Exact::Point_3& a, const Exact::Point_3& b);

/// A face as a set of points.
Shape face_shape(const Positions& positions, const Corners& corners);

bool contains(const Shape& shape, const Exact::Point_3& p);

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
bool faces_intersect(const Positions& positions, const Corners& a, const Corners& b);

/// All intersecting pairs of faces that share a vertex, sorted.
std::vector<Face_pair> adjacent_pairs(const Positions& positions, std::span<const Corners> faces);

}  // namespace by_definition

/// The result of Neighbour_check for a whole mesh; pairs sorted.
struct Neighbour_answer {
  std::vector<Face_pair> pairs;
  std::size_t exact_tests = 0;
};

Neighbour_answer answer(const Positions& positions, std::span<const Corners> faces);

Neighbour_answer answer(const Surface_mesh& mesh);

/// Compares a mesh without zero-area faces with CGAL; returns the number of pairs.
std::size_t expect_equal_to_cgal(const Surface_mesh& mesh);

/// Rotates a mesh by an angle at which every coordinate is rounded.
void turn(Surface_mesh& mesh);

}  // namespace lodestone
