// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/results/component_orientation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

namespace lodestone::test {
namespace {

/// Points and faces to which bodies are added.
struct Bodies {
  std::vector<Point> points;
  std::vector<Corners> faces;

  /// A tetrahedron that looks outward, its right angle at `apex`.
  Bodies& add_tetrahedron(const Point& apex, double size = 1) {
    const auto first = static_cast<std::uint32_t>(points.size());
    points.push_back(apex);
    points.emplace_back(apex.x() + size, apex.y(), apex.z());
    points.emplace_back(apex.x(), apex.y() + size, apex.z());
    points.emplace_back(apex.x(), apex.y(), apex.z() + size);
    for (const auto& [a, b, c] : {Corners{0, 2, 1}, Corners{0, 1, 3}, Corners{1, 2, 3}, Corners{0, 3, 2}})
      faces.push_back({first + a, first + b, first + c});
    return *this;
  }
  Bodies& flip(std::size_t first, std::size_t last) {
    for (auto face = first; face < last; ++face) std::swap(faces[face][1], faces[face][2]);
    return *this;
  }
  /// Makes two vertices one.
  Bodies& join(std::uint32_t from, std::uint32_t to) {
    for (auto& face : faces) std::ranges::replace(face, from, to);
    return *this;
  }
};

std::string orientations(const Bodies& bodies) {
  std::string text;
  for (const auto& component : component_orientations(bodies.points, bodies.faces))
    text += std::string(text.empty() ? "" : " ") + std::string(words_of(component.orientation).name);
  return text;
}

TEST(Component_orientation, of_a_closed_body_is_outward_or_inward) {
  EXPECT_EQ(orientations(Bodies().add_tetrahedron({7, 7, 7})), "outward");
  EXPECT_EQ(orientations(Bodies().add_tetrahedron({7, 7, 7}).flip(0, 4)), "inward");
}

TEST(Component_orientation, of_a_body_with_one_flipped_face_is_inconsistent) {
  for (std::size_t face = 0; face < 4; ++face)
    EXPECT_EQ(orientations(Bodies().add_tetrahedron({0, 0, 0}).flip(face, face + 1)), "inconsistent");
}

TEST(Component_orientation, of_an_open_surface_says_whether_its_faces_agree) {
  auto lid_off = Bodies().add_tetrahedron({0, 0, 0});
  lid_off.faces.pop_back();
  EXPECT_EQ(orientations(lid_off), "open");
  EXPECT_EQ(orientations(lid_off.flip(1, 2)), "open_inconsistent");
}

TEST(Component_orientation, lists_each_component_with_its_first_face) {
  auto bodies = Bodies().add_tetrahedron({0, 0, 0}).add_tetrahedron({5, 0, 0}).flip(4, 8);
  std::swap(bodies.faces[3], bodies.faces[7]);
  const auto list = component_orientations(bodies.points, bodies.faces);
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[0].first_face, 0U);
  EXPECT_EQ(list[1].first_face, 3U);
  EXPECT_EQ(list[0].faces, 4U);
  EXPECT_EQ(list[1].orientation, Face_orientation::inward);
}

TEST(Component_orientation, counts_the_faces_of_the_file) {
  const auto bodies = Bodies().add_tetrahedron({0, 0, 0}).add_tetrahedron({5, 0, 0});
  const std::vector<std::uint32_t> file_face{0, 1, 1, 2, 3, 3, 4, 5};
  const auto list = component_orientations(bodies.points, bodies.faces, file_face);
  EXPECT_EQ(list.at(0).faces, 3U);
  EXPECT_EQ(list.at(1).faces, 3U);
  EXPECT_EQ(list.at(1).first_face, 3U);
}

TEST(Component_orientation, of_a_cavity_is_inward) {
  EXPECT_EQ(orientations(Bodies().add_tetrahedron({0, 0, 0}, 9).add_tetrahedron({1, 1, 1}).flip(4, 8)),
            "outward inward");
}

TEST(Component_orientation, judges_bodies_that_share_a_vertex_one_by_one) {
  EXPECT_EQ(orientations(Bodies().add_tetrahedron({0, 0, 0}).add_tetrahedron({1, 0, 0}).join(4, 1)), "outward");
  EXPECT_EQ(orientations(Bodies().add_tetrahedron({0, 0, 0}).add_tetrahedron({1, 0, 0}, 9).flip(0, 4).join(4, 1)),
            "mixed");
}

TEST(Component_orientation, judges_bodies_that_share_an_edge_one_by_one) {
  // The edge from (1 0 0) to (0 1 0) of the first is that from the apex to the next vertex of the second.
  auto pair = Bodies().add_tetrahedron({0, 0, 0}).add_tetrahedron({1, 0, 0}, 9).join(4, 1).join(5, 2);
  pair.points[7] = {1, 0, -9};
  EXPECT_EQ(orientations(pair), "outward");
  EXPECT_EQ(orientations(pair.flip(0, 4)), "mixed");
  EXPECT_EQ(orientations(pair.flip(4, 8)), "inward");
}

TEST(Component_orientation, takes_sheets_that_enclose_a_volume_only_together_as_one_part) {
  // Two bowls with one rim: four cones, two of which look into a bowl.
  Bodies bowls{{{1, 0, 0}, {0, 1, 0}, {-1, -1, 0}, {0, 0, -2}, {0, 0, -1}, {0, 0, 1}, {0, 0, 2}}, {}};
  for (const std::uint32_t tip : {3U, 4U, 5U, 6U})
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t next = (i + 1) % 3;
      const bool looks_up = tip == 4 || tip == 6;
      bowls.faces.push_back(looks_up ? Corners{i, next, tip} : Corners{next, i, tip});
    }
  EXPECT_EQ(orientations(bowls), "outward");
  EXPECT_EQ(orientations(bowls.flip(0, 12)), "inward");
}

