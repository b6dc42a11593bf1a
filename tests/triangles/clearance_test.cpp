// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/triangles/clearance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "lodestone/triangles/triangle_intersection.h"
#include "support/boxed.h"
#include "support/exact_point.h"
#include "support/hard_pairs.h"
#include "support/special_numbers.h"

namespace lodestone {
namespace {

constexpr double slack = 0x1p-44;

Clearance clearance_of(const Triangle& a, const Triangle& b, const Eigen::Vector3d& direction) {
  return clearance(boxed(a), boxed(b), Way(direction, slack));
}

/// The solution of u x + v y + w z = right, if there is exactly one.
std::optional<Exact_vector> solution(const Exact_vector& u, const Exact_vector& v, const Exact_vector& w,
                                     const Exact_vector& right) {
  const Rational determinant = CGAL::determinant(u, v, w);
  if (determinant == 0) return std::nullopt;
  return Exact_vector(CGAL::determinant(right, v, w) / determinant, CGAL::determinant(u, right, w) / determinant,
                      CGAL::determinant(u, v, right) / determinant);
}

/// The exact clearance: it is taken at a corner of one triangle in line with the other, or where two edges cross, seen
/// along the direction. None if no points are in line. The triangles and the direction are in general position.
std::optional<Rational> exact_clearance(const Triangle& a, const Triangle& b, const Eigen::Vector3d& direction) {
  const Exact_vector d = exact_point(direction) - CGAL::ORIGIN;
  const auto corner = [](const Triangle& t, int i) { return exact_point(t[i % 3]); };
  std::optional<Rational> best;
  const auto keep = [&](const Rational& length) { best = best ? std::max(*best, length) : length; };
  const auto in_line = [&](const Exact_point& p, const Triangle& t, const Exact_vector& way) {
    const auto found = solution(way, corner(t, 0) - corner(t, 1), corner(t, 0) - corner(t, 2), corner(t, 0) - p);
    if (found && found->y() >= 0 && found->z() >= 0 && found->y() + found->z() <= 1) keep(found->x());
  };
  for (int i = 0; i < 3; ++i) {
    in_line(corner(a, i), b, d);
    in_line(corner(b, i), a, -d);
    for (int j = 0; j < 3; ++j) {
      const auto found =
          solution(d, corner(a, i + 1) - corner(a, i), corner(b, j) - corner(b, j + 1), corner(b, j) - corner(a, i));
      if (found && found->y() >= 0 && found->y() <= 1 && found->z() >= 0 && found->z() <= 1) keep(found->x());
    }
  }
  return best;
}

Eigen::Vector3d random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
}

Triangle_pair anywhere(Hard_pairs& pairs) { return (pairs.*Hard_pairs::kinds().front().make)(); }

TEST(Clearance, of_random_triangles_is_the_exact_one_rounded_up) {
  std::mt19937_64 random(1);
  Hard_pairs pairs(2);
  int in_line = 0, not_in_line = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const auto [a, b] = anywhere(pairs);
    const Eigen::Vector3d d = random_direction(random);
    const auto exact = exact_clearance(a, b, d);
    const double found = clearance_of(a, b, d).length;
    if (exact) {
      EXPECT_GE(found, CGAL::to_interval(*exact).first);
      EXPECT_LE(found, CGAL::to_double(*exact) + 1e-9);
      ++in_line;
    } else {
      ++not_in_line;
      EXPECT_EQ(found, -std::numeric_limits<double>::infinity());
    }
  }
  EXPECT_GT(in_line, 200);
  EXPECT_GT(not_in_line, 200);
}

TEST(Clearance, of_triangles_that_are_hard_to_decide_is_never_too_small) {
  std::mt19937_64 random(3);
  for (const auto& kind : Hard_pairs::kinds()) {
    Hard_pairs pairs(4);
    int in_line = 0;
    for (int trial = 0; trial < 500; ++trial) {
      const auto [a, b] = (pairs.*kind.make)();
      for (const Eigen::Vector3d& d : {random_direction(random), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, -1)}) {
        const auto exact = exact_clearance(a, b, d);
        if (!exact) continue;
        ++in_line;
        const double found = clearance_of(a, b, d).length;
        EXPECT_GE(found, CGAL::to_interval(*exact).first) << kind.name;
        EXPECT_LT(found, std::numeric_limits<double>::infinity()) << kind.name;
      }
    }
    EXPECT_GT(in_line, 50) << kind.name;
  }
}

TEST(Clearance, of_flat_pairs_along_their_plane_is_the_way_to_their_edges) {
  const Triangle left{Point(0, 0, 0), Point(2, -1, 0), Point(2, 1, 0)};
  const Triangle right{Point(3, 0, 0), Point(1, -1, 0), Point(1, 1, 0)};
  const Triangle level{Point(3, 0, 1), Point(1, -1, 1), Point(1, 1, 1)};
  EXPECT_NEAR(clearance_of(left, right, {1, 0, 0}).length, 3, 1e-9);
  EXPECT_NEAR(clearance_of(left, right, {-1, 0, 0}).length, 1, 1e-9);
  EXPECT_NEAR(clearance_of(left, right, {0, 1, 0}).length, 1.5, 1e-9);
  EXPECT_EQ(clearance_of(left, level, {1, 0, 0}).length, -std::numeric_limits<double>::infinity());
  EXPECT_NEAR(clearance_of(left, level, {0, 0, 1}).length, 1, 1e-9);
  const Triangle needle{Point(1.5, 0, 0), Point(1.5, 0, 0), Point(1.75, 0, 0)};
  EXPECT_NEAR(clearance_of(left, needle, {1, 0, 0}).length, 1.75, 1e-9);
  EXPECT_NEAR(clearance_of(needle, left, {1, 0, 0}).length, 0.5, 1e-9);
}

