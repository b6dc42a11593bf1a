// SPDX-License-Identifier: GPL-3.0-or-later
// Rays against every face, in exact numbers.
#include "lodestone/queries/ray_search.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <variant>

#include "lodestone/mesh/errors.h"
#include "lodestone/queries/containment.h"
#include "lodestone/queries/ray_tree.h"
#include "support/arm.h"
#include "support/face_soup.h"
#include "support/instruction_sets.h"

namespace lodestone {
namespace {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Exact_t = Exact::FT;

struct Exact_hit {
  std::uint32_t face;
  Exact_t t;
};

/// What CGAL intersects, as the set of points that it is.
using Exact_shape = std::variant<Exact::Point_3, Exact::Segment_3, Exact::Triangle_3>;

Exact_shape shape_of(const Triangle& t) {
  std::array<Exact::Point_3, 3> p;
  for (int i = 0; i < 3; ++i) p[i] = Exact::Point_3(t[i].x(), t[i].y(), t[i].z());
  if (!CGAL::collinear(p[0], p[1], p[2])) return Exact::Triangle_3(p[0], p[1], p[2]);
  std::ranges::sort(p);
  if (p[0] == p[2]) return p[0];
  return Exact::Segment_3(p[0], p[2]);
}

Exact::Point_3 exact_origin(const Ray& ray) { return {ray.origin.x(), ray.origin.y(), ray.origin.z()}; }
Exact::Vector_3 exact_direction(const Ray& ray) { return {ray.direction.x(), ray.direction.y(), ray.direction.z()}; }

/// A ray without end as a long segment, since CGAL 5.5 finds intersections behind the origin of some rays in the plane
/// of a triangle.
Exact_shape shape_of(const Ray& ray) {
  if (ray.length == 0) return exact_origin(ray);
  const Exact_t very_long = Exact_t(0x1p1000) * Exact_t(0x1p1000) * Exact_t(0x1p1000);
  const Exact_t length = std::isinf(ray.length) ? very_long : Exact_t(ray.length);
  return Exact::Segment_3(exact_origin(ray), exact_origin(ray) + length * exact_direction(ray));
}

/// The least t of the points in a result of `CGAL::intersection`.
struct Least_t {
  const Ray& ray;
  std::optional<Exact_t> least = {};

  void operator()(const Exact::Point_3& p) {
    const auto d = exact_direction(ray);
    const Exact_t t = (p - exact_origin(ray)) * d / d.squared_length();
    if (!least || t < *least) least = t;
  }
  void operator()(const Exact::Segment_3& s) {
    (*this)(s.source());
    (*this)(s.target());
  }
  template <class Other>
  void operator()(const Other&) {
    ADD_FAILURE() << "a line and a face have such an intersection?";
  }
};

struct Intersect {
  Least_t& found;

