// SPDX-License-Identifier: GPL-3.0-or-later
// Faces that meet, or are nearer than the margin, are kept.
#include <CGAL/Intersections_3/Segment_3_Triangle_3.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "filter/filter_checks.h"
#include "lodestone/triangles/triangle_distance.h"
#include "support/guarded_coordinates.h"
#include "support/hard_pairs.h"

namespace lodestone {
namespace {

struct Tally {
  std::size_t pairs = 0;      ///< of all leaves
  std::size_t kept = 0;       ///< candidates
  std::size_t true_ones = 0;  ///< found among the pairs that were looked at
};

/// Calls `check(a, b, tally)` with pairs of leaves, at least `per_kind` pairs of faces for each kind and placement.
template <class Check>
Tally for_leaves(std::size_t per_kind, const Check& check) {
  Tally total;
  std::map<std::uint32_t, std::array<Single_leaf, 2>> leaves;
  for (const std::uint32_t size : {1U, 2U, 7U, 32U, 128U})
    leaves.try_emplace(size, std::array{Single_leaf(size), Single_leaf(size)});
  Hard_pairs hard(1);
  for (const auto& kind : Hard_pairs::kinds())
    for (const auto& placement : placements) {
      SCOPED_TRACE(testing::Message() << kind.name << ", scale " << placement.scale << ", offset " << placement.offset);
      for (auto& [size, pair] : leaves)
        for (std::size_t done = 0; done < per_kind; done += size * size) {
          auto& [a, b] = pair;
          for (std::uint32_t i = 0; i < size; ++i) {
            const auto [s, t] = (hard.*kind.make)();
            a.set(i, placed(s, placement)), b.set(i, placed(t, placement));
          }
          a.refit(), b.refit();
          total.pairs += size * size;
          check(a, b, total);
          if (testing::Test::HasFailure()) return total;
        }
    }
  return total;
}

/// Checks that no pair is discarded for which `near(a, b)` holds. Of those kept, one in 16 is looked at.
template <class Near>
void expect_near_faces_kept(const Single_leaf& a, const Single_leaf& b, const Face_pairs& kept, Tally& tally,
                            const Near& near) {
  auto next = kept.begin();
  for (std::uint32_t i = 0; i < a.size(); ++i)
    for (std::uint32_t j = 0; j < b.size(); ++j) {
      const bool is_kept = next != kept.end() && *next == Face_pair{i, j};
      if (is_kept) ++next, ++tally.kept;
      if (is_kept && tally.kept % 16 != 0) continue;
      const bool is_near = near(a.triangle(i), b.triangle(j));
      if (is_near) ++tally.true_ones;
      ASSERT_TRUE(is_kept || !is_near) << i << ' ' << j;
    }
}

TEST(Face_filter, keeps_all_intersecting_faces) {
  const auto tally = for_leaves(3200, [](const Single_leaf& a, const Single_leaf& b, Tally& total) {
    expect_near_faces_kept(a, b, candidate_pairs(a.view(), b.view(), 0), total, triangles_intersect);
  });
  EXPECT_GT(tally.pairs, 1000000U);
  EXPECT_GT(tally.true_ones, 10000U) << "of one in 16";
  EXPECT_LT(tally.kept, tally.pairs / 2);
}

/// Boxes and corners are rounded relative to the size of their mesh, so small faces lose most of their digits.
TEST(Face_filter, keeps_intersecting_faces_that_are_tiny_beside_their_mesh) {
  constexpr std::uint32_t tiny = 32;
  Single_leaf a(tiny + 1), b(tiny + 1);
  a.set(tiny, {Point(-1, -1, -1), Point(1, 1, 1), Point(1, -1, 0.5)});
  b.set(tiny, {Point(1, 1, -1), Point(-1, -1, 1), Point(-1, 1, 0.25)});
  Hard_pairs hard(3);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> anywhere(-1, 1);
  Tally tally;
  for (const auto& kind : Hard_pairs::kinds())
    for (int exponent = -4; exponent >= -28; exponent -= 3) {
      SCOPED_TRACE(testing::Message() << kind.name << ", scale 2^" << exponent);
      for (int round = 0; round < 20; ++round) {
        for (std::uint32_t i = 0; i < tiny; ++i) {
          const auto [s, t] = (hard.*kind.make)();
          const double offset = anywhere(random), scale = std::ldexp(1, exponent);
          a.set(i, placed(s, {scale, offset})), b.set(i, placed(t, {scale, offset}));
        }
        a.refit(), b.refit();
        tally.pairs += a.size() * b.size();
        expect_near_faces_kept(a, b, candidate_pairs(a.view(), b.view(), 0), tally, triangles_intersect);
        if (HasFailure()) return;
      }
    }
  EXPECT_GT(tally.true_ones, 1000U) << "of one in 16";
  EXPECT_LT(tally.kept, tally.pairs / 4);
}

TEST(Face_filter, keeps_all_faces_nearer_than_the_margin) {
  std::mt19937_64 random(2);
  const auto tally = for_leaves(128, [&](const Single_leaf& a, const Single_leaf& b, Tally& total) {
    // A margin that differs from the distance of some pair in the last digit, or not much more.
    const double distance = closest_points(a.triangle(random() % a.size()), b.triangle(random() % b.size())).distance;
    const double factors[]{1, 1 - 0x1p-53, 1 + 0x1p-52, 1 - 1e-9, 1 + 1e-9, 0.5, 2};
    const double margin = std::min(factors[random() % 7] * distance, std::numeric_limits<double>::max());
    if (margin == 0) return;
    expect_near_faces_kept(a, b, candidate_pairs(a.view(), b.view(), margin), total,
                           [&](const Triangle& s, const Triangle& t) { return triangles_nearer_than(s, t, margin); });
  });
  EXPECT_GT(tally.true_ones, 300U) << "of one in 16";
  EXPECT_LT(tally.kept, tally.pairs * 3 / 4);
}

TEST(Face_filter, reads_nothing_past_the_last_vertex) {
  std::size_t count = 0;
  for (const std::uint32_t frequency : {1U, 2U, 4U, 7U}) {
    const Face_soup ball(icosphere(frequency)), other = placed(ball, 1, 0.3);
    for (const auto& soup : {ball, shuffled(ball, 1)}) {
      const Guarded_coordinates here(soup.coordinates), there(other.coordinates);
      for (const std::size_t leaf_faces : {3, 31, 128})
        for_instruction_sets([&] {
          const Region_tree a(soup.faces, {}, here.values(), {.leaf_faces = leaf_faces});
          const Region_tree b(other.faces, {}, there.values(), {.leaf_faces = leaf_faces});
          const Tree_view posed_a{&a, here.values()}, posed_b{&b, there.values()};
          Face_filter face_filter;
          for (const double margin : {0.0, 0.1}) {
            face_filter.begin(posed_a, posed_b, margin);
            for (std::uint32_t s = 0; s < a.leaf_count(); ++s)
              for (std::uint32_t t = 0; t < b.leaf_count(); ++t) count += face_filter.face_candidates(s, t).size();
          }
          face_filter.begin_within(posed_a, 0);
          for (std::uint32_t s = 0; s < a.leaf_count(); ++s)
            for (std::uint32_t t = s; t < a.leaf_count(); ++t) count += face_filter.face_candidates(s, t).size();
        });
    }
  }
  EXPECT_GT(count, 1000U);
}

TEST(Face_filter, guesses_an_edge_that_passes_through_the_other_face) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto triangle = [&] {
    Triangle t;
    for (auto& p : t) {
      const double x = unit(random), y = unit(random), z = unit(random);
      p = Point(x, y, z);
    }
    return t;
  };
  std::set<Crossing> seen;
  Single_leaf a(1), b(1);
  Face_filter face_filter;
  for (int i = 0; i < 2000; ++i) {
    const Triangle s = triangle(), t = triangle();
    if (!triangles_intersect(s, t)) continue;
    a.set(0, s), b.set(0, t);
    a.refit(), b.refit();
    for_instruction_sets([&] {
      face_filter.begin(a.view(), b.view(), 0);
      const auto candidates = face_filter.face_candidates(0, 0);
      ASSERT_EQ(candidates.size(), 1U);
      const Crossing crossing = candidates[0].crossing;
      ASSERT_LT(crossing, no_crossing);
      seen.insert(crossing);
      const Triangle &edges = crossing % 6 < 3 ? s : t, &face = crossing % 6 < 3 ? t : s;
      const Point &start = edges[crossing % 3], &end = edges[(crossing + 1) % 3];
      EXPECT_TRUE(CGAL::do_intersect(Kernel::Segment_3(start, end), Kernel::Triangle_3(face[0], face[1], face[2])));
      EXPECT_EQ(CGAL::orientation(face[0], face[1], face[2], start), crossing < 6 ? CGAL::POSITIVE : CGAL::NEGATIVE);
    });
  }
  // The last edge that is found is the guess. Two edges pass, save by chance, so edge 0 of a is never the last.
  EXPECT_EQ(seen.size(), 10U);
}

TEST(Face_filter, reads_positions_again_after_every_begin) {
  Single_leaf a(1), b(1);
  const Triangle s{Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)};
  a.set(0, s), b.set(0, s);
  a.refit(), b.refit();
  Face_filter face_filter;
  face_filter.begin(a.view(), b.view(), 0);
  EXPECT_EQ(face_filter.face_candidates(0, 0).size(), 1U);
  b.set(0, {Point(0, 0, 1), Point(1, 0, 1), Point(0, 1, 2)});
  b.refit();
  face_filter.begin(a.view(), b.view(), 0);
  EXPECT_TRUE(face_filter.face_candidates(0, 0).empty());
}

