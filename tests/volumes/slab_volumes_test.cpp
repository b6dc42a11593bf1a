// SPDX-License-Identifier: GPL-3.0-or-later
// What holds for every volume made of slabs.
#include <gtest/gtest.h>

#include <cstring>

#include "lodestone/volumes/bounding_volume.h"
#include "support/guarded_coordinates.h"
#include "support/instruction_sets.h"
#include "support/leaves.h"
#include "support/slab_membership.h"

namespace lodestone {
namespace {

template <class Volume>
class Slab_volume : public testing::Test {};
using Slab_volumes = testing::Types<K_dop<14>, K_dop<18>, K_dop<26>, Oriented_box, Quospo>;
TYPED_TEST_SUITE(Slab_volume, Slab_volumes);

Eigen::Vector3d sides(const Aabb& box) {
  return {box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]};
}

/// Points of a volume, many of them near its border: those from a vertex outwards, by less and less, that are inside.
template <class Volume>
std::vector<Exact_point> points_inside(const Volume& volume, const Leaf& leaf, std::mt19937_64& random) {
  const Eigen::Vector3d size = sides(volume.bounds());
  std::vector<Exact_point> points;
  for (int sample = 0; sample < 30; ++sample) {
    const Eigen::Vector3d step = std::ldexp(1.0, -2 * sample) * size.cwiseProduct(vector_in_cube(random));
    const Eigen::Vector3d p = leaf.point(random() % leaf.vertices.size()) + step;
    if (p.allFinite() && inside(volume, exact_point(p))) points.push_back(exact_point(p));
  }
  return points;
}

TYPED_TEST(Slab_volume, is_a_bounding_volume) { EXPECT_TRUE(Bounding_volume<TypeParam>); }

TYPED_TEST(Slab_volume, the_volume_around_two_contains_the_points_of_both) {
  const auto leaves = hard_leaves();
  std::mt19937_64 random(11);
  for (std::size_t i = 0; i + 1 < leaves.size(); ++i) {
    const auto a = volume_of<TypeParam>(leaves[i].leaf), b = volume_of<TypeParam>(leaves[i + 1].leaf);
    const TypeParam both[]{volume_of(a, b), volume_of(b, a), volume_of(a, a)};
    for (const auto& p : points_inside(a, leaves[i].leaf, random))
      for (const auto& volume : both) ASSERT_TRUE(inside(volume, p)) << leaves[i].name << " and " << leaves[i + 1].name;
  }
}

TYPED_TEST(Slab_volume, bounds_contain_the_points_of_the_volume) {
  std::mt19937_64 random(12);
  for (const auto& [name, leaf] : hard_leaves()) {
    const auto volume = volume_of<TypeParam>(leaf);
    const Aabb box = volume.bounds();
    for (const auto& p : points_inside(volume, leaf, random))
      for (int axis = 0; axis < 3; ++axis) ASSERT_TRUE(within(box.low[axis], p[axis], box.high[axis])) << name;
  }
}

TYPED_TEST(Slab_volume, is_near_another_that_shares_a_vertex) {
  std::mt19937_64 random(13);
  for (const auto& [name, leaf] : hard_leaves()) {
    const auto a = volume_of<TypeParam>(leaf);
    const auto size = sides(a.bounds());
    for (int sample = 0; sample < 10; ++sample) {
      std::vector<Eigen::Vector3d> points{leaf.point(random() % leaf.vertices.size())};
      const Eigen::Vector3d away = vector_in_cube(random);
      for (int k = 0; k < 6; ++k) points.push_back(points[0] + size.cwiseProduct(away + 0.2 * vector_in_cube(random)));
      const auto b = volume_of<TypeParam>(points);
      ASSERT_TRUE(near(a, b, 0) && near(b, a, 0)) << name;
      ASSERT_TRUE(near(a, b, 1e-3) && near(b, a, 1e-320)) << name;
    }
  }
}

TYPED_TEST(Slab_volume, is_near_another_within_the_margin) {
  std::mt19937_64 random(14);
  for (const double scale : {1.0, 0x1p-300, 0x1p300, 1e-320})
    for (int sample = 0; sample < 3000; ++sample) {
      auto points = points_in_box(10, {0.5, 0.3, sample % 2 * 0.1}, vector_in_cube(random), random);
      const auto others = points_in_box(10, {0.5, 0.3, 0.1}, 2 * vector_in_cube(random), random);
      std::vector<Eigen::Vector3d> a, b;
      for (const auto& p : points) a.push_back(scale * p);
      for (const auto& p : others) b.push_back(scale * p);
      double margin = (a[0] - b[0]).cwiseAbs().sum();
      for (const auto& p : a)
        for (const auto& q : b) margin = std::min(margin, scale * ((p - q) / scale).norm());
      margin *= 1 + 1e-15;
      margin = std::nextafter(margin, INFINITY);
      ASSERT_TRUE(near(volume_of<TypeParam>(a), volume_of<TypeParam>(b), margin));
    }
}

TYPED_TEST(Slab_volume, is_not_near_another_beyond_a_plane) {
  std::mt19937_64 random(15);
  for (const auto& d : K_dop<26>::directions) {
    const Eigen::Vector3d step(3.5 * d[0], 3.5 * d[1], 3.5 * d[2]);
    const auto a = volume_of<TypeParam>(points_in_box(60, {1, 1, 0.5}, {0, 0, 0}, random));
    const auto b = volume_of<TypeParam>(points_in_box(60, {1, 1, 0.5}, step, random));
    EXPECT_FALSE(near(a, b, 0));
    EXPECT_FALSE(near(a, b, 0.25));
    EXPECT_TRUE(near(a, b, step.norm()));
  }
}

TYPED_TEST(Slab_volume, of_a_single_point_has_no_extent_and_no_volume) {
  for (const double scale : {1.0, 0x1p-300, 0x1p300, 1e-320}) {
    const Leaf leaf = strip(std::vector(5, Eigen::Vector3d(0.1 * scale, -0.7 * scale, 0.3 * scale)));
    const auto a = volume_of<TypeParam>(leaf), both = volume_of(a, a);
    EXPECT_EQ(a.extent(), 0);
    EXPECT_EQ(a.volume(), 0);
    EXPECT_EQ(both.extent(), 0);
    EXPECT_TRUE(near(a, both, 0));
  }
}

TYPED_TEST(Slab_volume, of_flat_and_straight_leaves_has_next_to_no_volume) {
  std::mt19937_64 random(16);
  for (const double thickness : {0.0, 0.5}) {
    const auto flat = volume_of<TypeParam>(points_in_box(60, {1, thickness, 0}, {1, 2, 3}, random));
    EXPECT_GT(flat.extent(), 0);
    EXPECT_GE(flat.volume(), 0);
    EXPECT_LE(flat.volume(), sides(flat.bounds()).prod());
  }
  const Leaf level = strip({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}});
  EXPECT_LE(volume_of<TypeParam>(level).volume(), 1e-12);
}

