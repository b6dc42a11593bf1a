// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/contact/leaf_pairs.h"

#include <CGAL/Intersections_3/Segment_3_Triangle_3.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <map>
#include <set>

#include "face_soup.h"
#include "hard_pairs.h"
#include "instruction_sets.h"
#include "lodestone/contact/triangle_distance.h"

namespace lodestone {
namespace {

using Numbers = std::vector<Face_pair>;

/// A tree of a single leaf whose faces share no vertex, refitted to triangles.
class Leaf {
 public:
  explicit Leaf(std::uint32_t faces) {
    soup_.coordinates.resize(9 * std::size_t{faces});
    for (std::uint32_t i = 0; i < faces; ++i) soup_.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    tree_ = Region_tree(soup_.faces, {}, soup_.coordinates, {.leaf_faces = 128});
  }

  void set(std::size_t face, const Triangle& t) {
    double* x = soup_.coordinates.data() + 9 * face;
    for (const auto& corner : t)
      for (int axis = 0; axis < 3; ++axis) *x++ = corner[axis];
  }
  void refit() { ASSERT_TRUE(tree_.refit(soup_.coordinates)); }
  std::size_t size() const { return soup_.faces.size(); }
  Triangle triangle(std::size_t face) const { return soup_.triangle(face); }
  Posed_tree posed() const { return {&tree_, soup_.coordinates}; }

