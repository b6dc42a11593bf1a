// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/contact_patches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "lodestone/queries/surface_triangle.h"
#include "queries/searches.h"

namespace lodestone {
namespace {

/// The contacts of two objects, or of one with itself, with their geometry and patches.
struct Patched {
  std::vector<Face_pair> faces;
  std::vector<Intersection_points> points;
  std::vector<Contact_normal> normals;
  std::vector<Contact_patch> patches;

  Patched(const Posed_object& a, const Posed_object& b, double tolerance = 0) {
    faces = &a == &b ? search_within(a).found : search_between(a, b, {.tolerance = tolerance}).found;
    for (const auto [face_a, face_b] : faces) {
      const Triangle p = surface_triangle(a.object(), face_a), q = surface_triangle(b.object(), face_b);
      if (triangles_intersect(p, q)) {
        points.push_back(triangle_intersection(p, q));
        normals.push_back(contact_normal(p, q));
      } else {
        const Closest_points nearest = closest_points(p, q);
        points.push_back({nearest.a, nearest.b});
        normals.push_back(gap_normal(nearest));
      }
    }
    patches = contact_patches(a.object(), b.object(), {faces, points, normals}, tolerance);
  }
};

Patched patched(const Face_soup& a, const Face_soup& b, double tolerance = 0) {
  return {Posed_object(a), Posed_object(b), tolerance};
}

std::size_t patch_count(const Face_soup& a, const Face_soup& b) {
  const std::size_t count = patched(a, b).patches.size();
  EXPECT_EQ(patched(b, a).patches.size(), count);
  EXPECT_EQ(patched(shuffled(a, 1), shuffled(b, 2)).patches.size(), count);
  return count;
}

/// Vertices and edges that two faces share, without corners of a third face: as segments.
std::vector<Triangle> shared_by(const Face_soup& soup, std::uint32_t first, std::uint32_t second,
                                const Corners& without) {
  std::vector<std::uint32_t> common;
  for (const auto v : soup.faces[first])
    if (std::ranges::count(soup.faces[second], v) > 0 && std::ranges::count(without, v) == 0) common.push_back(v);
  std::vector<Triangle> segments;
  for (const auto v : common)
    for (const auto w : common) segments.push_back({soup.point(v), soup.point(w), soup.point(w)});
  return segments;
}

/// The definition: every contact against every other, then the transitive closure.
std::vector<std::vector<std::uint32_t>> patches_by_definition(const Face_soup& a, const Face_soup& b, bool one_object,
                                                              const std::vector<Face_pair>& contacts) {
  const auto linked = [](const Face_soup& faces, std::uint32_t face, const Face_soup& partners, std::uint32_t first,
                         std::uint32_t second, bool same) {
    const Corners none{~0U, ~0U, ~0U};
    for (const auto& shared : shared_by(partners, first, second, same ? faces.faces[face] : none))
      if (triangles_intersect(shared, faces.triangle(face))) return true;
    return false;
  };
  const auto directly = [&](const Face_pair& p, const Face_pair& q) {
    if (p.a == q.a && linked(a, p.a, b, p.b, q.b, one_object)) return true;
    if (p.b == q.b && linked(b, p.b, a, p.a, q.a, one_object)) return true;
    return one_object &&
           ((p.a == q.b && linked(a, p.a, a, p.b, q.a, true)) || (p.b == q.a && linked(a, p.b, a, p.a, q.b, true)));
  };
  std::vector<std::vector<std::uint32_t>> patches;
  std::vector<bool> taken(contacts.size());
  for (std::uint32_t start = 0; start < contacts.size(); ++start) {
    if (taken[start]) continue;
    std::vector<std::uint32_t> patch{start};
    taken[start] = true;
    for (std::size_t k = 0; k < patch.size(); ++k)
      for (std::uint32_t i = 0; i < contacts.size(); ++i)
        if (!taken[i] && directly(contacts[patch[k]], contacts[i])) {
          taken[i] = true;
          patch.push_back(i);
        }
    std::ranges::sort(patch);
    patches.push_back(patch);
  }
  return patches;
}

std::size_t expect_by_definition(const Patched& found, const Face_soup& a, const Face_soup& b, bool one_object) {
  std::vector<std::vector<std::uint32_t>> lists;
  for (const auto& patch : found.patches) lists.push_back(patch.contacts);
  EXPECT_EQ(lists, patches_by_definition(a, b, one_object, found.faces));
  return lists.size();
}

/// A sheet of sine waves along x, from 0 to 1, of some height.
Face_soup waves(double count, double height) {
  Face_soup sheet(cloth(60, 7));
  deform(sheet,
         [=](const Point& p) { return Point(p.x(), p.y(), height * std::cos(2 * std::numbers::pi * count * p.x())); });
  return sheet;
}

TEST(Contact_patches, of_two_spheres_are_one_circle) {
  const Face_soup left(icosphere(14)), right = moved(left, 1.2, 0, 0);
  EXPECT_EQ(patch_count(left, right), 1U);
  const Patched found = patched(left, right);
  const Contact_patch& patch = found.patches.at(0);
  EXPECT_EQ(patch.contacts.size(), found.faces.size());
  EXPECT_NEAR(patch.normal.x(), -1, 1e-3);
  EXPECT_NEAR(patch.normal.norm(), 1, 1e-12);
  EXPECT_NEAR((patch.point - Eigen::Vector3d(0.6, 0, 0)).norm(), 0, 0.01);
  EXPECT_NEAR(patch.length, 2 * std::numbers::pi * 0.8, 0.05);
  EXPECT_GT(patch.depth, 0);
}

TEST(Contact_patches, have_the_middle_of_the_curve_as_their_point_however_its_faces_divide_it) {
  // A wall from x = 0 to 4, in four faces: two meet the plate along 0.5 each, two along 1.5 each.
  const Face_soup plate = moved(placed(single_triangle(), 100), -20, -20, 0);
  Face_soup wall;
  wall.coordinates = {0, 0, -1, 1, 0, -1, 4, 0, -1, 0, 0, 1, 1, 0, 1, 4, 0, 1};
  wall.faces = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
  const Contact_patch patch = patched(wall, plate).patches.at(0);
  EXPECT_EQ(patch.contacts.size(), 4U);
  EXPECT_NEAR(patch.length, 4, 1e-12);
  EXPECT_NEAR((patch.point - Eigen::Vector3d(2, 0, 0)).norm(), 0, 1e-12);
}

TEST(Contact_patches, of_waves_through_a_plane_are_one_per_crossing) {
  Face_soup plane(cloth(1, 1));
  deform(plane, [](const Point& p) { return Point(3 * p.x() - 1, 3 * p.y() - 1.1, 0.05); });
  for (const int count : {1, 2, 5}) {
    EXPECT_EQ(patch_count(waves(count, 0.2), plane), 2U * static_cast<std::size_t>(count));
    for (const auto& patch : patched(waves(count, 0.2), plane).patches) EXPECT_NEAR(patch.length, 1, 1e-9);
  }
}

TEST(Contact_patches, of_fingers_through_one_face_are_one_per_finger) {
  const Face_soup plate = moved(placed(single_triangle(), 100), -20, -20, 0);
  Face_soup fingers;
  for (int i = 0; i < 6; ++i) {
    const Face_soup finger = moved(cube(2), 2 * i, i, -0.4);
    fingers = i == 0 ? finger : joined(fingers, finger);
  }
  EXPECT_EQ(patch_count(fingers, plate), 6U);
  for (const auto& patch : patched(fingers, plate).patches) EXPECT_NEAR(patch.length, 4, 1e-9);
}

TEST(Contact_patches, of_faces_that_share_a_vertex_away_from_the_other_face_are_two) {
  // Two prongs that meet below the plate, and the same with the vertex in the plate.
  const Face_soup plate = moved(placed(single_triangle(), 100), -20, -20, 0);
  Face_soup prongs;
  prongs.coordinates = {0, 0, -1, -2, -0.5, 1, -2, 0.5, 1, 2, -0.5, 1, 2, 0.5, 1};
  prongs.faces = {{0, 1, 2}, {0, 3, 4}};
  EXPECT_EQ(patch_count(prongs, plate), 2U);
  EXPECT_EQ(patch_count(moved(prongs, 0, 0, 1), plate), 1U);
}

TEST(Contact_patches, that_touch_without_area_have_a_point_and_no_length) {
  const Face_soup box(cube(2)), plate = moved(placed(single_triangle(), 100), -20, -20, 0);
  Face_soup on_corner = box;
  deform(on_corner, [](const Point& p) { return Point(p.x() - p.y(), p.y() - p.z(), p.x() + p.y() + p.z()); });
  EXPECT_EQ(patch_count(on_corner, plate), 1U);
  const Contact_patch touching = patched(on_corner, plate).patches.at(0);
  EXPECT_EQ(touching.length, 0);
  EXPECT_EQ(touching.point, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(patch_count(box, moved(box, 1, 0, 0)), 1U) << "one side on another";
  EXPECT_EQ(patch_count(box, moved(box, 1, 1, 1)), 1U) << "one corner on another";
}

TEST(Contact_patches, of_objects_of_many_kinds_follow_the_definition) {
  std::mt19937_64 random(1);
  const auto objects = small_objects();
  std::size_t patches = 0;
  for (std::size_t i = 0; i < objects.size(); ++i)
    for (std::size_t j = i; j < objects.size(); ++j) {
      SCOPED_TRACE(objects[i].first + ", " + objects[j].first);
      const Face_soup& a = objects[i].second;
      const Face_soup b = posed_at_random(objects[j].second, 0.5, random);
      const Patched found = patched(a, b);
      if (found.faces.size() > 1500) continue;
      patches += expect_by_definition(found, a, b, false);
    }
  EXPECT_GT(patches, 50U);
}

TEST(Contact_patches, of_one_object_with_itself_follow_the_definition) {
  std::size_t patches = 0;
  const std::vector<Face_soup> folded{torus_knot({.tube = 0.5, .segments = 60, .sides = 8}),
                                      crumpled(cloth(10, 10), 0.05, 3), crumpled(icosphere(4), 0.1, 4)};
  for (const auto& soup : folded) {
    const Posed_object object(soup);
    const Patched found(object, object);
    ASSERT_FALSE(found.faces.empty());
    patches += expect_by_definition(found, soup, soup, true);
  }
  EXPECT_GT(patches, 10U);
}

TEST(Contact_patches, of_faces_that_share_an_edge_which_only_ends_at_a_corner_of_the_other_are_two) {
  // Both fins run from the corner of the plate to its inside. Their edge, which both go along in the same direction,
  // stands on that corner.
  Face_soup soup;
  soup.coordinates = {0, 0, 0, 4, -6, 0, 4, 6, 0, 1, 0, 2, 1, 1, -2, 1, -1, -2};
  soup.faces = {{0, 1, 2}, {3, 0, 4}, {3, 0, 5}};
  const Posed_object object(soup);
  const Patched found(object, object);
  EXPECT_EQ(found.faces, (std::vector<Face_pair>{{0, 1}, {0, 2}}));
  EXPECT_EQ(expect_by_definition(found, soup, soup, true), 2U);
}

TEST(Contact_patches, of_faces_that_are_only_near_are_linked_within_the_tolerance) {
  // Two humps under a plate; between them the sheet is farther than the tolerance.
  const Face_soup sheet = waves(1, 0.2);
  Face_soup plate(cloth(1, 1));
  deform(plate, [](const Point& p) { return Point(3 * p.x() - 1, 3 * p.y() - 1, 0.25); });
  const Patched found = patched(sheet, plate, 0.1);
  ASSERT_EQ(found.patches.size(), 2U);
  for (const auto& patch : found.patches) {
    EXPECT_LT(patch.depth, 0);
    EXPECT_NEAR(patch.depth, -0.05, 1e-12);
    EXPECT_EQ(patch.length, 0);
    EXPECT_GT(patch.normal.z(), -1.0000001);
    EXPECT_LT(patch.normal.z(), -0.9);
  }
  EXPECT_EQ(patched(sheet, plate, 0.5).patches.size(), 1U);
}

TEST(Contact_patches, scale_with_powers_of_two) {
  const Face_soup a(icosphere(5)), b = moved(a, 0.9, 0.2, 0.1);
  const Contact_patch patch = patched(a, b).patches.at(0);
  for (const double factor : {0x1p-300, 0x1p300, 0x1p1000}) {
    const Contact_patch scaled = patched(placed(a, factor), placed(b, factor)).patches.at(0);
    EXPECT_EQ(scaled.contacts, patch.contacts);
    EXPECT_NEAR((scaled.normal - patch.normal).norm(), 0, 1e-12);
    EXPECT_NEAR((scaled.point / factor - patch.point).norm(), 0, 1e-12);
    EXPECT_NEAR(scaled.length / factor, patch.length, 1e-12);
  }
}

TEST(Contact_patches, of_segments_longer_than_the_largest_double_have_a_point_and_a_normal) {
  Face_soup plate, blade;
  plate.coordinates = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
  blade.coordinates = {-1, -0.9, 0.1, 1, -0.9, 0.1, 0, -0.9, -1};  // from -10/11 to 10/11 where it meets the plate
  plate.faces = blade.faces = {{0, 1, 2}};
  const double factor = 1.7e308;
  const Contact_patch patch = patched(placed(plate, factor), placed(blade, factor)).patches.at(0);
  EXPECT_EQ(patch.length, std::numeric_limits<double>::infinity());
  EXPECT_NEAR((patch.point / factor - Eigen::Vector3d(0, -0.9, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR(patch.normal.norm(), 1, 1e-12);
}

TEST(Contact_patches, of_no_contacts_are_none) {
  const Face_soup ball(icosphere(3));
  EXPECT_EQ(patch_count(ball, moved(ball, 5, 0, 0)), 0U);
}

}  // namespace
}  // namespace lodestone
