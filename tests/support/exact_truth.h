// SPDX-License-Identifier: GPL-3.0-or-later
// What a frame of mode exact must contain: the result of checking every face against every other.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "lodestone/detector.h"
#include "lodestone/queries/exhaustive.h"
#include "lodestone/triangles/triangle_distance.h"
#include "support/test_meshes.h"

namespace lodestone {

using Exact_detector = Detector<Surface_mesh>;
/// Meshes of a detector, by object index.
using Meshes = std::vector<const Surface_mesh*>;

inline Meshes all_of(const std::deque<Surface_mesh>& owned) {
  Meshes meshes;
  for (const auto& mesh : owned) meshes.push_back(&mesh);
  return meshes;
}

template <class Detector_type>
void add_all(Detector_type& detector, const Meshes& meshes) {
  for (const auto* mesh : meshes) detector.add(*mesh);
}

/// The result of a pair; nullptr: it is not listed.
inline const Pair_result* result_of(const Frame& frame, Object_id a, Object_id b) {
  const auto result = std::ranges::find_if(frame.pairs, [&](const auto& pair) { return pair.a == a && pair.b == b; });
  return result == frame.pairs.end() ? nullptr : &*result;
}

inline std::vector<Face_pair> contacts_of(const Frame& frame, Object_id a, Object_id b) {
  const auto* result = result_of(frame, a, b);
  if (result == nullptr) return {};
  const auto contacts = frame.contacts(*result);
  return {contacts.begin(), contacts.end()};
}

/// A pair of the frame lists these faces, all and in order. A pair that is not listed has none.
inline void expect_contacts(const Frame& frame, Object_id a, Object_id b, const std::vector<Face_pair>& truth) {
  const std::string where = std::to_string(a) + " and " + std::to_string(b) + ", frame " + std::to_string(frame.number);
  EXPECT_EQ(contacts_of(frame, a, b), truth) << where;
  const auto* result = result_of(frame, a, b);
  if (result == nullptr) return;
  EXPECT_EQ(result->collides, !truth.empty()) << where;
  EXPECT_FALSE(result->capped) << where;
}

/// Checks every pair of different objects, listed or not; returns how many intersect.
inline std::size_t expect_exhaustive(const Frame& frame, const Meshes& meshes) {
  std::size_t colliding = 0;
  for (Object_id a = 0; a < meshes.size(); ++a)
    for (Object_id b = a + 1; b < meshes.size(); ++b) {
      const auto truth = exhaustive_face_pairs(*meshes[a], *meshes[b]);
      expect_contacts(frame, a, b, truth);
      colliding += truth.empty() ? 0 : 1;
    }
  return colliding;
}

/// The triangle of a face, by index.
inline Triangle triangle_of(const Surface_mesh& mesh, std::uint32_t face) {
  Triangle triangle;
  auto corner = triangle.begin();
  for (const auto v : mesh.vertices_around_face(mesh.halfedge(Surface_mesh::Face_index(face))))
    *corner++ = mesh.point(v);
  return triangle;
}

/// All face pairs that intersect or are nearer than `distance`: every face against every other.
inline std::vector<Face_pair> near_face_pairs(const Surface_mesh& a, const Surface_mesh& b, double distance) {
  std::vector<Face_pair> pairs;
  for (const auto f : a.faces())
    for (const auto g : b.faces())
      if (triangles_nearer_than(triangle_of(a, f), triangle_of(b, g), distance)) pairs.push_back({f, g});
  return pairs;
}

/// The distance of two surfaces: the minimum over all face pairs.
inline double distance_of(const Surface_mesh& a, const Surface_mesh& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto f : a.faces())
    for (const auto g : b.faces())
      least = std::min(least, closest_points(triangle_of(a, f), triangle_of(b, g)).distance);
  return least;
}

/// Positions of all vertices, by index.
inline Positions positions_of(const Surface_mesh& mesh) {
  return read_positions(Mesh_numbering<Surface_mesh>(mesh), mesh.points());
}

/// Moves all vertices to other positions.
inline void place(Surface_mesh& mesh, const Positions& positions) {
  Eigen::Index row = 0;
  for (const auto v : mesh.vertices()) {
    const Eigen::RowVector3d p = positions.row(row++);
    mesh.point(v) = Point(p.x(), p.y(), p.z());
  }
}

/// A copy of a mesh with other positions.
inline Surface_mesh posed(Surface_mesh mesh, const Positions& positions) {
  place(mesh, positions);
  return mesh;
}

/// Moves every vertex at random.
inline void crumple(Surface_mesh& mesh, double distance, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> step(0, distance);
  deform(mesh, [&](const Point& p) {
    const double x = step(random), y = step(random), z = step(random);
    return Point(p.x() + x, p.y() + y, p.z() + z);
  });
}

/// A frame without its times, which differ in every run.
inline void expect_same_frame(const Frame& a, const Frame& b) {
  EXPECT_EQ(a.number, b.number);
  EXPECT_EQ(a.face_pairs, b.face_pairs);
  EXPECT_EQ(a.contact_points, b.contact_points);
  ASSERT_EQ(a.contact_normals.size(), b.contact_normals.size());
  for (std::size_t i = 0; i < a.contact_normals.size(); ++i) {
    EXPECT_EQ(a.contact_normals[i].normal, b.contact_normals[i].normal);
    EXPECT_EQ(a.contact_normals[i].depth, b.contact_normals[i].depth);
  }
  ASSERT_EQ(a.pairs.size(), b.pairs.size());
  const auto fields = [](const Pair_result& pair) {
    return std::make_tuple(pair.a, pair.b, pair.collides, pair.candidates, pair.first_contact, pair.contacts,
                           pair.capped, pair.containment);
  };
  for (std::size_t i = 0; i < a.pairs.size(); ++i) EXPECT_EQ(fields(a.pairs[i]), fields(b.pairs[i])) << i;
  const auto counts = [](const Frame_statistics& s) {
    return std::make_tuple(s.object_candidates, s.iterations, s.moves, s.relaxed, s.candidates, s.exact_tests, s.contacts,
                           s.repartitions);
  };
  EXPECT_EQ(counts(a.statistics), counts(b.statistics));
}

}  // namespace lodestone