 private:
  Face_soup soup_;
  Region_tree tree_;
};

/// Faces by number instead of place, sorted.
Numbers numbered(std::span<const Face_places> places, const Posed_tree& a, std::uint32_t leaf_a, const Posed_tree& b,
                 std::uint32_t leaf_b) {
  Numbers pairs;
  for (const auto& place : places) pairs.push_back({a.tree->faces(leaf_a)[place.a], b.tree->faces(leaf_b)[place.b]});
  std::ranges::sort(pairs);
  return pairs;
}

/// The near pairs of two trees of one leaf, the same for each instruction set.
Numbers near_pairs(const Posed_tree& a, const Posed_tree& b, double margin) {
  Leaf_pairs leaf_pairs;
  std::vector<Numbers> answers;
  for_instruction_sets([&] {
    leaf_pairs.begin(a, b, margin);
    answers.push_back(numbered(leaf_pairs.near_faces(0, 0), a, 0, b, 0));
  });
  for (const auto& answer : answers) EXPECT_EQ(answer, answers[0]);
  EXPECT_EQ(std::ranges::adjacent_find(answers[0]), answers[0].end()) << "a pair twice";
  return answers[0];
}

struct Place {
  double scale, offset;
};
const std::vector<Place> places{{1, 0},        {1, 0x1p20},  {1, -0x1p40},   {0x1p-300, 0},
                                {0x1p-340, 0}, {0x1p300, 0}, {0x1p-1050, 0}, {0x1p1020, 0}};

Triangle placed(Triangle t, const Place& place) {
  for (auto& p : t) {
    const auto moved = [&](double x) { return place.scale * x + place.offset; };
    p = {moved(p.x()), moved(p.y()), moved(p.z())};
  }
  return t;
}

struct Tally {
  std::size_t pairs = 0, near = 0, true_ones = 0;
};

/// Calls `check(a, b, tally)` with pairs of leaves, `per_kind` pairs of faces at least for each kind and place.
template <class Check>
Tally for_leaves(std::size_t per_kind, const Check& check) {
  Tally total;
  std::map<std::uint32_t, std::array<Leaf, 2>> leaves;
  for (const std::uint32_t size : {1U, 2U, 7U, 32U}) leaves.try_emplace(size, std::array{Leaf(size), Leaf(size)});
  Hard_pairs hard(1);
  for (const auto& kind : Hard_pairs::kinds())
    for (const auto& place : places) {
      SCOPED_TRACE(testing::Message() << kind.name << ", scale " << place.scale << ", offset " << place.offset);
      for (auto& [size, pair] : leaves)
        for (std::size_t done = 0; done < per_kind; done += size * size) {
          auto& [a, b] = pair;
          for (std::uint32_t i = 0; i < size; ++i) {
            const auto [s, t] = (hard.*kind.make)();
            a.set(i, placed(s, place)), b.set(i, placed(t, place));
          }
          a.refit(), b.refit();
          total.pairs += size * size;
          check(a, b, total);
          if (testing::Test::HasFailure()) return total;
        }
    }
  return total;
}

/// Checks that the pairs left out are apart, which `near(a, b)` tells; of those listed, one in a few is looked at.
template <class Near>
void expect_none_left_out(const Leaf& a, const Leaf& b, const Numbers& listed, Tally& tally, const Near& near) {
  auto next = listed.begin();
  for (std::uint32_t i = 0; i < a.size(); ++i)
    for (std::uint32_t j = 0; j < b.size(); ++j) {
      const bool is_listed = next != listed.end() && *next == Face_pair{i, j};
      if (is_listed) ++next, ++tally.near;
      if (is_listed && tally.near % 16 != 0) continue;
      const bool is_near = near(a.triangle(i), b.triangle(j));
      if (is_near) ++tally.true_ones;
      ASSERT_TRUE(is_listed || !is_near) << i << ' ' << j;
    }
}

TEST(Leaf_pairs, never_leave_out_faces_that_intersect) {
  const auto tally = for_leaves(3200, [](const Leaf& a, const Leaf& b, Tally& total) {
    expect_none_left_out(a, b, near_pairs(a.posed(), b.posed(), 0), total, triangles_intersect);
  });
  EXPECT_GT(tally.pairs, 1000000U);
  EXPECT_GT(tally.true_ones, 10000U) << "of one in 16";
  EXPECT_LT(tally.near, tally.pairs / 2);
}

TEST(Leaf_pairs, never_leave_out_faces_nearer_than_the_margin) {
  std::mt19937_64 random(2);
  const auto tally = for_leaves(128, [&](const Leaf& a, const Leaf& b, Tally& total) {
    // A margin that decides about some pair by the last digit, or thereabouts.
    const double distance = closest_points(a.triangle(random() % a.size()), b.triangle(random() % b.size())).distance;
    const double factors[]{1, 1 - 0x1p-53, 1 + 0x1p-52, 1 - 1e-9, 1 + 1e-9, 0.5, 2};
    const double margin = std::min(factors[random() % 7] * distance, std::numeric_limits<double>::max());
    if (margin == 0) return;
    expect_none_left_out(a, b, near_pairs(a.posed(), b.posed(), margin), total,
                         [&](const Triangle& s, const Triangle& t) { return triangles_nearer_than(s, t, margin); });
  });
  EXPECT_GT(tally.true_ones, 300U) << "of one in 16";
  EXPECT_LT(tally.near, tally.pairs * 3 / 4);
}

/// Pairs whose boxes overlap, apart along the normal of one of them or within its plane across an edge.
std::vector<Triangle_pair> apart_by(double gap, std::mt19937_64& random, int count) {
  std::vector<Triangle_pair> pairs;
  std::uniform_real_distribution<double> unit(-1, 1);
  while (std::ssize(pairs) < count) {
    const auto vector = [&] {
      const double x = unit(random), y = unit(random), z = unit(random);
      return Eigen::Vector3d(x, y, z);
    };
    std::array<Eigen::Vector3d, 3> a{vector(), vector(), vector()}, b{vector(), vector(), vector()};
    const Eigen::Vector3d edge = a[1] - a[0], normal = edge.cross(a[2] - a[0]);
    if (normal.norm() < 0.1) continue;
    const Eigen::Vector3d axis = (pairs.size() % 2 == 0 ? normal : normal.cross(edge)).normalized();
    const auto along = [&](const auto& p) { return axis.dot(p); };
    const double top = std::max({along(a[0]), along(a[1]), along(a[2])});
    const double low = std::min({along(b[0]), along(b[1]), along(b[2])});
    Eigen::AlignedBox3d box_a, box_b;
    for (auto& p : b) p += (top - low + gap) * axis, box_b.extend(p);
    for (const auto& p : a) box_a.extend(p);
    if (!box_a.intersects(box_b)) continue;
    const auto triangle = [](const auto& t) {
      const auto point = [](const auto& p) { return Point(p.x(), p.y(), p.z()); };
      return Triangle{point(t[0]), point(t[1]), point(t[2])};
    };
    pairs.emplace_back(triangle(a), triangle(b));
  }
  return pairs;
}

TEST(Leaf_pairs, leave_out_faces_that_a_plane_through_one_of_them_separates) {
  std::mt19937_64 random(1);
  Leaf a(1), b(1);
  for (const Place& place : {Place{1, 0}, {1, 1}, {0x1p-200, 0}, {0x1p200, 0}})
    for (const auto& [s, t] : apart_by(1e-9, random, 2000)) {
      a.set(0, placed(s, place)), b.set(0, placed(t, place));
      a.refit(), b.refit();
      ASSERT_TRUE(near_pairs(a.posed(), b.posed(), 0).empty()) << place.scale;
      ASSERT_TRUE(near_pairs(b.posed(), a.posed(), 0).empty()) << place.scale;
    }
  // Beyond 1e-90 and 1e90 determinants are not relied upon: a normal still separates.
  const auto pairs = apart_by(1e-9, random, 2000);
  for (const double scale : {0x1p-310, 0x1p310})
    for (std::size_t i = 0; i < pairs.size(); i += 2) {
      a.set(0, placed(pairs[i].first, {scale, 0})), b.set(0, placed(pairs[i].second, {scale, 0}));
      a.refit(), b.refit();
      ASSERT_TRUE(near_pairs(a.posed(), b.posed(), 0).empty()) << scale;
    }
  for (const auto& [s, t] : apart_by(0.1, random, 2000)) {
    a.set(0, s), b.set(0, t);
    a.refit(), b.refit();
    ASSERT_TRUE(near_pairs(a.posed(), b.posed(), 0.1 - 1e-9).empty());
  }
}

/// Pairs that are a gap apart across an edge of each, and along no direction that only one of them decides: two edges
/// at right angles, one above the other, and faces that lean aside from them.
std::vector<Triangle_pair> apart_across_edges(double gap, std::mt19937_64& random, int count) {
  std::vector<Triangle_pair> pairs;
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < count; ++i) {
    const double w = unit(random), u = unit(random), v = unit(random), t = unit(random);
    const Eigen::Matrix3d rotation = Eigen::Quaterniond(w, u, v, t).normalized().toRotationMatrix();
    const auto point = [&](double x, double y, double z) {
      const Eigen::Vector3d p = rotation * Eigen::Vector3d(x, y, z);
      return Point(p.x(), p.y(), p.z());
    };
    const double x = 0.2 * unit(random), y = 0.2 * unit(random);
    Triangle a{point(-2, y, 0), point(2, y, 0), point(0, y + 1.5, -2)};
    Triangle b{point(x, -2, gap), point(x, 2, gap), point(x - 1.5, 0, 2 + gap)};
    std::ranges::rotate(a, a.begin() + i % 3);
    std::ranges::rotate(b, b.begin() + i / 3 % 3);
    pairs.emplace_back(a, b);
  }
  return pairs;
}

TEST(Leaf_pairs, leave_out_faces_that_an_edge_of_each_separates) {
  std::mt19937_64 random(1);
  Leaf a(1), b(1);
  for (const Place& place : {Place{1, 0}, {1, 1}, {0x1p-200, 0}, {0x1p200, 0}})
    for (const auto& [s, t] : apart_across_edges(1e-9, random, 500)) {
      a.set(0, placed(s, place)), b.set(0, placed(t, place));
      a.refit(), b.refit();
      ASSERT_TRUE(near_pairs(a.posed(), b.posed(), 0).empty()) << place.scale;
      ASSERT_TRUE(near_pairs(b.posed(), a.posed(), 0).empty()) << place.scale;
    }
}

TEST(Leaf_pairs, know_an_edge_that_passes_through_the_other_face) {
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
  Leaf a(1), b(1);
  Leaf_pairs leaf_pairs;
  for (int i = 0; i < 2000; ++i) {
    const Triangle s = triangle(), t = triangle();
    if (!triangles_intersect(s, t)) continue;
    a.set(0, s), b.set(0, t);
    a.refit(), b.refit();
    for_instruction_sets([&] {
      leaf_pairs.begin(a.posed(), b.posed(), 0);
      const auto near = leaf_pairs.near_faces(0, 0);
      ASSERT_EQ(near.size(), 1U);
      const Crossing crossing = near[0].crossing;
      ASSERT_LT(crossing, no_crossing);
      seen.insert(crossing);
      const Triangle &edges = crossing % 6 < 3 ? s : t, &face = crossing % 6 < 3 ? t : s;
      const Point &start = edges[crossing % 3], &end = edges[(crossing + 1) % 3];
      EXPECT_TRUE(CGAL::do_intersect(Kernel::Segment_3(start, end), Kernel::Triangle_3(face[0], face[1], face[2])));
      EXPECT_EQ(CGAL::orientation(face[0], face[1], face[2], start), crossing < 6 ? CGAL::POSITIVE : CGAL::NEGATIVE);
    });
  }
  // The last one that is found is told, and edge 0 of a is never the only one: two edges pass, save by chance.
  EXPECT_EQ(seen.size(), 10U);
}

TEST(Leaf_pairs, are_read_anew_after_every_begin) {
  Leaf a(1), b(1);
  const Triangle s{Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)};
  a.set(0, s), b.set(0, s);
  a.refit(), b.refit();
  Leaf_pairs leaf_pairs;
  leaf_pairs.begin(a.posed(), b.posed(), 0);
  EXPECT_EQ(leaf_pairs.near_faces(0, 0).size(), 1U);
  b.set(0, {Point(0, 0, 1), Point(1, 0, 1), Point(0, 1, 2)});
  b.refit();
  leaf_pairs.begin(a.posed(), b.posed(), 0);
  EXPECT_TRUE(leaf_pairs.near_faces(0, 0).empty());
}

