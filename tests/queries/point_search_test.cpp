// SPDX-License-Identifier: GPL-3.0-or-later
// The face nearest to a point, against every face, in rational numbers.
#include "lodestone/queries/point_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lodestone/mesh/errors.h"
#include "support/arm.h"
#include "support/exact_point.h"
#include "support/face_soup.h"
#include "support/instruction_sets.h"
#include "triangles/point_distance.h"

namespace lodestone {
namespace {

struct Exact_nearest {
  std::uint32_t face = 0;
  Rational squared;
};

Rational squared_distance(const Face_soup& soup, std::uint32_t face, const Point& query) {
  const auto t = soup.triangle(face);
  const auto at = exact_point(query);
  return (nearest_point({exact_point(t[0]), exact_point(t[1]), exact_point(t[2])}, at) - at).squared_length();
}

Exact_nearest true_nearest(const Face_soup& soup, const Point& query) {
  Exact_nearest best{0, squared_distance(soup, 0, query)};
  for (std::uint32_t face = 1; face < soup.faces.size(); ++face)
    if (const Rational squared = squared_distance(soup, face, query); squared < best.squared) best = {face, squared};
  return best;
}

/// Compares several trees over one surface with the truth.
/// @return whether several faces are nearest
bool expect_nearest(const std::vector<const Posed_object*>& objects, const Point& query) {
  const Face_soup& soup = objects.front()->soup();
  const auto truth = true_nearest(soup, query);
  SCOPED_TRACE(testing::Message() << "from " << query);
  for (const Posed_object* object : objects) {
    const auto found = closest_point(object->view(), query);
    EXPECT_EQ(found.face, truth.face);
    if (truth.squared == 0) {
      EXPECT_EQ(found.distance, 0);
      EXPECT_EQ(found.point, query);
      continue;
    }
    EXPECT_GT(found.distance, 0);
    if (found.distance < std::numeric_limits<double>::min()) continue;
    // The squares of the distance without and with its largest error.
    const Rational error(0x1p-30), squared = Rational(found.distance) * Rational(found.distance);
    EXPECT_LE(squared, truth.squared * (1 + error) * (1 + error));
    EXPECT_GE(squared, truth.squared * (1 - error) * (1 - error));
    double largest = found.distance;
    for (const Point& corner : soup.triangle(found.face))
      for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(corner[axis]));
    const double away = std::sqrt(CGAL::to_double((exact_point(found.point) - exact_point(query)).squared_length()));
    if (std::isfinite(away) && away > 1e-100) {
      EXPECT_LE(std::abs(away - found.distance), 0x1p-48 * largest);
    }
  }
  std::size_t nearest = 0;
  for (std::uint32_t face = 0; face < soup.faces.size(); ++face)
    nearest += squared_distance(soup, face, query) == truth.squared ? 1 : 0;
  return nearest > 1;
}

/// Points anywhere, on the surface, near it, and straight above vertices and edges.
/// @return number of points to which several faces are nearest
std::size_t expect_truth_for_many_points(const Face_soup& soup, int points, std::uint64_t seed) {
  const Posed_object small(soup, 2), usual(soup, 16), large(soup, 128, false);
  std::mt19937_64 random(seed);
  double size = 0;
  const Point start = soup.point(0);
  for (std::uint32_t v = 0; v < soup.vertex_count(); ++v)
    for (int axis = 0; axis < 3; ++axis) size = std::max(size, std::abs(soup.point(v)[axis] - start[axis]));
  const auto number = [&](double most) { return std::uniform_real_distribution<double>(-most, most)(random) * size; };
  std::size_t ties = 0;
  for (int kind = 0; kind < points && !testing::Test::HasFailure(); ++kind) {
    const auto t = soup.triangle(random() % soup.faces.size());
    const Point &p = t[0], &q = t[1];
    Point query(start.x() + number(1.5), start.y() + number(1.5), start.z() + number(1.5));
    const Point middle((p.x() + q.x()) / 2, (p.y() + q.y()) / 2, (p.z() + q.z()) / 2);
    if (kind % 6 == 1) query = p;
    if (kind % 6 == 2) query = middle;
    if (kind % 6 == 3) query = Point(p.x() + number(1e-9), p.y() + number(1e-9), p.z() + number(1e-9));
    if (kind % 6 == 4) query = Point(middle.x(), middle.y(), middle.z() + number(1));
    if (kind % 6 == 5) query = Point(p.x(), p.y() + number(0.1), p.z());
    ties += expect_nearest({&small, &usual, &large}, query) ? 1 : 0;
  }
  return ties;
}

TEST(Point_search, finds_what_exhaustive_checking_finds) {
  std::size_t ties = 0;
  const std::vector<Face_soup> objects{icosphere(2),
                                       potato(3),
                                       cube(2),
                                       cloth(6, 5),
                                       loose_triangles(40, 0.4, 1),
                                       joined(icosphere(1), icosphere(1)),
                                       teapot({1, 1}),
                                       Face_soup(single_triangle())};
  for (const auto& soup : objects) ties += expect_truth_for_many_points(soup, 90, 1);
  EXPECT_GT(ties, 200U);
}

TEST(Point_search, counts_faces_without_area_as_the_segments_and_points_that_they_are) {
  for (const std::uint64_t seed : {1, 2, 3}) expect_truth_for_many_points(lattice_soup(40, 30, 4, seed), 90, seed);
  Face_soup flat;  // a segment along x with a corner within it, and a point
  flat.coordinates = {0, 0, 0, 2, 0, 0, 1, 0, 0, 4, 0, 0};
  flat.faces = {{0, 1, 2}, {3, 3, 3}, {2, 1, 0}};
  const Posed_object object(flat, 2, false);
  EXPECT_TRUE(expect_nearest({&object}, {1.5, 1, 1}));
  EXPECT_FALSE(expect_nearest({&object}, {5, 1, 1}));
  EXPECT_TRUE(expect_nearest({&object}, {3, 0, 0}));
}

TEST(Point_search, is_exact_with_every_instruction_set) {
  for_instruction_sets([] {
    expect_truth_for_many_points(crumpled(icosphere(3), 0.1, 7), 30, 8);
    expect_truth_for_many_points(lattice_soup(40, 30, 4, 9), 30, 9);
  });
}

/// Triangles that are long, thin and almost flat: floating point does not know in which region a point is.
Face_soup needles(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  Face_soup soup;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d base(unit(random), unit(random), unit(random)),
        along(unit(random), unit(random), unit(random));
    const double width = std::ldexp(1.0, -static_cast<int>(random() % 56));
    const auto first = static_cast<std::uint32_t>(3 * i);
    soup.faces.push_back({first, first + 1, first + 2});
    for (const double part : {0.0, unit(random), unit(random)})
      for (int axis = 0; axis < 3; ++axis)
        soup.coordinates.push_back(base[axis] + part * along[axis] + (part == 0 ? 0 : width * unit(random)));
  }
  return soup;
}

