// SPDX-License-Identifier: GPL-3.0-or-later
// Long oblique faces beside small ones: their boxes overlap everything, so directions must part them.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "filter/filter_checks.h"
#include "lodestone/triangles/triangle_distance.h"

namespace lodestone {
namespace {

Point point_at(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }
Eigen::Vector3d vector_of(const Point& p) { return {p.x(), p.y(), p.z()}; }

/// Makes leaves of long faces that pass through, touch or just miss the small faces of another.
class Long_faces {
 public:
  explicit Long_faces(unsigned seed) : random_(seed) {}

  /// In a cube of size 1 in the origin, some of them flat in one of its sides.
  Triangle small() {
    Triangle t;
    const std::size_t side = random_() % 8;
    for (auto& corner : t) {
      Eigen::Vector3d p(number(0, 1), number(0, 1), number(0, 1));
      if (side < 3) p[static_cast<Eigen::Index>(side)] = random_() % 2 == 0 ? 0 : 1;
      corner = point_at(p);
    }
    return t;
  }

  /// Its first edge passes through a corner of another face, or near it: off by at most that much in units of it.
  Triangle through(const Point& corner, double off) {
    const Eigen::Vector3d along = direction() * number(2, 200), aside = direction();
    const Eigen::Vector3d at = vector_of(corner) + off * aside;
    // Away from the cube, so that the face often has but this edge near it.
    const Eigen::Vector3d third = at + number(-1, 1) * along + number(0.1, 2) * aside;
    return {point_at(at - number(0.1, 1) * along), point_at(at + number(0.1, 1) * along), point_at(third)};
  }

  /// Touches the cube in a corner of it, and lies beyond a plane through that corner alone.
  Triangle touching(const Point& corner) {
    const Eigen::Vector3d at = vector_of(corner);
    const Eigen::Vector3d out = number(0.1, 1) * Eigen::Vector3d(at.x() - 0.5, 0, 0) +
                                number(0.1, 1) * Eigen::Vector3d(0, at.y() - 0.5, 0) +
                                number(0.1, 1) * Eigen::Vector3d(0, 0, at.z() - 0.5);
    const auto edge = [&] { return (number(1, 200) * (direction().cross(out) + off() * out)).eval(); };
    return {corner, point_at(at + edge()), point_at(at + edge())};
  }

  double off() {
    const double sizes[]{0, 1e-16, 1e-9, 1e-5, 0.1, 1, 3};
    return sizes[random_() % 7] * number(0, 1);
  }
  std::size_t below(std::size_t n) { return random_() % n; }

 private:
  double number(double from, double to) { return std::uniform_real_distribution(from, to)(random_); }
  Eigen::Vector3d direction() {
    Eigen::Vector3d d;
    do d = {number(-1, 1), number(-1, 1), number(-1, 1)};
    while (d.squaredNorm() < 0.01);
    return d.normalized();
  }

