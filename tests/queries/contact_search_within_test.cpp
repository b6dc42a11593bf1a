// SPDX-License-Identifier: GPL-3.0-or-later
// Searches within one object.
#include <gtest/gtest.h>

#include "queries/searches.h"
#include "support/cgal_self_intersections.h"

namespace lodestone {
namespace {

/// All intersecting face pairs by `faces_intersect`.
std::vector<Face_pair> by_definition_of_faces(const Face_soup& soup) {
  std::vector<Face_pair> pairs;
  for (std::uint32_t a = 0; a < soup.faces.size(); ++a)
    for (std::uint32_t b = a + 1; b < soup.faces.size(); ++b)
      if (faces_intersect(soup.faces[a], soup.triangle(a), soup.faces[b], soup.triangle(b))) pairs.push_back({a, b});
  return pairs;
}

struct Folded {
  std::string name;
  Surface_mesh mesh;
};

/// Surfaces that pass through, touch or lie on themselves.
std::vector<Folded> folded_surfaces() {
  std::vector<Folded> result{{"teapot", teapot({3, 4})},
                             {"knot through itself", torus_knot({.tube = 0.5, .segments = 60, .sides = 9})}};
  for (const double distance : {0.0, 0.02, 0.1, 0.5}) {
    result.push_back({"crumpled sphere", icosphere(6)});
    crumple(result.back().mesh, distance, 1);
    result.push_back({"crumpled cloth", cloth(19, 14)});
    crumple(result.back().mesh, distance, 2);
  }
  result.push_back({"cloth folded in two", cloth(8, 8)});
  deform(result.back().mesh, [](const Point& p) { return Point(std::abs(p.x() - 0.5), p.y(), 0); });
  result.push_back({"cloth rolled up", cloth(40, 6)});
  deform(result.back().mesh,
         [](const Point& p) { return Point(std::cos(15 * p.x()), std::sin(15 * p.x()), p.y() + 0.1 * p.x()); });
  result.push_back({"box turned inside out at a corner", cube(4)});
  deform(result.back().mesh,
         [](const Point& p) { return p.x() + p.y() + p.z() > 2.4 ? Point(-0.5, 0.4, 0.3) + (p - Point(1, 1, 1)) : p; });
  return result;
}

TEST(Contact_search_within, equals_cgal) {
  std::size_t found = 0;
  for (const auto& [name, mesh] : folded_surfaces())
    for (const std::size_t leaf_faces : {2, 16, 128}) {
      SCOPED_TRACE(name + ", " + std::to_string(leaf_faces));
      const auto truth = self_intersections_by_cgal(mesh);
      const Posed_object object(Face_soup(mesh), leaf_faces);
      expect_answers(truth, 0, [&](const Contact_request& request) { return search_within(object, request); });
      Searcher several(3);
      expect_answers(truth, 0, [&](const Contact_request& request) { return several.within(object, request); });
      found += truth.size();
    }
  EXPECT_GT(found, 10000U);
}

TEST(Contact_search_within, equals_cgal_on_tiny_huge_and_far_away_surfaces) {
  for (const auto& [factor, offset] : {std::pair{0x1p-300, 0.0}, {0x1p300, 0.0}, {1.0, 0x1p20}})
    for (auto [name, mesh] : folded_surfaces()) {
      SCOPED_TRACE(name);
      scale(mesh, factor);
      shift(mesh, offset, -offset, offset);
      EXPECT_EQ(search_within(Posed_object(Face_soup(mesh))).found, self_intersections_by_cgal(mesh));
    }
}

TEST(Contact_search_within, finds_nothing_in_surfaces_that_do_not_intersect_themselves) {
  for (const auto& mesh : {icosphere(9), uv_sphere(20, 15), cloth(30, 20), cube(6), torus_knot(), potato(8)}) {
    EXPECT_TRUE(self_intersections_by_cgal(mesh).empty());
    EXPECT_FALSE(search_within(Posed_object(Face_soup(mesh))).summary.found);
  }
}

TEST(Contact_search_within, equals_the_definition_for_any_faces) {
  std::size_t found = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
    for (const std::size_t leaf_faces : {2, 16, 128}) {
      const Posed_object object(lattice_soup(200, 15U << seed % 4U, 2 + seed, seed), leaf_faces, seed % 2 == 0);
      const auto truth = by_definition_of_faces(object.soup());
      Searcher searcher(1 + seed % 3);
      expect_answers(truth, 0, [&](const Contact_request& request) { return searcher.within(object, request); });
      found += truth.size();
    }
  EXPECT_GT(found, 10000U);
}

TEST(Contact_search_within, finds_the_same_with_any_number_of_workers) {
  std::vector<Surface_mesh> meshes{icosphere(25), cloth(80, 70),
                                   torus_knot({.tube = 0.5, .segments = 500, .sides = 15})};
  for (auto& mesh : meshes) {
    crumple(mesh, 0.03, 1);
    const Posed_object object(Face_soup(mesh), 32);
    const auto truth = self_intersections_by_cgal(mesh);
    EXPECT_GT(truth.size(), 1000U);
    EXPECT_EQ(search_within(object).found, truth);
    expect_same_for_any_workers(truth.size(), [&](Searcher& searcher, const Contact_request& request) {
      return searcher.within(object, request);
    });
  }
}

/// A worker may then begin with a task of either kind.
TEST(Contact_search_within, finds_the_same_where_most_tasks_check_neighbours) {
  auto mesh = icosphere(40);
  crumple(mesh, 0.02, 3);
  Face_soup soup(mesh);
  soup.coordinates.resize(soup.coordinates.size() + 3 * std::size_t{3'000'000});  // that no face uses
  const Posed_object object(std::move(soup), 16, false);
  const Search_answer alone = search_within(object);
  EXPECT_GT(alone.found.size(), 1000U);
  for (int repetition = 0; repetition < 10; ++repetition) {
    Searcher several(0);
    EXPECT_EQ(several.within(object, {}), alone);
  }
}

}  // namespace
}  // namespace lodestone