TEST(Clearance, of_walls_that_face_an_axis_has_their_normal) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto corner = [axis](double along, double u, double v) {
      double at[3];
      at[axis] = along, at[(axis + 1) % 3] = u, at[(axis + 2) % 3] = v;
      return Point(at[0], at[1], at[2]);
    };
    const Triangle near{corner(0, 0, 0), corner(0, 2, 0), corner(0, 0, 2)};
    const Triangle far{corner(1, 0.5, 0.5), corner(1, 2, 0.5), corner(1, 0.5, 2)};
    const Eigen::Vector3d along = Eigen::Vector3d::Unit(axis);
    const Clearance found = clearance_of(near, far, along);
    EXPECT_NEAR(found.length, 1, 1e-9);
    EXPECT_EQ(found.normal.normalized(), along);
  }
}

TEST(Clearance, of_boxes_is_the_way_through_the_box_of_their_differences) {
  const auto box = [](double x, double y, double z, double depth, double height) {
    return Box(Eigen::Vector3d(x, y, z), Eigen::Vector3d(x + 1, y + depth, z + height));
  };
  const Box a = box(0, 0, 0, 1, 1), b = box(0.5, 0.25, 0, 1, 4);
  EXPECT_NEAR(clearance(a, b, Way({1, 0, 0}, slack)), 1.5, 1e-9);
  EXPECT_NEAR(clearance(a, b, Way({0, -1, 0}, slack)), 0.75, 1e-9);
  EXPECT_NEAR(clearance(a, b, Way({0, 0.6, 0.8}, slack)), 1.25 / 0.6, 1e-9);
  EXPECT_EQ(clearance(a, box(2, 0, 0, 1, 1), Way({0, 0, 1}, slack)), -std::numeric_limits<double>::infinity());
}

TEST(Clearance, of_boxes_is_no_smaller_than_that_of_what_they_hold) {
  std::mt19937_64 random(5);
  Hard_pairs pairs(6);
  for (int trial = 0; trial < 2000; ++trial) {
    const auto [a, b] = anywhere(pairs);
    const auto [c, e] = anywhere(pairs);
    const Way way(random_direction(random), slack);
    const Boxed_triangle p = boxed(a), q = boxed(b);
    const double of_boxes = clearance(p.box, q.box, way);
    EXPECT_LE(clearance(p, q, way).length, of_boxes);
    EXPECT_LE(of_boxes, clearance(p.box.merged(boxed(c).box), q.box.merged(boxed(e).box), way));
  }
}

TEST(Clearance, of_triangles_is_the_same_where_only_large_ones_are_needed) {
  std::mt19937_64 random(7);
  Hard_pairs pairs(8);
  int in_line = 0;
  for (const auto& kind : Hard_pairs::kinds())
    for (int trial = 0; trial < 300; ++trial) {
      const auto [a, b] = (pairs.*kind.make)();
      const Way way(random_direction(random), slack);
      const Boxed_triangle p = boxed(a), q = boxed(b);
      const Clearance all = clearance(p, q, way);
      if (!std::isfinite(all.length)) continue;
      ++in_line;
      for (const double least : {all.length - 1, all.length}) {
        const Clearance found = clearance(p, q, way, least);
        EXPECT_EQ(found.length, all.length) << kind.name;
        EXPECT_EQ(found.normal, all.normal) << kind.name;
      }
      for (const double least : {std::nextafter(all.length, 1e300), all.length + 1})
        EXPECT_LT(clearance(p, q, way, least).length, least) << kind.name;
    }
  EXPECT_GT(in_line, 200);
}

TEST(Clearance, of_pairs_that_are_apart_across_an_axis_is_none_on_whichever_side_they_are) {
  const Triangle here{Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0.5)};
  const auto moved_to = [&](const Eigen::Vector3d& by) {
    Triangle t = here;
    for (Point& p : t) p = Point(p.x() + by[0], p.y() + by[1], p.z() + by[2]);
    return t;
  };
  const auto turned = [](const Triangle& t) { return Triangle{t[0], t[2], t[1]}; };
  for (int along = 0; along < 3; ++along)
    for (int across = 0; across < 3; ++across)
      for (const double side : {-1.5, 1.5}) {
        if (across == along) continue;
        const Triangle other = moved_to(side * Eigen::Vector3d::Unit(across));
        for (const Triangle& a : {here, turned(here)})
          for (const Triangle& b : {other, turned(other)})
            for (const double sense : {-1.0, 1.0}) {
              const Eigen::Vector3d direction = sense * Eigen::Vector3d::Unit(along);
              EXPECT_EQ(clearance_of(a, b, direction).length, -infinity) << along << across << side;
              EXPECT_EQ(clearance(boxed(a).box, boxed(b).box, Way(direction, slack)), -infinity);
            }
      }
}

}  // namespace
}  // namespace lodestone