TEST(Point_search, is_exact_among_needles) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) expect_truth_for_many_points(needles(60, seed), 60, seed);
}

TEST(Point_search, is_exact_at_any_scale_and_far_from_the_origin) {
  for (const auto& [factor, offset] : {std::pair{1.0, 0x1p20},
                                       {1.0, 0x1p45},
                                       {0x1p-100, 0.0},
                                       {0x1p-300, 0.0},
                                       {0x1p-1000, 0.0},
                                       {0x1p300, 0.0},
                                       {0x1p510, 0.0},
                                       {0x1p1020, 0.0}}) {
    SCOPED_TRACE(testing::Message() << factor << ' ' << offset);
    expect_truth_for_many_points(placed(icosphere(2), factor, offset), 40, 2);
    expect_truth_for_many_points(placed(Face_soup(cube(2)), factor, offset), 40, 3);
  }
}

TEST(Point_search, scales_what_is_tiny_only_as_far_as_coordinates_allow) {
  Face_soup thin(icosphere(1));
  deform(thin, [](const Point& p) { return Point(1e10, 1e-300 * p.y(), 1e-290 * p.z()); });
  expect_truth_for_many_points(thin, 40, 4);
}

TEST(Point_search, is_right_among_the_smallest_numbers) {
  for (const double factor : {0x1p-1020, 0x1p-1030, 0x1p-1060}) {
    SCOPED_TRACE(factor);
    expect_truth_for_many_points(placed(icosphere(2), factor), 40, 5);
    expect_truth_for_many_points(placed(needles(9, 6), factor), 40, 6);
  }
}