  void operator()(const Exact::Point_3& a, const Exact::Point_3& b) const {
    if (a == b) found(a);
  }
  template <class A>
  void operator()(const A& a, const Exact::Point_3& b) const {
    if (a.has_on(b)) found(b);
  }
  template <class B>
  void operator()(const Exact::Point_3& a, const B& b) const {
    if (b.has_on(a)) found(a);
  }
  void operator()(const Exact::Triangle_3&, const Exact::Triangle_3&) const { FAIL(); }
  template <class A, class B>
  void operator()(const A& a, const B& b) const {
    if (const auto common = CGAL::intersection(a, b)) {
      auto& into = found;
      boost::apply_visitor([&into](const auto& part) { into(part); }, *common);
    }
  }
};

/// The faces that a ray meets, by (t, face).
std::vector<Exact_hit> true_hits(const Face_soup& soup, const Ray& ray) {
  const auto line = shape_of(ray);
  std::vector<Exact_hit> hits;
  for (std::uint32_t face = 0; face < soup.faces.size(); ++face) {
    Least_t found{ray};
    std::visit(Intersect{found}, shape_of(soup.triangle(face)), line);
    if (found.least) hits.push_back({face, *found.least});
  }
  std::ranges::stable_sort(hits, [](const Exact_hit& a, const Exact_hit& b) { return a.t < b.t; });
  return hits;
}

void expect_hit(const Ray_hit& found, const Exact_hit& truth, const Ray& ray) {
  EXPECT_EQ(found.face, truth.face);
  truth.t.exact();
  const double t = CGAL::to_double(truth.t);
  EXPECT_LE(std::abs(found.t - t), 0x1p-30 * t) << found.t << ' ' << t;
  const double rounding = 0x1p-50 * (ray.origin.cwiseAbs().maxCoeff() + t * ray.direction.cwiseAbs().maxCoeff());
  const Eigen::Vector3d off = found.point - (ray.origin + t * ray.direction);
  EXPECT_LE(off.cwiseAbs().maxCoeff(), 0x1p-30 * t * ray.direction.cwiseAbs().maxCoeff() + rounding);
}

/// Compares both questions with the truth, for several leaf sizes, with and without a Ray_tree.
/// @return number of faces that the ray meets
std::size_t expect_hits(const std::vector<const Posed_object*>& objects, const Ray& ray) {
  const auto truth = true_hits(objects.front()->soup(), ray);
  SCOPED_TRACE(testing::Message() << "from " << ray.origin.transpose() << " along " << ray.direction.transpose()
                                  << " as far as " << ray.length);
  const auto expect_first = [&](const std::optional<Ray_hit>& first) {
    EXPECT_EQ(first.has_value(), !truth.empty());
    if (first && !truth.empty()) expect_hit(*first, truth.front(), ray);
  };
  const auto expect_all = [&](const std::vector<Ray_hit>& all) {
    EXPECT_EQ(all.size(), truth.size());
    for (std::size_t i = 0; i < std::min(all.size(), truth.size()); ++i) expect_hit(all[i], truth[i], ray);
  };
  for (const Posed_object* object : objects) {
    const Layout_view view = object->view();
    expect_first(first_hit(view, ray));
    expect_all(all_hits(view, ray));
    const Ray_tree tree(view);
    expect_first(first_hits(tree, std::span(&ray, 1)).front());
    expect_all(all_hits(tree, std::span(&ray, 1)).front());
  }
  return truth.size();
}

/// Rays of many kinds at one object: through its vertices and edges, along its edges and in the planes of its faces,
/// parallel to axes, and from points on it.
class Ray_maker {
 public:
  Ray_maker(const Face_soup& soup, std::uint64_t seed) : soup_(soup), random_(seed) {
    for (std::size_t i = 0; i < soup.coordinates.size(); ++i) {
      low_ = std::min(low_, soup.coordinates[i]);
      high_ = std::max(high_, soup.coordinates[i]);
    }
  }

  Ray operator()(int kind) {
    const auto t = soup_.triangle(random_() % soup_.faces.size());
    const auto corner = [&](std::size_t i) { return Eigen::Vector3d(t[i % 3].x(), t[i % 3].y(), t[i % 3].z()); };
    const std::size_t i = random_() % 3;
    const Eigen::Vector3d p = corner(i), q = corner(i + 1), anywhere = point(), other = point();
    Ray ray{anywhere, other - anywhere};
    if (kind % 12 == 1) ray.direction = p - anywhere;            // at a vertex
    if (kind % 12 == 2) ray.direction = (p + q) / 2 - anywhere;  // about at an edge
    if (kind % 12 == 3) ray = {p - (q - p), q - p};              // about along an edge
    if (kind % 12 == 4) ray = {p, other - p};                    // from a vertex
    if (kind % 12 == 5) ray = {(p + q) / 2, other - p};          // about from an edge
    if (kind % 12 == 6) ray.direction = (p.x() < q.x() ? -2 : 3) * Eigen::Vector3d::Unit(static_cast<Eigen::Index>(i));
    if (kind % 12 == 7) ray = {Eigen::Vector3d(p.x(), p.y(), anywhere.z()), -Eigen::Vector3d::UnitZ()};
    if (kind % 12 == 8) ray = {p + (p - corner(i + 2)), q - p + 2 * (corner(i + 2) - p)};  // about in a plane
    if (kind % 12 == 9) ray = {p, q - p};
    if (kind % 12 == 10) ray = {q + 2 * (q - p), p - q};
    if (kind % 12 == 11) ray.direction[static_cast<Eigen::Index>(i)] = 1e-320;
    if (kind % 5 == 0) ray.length = std::uniform_real_distribution<double>(0, 1.5)(random_);
    if (kind % 35 == 0) ray.length = 0;
    if (kind % 15 == 1) ray.length = 1;  // exactly up to a point of interest
    if (!ray.direction.allFinite() || ray.direction.isZero(0)) ray.direction = Eigen::Vector3d::UnitX();
    return ray;
  }

 private:
  Eigen::Vector3d point() {
    std::uniform_real_distribution<double> unit(-0.25, 1.25);
    const auto number = [&] { return low_ + unit(random_) * (high_ - low_); };
    return {number(), number(), number()};
  }