TEST(Leaf_pairs, of_two_leaves_whose_boxes_overlap_are_few) {
  Face_soup low(cloth(8, 8)), high = low;
  deform(low, [](const Point& p) { return Point(p.x(), p.y(), p.x()); });
  deform(high, [](const Point& p) { return Point(p.x(), p.y(), p.x() + 0.2); });
  const Posed_object a(low, 128, false), b(high, 128, false);
  ASSERT_EQ(a.object().tree().leaf_count(), 1U);
  EXPECT_TRUE(near_pairs(a.posed(), b.posed(), 0).empty());
  const auto near = near_pairs(a.posed(), b.posed(), 0.15);
  EXPECT_GT(near.size(), 0U);
  EXPECT_LT(near.size(), 128U * 128 / 5);
}

TEST(Leaf_pairs, of_full_leaves_whose_faces_all_meet_are_all_of_them) {
  constexpr std::uint32_t full = 128;
  Leaf a(full), b(full);
  for (std::uint32_t i = 0; i < full; ++i) {
    const double x = 0.001 * i;  // upright ones, and level ones that each of them cuts
    a.set(i, {Point(x, -1, -1), Point(x, 1, -1), Point(x, 0, 2)});
    b.set(i, {Point(-2, -1, x), Point(2, -1, x), Point(0, 3, x)});
  }
  a.refit(), b.refit();
  for (const double margin : {0.0, 0.5}) {
    const auto near = near_pairs(a.posed(), b.posed(), margin);
    EXPECT_EQ(near.size(), full * full);
    EXPECT_EQ(near.back(), (Face_pair{full - 1, full - 1}));
  }
}