TYPED_TEST(Slab_volume, is_the_same_for_every_instruction_set) {
  for (const auto& [name, leaf] : hard_leaves()) {
    const auto first = volume_of<TypeParam>(leaf);
    for_instruction_sets([&] {
      const auto again = volume_of<TypeParam>(leaf);
      ASSERT_EQ(std::memcmp(&first, &again, sizeof first), 0) << name;
      ASSERT_TRUE(first == again) << name;
    });
  }
}

TYPED_TEST(Slab_volume, reads_nothing_past_the_last_vertex) {
  std::mt19937_64 random(17);
  for (std::size_t count = 1; count < 40; ++count) {
    Leaf leaf = strip(points_in_box(count, {1, 1, 1}, {0, 0, 0}, random));
    const Guarded_coordinates guarded(leaf.coordinates);
    for_instruction_sets([&] {
      TypeParam volume;
      volume.enclose({guarded.values(), leaf.vertices, leaf.corners});
      ASSERT_TRUE(volume == volume_of<TypeParam>(leaf));
    });
  }
}

TYPED_TEST(Slab_volume, of_non_finite_coordinates_terminates) {
  std::mt19937_64 random(18);
  for (const double bad : {double{NAN}, double{INFINITY}, double{-INFINITY}})
    for (std::size_t place = 0; place < 27; ++place) {
      Leaf leaf = strip(points_in_box(9, {1, 1, 1}, {0, 0, 0}, random));
      leaf.coordinates[place] = bad;
      const auto a = volume_of<TypeParam>(leaf), both = volume_of(a, a);
      near(a, both, 0), a.extent(), a.volume(), both.volume(), a.bounds(), both.bounds();
    }
}

}  // namespace
}  // namespace lodestone