  const Face_soup& soup_;
  std::mt19937_64 random_;
  double low_ = std::numeric_limits<double>::max(), high_ = -low_;
};

/// @return number of rays that meet something
std::size_t expect_truth_for_many_rays(const Face_soup& soup, int rays, std::uint64_t seed) {
  const Posed_object small(soup, 2), usual(soup, 16), large(soup, 128, false);
  Ray_maker make(soup, seed);
  std::size_t meeting = 0;
  for (int kind = 0; kind < rays && !testing::Test::HasFailure(); ++kind)
    meeting += expect_hits({&small, &usual, &large}, make(kind)) > 0 ? 1 : 0;
  return meeting;
}

/// Objects of a few dozen faces.
std::vector<Face_soup> few_faces() {
  return {icosphere(2),
          Face_soup(potato(3)),
          cube(2),
          cloth(6, 5),
          loose_triangles(40, 0.4, 1),
          joined(icosphere(1), icosphere(1)),
          Face_soup(single_triangle())};
}

TEST(Ray_search, finds_what_exhaustive_checking_finds) {
  std::size_t meeting = 0;
  for (const auto& soup : few_faces()) meeting += expect_truth_for_many_rays(soup, 120, 1);
  EXPECT_GT(meeting, 300U);
}

TEST(Ray_search, counts_faces_without_area_as_the_segments_and_points_that_they_are) {
  for (const std::uint64_t seed : {1, 2, 3})
    EXPECT_GT(expect_truth_for_many_rays(lattice_soup(40, 30, 4, seed), 120, seed), 60U);
  Face_soup flat;  // a segment along x with a corner within it, and a point
  flat.coordinates = {0, 0, 0, 2, 0, 0, 1, 0, 0, 4, 0, 0};
  flat.faces = {{0, 1, 2}, {3, 3, 3}, {2, 1, 0}};
  const Posed_object object(flat, 2, false);
  EXPECT_EQ(expect_hits({&object}, {{1, -1, 0}, {0, 1, 0}}), 2U);
  EXPECT_EQ(expect_hits({&object}, {{1.5, -1, 0}, {0, 0.5, 0}}), 2U);
  EXPECT_EQ(expect_hits({&object}, {{-1, 0, 0}, {1, 0, 0}}), 3U);
  EXPECT_EQ(expect_hits({&object}, {{1, 0, 0}, {1, 0, 0}, 2.5}), 2U);
  EXPECT_EQ(expect_hits({&object}, {{4, 1, 0}, {0, -1, 0}}), 1U);
  EXPECT_EQ(expect_hits({&object}, {{4, 1, 0}, {1e-17, -1, 0}}), 0U);
}

TEST(Ray_search, is_exact_at_any_scale_and_far_from_the_origin) {
  for (const auto& [factor, offset] : {std::pair{1.0, 0x1p20},
                                       {1.0, 0x1p45},
                                       {0x1p-100, 0.0},
                                       {0x1p-300, 0.0},
                                       {0x1p-520, 0.0},
                                       {0x1p300, 0.0},
                                       {0x1p510, 0.0},
                                       {0x1p1000, 0.0}}) {
    SCOPED_TRACE(testing::Message() << factor << ' ' << offset);
    expect_truth_for_many_rays(placed(icosphere(2), factor, offset), 40, 2);
    expect_truth_for_many_rays(placed(Face_soup(cube(2)), factor, offset), 40, 3);
  }
}

TEST(Ray_search, of_several_faces_at_one_place_the_lowest_is_first) {
  const Face_soup ball(icosphere(2));
  const Posed_object object(shuffled(joined(ball, joined(ball, ball)), 1), 4);
  for (const auto v : {0U, 5U, 20U}) {
    const Point p = object.soup().point(v);
    const Ray ray{{3 * p.x(), 3 * p.y(), 3 * p.z()}, {-p.x(), -p.y(), -p.z()}};
    EXPECT_GE(expect_hits({&object}, ray), 6U);
  }
}

TEST(Ray_search, equals_exhaustive_checking_with_every_instruction_set) {
  const Face_soup knot(torus_knot({.radius = 0.7, .tube = 0.1, .segments = 12, .sides = 5}));
  for_instruction_sets([&] { EXPECT_GT(expect_truth_for_many_rays(knot, 40, 4), 10U); });
}

TEST(Ray_search, starts_at_the_origin_and_ends_at_its_length) {
  const Posed_object object(Face_soup(single_triangle()), 2, false);
  const auto t = object.soup().triangle(0);
  const Eigen::Vector3d middle((t[0].x() + t[1].x() + 2 * t[2].x()) / 4, (t[0].y() + t[1].y() + 2 * t[2].y()) / 4,
                               (t[0].z() + t[1].z() + 2 * t[2].z()) / 4);
  const Eigen::Vector3d away = Eigen::Vector3d::UnitZ();
  for (const double length : {0.0, 1.0, 2.0, std::numeric_limits<double>::infinity()}) {
    expect_hits({&object}, {middle, away, length});
    expect_hits({&object}, {middle - away, away, length});
    expect_hits({&object}, {middle + away, away, length});
    expect_hits({&object}, {middle - away, away, std::nextafter(length, 0)});
  }
}

TEST(Ray_search, tells_where_it_meets_a_face_whose_depth_exceeds_the_greatest_double) {
  Face_soup plate;
  plate.coordinates = {-1, -1, 1.7e308, 2, -1, 1.7e308, -1, 2, 1.7e308};
  plate.faces = {{0, 1, 2}};
  const Posed_object object(plate, 2, false);
  const auto hit = first_hit(object.view(), Ray{{0.25, 0.25, -1e307}, {0, 0, 1e300}});
  ASSERT_TRUE(hit);
  EXPECT_DOUBLE_EQ(hit->t, 1.8e8);
  EXPECT_DOUBLE_EQ(hit->point.z(), 1.7e308);
  EXPECT_EQ(hit->point.x(), 0.25);
  EXPECT_EQ(hit->point.y(), 0.25);
}

TEST(Ray_search, meets_a_face_at_the_greatest_double_in_a_point_that_is_finite) {
  constexpr double greatest = std::numeric_limits<double>::max();
  Face_soup wall;
  wall.coordinates = {greatest, -greatest, -1, greatest, greatest, -1, greatest, 0, greatest};
  wall.faces = {{0, 1, 2}};
  const Posed_object object(wall, 2, false);
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> part(0.2, 0.9);
  int hits = 0;
  for (int i = 0; i < 200; ++i) {  // the depth, along the wall, is longer than the way to it, and both are rounded
    const Eigen::Vector3d from(-0.1 * part(random) * greatest, -part(random) * greatest, 0);
    const double slope = 1.1 / (1 + part(random));
    const auto hit = first_hit(object.view(), Ray{from, {slope, 1, 0}});
    if (!hit) continue;  // beyond the end of the wall
    ++hits;
    EXPECT_TRUE(hit->point.allFinite()) << i;
    EXPECT_DOUBLE_EQ(hit->point.x(), greatest) << i;
  }
  EXPECT_GT(hits, 100);
}

TEST(Ray_search, refuses_what_is_no_ray) {
  const Posed_object object(Face_soup(single_triangle()), 2, false);
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  for (const Ray& ray :
       {Ray{{nan, 0, 0}}, Ray{{0, infinity, 0}}, Ray{{0, 0, 0}, {0, 0, 0}}, Ray{{0, 0, 0}, {nan, 0, 1}},
        Ray{{0, 0, 0}, {infinity, 0, 0}}, Ray{{0, 0, 0}, {1, 0, 0}, -1}, Ray{{0, 0, 0}, {1, 0, 0}, nan}}) {
    EXPECT_THROW(first_hit(object.view(), ray), Bad_argument);
    EXPECT_THROW(all_hits(object.view(), ray), Bad_argument);
  }
}

TEST(Ray_search, meets_a_closed_surface_an_odd_number_of_times_from_inside) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1.2, 1.2);
  std::size_t inside = 0;
  for (const auto& mesh : {icosphere(5), torus_knot(), potato(5)}) {
    const Posed_object object{Face_soup(mesh)};
    for (int trial = 0; trial < 1000; ++trial) {
      const Eigen::Vector3d p(unit(random), unit(random), unit(random)), q(unit(random), unit(random), unit(random));
      const auto hits = all_hits(object.view(), {p, q - p});
      const bool odd = hits.size() % 2 == 1;
      ASSERT_EQ(odd, point_side(object.object(), Point(p.x(), p.y(), p.z())) == Point_side::inside);
      inside += odd ? 1 : 0;
      const auto first = first_hit(object.view(), {p, q - p});
      ASSERT_EQ(first.has_value(), !hits.empty());
      if (first) {
        ASSERT_EQ(first->face, hits.front().face);
        ASSERT_EQ(first->t, hits.front().t);
      }
    }
  }
  EXPECT_GT(inside, 500U);
}