/// The boxes of the faces touch, or miss each other by the last digit: what is lost by rounding must not matter.
TEST(Leaf_pairs, never_leave_out_faces_whose_boxes_only_touch) {
  Leaf a(16), b(16);
  for (const Place& place : {Place{1, 0}, {1, 0x1p20}, {1, -0x1p40}, {0x1p-200, 0}, {0x1p-1040, 0}, {0x1p1020, 0}})
    for (int axis = 0; axis < 3; ++axis) {
      for (std::uint32_t f = 0; f < 16; ++f) {
        const auto turned = [&](double x, double y, double z) {
          const double p[]{x, y, z};
          return Point(p[(3 - axis) % 3], p[(4 - axis) % 3], p[(5 - axis) % 3]);
        };
        const double touch = 1.0 / 3, y = f;
        a.set(f, placed({turned(0, y, 0), turned(touch, y, 0), turned(0, y, 1)}, place));
        b.set(f, placed({turned(touch, y, 0), turned(1, y, 0), turned(1, y, 1)}, place));
      }
      a.refit(), b.refit();
      const auto near = near_pairs(a.posed(), b.posed(), 0);
      for (std::uint32_t f = 0; f < 16; ++f)
        ASSERT_TRUE(std::ranges::binary_search(near, Face_pair{f, f})) << place.scale << ' ' << axis;
    }
}

bool share_a_vertex(const Corners& a, const Corners& b) {
  return std::ranges::any_of(a, [&](std::uint32_t v) { return std::ranges::count(b, v) > 0; });
}

/// Checks the pairs within an object for each instruction set; gives how many intersect.
std::size_t expect_pairs_within(const Posed_object& object) {
  const Face_soup& soup = object.soup();
  const auto posed = object.posed();
  const auto leaves = static_cast<std::uint32_t>(posed.tree->leaf_count());
  std::size_t intersecting = 0;
  std::vector<Numbers> answers;
  for_instruction_sets([&] {
    Leaf_pairs leaf_pairs;
    leaf_pairs.begin_within(posed);
    Numbers found;
    for (std::uint32_t i = 0; i < leaves; ++i)
      for (std::uint32_t j = i; j < leaves; ++j)
        for (auto [a, b] : numbered(leaf_pairs.near_faces(i, j), posed, i, posed, j)) {
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

TEST(Leaf_pairs, within_one_mesh_are_each_pair_once_of_faces_that_share_no_vertex) {
  std::size_t intersecting = 0;
  for (const std::size_t leaf_faces : {2, 9, 128}) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed)
      for (const auto& place : places) {
        const auto soup = lattice_soup(128, 20U << seed % 3U * 2, 6, seed);
        intersecting +=
            expect_pairs_within(Posed_object(lodestone::placed(soup, place.scale, place.offset), leaf_faces));
      }
    for (const double distance : {0.02, 0.1, 0.5})
      intersecting += expect_pairs_within(Posed_object(crumpled(icosphere(3), distance, 1), leaf_faces));
  }
  EXPECT_GT(intersecting, 10000U);
}

}  // namespace
}  // namespace lodestone