TEST(Point_search, from_the_centre_of_a_ball_decides_exactly_between_all_faces) {
  const Face_soup ball(icosphere(3));
  const Posed_object object(ball, 4);
  expect_nearest({&object}, {0, 0, 0});
  expect_nearest({&object}, {1e-16, 0, 0});
  const Posed_object box(Face_soup(cube(3)), 4);
  EXPECT_TRUE(expect_nearest({&box}, {0.5, 0.5, 0.5}));
}

TEST(Point_search, on_the_axis_of_a_disc_names_the_lowest_of_all_faces_around_its_centre) {
  for (const Point centre : {Point(0, 0, 0), Point(0.1, -0.7, 0.3)})
    for (const double height : {0.0, 0.2}) {  // flat, and the tip of a cone
      const Face_soup disc = fan_of_faces(40, centre, height);
      const Posed_object small(disc, 2), usual(disc, 16);
      for (const double above : {1e-12, 0.5, 20.0})
        EXPECT_TRUE(expect_nearest({&small, &usual}, {centre.x(), centre.y(), centre.z() + above}));
      // Below the tip, the nearest points are inside the faces.
      expect_nearest({&small, &usual}, {centre.x(), centre.y(), centre.z() - 0.5});
      expect_nearest({&small, &usual}, {centre.x() + 1e-9, centre.y(), centre.z() + 0.5});
    }
}

TEST(Point_search, knows_without_exact_numbers_that_the_centre_of_a_disc_is_nearest_to_its_axis) {
  for (const double height : {0.0, 0.2})
    for (const int exponent : {-600, 0, 600}) {
      Face_soup disc = fan_of_faces(9, {0.1, -0.7, 0.3}, height);
      for (double& x : disc.coordinates) x = std::ldexp(x, exponent);
      const double above = std::ldexp(1.0, exponent);
      const auto low = std::ranges::min(disc.coordinates), high = std::ranges::max(disc.coordinates);
      const double lows[]{low, low, low}, highs[]{high + above, high + above, high + above};
      const double* const centre = disc.coordinates.data();
      const Query_point query(Point(centre[0], centre[1], centre[2] + above), lows, highs);
      for (const Corners& face : disc.faces)
        for (std::size_t turn = 0; turn < 3; ++turn) {
          const Corners corners{face[turn], face[(turn + 1) % 3], face[(turn + 2) % 3]};
          const auto at = [&](std::size_t i) { return centre + 3 * std::size_t{corners[i]}; };
          const auto found = estimate_distance(query, {at(0), at(1), at(2)}, corners);
          EXPECT_EQ(found.part, (Nearest_part{0, 0})) << height << ' ' << exponent << ' ' << turn;
        }
    }
}

TEST(Point_search, decides_exactly_between_a_vertex_and_an_edge_that_is_hardly_nearer) {
  std::mt19937_64 random(9);
  const auto vector = [&] {
    std::uniform_real_distribution<double> unit(-1, 1);
    return Eigen::Vector3d(unit(random), unit(random), unit(random));
  };
  int nearer = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Vector3d q = vector(), across = q.cross(vector());
    Face_soup soup;  // two faces that share a vertex at the origin; an edge of the second is orthogonal up to rounding
    for (const Eigen::Vector3d& p : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(-q + 0.5 * vector() * q.norm()),
                                     Eigen::Vector3d(-q + 0.5 * vector() * q.norm()), across})
      soup.coordinates.insert(soup.coordinates.end(), p.data(), p.data() + 3);
    soup.faces = {{0, 1, 2}, {0, 3, 2}};
    const Posed_object object(soup, 2, false);
    const Point query(q.x(), q.y(), q.z());
    expect_nearest({&object}, query);
    nearer += true_nearest(soup, query).face == 1 ? 1 : 0;

    // The same as a tiny part of something large.
    Face_soup tiny = placed(soup, 0x1p-280);
    tiny.coordinates.insert(tiny.coordinates.end(), {-1, -1, 1, -1, -0.5, 1, -0.25, -1, 1});
    tiny.faces.push_back({4, 5, 6});
    const Posed_object large(tiny, 4, false);
    expect_nearest({&large}, Point(0x1p-280 * q.x(), 0x1p-280 * q.y(), 0x1p-280 * q.z()));
  }
  EXPECT_GT(nearer, 40);
  EXPECT_LT(nearer, 160);
}