/// Compares a surface that is bounded with a tree that is fitted.
/// @return number of hits
std::size_t expect_as_fitted(Bounded_surface& surface, const Posed_object& fitted, const Ray& ray) {
  const auto same = [](const Ray_hit& a, const Ray_hit& b) {
    return a.face == b.face && a.t == b.t && a.point == b.point;
  };
  const auto truth = all_hits(fitted.view(), ray);
  const auto first = first_hit(surface, ray);
  EXPECT_EQ(first.has_value(), !truth.empty());
  if (first && !truth.empty()) {
    EXPECT_TRUE(same(*first, truth.front()));
  }
  EXPECT_TRUE(std::ranges::equal(all_hits(surface, ray), truth, same));
  return truth.size();
}

TEST(Ray_search, on_bounded_surfaces_equals_that_on_fitted_ones) {
  std::mt19937_64 random(6);
  const auto number = [&] { return std::uniform_real_distribution<double>(-1, 1)(random); };
  std::size_t meeting = 0;
  for (const bool morphed : {false, true})
    for (const std::size_t leaf_faces : {4, 40}) {
      Arm arm(long_potato(8, 1), morphed, leaf_faces);
      for (int round = 0; round < 6; ++round) {
        arm.pose(1.5 * number(), {number(), number(), number()});
        const Posed_object fitted{Face_soup(arm.mesh)};
        Ray_maker make(fitted.soup(), random());
        for (int kind = 0; kind < 24; ++kind) meeting += expect_as_fitted(arm.surface, fitted, make(kind)) > 0 ? 1 : 0;
        EXPECT_EQ(arm.surface.violations(), 0U);
      }
    }
  EXPECT_GT(meeting, 100U);
}

