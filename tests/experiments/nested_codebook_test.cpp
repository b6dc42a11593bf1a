// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "lodestone/io/shapes/shapes.h"
#include "lodestone/queries/exhaustive.h"
#include "nested_codebook/face_hierarchy.h"
#include "nested_codebook/hierarchy_search.h"

namespace lodestone {
namespace {

/// An icosphere, moved along the x-axis.
struct Sphere {
  Surface_mesh mesh = icosphere(10);
  std::vector<Corners> corners;
  Positions positions;
  std::vector<Region_index> regions;  ///< of the faces: two of them, by the side on which the first corner is

  explicit Sphere(double x = 0) {
    for (auto& point : mesh.points()) point = Point(point.x() + x, point.y(), point.z());
    const Mesh_numbering<Surface_mesh> numbering(mesh);
    corners = Mesh_numbering<Surface_mesh>(mesh).corners();
    positions = read_positions(numbering, mesh.points());
    for (const auto& face : corners) regions.push_back(positions(face[0], 1) > 0 ? 1 : 0);
  }
  Rest_surface surface() const { return {corners, positions}; }
};

constexpr std::size_t most_faces = 20;

std::vector<Face_split> both_splits(const Sphere& sphere) {
  return {split_at_median(sphere.surface(), most_faces), split_by_lbg(face_features(sphere.surface(), 0.5))};
}

TEST(Face_hierarchy, has_every_face_in_one_leaf_of_its_region_and_no_leaf_too_large) {
  const Sphere sphere;
  for (const auto& split : both_splits(sphere)) {
    const auto hierarchy = build_hierarchy(sphere.surface(), sphere.regions, most_faces, split);
    std::vector<std::size_t> uses(sphere.corners.size());
    for (const auto& node : hierarchy.nodes) {
      if (node.second_child != 0) continue;
      EXPECT_LE(node.end_face - node.first_face, most_faces);
      for (auto place = node.first_face; place < node.end_face; ++place) {
        ++uses[hierarchy.faces[place]];
        EXPECT_EQ(sphere.regions[hierarchy.faces[place]], sphere.regions[hierarchy.faces[node.first_face]]);
      }
    }
    EXPECT_EQ(std::ranges::count(uses, 1U), static_cast<std::ptrdiff_t>(uses.size()));
    EXPECT_EQ(hierarchy.roots.size(), 2U);
  }
}

TEST(Face_hierarchy, every_vertex_of_a_node_is_within_the_radius_of_its_anchor) {
  const Sphere sphere;
  for (const auto& split : both_splits(sphere)) {
    const auto hierarchy = build_hierarchy(sphere.surface(), sphere.regions, most_faces, split);
    for (const auto& node : hierarchy.nodes) {
      double farthest = 0;
      for (auto place = node.first_face; place < node.end_face; ++place)
        for (const auto corner : sphere.corners[hierarchy.faces[place]])
          farthest = std::max(farthest, (sphere.positions.row(corner) - sphere.positions.row(node.anchor)).norm());
      EXPECT_DOUBLE_EQ(node.radius, farthest);
    }
  }
}

/// A roof of two slopes of 45 degrees, twice as long as wide: vertices at x = 0 .. 20, faces of the first slope first.
struct Roof {
  std::vector<Corners> corners;
  Positions positions{3 * 21, 3};

  Roof() {
    for (Eigen::Index x = 0; x <= 20; ++x)
      for (Eigen::Index y = 0; y < 3; ++y) positions.row(3 * x + y) << double(x), 5.0 * double(y), y == 1 ? 5.0 : 0.0;
    for (std::uint32_t slope = 0; slope < 2; ++slope)
      for (std::uint32_t x = 0; x < 20; ++x) {
        const std::uint32_t v = 3 * x + slope;
        corners.push_back({v, v + 3, v + 1});
        corners.push_back({v + 1, v + 3, v + 4});
      }
  }
};

/// The faces of the first child.
std::vector<std::uint32_t> first_half(const Roof& roof, const Face_split& split) {
  std::vector<std::uint32_t> faces(roof.corners.size());
  std::iota(faces.begin(), faces.end(), 0U);
  faces.resize(split(faces));
  std::ranges::sort(faces);
  return faces;
}

TEST(Face_split, by_lbg_parts_two_slopes_if_normals_weigh_and_the_length_if_they_do_not) {
  const Roof roof;
  const Rest_surface surface{roof.corners, roof.positions};
  const auto is_first_slope = [&](std::uint32_t face) { return face < roof.corners.size() / 2; };
  const auto by_normals = first_half(roof, split_by_lbg(face_features(surface, 2)));
  EXPECT_EQ(by_normals.size(), roof.corners.size() / 2);
  EXPECT_TRUE(std::ranges::all_of(by_normals, is_first_slope) || std::ranges::none_of(by_normals, is_first_slope));
  const auto by_length = first_half(roof, split_by_lbg(face_features(surface, 0)));
  EXPECT_EQ(std::ranges::count_if(by_length, is_first_slope), static_cast<std::ptrdiff_t>(by_length.size() / 2));
}

TEST(Face_split, at_medians_halves_along_the_widest_axis) {
  const Roof roof;
  const auto half = first_half(roof, split_at_median({roof.corners, roof.positions}, 40));
  EXPECT_EQ(half.size(), roof.corners.size() / 2);
  for (const auto face : half) EXPECT_LT(roof.positions(roof.corners[face][0], 0), 10);
}

TEST(Face_split, by_lbg_halves_faces_with_equal_features) {
  std::vector<std::uint32_t> faces(10);
  std::iota(faces.begin(), faces.end(), 0U);
  EXPECT_EQ(split_by_lbg(Feature_vectors::Ones(10, 6))(faces), 5U);
}

TEST(Hierarchy_search, reaches_every_contact_of_rigid_surfaces_and_reads_nothing_twice) {
  const Sphere a, b(1.7);
  const auto contacts = exhaustive_face_pairs(a.mesh, b.mesh);
  ASSERT_GT(contacts.size(), 10U);
  for (std::size_t split = 0; split < 2; ++split) {
    Hierarchy_in_frame in_a(build_hierarchy(a.surface(), a.regions, most_faces, both_splits(a)[split]));
    Hierarchy_in_frame in_b(build_hierarchy(b.surface(), b.regions, most_faces, both_splits(b)[split]));
    in_a.start_frame(a.positions);
    in_b.start_frame(b.positions);
    Search_counts counts;
    search(in_a, in_b, 1, contacts, counts);
    EXPECT_EQ(counts.contacts_reached, contacts.size());
    EXPECT_EQ(counts.reached, 1U);
    EXPECT_GT(counts.leaf_pairs, 0U);
    const std::size_t read = in_a.vertices_read() + in_b.vertices_read();
    EXPECT_LE(counts.read_to_first, read);
    search(in_a, in_b, 1, contacts, counts);
    EXPECT_EQ(in_a.vertices_read() + in_b.vertices_read(), read);

    in_a.start_frame(a.positions);
    in_b.start_frame(b.positions);
    Search_counts near;
    search(in_a, in_b, 0.2, contacts, near);
    EXPECT_LT(near.contacts_reached, contacts.size());
    EXPECT_LT(in_a.vertices_read() + in_b.vertices_read(), read);
  }
}

}  // namespace
}  // namespace lodestone