TEST(Point_search, at_a_distance_that_overflows_is_infinite) {
  const Posed_object ball(placed(icosphere(1), 1e300, -1.7e308));
  const auto found = closest_point(ball.view(), Point(1.7e308, 1.7e308, 1.7e308));
  EXPECT_EQ(found.distance, std::numeric_limits<double>::infinity());
  EXPECT_EQ(found.face, true_nearest(ball.soup(), Point(1.7e308, 1.7e308, 1.7e308)).face);
}

TEST(Point_search, refuses_points_that_are_not_finite) {
  const Posed_object box(Face_soup(cube(2)), 2);
  for (const double x : {std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_THROW(closest_point(box.view(), Point(0, x, 0)), Bad_argument);
}

void expect_as_fitted(Bounded_surface& surface, const Posed_object& fitted, const Point& query) {
  const auto truth = closest_point(fitted.view(), query), found = closest_point(surface, query);
  EXPECT_EQ(found.face, truth.face);
  EXPECT_EQ(found.distance, truth.distance);
  EXPECT_EQ(found.point, truth.point);
}

TEST(Point_search, on_bounded_surfaces_equals_that_on_fitted_ones) {
  std::mt19937_64 random(6);
  const auto number = [&](double most) { return std::uniform_real_distribution<double>(-most, most)(random); };
  for (const bool morphed : {false, true})
    for (const std::size_t leaf_faces : {4, 40}) {
      Arm arm(long_potato(8, 1), morphed, leaf_faces);
      for (int round = 0; round < 8; ++round) {
        arm.pose(number(1.5), {number(1), number(1), number(1)});
        const Posed_object fitted{Face_soup(arm.mesh)};
        for (int trial = 0; trial < 20; ++trial)
          expect_as_fitted(arm.surface, fitted, Point(number(4), number(3), number(3)));
        for (std::uint32_t v = 0; v < 10; ++v) expect_as_fitted(arm.surface, fitted, fitted.soup().point(v));
        EXPECT_EQ(arm.surface.violations(), 0U);
      }
    }
}

TEST(Point_search, poses_few_leaves) {
  Surface_mesh smooth = sphere(60);
  for (const auto v : smooth.vertices())
    smooth.point(v) = Point(3 * smooth.point(v).x(), smooth.point(v).y(), smooth.point(v).z());
  Arm arm(smooth, false);
  arm.pose(0.2, {0, 0, 0});
  const Posed_object fitted{Face_soup(arm.mesh)};
  expect_as_fitted(arm.surface, fitted, Point(4, 0.2, 0.1));
  EXPECT_GT(arm.surface.leaves_posed(), 0U);
  EXPECT_LT(arm.surface.leaves_posed(), arm.layout.leaf_count() / 8);
}

TEST(Point_search, is_right_where_a_broken_bound_is_noticed) {
  Arm arm(long_potato(10, 1), false);
  arm.pose(0.4, {0, 0, 0});
  const Posed_object fitted{Face_soup(arm.mesh)};
  int broken = 0;
  for (std::uint32_t from = 0; from < arm.bound.node_count(); from += 3) {
    const Shrunk_bound lie{arm.bound, from};
    Tree_surface tree = arm.tree;
    Bounded_surface surface(tree, arm.points, lie);
    const Point query(0.1 * (from % 40) - 2, 1.5, 0.2);
    closest_point(surface, query);
    if (surface.violations() == 0) continue;
    ++broken;
    EXPECT_FALSE(surface.is_broken());
    expect_as_fitted(surface, fitted, query);
  }
  EXPECT_GT(broken, 10);
}

}  // namespace
}  // namespace lodestone