TEST(Ray_search, poses_few_leaves) {
  Arm arm(long_potato(40, 1), false);
  arm.pose(0.5, {0, 0, 0});
  const Posed_object fitted{Face_soup(arm.mesh)};
  const Ray ray{{0.3, 0.1, 5}, {0, 0, -1}};
  const auto found = first_hit(arm.surface, ray);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->face, first_hit(fitted.view(), ray)->face);
  EXPECT_GT(arm.surface.leaves_posed(), 0U);
  EXPECT_LT(arm.surface.leaves_posed(), arm.layout.leaf_count() / 20);
  Arm other(long_potato(40, 1), false);
  other.pose(0.5, {0, 0, 0});
  EXPECT_FALSE(first_hit(other.surface, {{0.3, 0.1, 5}, {0, 0, 1}}));
  EXPECT_EQ(other.surface.leaves_posed(), 0U);
}

TEST(Ray_search, is_right_where_a_broken_bound_is_noticed) {
  Arm arm(long_potato(10, 1), false);
  arm.pose(0.4, {0, 0, 0});
  const Posed_object fitted{Face_soup(arm.mesh)};
  int broken = 0;
  for (std::uint32_t from = 0; from < arm.bound.node_count(); from += 3) {
    const Shrunk_bound lie{arm.bound, from};
    for (std::uint32_t leaf = 0; leaf < arm.layout.leaf_count(); ++leaf) {
      Tree_surface tree = arm.tree;
      Bounded_surface surface(tree, arm.points, lie);
      const Aabb box = arm.bound.box(arm.layout.leaf_node(leaf));
      const Ray ray{{box.low[0] / 2 + box.high[0] / 2, box.low[1] / 2 + box.high[1] / 2, 9}, {0, 0, -1}};
      first_hit(surface, ray);
      if (surface.violations() == 0) continue;
      ++broken;
      EXPECT_FALSE(surface.is_broken());
      expect_as_fitted(surface, fitted, ray);
    }
  }
  EXPECT_GT(broken, 20);
}

TEST(Ray_search, takes_bounds_that_are_infinite) {
  Arm arm(long_potato(6, 1), false);
  arm.pose(0.4, {0, 0, 0});
  const Posed_object fitted{Face_soup(arm.mesh)};
  struct Half_known {
    const Skin_bound& truth;
    std::size_t node_count() const { return truth.node_count(); }
    Aabb box(std::uint32_t node) const {
      if (node % 3 != 1) return truth.box(node);
      return No_bound{truth.node_count()}.box(node);
    }
  };
  const Half_known some{arm.bound};
  const No_bound nothing{arm.bound.node_count()};
  Tree_surface tree = arm.tree;
  Bounded_surface half(tree, arm.points, some), none(arm.tree, arm.points, nothing);
  Ray_maker make(fitted.soup(), 8);
  std::size_t meeting = 0;
  for (int kind = 0; kind < 60; ++kind) {
    const Ray ray = make(kind);
    meeting += expect_as_fitted(half, fitted, ray) > 0 ? 1 : 0;
    expect_as_fitted(none, fitted, ray);
  }
  EXPECT_GT(meeting, 20U);
}

}  // namespace
}  // namespace lodestone
