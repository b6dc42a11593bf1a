// SPDX-License-Identifier: GPL-3.0-or-later
// What a frame of mode exact must contain: the result of checking every face against every other.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lodestone/detector.h"
#include "lodestone/queries/exhaustive.h"
#include "lodestone/triangles/triangle_distance.h"
#include "support/test_meshes.h"

namespace lodestone {

using Exact_detector = Detector<>;
inline const Detector_options self_collision{.mode = Mode::exact, .exact = {.self_collision = true}};

/// Meshes of a detector, by object index.
using Meshes = std::vector<const Surface_mesh*>;

Meshes all_of(const std::deque<Surface_mesh>& owned);

template <class Detector_type>
void add_all(Detector_type& detector, const Meshes& meshes) {
  for (const auto* mesh : meshes) detector.add(*mesh);
}

/// The result of a pair; nullptr: it is not listed.
inline const Pair_result* result_of(const Frame& frame, Object_id a, Object_id b) {
  const auto result = std::ranges::find_if(frame.pairs, [&](const auto& pair) { return pair.a == a && pair.b == b; });
  return result == frame.pairs.end() ? nullptr : &*result;
}

std::vector<Face_pair> contacts_of(const Frame& frame, Object_id a, Object_id b);

/// A pair of the frame lists these faces, all and in order. A pair that is not listed has none.
void expect_contacts(const Frame& frame, Object_id a, Object_id b, const std::vector<Face_pair>& truth);

/// The contacts of a pair that intersect, in the order of the frame.
std::vector<Face_pair> intersecting_contacts(const Frame& frame, const Pair_result& pair);

/// The same with a tolerance: the faces that are nearer than it or intersect. The pair says whether there are any, and
/// whether any intersect; the contacts say which.
/// @return how many there are
std::size_t expect_near_contacts(const Frame& frame, Object_id a, Object_id b, const Surface_mesh& mesh_a,
                                 const Surface_mesh& mesh_b, double tolerance);

/// Checks every pair of different objects, listed or not; returns how many intersect.
std::size_t expect_exhaustive(const Frame& frame, const Meshes& meshes);

/// The triangle of a face, by index.
Triangle triangle_of(const Surface_mesh& mesh, std::uint32_t face);

/// All face pairs that intersect or are nearer than `distance`: every face against every other.
std::vector<Face_pair> near_face_pairs(const Surface_mesh& a, const Surface_mesh& b, double distance);

/// The distance of two surfaces: the minimum over all face pairs.
double distance_of(const Surface_mesh& a, const Surface_mesh& b);

/// Positions of all vertices, by index.
Positions positions_of(const Surface_mesh& mesh);

/// Moves all vertices to other positions.
void place(Surface_mesh& mesh, const Positions& positions);

/// A copy of a mesh with other positions.
Surface_mesh posed(Surface_mesh mesh, const Positions& positions);

void expect_same_normals(std::span<const Contact_normal> a, std::span<const Contact_normal> b);
/// A frame without its times, which differ in every run.
void expect_same_frame(const Frame& a, const Frame& b);

}  // namespace lodestone
