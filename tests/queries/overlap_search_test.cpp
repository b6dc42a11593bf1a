// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/overlap_search.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "lodestone/io/shapes/shapes.h"
#include "support/face_soup.h"
#include "support/hard_pairs.h"
#include "support/instruction_sets.h"

namespace lodestone {
namespace {

Box box_of(const Face_soup& soup) {
  Box box;
  for (std::uint32_t v = 0; v < soup.vertex_count(); ++v) box.extend(coordinates(soup.point(v)));
  return box;
}

void read(const Face_soup& soup, const Box& part, Faces_in_box& found) {
  Faces_in_box all;
  all.faces.resize(soup.faces.size());
  std::iota(all.faces.begin(), all.faces.end(), 0U);
  all.corners.assign(soup.faces.begin(), soup.faces.end());
  all.coordinates = soup.coordinates;
  select_faces(all, part, found);
}

/// Checks all three queries on every instruction set.
/// @return number of contacts
std::size_t expect_truth(const Face_soup& a, const Face_soup& b) {
  const auto truth = true_pairs(a, b);
  const Box box_a = box_of(a), box_b = box_of(b);
  const Box overlap = box_a.intersection(box_b);
  Faces_in_box faces_a, faces_b;
  if (!overlap.isEmpty()) read(a, overlap, faces_a), read(b, overlap, faces_b);
  std::vector<Face_pair> firsts;
  for_instruction_sets([&] {
    std::vector<Face_pair> found, first, none;
    Overlap_search search;
    const auto all = search.run(faces_a, box_a, faces_b, box_b, Contact_query::all, found);
    EXPECT_EQ(found, truth);
    EXPECT_EQ(all->found, !truth.empty());
    EXPECT_GE(all->exact_tests, truth.size());
    EXPECT_EQ(search.run(faces_a, box_a, faces_b, box_b, Contact_query::first, first)->found, !truth.empty());
    EXPECT_EQ(first.size(), truth.empty() ? 0U : 1U);
    for (const Face_pair pair : first) EXPECT_TRUE(std::ranges::binary_search(truth, pair));
    firsts.insert(firsts.end(), first.begin(), first.end());
    EXPECT_EQ(search.run(faces_a, box_a, faces_b, box_b, Contact_query::yes_no, none)->found, !truth.empty());
    EXPECT_TRUE(none.empty());
  });
  for (const Face_pair pair : firsts) EXPECT_EQ(pair, firsts.front());
  return truth.size();
}

TEST(Overlap_search, equals_exhaustive_checking_in_any_pose) {
  std::mt19937_64 random(1);
  std::size_t poses = 0, meeting = 0;
  const auto objects = small_objects();
  for (const auto& [name_a, a] : objects)
    for (const auto& [name_b, b] : objects)
      for (const double distance : {0.3, 0.9, 1.6}) {
        SCOPED_TRACE(name_a + " and " + name_b);
        meeting += expect_truth(posed_at_random(a, distance, random), posed_at_random(b, distance, random)) > 0 ? 1 : 0;
        ++poses;
      }
  EXPECT_GT(meeting, poses / 3);
  EXPECT_LT(meeting, poses);
}

TEST(Overlap_search, equals_exhaustive_checking_of_shapes_that_touch_or_coincide) {
  for (const auto& [a, b] : touching_soups(3))
    for (const auto& [factor, offset] : {std::pair{1.0, 0.0}, {1.0, 0x1p20}, {0x1p-1060, 0.0}, {0x1p1020, 0.0}}) {
      SCOPED_TRACE(testing::Message() << factor << " and " << offset);
      EXPECT_GT(expect_truth(placed(a, factor, offset), placed(b, factor, offset)), 0U);
    }
}

TEST(Overlap_search, equals_exhaustive_checking_of_triangles_that_are_hard_to_decide) {
  constexpr std::array<std::uint32_t, 4> sizes{1, 7, 9, 200};  // up to 64 face pairs are not divided
  Hard_pairs hard(5);
  std::size_t meeting = 0;
  for (const auto& kind : Hard_pairs::kinds()) {
    SCOPED_TRACE(kind.name);
    for (std::size_t trial = 0; trial < 32; ++trial) {
      Face_soup a, b;
      for (std::uint32_t face = 0; face < sizes[trial % sizes.size()]; ++face) {
        const auto [s, t] = (hard.*kind.make)();
        for (auto [soup, triangle] : {std::pair{&a, &s}, {&b, &t}}) {
          for (const auto& p : *triangle) soup->coordinates.insert(soup->coordinates.end(), {p.x(), p.y(), p.z()});
          soup->faces.push_back({3 * face, 3 * face + 1, 3 * face + 2});
        }
      }
      meeting += expect_truth(a, b) > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(meeting, 100U);
}

TEST(Overlap_search, equals_exhaustive_checking_of_large_surfaces_that_lie_inside_one_another_cross_and_just_miss) {
  const Face_soup outer(icosphere(24)), inner = placed(Face_soup(icosphere(20)), 0.98);
  EXPECT_EQ(expect_truth(outer, placed(inner, 0.5)), 0U);
  EXPECT_GT(expect_truth(outer, moved(inner, 0.01, 0.02, 0.03)), 0U);
  EXPECT_GT(expect_truth(outer, moved(outer, 0.4, 0.01, 0)), 0U);
  EXPECT_GT(expect_truth(outer, moved(outer, 1e-6, 1e-7, 0)), 0U);
  EXPECT_EQ(expect_truth(outer, moved(outer, 2.5, 0, 0)), 0U);
  EXPECT_EQ(expect_truth(outer, moved(outer, 1.7, 1.1, 0)), 0U);  // boxes overlap, surfaces do not
  EXPECT_GT(expect_truth(moved(outer, 1e9, 0, 0), moved(outer, 1e9 + 1, 0, 0)), 0U);
}

/// All centres are the same, so only the median divides the list.
TEST(Overlap_search, divides_faces_that_lie_on_each_other) {
  const auto pile = [](std::uint32_t faces) {
    Face_soup soup;
    for (const double x : {0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0}) soup.coordinates.push_back(x);
    soup.faces.assign(faces, {0, 1, 2});
    return soup;
  };
  EXPECT_EQ(expect_truth(pile(300), pile(70)), 300U * 70U);
  EXPECT_EQ(expect_truth(pile(1), pile(700)), 700U);
}

TEST(Overlap_search, of_one_large_face_and_many_small_ones_finds_all) {
  Face_soup large;
  large.coordinates = {-50, -50, 0.1, 50, -50, 0.1, 0, 90, 0.1};
  large.faces = {{0, 1, 2}};
  const Face_soup ball(icosphere(20));
  EXPECT_GT(expect_truth(large, ball), 100U);
  EXPECT_GT(expect_truth(ball, large), 100U);
}

TEST(Overlap_search, needs_few_exact_tests_where_surfaces_cross) {
  const Face_soup a(icosphere(24)), b = moved(a, 0.4, 0.01, 0);
  const Box overlap = box_of(a).intersection(box_of(b));
  Faces_in_box faces_a, faces_b;
  read(a, overlap, faces_a), read(b, overlap, faces_b);
  std::vector<Face_pair> found;
  const auto summary = Overlap_search().run(faces_a, box_of(a), faces_b, box_of(b), Contact_query::all, found);
  EXPECT_LT(summary->exact_tests, 2 * found.size());
}

/// One contact is searched for with exact tests alone at first. Where there is none, the filter is worth it.
TEST(Overlap_search, needs_few_exact_tests_where_surfaces_lie_close_to_each_other_but_do_not_meet) {
  const Face_soup a(icosphere(8)), b = placed(a, 0.97);
  Faces_in_box faces_a, faces_b;
  read(a, box_of(b), faces_a), read(b, box_of(b), faces_b);
  std::vector<Face_pair> found;
  const auto summary = Overlap_search().run(faces_a, box_of(a), faces_b, box_of(b), Contact_query::yes_no, found);
  EXPECT_FALSE(summary->found);
  EXPECT_LT(summary->exact_tests, 100U);
}

TEST(Overlap_search, adds_to_what_was_found_before_and_counts_each_run_alone) {
  const Face_soup a(icosphere(12)), inner = placed(a, 0.5), crossing = moved(a, 0.4, 0.01, 0);
  const Face_pair before{7, 7};
  std::vector<Face_pair> found{before};
  Overlap_search search;
  const auto run = [&](const Face_soup& b, Contact_query query) {
    const Box overlap = box_of(a).intersection(box_of(b));
    Faces_in_box faces_a, faces_b;
    read(a, overlap, faces_a), read(b, overlap, faces_b);
    return search.run(faces_a, box_of(a), faces_b, box_of(b), query, found);
  };
  for (const auto query : {Contact_query::yes_no, Contact_query::first, Contact_query::all}) {
    EXPECT_FALSE(run(inner, query)->found);
    EXPECT_EQ(found, std::vector{before});
  }
  EXPECT_TRUE(run(crossing, Contact_query::yes_no)->found);
  EXPECT_EQ(found, std::vector{before});
  const auto first = run(crossing, Contact_query::all), second = run(crossing, Contact_query::all);
  EXPECT_EQ(found.size(), 1 + 2 * true_pairs(a, crossing).size());
  EXPECT_EQ(second->leaf_tests, first->leaf_tests);
  EXPECT_EQ(second->exact_tests, first->exact_tests);
}

/// A cone of n faces around a vertex at (0, 0, z).
Face_soup cone(std::uint32_t faces, double z) {
  Face_soup soup;
  soup.coordinates = {0, 0, z};
  for (std::uint32_t face = 0; face < faces; ++face) {
    const double angle = 2 * std::numbers::pi * face / faces;
    soup.coordinates.insert(soup.coordinates.end(), {std::cos(angle), std::sin(angle), z + 0.5});
    soup.faces.push_back({0, 1 + face, 1 + (face + 1) % faces});
  }
  return soup;
}

TEST(Overlap_search, gives_up_where_boxes_part_little) {
  const auto run = [](std::uint32_t faces, double z) {
    const Face_soup a = cone(faces, 0), b = cone(faces, z);
    const Box overlap = box_of(a).intersection(box_of(b));
    Faces_in_box faces_a, faces_b;
    read(a, overlap, faces_a), read(b, overlap, faces_b);
    std::vector<Face_pair> found;
    return Overlap_search().run(faces_a, box_of(a), faces_b, box_of(b), Contact_query::all, found);
  };
  EXPECT_FALSE(run(8000, 0.1).has_value());
  ASSERT_TRUE(run(1000, 0.1).has_value());
  EXPECT_FALSE(run(1000, 0.1)->found);
}

/// What brings their sides near 1 takes their coordinates beyond the largest number.
TEST(Overlap_search, finds_contacts_of_small_faces_in_a_plane_very_far_away) {
  const auto in_plane = [](double x) {
    Face_soup soup;
    for (std::uint32_t face = 0; face < 100; ++face) {
      const double y = 0x1p-20 * face;
      soup.coordinates.insert(soup.coordinates.end(), {x, y, 0, x, y + 0x1p-21, 0, x, y, 0x1p-20});
      soup.faces.push_back({3 * face, 3 * face + 1, 3 * face + 2});
    }
    return soup;
  };
  EXPECT_GT(expect_truth(in_plane(0x1p1020), in_plane(0x1p1020)), 0U);
}

}  // namespace
}  // namespace lodestone