TEST(Face_filter, keeps_all_pairs_of_full_leaves_whose_faces_all_meet) {
  constexpr std::uint32_t full = 128;
  Single_leaf a(full), b(full);
  for (std::uint32_t i = 0; i < full; ++i) {
    const double x = 0.001 * i;  // upright ones, and level ones that each of them cuts
    a.set(i, {Point(x, -1, -1), Point(x, 1, -1), Point(x, 0, 2)});
    b.set(i, {Point(-2, -1, x), Point(2, -1, x), Point(0, 3, x)});
  }
  a.refit(), b.refit();
  for (const double margin : {0.0, 0.5}) {
    const auto candidates = candidate_pairs(a.view(), b.view(), margin);
    EXPECT_EQ(candidates.size(), full * full);
    EXPECT_EQ(candidates.back(), (Face_pair{full - 1, full - 1}));
  }
}

/// The boxes of the faces touch, or miss each other by the last digit.
TEST(Face_filter, keeps_faces_whose_boxes_only_touch) {
  Single_leaf a(16), b(16);
  for (const Placement& placement :
       {Placement{1, 0}, {1, 0x1p20}, {1, -0x1p40}, {0x1p-200, 0}, {0x1p-1040, 0}, {0x1p1020, 0}})
    for (int axis = 0; axis < 3; ++axis) {
      for (std::uint32_t f = 0; f < 16; ++f) {
        const auto turned = [&](double x, double y, double z) {
          const double p[]{x, y, z};
          return Point(p[(3 - axis) % 3], p[(4 - axis) % 3], p[(5 - axis) % 3]);
        };
        const double touch = 1.0 / 3, y = f;
        a.set(f, placed({turned(0, y, 0), turned(touch, y, 0), turned(0, y, 1)}, placement));
        b.set(f, placed({turned(touch, y, 0), turned(1, y, 0), turned(1, y, 1)}, placement));
      }
      a.refit(), b.refit();
      const auto candidates = candidate_pairs(a.view(), b.view(), 0);
      for (std::uint32_t f = 0; f < 16; ++f)
        ASSERT_TRUE(std::ranges::binary_search(candidates, Face_pair{f, f})) << placement.scale << ' ' << axis;
    }
}

