// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/exact_truth.h"

namespace lodestone {

Meshes all_of(const std::deque<Surface_mesh>& owned) {
  Meshes meshes;
  for (const auto& mesh : owned) meshes.push_back(&mesh);
  return meshes;
}

std::vector<Face_pair> contacts_of(const Frame& frame, Object_id a, Object_id b) {
  const auto* result = result_of(frame, a, b);
  if (result == nullptr) return {};
  const auto contacts = frame.contacts(*result);
  return {contacts.begin(), contacts.end()};
}

void expect_contacts(const Frame& frame, Object_id a, Object_id b, const std::vector<Face_pair>& truth) {
  const std::string where = std::to_string(a) + " and " + std::to_string(b) + ", frame " + std::to_string(frame.number);
  EXPECT_EQ(contacts_of(frame, a, b), truth) << where;
  const auto* result = result_of(frame, a, b);
  if (result == nullptr) return;
  EXPECT_EQ(result->collides, !truth.empty()) << where;
  EXPECT_FALSE(result->near) << where;
  EXPECT_FALSE(result->capped) << where;
}

std::vector<Face_pair> intersecting_contacts(const Frame& frame, const Pair_result& pair) {
  std::vector<Face_pair> intersecting;
  for (std::size_t i = pair.first_contact; i < pair.first_contact + pair.contacts; ++i)
    if (frame.intersects(i)) intersecting.push_back(frame.face_pairs[i]);
  return intersecting;
}

std::size_t expect_near_contacts(const Frame& frame, Object_id a, Object_id b, const Surface_mesh& mesh_a,
                                 const Surface_mesh& mesh_b, double tolerance) {
  const std::string where = std::to_string(a) + " and " + std::to_string(b) + ", frame " + std::to_string(frame.number);
  const auto truth = near_face_pairs(mesh_a, mesh_b, tolerance);
  EXPECT_EQ(contacts_of(frame, a, b), truth) << where;
  const auto* result = result_of(frame, a, b);
  if (result == nullptr) return truth.size();
  EXPECT_EQ(result->near, !truth.empty()) << where;
  const auto intersecting = exhaustive_face_pairs(mesh_a, mesh_b);
  EXPECT_EQ(result->collides, !intersecting.empty()) << where;
  EXPECT_EQ(intersecting_contacts(frame, *result), intersecting) << where;
  EXPECT_FALSE(result->capped) << where;
  return truth.size();
}

std::size_t expect_exhaustive(const Frame& frame, const Meshes& meshes) {
  std::size_t colliding = 0;
  for (Object_id a = 0; a < meshes.size(); ++a)
    for (Object_id b = a + 1; b < meshes.size(); ++b) {
      const auto truth = exhaustive_face_pairs(*meshes[a], *meshes[b]);
      expect_contacts(frame, a, b, truth);
      colliding += truth.empty() ? 0 : 1;
    }
  return colliding;
}

Triangle triangle_of(const Surface_mesh& mesh, std::uint32_t face) {
  Triangle triangle;
  auto corner = triangle.begin();
  for (const auto v : mesh.vertices_around_face(mesh.halfedge(Surface_mesh::Face_index(face))))
    *corner++ = mesh.point(v);
  return triangle;
}

std::vector<Face_pair> near_face_pairs(const Surface_mesh& a, const Surface_mesh& b, double distance) {
  std::vector<Face_pair> pairs;
  for (const auto f : a.faces())
    for (const auto g : b.faces())
      if (triangles_nearer_than(triangle_of(a, f), triangle_of(b, g), distance)) pairs.push_back({f, g});
  return pairs;
}

double distance_of(const Surface_mesh& a, const Surface_mesh& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto f : a.faces())
    for (const auto g : b.faces())
      least = std::min(least, closest_points(triangle_of(a, f), triangle_of(b, g)).distance);
  return least;
}

Positions positions_of(const Surface_mesh& mesh) {
  return read_positions(Mesh_numbering<Surface_mesh>(mesh), mesh.points());
}

void place(Surface_mesh& mesh, const Positions& positions) {
  Eigen::Index row = 0;
  for (const auto v : mesh.vertices()) {
    const Eigen::RowVector3d p = positions.row(row++);
    mesh.point(v) = Point(p.x(), p.y(), p.z());
  }
}

Surface_mesh posed(Surface_mesh mesh, const Positions& positions) {
  place(mesh, positions);
  return mesh;
}

void expect_same_normals(std::span<const Contact_normal> a, std::span<const Contact_normal> b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].normal, b[i].normal);
    EXPECT_EQ(a[i].depth, b[i].depth);
  }
}

void expect_same_frame(const Frame& a, const Frame& b) {
  EXPECT_EQ(a.number, b.number);
  EXPECT_EQ(a.face_pairs, b.face_pairs);
  EXPECT_EQ(a.contact_intersects, b.contact_intersects);
  EXPECT_EQ(a.contact_points, b.contact_points);
  expect_same_normals(a.contact_normals, b.contact_normals);
  ASSERT_EQ(a.pairs.size(), b.pairs.size());
  const auto fields = [](const Pair_result& pair) {
    return std::make_tuple(pair.a, pair.b, pair.collides, pair.near, pair.candidates, pair.leaf_tests,
                           pair.first_contact, pair.contacts, pair.capped, pair.unfinished, pair.containment,
                           pair.first_patch, pair.patches);
  };
  for (std::size_t i = 0; i < a.pairs.size(); ++i) {
    EXPECT_EQ(fields(a.pairs[i]), fields(b.pairs[i])) << i;
    ASSERT_EQ(a.pairs[i].parting.has_value(), b.pairs[i].parting.has_value()) << i;
    if (a.pairs[i].parting) {
      EXPECT_EQ(a.pairs[i].parting->translation, b.pairs[i].parting->translation) << i;
    }
  }
  ASSERT_EQ(a.patches.size(), b.patches.size());
  for (std::size_t i = 0; i < a.patches.size(); ++i) {
    EXPECT_EQ(a.patches[i].contacts, b.patches[i].contacts);
    EXPECT_EQ(a.patches[i].normal, b.patches[i].normal);
  }
  const auto counts = [](const Frame_statistics& s) {
    return std::make_tuple(s.object_candidates, s.iterations, s.moves, s.relaxed, s.candidates, s.exact_tests,
                           s.contacts, s.meetings, s.leaf_tests, s.repartitions);
  };
  EXPECT_EQ(counts(a.statistics), counts(b.statistics));
}

}  // namespace lodestone
