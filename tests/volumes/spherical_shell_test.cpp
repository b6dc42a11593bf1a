// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/volumes/spherical_shell.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "lodestone/volumes/bounding_volume.h"
#include "support/ball_membership.h"
#include "support/guarded_coordinates.h"
#include "support/instruction_sets.h"
#include "support/leaves.h"
#include "support/special_numbers.h"

namespace lodestone {
namespace {

static_assert(Bounding_volume<Spherical_shell>);

/// Points of the faces: corners, the nearest to the centre of a shell, and some anywhere.
std::vector<Exact_point> face_points(const Leaf& leaf, const double* centre) {
  std::vector<Exact_point> points;
  for (std::size_t place = 0; place < leaf.vertices.size(); ++place) points.push_back(exact_point(leaf.point(place)));
  for (const auto& [a, b, c] : leaf.corners) {
    const Exact_triangle t{points[a], points[b], points[c]};
    points.push_back(nearest_point(t, exact_point(centre)));
    points.push_back(t[0] + (t[1] - t[0]) / 3 + (t[2] - t[0]) / 7);
  }
  return points;
}

void expect_inside(const Spherical_shell& shell, const std::vector<Exact_point>& points) {
  for (const auto& p : points) ASSERT_TRUE(inside(shell, p));
}

TEST(Spherical_shell, contains_random_triangles_exactly) {
  std::mt19937_64 random(1);
  int shells = 0;
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector3d offset = (i % 2) * 0x1p20 * random_vector(random), a = random_vector(random);
    const Eigen::Vector3d b = a + std::pow(10, -(i % 17)) * random_vector(random), c = a + random_vector(random);
    Leaf leaf = strip({a + offset, b + offset, c + offset, a + offset + random_vector(random)});
    if (i % 3 == 0) leaf = strip({a + offset, b + offset, c + offset});
    const auto shell = volume_of<Spherical_shell>(leaf);
    shells += shell.has_shell();
    expect_inside(shell, face_points(leaf, shell.centre));
  }
  EXPECT_GT(shells, 2000);
}

TEST(Spherical_shell, of_a_patch_of_a_sphere_is_as_thick_as_its_faces_bulge) {
  for (const double radius : {0.8, 2.0, 10.0, 500.0}) {
    const Leaf leaf = grid(8, 8, [radius](const auto& p) { return onto_sphere(p, radius); });
    const auto shell = volume_of<Spherical_shell>(leaf);
    ASSERT_TRUE(shell.has_shell());
    EXPECT_NEAR(shell.outer, radius, 1e-6 * radius);
    EXPECT_NEAR(shell.centre[2], -radius, 1e-6 * radius);
    const double centre[]{0, 0, -radius};
    Rational least = radius * radius;
    for (const auto& p : face_points(leaf, centre)) least = std::min(least, squared_distance(p, exact_point(centre)));
    const double bulge = radius - std::sqrt(CGAL::to_double(least));
    EXPECT_NEAR(shell.outer - shell.inner, bulge, 0.02 * bulge + 1e-9);
    EXPECT_LT(shell.volume(), 0.05 * shell.ball.volume());
  }
}

TEST(Spherical_shell, of_a_flat_leaf_is_thin) {
  const auto shell = volume_of<Spherical_shell>(grid(8, 8, [](const auto& p) { return p; }));
  EXPECT_LT(shell.outer - shell.inner, 1e-3);
  EXPECT_LT(shell.volume(), 2e-3 * shell.ball.volume());
  EXPECT_LT(shell.centre[2], -100) << "on the back of the faces";
}

TEST(Spherical_shell, is_never_larger_than_the_ball) {
  for_placed_leaves([](const Leaf& leaf) {
    const auto shell = volume_of<Spherical_shell>(leaf);
    const auto ball = volume_of<Bounding_sphere>(leaf);
    EXPECT_EQ(shell.ball, ball);
    EXPECT_EQ(shell.extent(), ball.extent());
    EXPECT_EQ(shell.bounds(), ball.bounds());
    EXPECT_LE(shell.volume(), ball.volume());
    EXPECT_GE(shell.outer, shell.inner);
  });
}

/// Points of a shell, many of them on its border up to rounding.
std::vector<Exact_point> points_of(const Spherical_shell& shell, int count, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const auto often_an_end = [&] { return std::clamp(1.4 * unit(random) - 0.2, 0.0, 1.0); };
  const Eigen::Map<const Eigen::Vector3d> axis(shell.axis), centre(shell.centre), middle(shell.ball.centre);
  std::vector<Exact_point> points;
  for (int i = 0; i < count; ++i) {
    Eigen::Vector3d p = middle + shell.ball.radius * often_an_end() * random_vector(random).normalized();
    if (shell.has_shell() && i % 4 != 0) {
      Eigen::Vector3d direction = random_vector(random).normalized();
      if (shell.cosine > 0) {
        const double cosine = shell.cosine + (1 - shell.cosine) * often_an_end();
        const Eigen::Vector3d across = axis.cross(direction).normalized();
        direction = cosine * axis + std::sqrt(std::max(0.0, 1 - cosine * cosine)) * across;
      }
      p = centre + (shell.inner + (shell.outer - shell.inner) * often_an_end()) * direction;
    }
    if (inside(shell, exact_point(p))) points.push_back(exact_point(p));
  }
  return points;
}

std::vector<Spherical_shell> assorted_shells(std::mt19937_64& random) {
  std::vector<Spherical_shell> shells;
  for (const auto& [name, leaf] : leaf_cases())
    for (int i = 0; i < 4; ++i) {
      const Eigen::AngleAxisd turn(i, random_vector(random).normalized());
      const Eigen::Vector3d step = i * random_vector(random) + (i / 3) * 0x1p20 * Eigen::Vector3d::Ones();
      Leaf moved = leaf;
      for (std::size_t v = 0; v < moved.vertices.size(); ++v) {
        Eigen::Map<Eigen::Vector3d> p(moved.coordinates.data() + 3 * v);
        p = (turn * p + step).eval();
      }
      shells.push_back(volume_of<Spherical_shell>(moved));
    }
  return shells;
}

TEST(Spherical_shell, of_two_shells_contains_both_exactly) {
  std::mt19937_64 random(2);
  auto shells = assorted_shells(random);
  std::vector<std::vector<Exact_point>> points;
  int with_shell = 0;
  for (std::size_t i = 0; i < shells.size(); ++i) points.push_back(points_of(shells[i], 40, random));
  for (std::size_t i = 0; i < 4000; ++i) {
    const std::size_t a = random() % shells.size(), b = i % shells.size();
    const auto both = volume_of(shells[a], shells[b]);
    with_shell += both.has_shell();
    expect_inside(both, points[a]);
    expect_inside(both, points[b]);
    if (i % 10 == 0) {
      shells.push_back(both);
      points.push_back(points_of(both, 40, random));
    }
  }
  EXPECT_GT(with_shell, 200);
}

TEST(Spherical_shell, of_neighbours_on_one_sphere_is_centred_on_it) {
  const auto patch = [](double x, double y) {
    return volume_of<Spherical_shell>(
        grid(8, 8, [=](const auto& p) { return onto_sphere(p + Eigen::Vector3d(x, y, 0), 3); }));
  };
  const auto one = patch(0, 0), both = volume_of(one, patch(1, 0)),
             four = volume_of(both, volume_of(patch(0, 1), patch(1, 1)));
  EXPECT_NEAR(both.centre[2], -3, 1e-4);
  EXPECT_LT(both.outer - both.inner, 1.01 * (one.outer - one.inner));
  EXPECT_LT(four.outer - four.inner, 1.01 * (one.outer - one.inner));
  EXPECT_LT(four.volume(), 0.02 * four.ball.volume());
}

TEST(Spherical_shell, is_near_another_with_a_common_point) {
  std::mt19937_64 random(3);
  const auto shells = assorted_shells(random);
  int apart = 0, seen_by_balls = 0;
  for (const auto& a : shells) {
    const auto points = points_of(a, 40, random);
    for (const auto& b : shells) {
      if (near(a, b, 0)) continue;
      ++apart;
      seen_by_balls += !near(a.ball, b.ball, 0);
      for (const auto& p : points) ASSERT_FALSE(inside(b, p));
    }
  }
  EXPECT_GT(apart, seen_by_balls + 50);
}

TEST(Spherical_shell, is_near_another_at_the_distance_of_the_margin) {
  std::mt19937_64 random(4);
  const auto integer = [&] { return static_cast<double>(random() % 64); };
  for (int i = 0; i < 100000; ++i) {
    Eigen::Vector3d a[3], b[4];
    for (auto& p : a) p = {integer(), integer(), integer()};
    for (auto& p : b) p = {integer(), integer(), integer()};
    // A point of the one is a corner of the other: exact in multiples of 1/8; then it is moved by the margin.
    b[0] = (a[0] + 2 * a[1] + 5 * a[2]) / 8;
    if (i % 2 == 0) b[1] = b[0] + (b[1] - b[0]) / 64;
    const double margin = i % 3 == 0 ? 0 : integer();
    for (auto& p : b) p[i % 3] += margin;
    const double offset = i % 5 == 0 ? 0x1p20 : 0;
    const auto first = volume_of<Spherical_shell>(placed(strip({a[0], a[1], a[2]}), 1, offset));
    const auto second = volume_of<Spherical_shell>(placed(strip({b[0], b[1], b[2], b[3]}), 1, offset));
    ASSERT_TRUE(near(first, second, margin));
    ASSERT_TRUE(near(second, first, margin));
  }
}

TEST(Spherical_shell, separates_surfaces_whose_balls_meet) {
  const auto layer = [](double radius, double turn) {
    return volume_of<Spherical_shell>(grid(8, 8, [=](const auto& p) -> Eigen::Vector3d {
      return Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitX()) *
             (onto_sphere(p, radius) + Eigen::Vector3d(0, 0, radius));
    }));
  };
  EXPECT_FALSE(near(layer(3, 0), layer(3.02, 0.05), 0)) << "layers";
  EXPECT_FALSE(near(layer(3, 0), layer(3.1, 0.05), 0.05));
  EXPECT_TRUE(near(layer(3, 0), layer(3.1, 0.05), 0.15));
  const auto plate = [](double height, double slope) {
    return volume_of<Spherical_shell>(
        grid(8, 8, [=](const auto& p) { return Eigen::Vector3d(p.x() + height, p.y(), height + slope * p.x()); }));
  };
  EXPECT_FALSE(near(plate(0, 0), plate(0.02, 0), 0)) << "plates";
  EXPECT_FALSE(near(plate(0, 0), plate(0.1, 0.05), 0));
  EXPECT_TRUE(near(plate(0, 0), plate(0, 0.05), 0));
}

