// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/vertex_fans.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "support/test_meshes.h"

namespace lodestone {
namespace {

bool uses(const Corners& corners, std::uint32_t vertex) { return std::ranges::count(corners, vertex) > 0; }

/// Whether the faces of a vertex form a row, by counting: no neighbour is in more than two of them, and all neighbours
/// are connected.
bool form_a_row(std::uint32_t vertex, std::span<const Corners> faces) {
  std::map<std::uint32_t, std::set<std::uint32_t>> linked;
  std::map<std::uint32_t, int> times;
  for (const auto& corners : faces) {
    if (!uses(corners, vertex)) continue;
    if (std::set(corners.begin(), corners.end()).size() < 3) return false;
    for (const auto p : corners)
      for (const auto q : corners)
        if (p != q && p != vertex && q != vertex) linked[p].insert(q);
    for (const auto p : corners)
      if (p != vertex && ++times[p] > 2) return false;
  }
  if (linked.empty()) return false;
  std::vector<std::uint32_t> reached{linked.begin()->first};
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const auto next : linked[reached[i]])
      if (std::ranges::find(reached, next) == reached.end()) reached.push_back(next);
  return reached.size() == linked.size();
}

/// Checks everything that the header guarantees; returns the number of vertices with a rim.
std::size_t expect_valid(const Vertex_fans& fans, std::uint32_t vertex_count, std::span<const Corners> faces) {
  std::size_t rims = 0;
  EXPECT_EQ(fans.vertex_count(), vertex_count);
  for (std::uint32_t v = 0; v < vertex_count; ++v) {
    const auto fan = fans.faces(v);
    const auto rim = fans.rim(v);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t face = 0; face < faces.size(); ++face)
      if (uses(faces[face], v)) expected.push_back(face);
    std::vector<std::uint32_t> listed(fan.begin(), fan.end());
    if (!rim.empty()) std::ranges::sort(listed);
    EXPECT_EQ(listed, expected) << v;

    EXPECT_EQ(!rim.empty(), form_a_row(v, faces)) << v;
    if (rim.empty()) continue;
    ++rims;
    EXPECT_EQ(rim.size(), fan.size() + 1);
    for (std::size_t i = 0; i < fan.size(); ++i) {
      const auto& corners = faces[fan[i]];
      EXPECT_TRUE(uses(corners, rim[i]) && uses(corners, rim[i + 1]) && rim[i] != rim[i + 1]);
      EXPECT_TRUE(rim[i] != v && rim[i + 1] != v);
    }
    const std::set<std::uint32_t> different(rim.begin(), rim.end());
    EXPECT_EQ(different.size(), rim.front() == rim.back() ? fan.size() : fan.size() + 1);
  }
  return rims;
}

std::size_t expect_valid(std::uint32_t vertex_count, const std::vector<Corners>& faces) {
  return expect_valid({vertex_count, faces}, vertex_count, faces);
}

TEST(Vertex_fans, of_a_closed_surface_have_closed_rims) {
  const Numbered_mesh mesh(potato(6));
  const Vertex_fans fans(mesh.numbering.vertex_count(), mesh.faces);
  EXPECT_EQ(expect_valid(fans, fans.vertex_count(), mesh.faces), fans.vertex_count());
  for (std::uint32_t v = 0; v < fans.vertex_count(); ++v) EXPECT_EQ(fans.rim(v).front(), fans.rim(v).back());
}

TEST(Vertex_fans, have_open_rims_exactly_at_the_border) {
  const auto faces = grid_faces(7, 5);
  const Vertex_fans fans(35, faces);
  EXPECT_EQ(expect_valid(fans, 35, faces), 35U);
  const auto border = open_border(35, faces);
  for (std::uint32_t v = 0; v < 35; ++v) EXPECT_EQ(fans.rim(v).front() != fans.rim(v).back(), border[v]);
}

TEST(Vertex_fans, do_not_depend_on_the_orientation_of_faces) {
  std::mt19937_64 random(1);
  auto faces = grid_faces(7, 5);
  for (auto& corners : faces) std::ranges::shuffle(corners, random);
  EXPECT_EQ(expect_valid(35, faces), 35U);
}

TEST(Vertex_fans, have_no_rim_where_faces_do_not_form_a_single_row) {
  EXPECT_EQ(expect_valid(4, {{0, 1, 2}}), 3U) << "vertex 3 has no face";
  EXPECT_EQ(expect_valid(5, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}), 3U) << "three faces at an edge";
  EXPECT_EQ(expect_valid(5, {{0, 1, 2}, {0, 3, 4}}), 4U) << "two rows at vertex 0";
  EXPECT_EQ(expect_valid(7, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}}), 6U)
      << "two rings at 0";
  EXPECT_EQ(expect_valid(3, {{0, 1, 2}, {2, 1, 0}}), 3U) << "the same face twice closes around each vertex";
  EXPECT_EQ(expect_valid(4, {{0, 1, 2}, {0, 2, 1}, {0, 2, 3}}), 2U) << "the same face twice, and one beside it";
  EXPECT_EQ(expect_valid(3, {{0, 0, 1}, {1, 2, 0}}), 1U) << "a face that uses a vertex twice";
  EXPECT_EQ(expect_valid(1, {{0, 0, 0}}), 0U);
  EXPECT_EQ(expect_valid(0, {}), 0U);
}

TEST(Vertex_fans, satisfy_their_definition_on_any_faces) {
  std::mt19937_64 random(2);
  std::size_t rims = 0, vertices = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const auto vertex_count = static_cast<std::uint32_t>(3 + random() % 7);
    std::vector<Corners> faces(1 + random() % 9);
    for (auto& corners : faces)
      for (auto& corner : corners) corner = static_cast<std::uint32_t>(random() % vertex_count);
    rims += expect_valid(vertex_count, faces);
    vertices += vertex_count;
  }
  EXPECT_GT(rims, vertices / 10);
  EXPECT_LT(rims, vertices / 2);
}

TEST(Vertex_fans, accept_a_vertex_that_all_faces_share) {
  constexpr std::uint32_t faces_at_apex = 100000;
  std::vector<Corners> faces;
  for (std::uint32_t i = 0; i < faces_at_apex; ++i) faces.push_back({0, i + 1, (i + 1) % faces_at_apex + 1});
  std::mt19937_64 random(3);
  std::ranges::shuffle(faces, random);
  const Vertex_fans fans(faces_at_apex + 1, faces);
  EXPECT_EQ(fans.faces(0).size(), faces_at_apex);
  const auto rim = fans.rim(0);
  ASSERT_EQ(rim.size(), faces_at_apex + 1);
  EXPECT_EQ(rim.front(), rim.back());
  for (std::size_t i = 0; i < faces_at_apex; ++i) {
    const std::uint32_t step = rim[i] > rim[i + 1] ? rim[i] - rim[i + 1] : rim[i + 1] - rim[i];
    ASSERT_TRUE(step == 1 || step == faces_at_apex - 1);
  }
}

}  // namespace
}  // namespace lodestone