TEST(Component_orientation, of_a_sheet_with_two_sides_is_without_volume) {
  const std::vector<Point> points{{0.1, 0.2, 0.3}, {0.7, 0.1, 1e-9}, {0.3, 1.1, 5}, {1e8, 1, 1}};
  EXPECT_EQ(orientations({points, {{0, 1, 2}, {2, 1, 0}}}), "no_volume");
  EXPECT_EQ(orientations({points, {{0, 1, 2}, {1, 3, 2}, {2, 1, 0}, {2, 3, 1}}}), "no_volume");
}

TEST(Component_orientation, of_a_zero_area_face_does_not_count) {
  auto bodies = Bodies().add_tetrahedron({0, 0, 0});
  bodies.faces.push_back({0, 1, 1});
  EXPECT_EQ(orientations(bodies), "outward");
  EXPECT_EQ(orientations({bodies.points, {{1, 1, 1}}}), "no_volume");
}

TEST(Component_orientation, is_exact_where_doubles_cannot_tell_the_sign) {
  // The apex is one step of doubles away from the plane through the others.
  const std::vector<Point> points{
      {0.1, 0.1, 0.1}, {1e6, 0.3, 0.3}, {0.7, 1e6, 0.7}, {333333.6, 333333.46666666667, 0.36666666666666664}};
  const std::vector<Corners> faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  for (int steps = -3; steps <= 3; ++steps) {
    auto moved = points;
    double z = 0.36666666666666664;
    for (int i = 0; i < std::abs(steps); ++i) z = std::nextafter(z, steps);
    moved[3] = {points[3].x(), points[3].y(), z};
    const auto sign = CGAL::orientation(moved[0], moved[1], moved[2], moved[3]);
    const std::string expected = sign == CGAL::POSITIVE ? "outward" : sign == CGAL::NEGATIVE ? "inward" : "no_volume";
    EXPECT_EQ(orientations({moved, faces}), expected) << steps;
  }
}

TEST(Component_orientation, holds_for_the_largest_and_smallest_coordinates) {
  for (const double scale : {1e-300, 1e300}) {
    EXPECT_EQ(orientations(Bodies().add_tetrahedron({0, 0, 0}, scale)), "outward");
    EXPECT_EQ(orientations(Bodies().add_tetrahedron({0, 0, 0}, scale).flip(0, 4)), "inward");
  }
}

TEST(Component_orientation, of_no_faces_is_an_empty_list) { EXPECT_EQ(orientations({}), ""); }

}  // namespace
}  // namespace lodestone::test