bool share_a_vertex(const Corners& a, const Corners& b) {
  return std::ranges::any_of(a, [&](std::uint32_t v) { return std::ranges::count(b, v) > 0; });
}

/// Checks the candidates within an object on each instruction set.
/// @return number of intersecting pairs
std::size_t expect_pairs_within(const Posed_object& object) {
  const Face_soup& soup = object.soup();
  const auto posed = object.view();
  const auto leaves = static_cast<std::uint32_t>(posed.tree->leaf_count());
  std::size_t intersecting = 0;
  std::vector<Face_pairs> answers;
  for_instruction_sets([&] {
    Face_filter face_filter;
    face_filter.begin_within(posed, 0);
    Face_pairs found;
    for (std::uint32_t i = 0; i < leaves; ++i)
      for (std::uint32_t j = i; j < leaves; ++j)
        for (auto [a, b] : face_pairs(face_filter.face_candidates(i, j), posed, i, posed, j)) {
          EXPECT_FALSE(share_a_vertex(soup.faces[a], soup.faces[b])) << a << ' ' << b;
          found.push_back({std::min(a, b), std::max(a, b)});
        }
    std::ranges::sort(found);
    EXPECT_EQ(std::ranges::adjacent_find(found), found.end()) << "a pair twice";
    answers.push_back(found);
  });
  for (const auto& answer : answers) EXPECT_EQ(answer, answers[0]);
  for (std::uint32_t a = 0; a < soup.faces.size(); ++a)
    for (std::uint32_t b = a + 1; b < soup.faces.size(); ++b)
      if (!share_a_vertex(soup.faces[a], soup.faces[b]) && triangles_intersect(soup.triangle(a), soup.triangle(b))) {
        ++intersecting;
        EXPECT_TRUE(std::ranges::binary_search(answers[0], Face_pair{a, b})) << a << ' ' << b;
      }
  return intersecting;
}

TEST(Face_filter, within_one_mesh_keeps_each_intersecting_pair_that_shares_no_vertex_once) {
  std::size_t intersecting = 0;
  for (const std::size_t leaf_faces : {2, 9, 128}) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed)
      for (const auto& placement : placements) {
        const auto soup = lattice_soup(128, 20U << seed % 3U * 2, 6, seed);
        intersecting += expect_pairs_within(Posed_object(placed(soup, placement.scale, placement.offset), leaf_faces));
      }
    for (const double distance : {0.02, 0.1, 0.5})
      intersecting += expect_pairs_within(Posed_object(crumpled(icosphere(3), distance, 1), leaf_faces));
    // The tips of two cones pass through each other; all faces of a leaf have a tip in common.
    const Face_soup cones = joined(fan_of_faces(24, {0, 0, -0.25}, -0.5), fan_of_faces(25, {0.01, 0.02, 0}, 0.5));
    EXPECT_GT(expect_pairs_within(Posed_object(cones, leaf_faces)), 20U);
  }
  EXPECT_GT(intersecting, 10000U);
}

}  // namespace
}  // namespace lodestone