TEST(Spherical_shell, is_the_same_for_every_instruction_set_and_never_reads_past_the_last_vertex) {
  for_placed_leaves([](const Leaf& leaf) {
    const Guarded_coordinates guarded(leaf.coordinates);
    Spherical_shell best = volume_of<Spherical_shell>(leaf), other;
    for_instruction_sets([&] {
      other.enclose({guarded.values(), leaf.vertices, leaf.corners});
      ASSERT_EQ(other, best);
    });
  });
}

TEST(Spherical_shell, never_separates_on_overflow_underflow_or_nan) {
  const auto unit = volume_of<Spherical_shell>(grid(8, 8, [](const auto& p) { return onto_sphere(p, 1); }));
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity}) {
    for (auto leaf : {grid(8, 8, [](const auto& p) { return p; }), strip({Eigen::Vector3d(1, 2, 3)})})
      for (double& x : leaf.coordinates) {
        const double before = std::exchange(x, bad);
        const auto shell = volume_of<Spherical_shell>(leaf);
        EXPECT_TRUE(near(shell, unit, 0));
        EXPECT_TRUE(near(unit, volume_of(unit, shell), 0));
        x = before;
      }
    EXPECT_TRUE(near(unit, volume_of<Spherical_shell>(grid(8, 8, [](const auto& p) { return onto_sphere(p, 2); })),
                     std::abs(bad)));
  }
}

}  // namespace
}  // namespace lodestone
