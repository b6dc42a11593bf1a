// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/meeting.h"

#include <gtest/gtest.h>

#include "lodestone/mesh/errors.h"
#include "support/owned_surface.h"
#include "support/special_numbers.h"

namespace lodestone {
namespace {

constexpr std::size_t any_hops = 1'000'000;

std::uint32_t some_vertex(const Owned_surface& surface, std::mt19937_64& random) {
  return static_cast<std::uint32_t>(random() % surface.soup().vertex_count());
}

/// Whether no neighbour of a vertex is nearer to a point.
bool is_nearest_of_its_neighbours(const Owned_surface& surface, std::uint32_t vertex, const Eigen::Vector3d& point) {
  const double here = (surface.at(vertex) - point).squaredNorm();
  return std::ranges::none_of(neighbours(surface.graph(), vertex), [&](std::uint32_t neighbour) {
    return (surface.at(neighbour) - point).squaredNorm() < here;
  });
}

TEST(Meeting, ends_where_no_step_of_either_particle_leads_nearer) {
  std::mt19937_64 random(1);
  const Owned_surface a(potato(10)), b(moved(potato(9, 2), 1.7, 0.4, 0.2)), c(torus_knot({.radius = 0.7}));
  for (const auto& [first, second] : {std::pair(&a, &b), std::pair(&b, &c), std::pair(&c, &a)})
    for (int i = 0; i < 200; ++i) {
      const Meeting start{some_vertex(*first, random), some_vertex(*second, random)};
      const auto ended = meet(first->view(), second->view(), start, any_hops);
      const auto at_a = first->at(ended.at.a), at_b = second->at(ended.at.b);
      EXPECT_TRUE(is_nearest_of_its_neighbours(*first, ended.at.a, at_b));
      EXPECT_TRUE(is_nearest_of_its_neighbours(*second, ended.at.b, at_a));
      EXPECT_EQ(ended.squared_distance, (at_a - at_b).squaredNorm());
      EXPECT_LE(ended.squared_distance, (first->at(start.a) - second->at(start.b)).squaredNorm());
      EXPECT_GE(ended.vertices_read, 2 + ended.hops);
      const auto again = meet(first->view(), second->view(), ended.at, any_hops);
      EXPECT_EQ(again.hops, 0U);
      EXPECT_EQ(again.vertices_read,
                2 + out_degree(ended.at.a, first->graph()) + out_degree(ended.at.b, second->graph()));
      EXPECT_EQ(again.at.a, ended.at.a);
      EXPECT_EQ(again.at.b, ended.at.b);
    }
}

TEST(Meeting, particles_on_the_far_sides_of_two_spheres_meet_between_them) {
  const Owned_surface a(sphere(20)), b(moved(sphere(20), 2.5, 0.1, 0.05));
  double nearest = infinity;
  for (std::uint32_t i = 0; i < a.soup().vertex_count(); ++i)
    for (std::uint32_t j = 0; j < b.soup().vertex_count(); ++j) nearest = std::min(nearest, (a.at(i) - b.at(j)).norm());
  std::mt19937_64 random(2);
  for (int i = 0; i < 50; ++i) {
    const auto ended = meet(a.view(), b.view(), {some_vertex(a, random), some_vertex(b, random)}, any_hops);
    EXPECT_LT(std::sqrt(ended.squared_distance), nearest + 0.05);
  }
}

TEST(Meeting, takes_no_more_hops_than_it_may_and_each_on_the_way_of_the_full_walk) {
  const Owned_surface a(potato(12)), b(moved(potato(12, 2), 3, 0, 0));
  const Meeting start{7, 11};
  const auto full = meet(a.view(), b.view(), start, any_hops);
  ASSERT_GT(full.hops, 5U);
  Ended_meeting before = meet(a.view(), b.view(), start, 0);
  EXPECT_EQ(before.hops, 0U);
  EXPECT_EQ(before.at.a, start.a);
  EXPECT_EQ(before.at.b, start.b);
  for (std::size_t most = 1; most <= full.hops; ++most) {
    const auto ended = meet(a.view(), b.view(), start, most);
    EXPECT_EQ(ended.hops, most);
    EXPECT_LT(ended.squared_distance, before.squared_distance);
    const auto step_a = neighbours(a.graph(), before.at.a), step_b = neighbours(b.graph(), before.at.b);
    EXPECT_EQ(ended.at.a != before.at.a, ended.at.b == before.at.b) << "one particle takes each hop";
    EXPECT_TRUE(ended.at.a == before.at.a || std::ranges::find(step_a, ended.at.a) != step_a.end());
    EXPECT_TRUE(ended.at.b == before.at.b || std::ranges::find(step_b, ended.at.b) != step_b.end());
    before = ended;
  }
  EXPECT_EQ(before.at.a, full.at.a);
  EXPECT_EQ(before.at.b, full.at.b);
}

TEST(Meeting, ties_go_to_the_lowest_vertex) {
  // Corner 0 of a square sees its neighbours 1 and 2 at the same distance of the other object, a single place.
  Face_soup square, place;
  square.coordinates = {0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0};
  square.faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
  place.faces = {{0, 1, 2}};
  const auto single_place = [&](double x, double y) {
    place.coordinates = {x, y, 0, x, y, 0, x, y, 0};
    return place;
  };
  const Owned_surface a(square);
  struct Case {
    double x, y;
    std::uint32_t lowest;
  };
  for (const auto& [x, y, lowest] : {Case{5, 5, 1}, Case{-5, 5, 2}, Case{-5, -5, 3}, Case{5, -5, 1}}) {
    const Owned_surface b(single_place(x, y));
    const auto ended = meet(a.view(), b.view(), {0, 2}, 1);
    EXPECT_EQ(ended.at.a, lowest);
    EXPECT_EQ(ended.at.b, 2U) << "no step leads nearer";
  }
}

TEST(Meeting, particles_cross_seams_that_are_closed) {
  const Face_soup apart = flat_shaded(sphere(8));
  const Owned_surface open(apart), closed(apart, true), other(moved(sphere(8), 2.3, 0, 0));
  // A vertex on the far side.
  std::uint32_t farthest = 0;
  for (std::uint32_t v = 0; v < apart.vertex_count(); ++v)
    if (apart.point(v).x() < apart.point(farthest).x()) farthest = v;
  const auto& corners = apart.faces[farthest / 3];
  const auto place = std::ranges::find(corners, farthest) - corners.begin();
  const std::uint32_t joined = closed.walked()[farthest / 3][static_cast<std::size_t>(place)];
  EXPECT_GT(std::sqrt(meet(open.view(), other.view(), {farthest, 0}, any_hops).squared_distance), 1.5);
  EXPECT_LT(std::sqrt(meet(closed.view(), other.view(), {joined, 0}, any_hops).squared_distance), 0.6);
}

TEST(Meeting, a_coordinate_that_is_not_finite_is_refused_where_it_is_read) {
  for (const double bad : {not_a_number, infinity, -infinity}) {
    Owned_surface a(sphere(6));
    const Owned_surface b(moved(sphere(6), 3, 0, 0));
    const std::uint32_t start = 5, beside = *neighbours(a.graph(), start).begin();
    a.coordinates()[3 * std::size_t{beside}] = bad;
    EXPECT_THROW(meet(a.view(), b.view(), {start, 0}, any_hops), Bad_mesh);
    EXPECT_THROW(meet(b.view(), a.view(), {0, start}, any_hops), Bad_mesh);
    EXPECT_THROW(meet(a.view(), b.view(), {beside, 0}, 0), Bad_mesh);
    EXPECT_NO_THROW(meet(a.view(), b.view(), {start, 0}, 0));
  }
}

}  // namespace
}  // namespace lodestone