  std::mt19937_64 random_;
};

/// Small faces, and long ones at their corners.
void fill(Single_leaf& small, Single_leaf& long_ones, Long_faces& make, const Placement& placement) {
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < small.size(); ++i) {
    triangles.push_back(make.small());
    if (i < 8) triangles[i][0] = Point(i & 1U, i >> 1U & 1U, i >> 2U);
    small.set(i, placed(triangles[i], placement));
  }
  for (std::size_t i = 0; i < long_ones.size(); ++i) {
    const Triangle& at = triangles[make.below(i % 2 == 0 ? 8 : small.size())];
    long_ones.set(i,
                  placed(i % 2 == 0 ? make.touching(at[0]) : make.through(at[make.below(3)], make.off()), placement));
  }
  small.refit(), long_ones.refit();
}

/// Long faces must not end beyond all doubles.
std::vector<Placement> placements_of_long_faces() {
  auto all = placements;
  for (auto& placement : all) placement.scale = std::min(placement.scale, 0x1p1010);
  return all;
}

TEST(Face_filter_of_long_faces, keeps_all_that_intersect) {
  Long_faces make(1);
  Single_leaf small(48), long_ones(100);
  std::size_t kept = 0, intersecting = 0;
  for (const auto& placement : placements_of_long_faces())
    for (int round = 0; round < 12; ++round) {
      fill(small, long_ones, make, placement);
      const auto candidates = candidate_pairs(small.view(), long_ones.view(), 0);
      const auto turned = candidate_pairs(long_ones.view(), small.view(), 0);
      kept += candidates.size();
      for (std::uint32_t i = 0; i < small.size(); ++i)
        for (std::uint32_t j = 0; j < long_ones.size(); ++j) {
          if (!triangles_intersect(small.triangle(i), long_ones.triangle(j))) continue;
          ++intersecting;
          ASSERT_TRUE(std::ranges::binary_search(candidates, Face_pair{i, j})) << i << ' ' << j;
          ASSERT_TRUE(std::ranges::binary_search(turned, Face_pair{j, i})) << i << ' ' << j;
        }
    }
  EXPECT_GT(intersecting, 5000U);
  EXPECT_LT(kept, 3 * intersecting);
}

TEST(Face_filter_of_long_faces, keeps_all_that_are_nearer_than_the_margin) {
  Long_faces make(2);
  Single_leaf small(24), long_ones(96);
  std::size_t near = 0;
  for (const auto& placement : placements_of_long_faces())
    for (int round = 0; round < 6; ++round) {
      fill(small, long_ones, make, placement);
      double margin = 0;
      while (margin == 0)
        margin =
            closest_points(small.triangle(make.below(small.size())), long_ones.triangle(make.below(long_ones.size())))
                .distance *
            (round % 2 == 0 ? 1 : 1 + 1e-9);
      if (margin > 1e300) continue;
      const auto candidates = candidate_pairs(small.view(), long_ones.view(), margin);
      for (std::uint32_t i = 0; i < small.size(); ++i)
        for (std::uint32_t j = 0; j < long_ones.size(); ++j) {
          const bool is_kept = std::ranges::binary_search(candidates, Face_pair{i, j});
          if (is_kept && make.below(8) > 0) continue;  // exact distances take long
          const bool is_near = triangles_nearer_than(small.triangle(i), long_ones.triangle(j), margin);
          near += is_near ? 1 : 0;
          ASSERT_TRUE(is_kept || !is_near) << i << ' ' << j << ' ' << margin;
        }
    }
  EXPECT_GT(near, 1000U) << "of one in eight";
}

/// All faces are in the plane x + y + z = 0, and those of one leaf end so far away that a float cannot hold all digits
/// of their corners: rounded, they leave the plane by more than the small ones measure.
TEST(Face_filter_of_long_faces, keeps_small_faces_in_the_plane_of_others_that_reach_far_away) {
  constexpr std::uint32_t small_faces = 32, long_faces = 64;  // so many that slabs are compared first
  std::mt19937_64 random(4);
  const auto in_plane = [](double x, double y) { return Point(x, y, -x - y); };
  Single_leaf small(small_faces), long_ones(long_faces);
  for (std::uint32_t i = 0; i < small_faces; ++i) {
    const double x = i % 8, y = i / 8;  // multiples of 1/8 near the origin
    small.set(i, {in_plane(x / 8, y / 8), in_plane((x + 1) / 8, y / 8), in_plane(x / 8, (y + 1) / 8)});
  }
  for (std::uint32_t i = 0; i < long_faces; ++i) {
    // Around the origin in whole numbers, which the sum of two of them is too.
    const auto far = [&] { return std::ldexp(1.0, 30) + static_cast<double>(random() >> 36); };
    long_ones.set(i, {in_plane(-far(), -far()), in_plane(4 * far(), -far()), in_plane(-far(), 4 * far())});
  }
  small.refit(), long_ones.refit();
  EXPECT_TRUE(triangles_intersect(small.triangle(0), long_ones.triangle(0)));
  EXPECT_EQ(candidate_pairs(small.view(), long_ones.view(), 0).size(), small_faces * long_faces);
  EXPECT_EQ(candidate_pairs(long_ones.view(), small.view(), 0).size(), small_faces * long_faces);
}

/// A tilted rod of long faces, whose box holds a small patch beside it: no pair is left.
TEST(Face_filter_of_long_faces, parts_a_rod_from_what_its_box_contains) {
  constexpr std::uint32_t sides = 64;
  Single_leaf rod(sides), patch(64);
  const Eigen::Quaterniond turn = Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 0.5).normalized()));
  for (std::uint32_t i = 0; i < sides; ++i) {
    const auto corner = [&](std::uint32_t side, double z) {
      const double angle = 2 * M_PI * side / sides;
      return point_at(turn * Eigen::Vector3d(std::cos(angle), std::sin(angle), z));
    };
    rod.set(i, {corner(i, -50), corner(i + 1, -50), corner(i, 50)});
  }
  Long_faces make(3);
  for (std::size_t i = 0; i < patch.size(); ++i) {
    Triangle t = make.small();
    for (auto& p : t) p = point_at(turn * Eigen::Vector3d(0.3 * p.x() + 1.2, 0.3 * p.y() - 0.1, 0.3 * p.z()));
    patch.set(i, t);
  }
  rod.refit(), patch.refit();
  EXPECT_TRUE(candidate_pairs(rod.view(), patch.view(), 0).empty());
  EXPECT_TRUE(candidate_pairs(patch.view(), rod.view(), 0.05).empty());
}

}  // namespace
}  // namespace lodestone
