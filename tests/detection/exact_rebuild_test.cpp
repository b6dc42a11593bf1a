// SPDX-License-Identifier: GPL-3.0-or-later
// Trees are built anew where their leaves have become loose, and only there.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <random>

#include "lodestone/io/shapes/shapes.h"
#include "support/exact_truth.h"

namespace lodestone {
namespace {

/// Small tetrahedra, one around each of the given places.
Surface_mesh pieces_at(const std::vector<Point>& places) {
  Surface_mesh mesh;
  for (const auto& place : places) {
    auto piece = tetrahedron();
    scale(piece, 0.08);
    shift(piece, place.x(), place.y(), place.z());
    append(mesh, piece);
  }
  return mesh;
}

std::vector<Point> places(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(-1, 1);
  std::vector<Point> result;
  for (int i = 0; i < 500; ++i) {
    const double x = place(random), y = place(random), z = place(random);
    result.emplace_back(x, y, z);
  }
  return result;
}

/// Frames in which 500 pieces go from where they are to other places; gives the rebuilds.
/// @param strays  so many of them fly off
std::size_t rebuilds_while_mixing(double loosest, std::size_t strays = 0) {
  const auto from = places(1);
  auto to = places(2);
  for (std::size_t i = 0; i < strays; ++i) to[i] = Point(i == 1 ? -1000 : 1000, i == 2 ? -1000 : 1000, 1000);
  auto soup = pieces_at(from);
  const auto body = potato(10);
  Exact_detector detector({.mode = Mode::exact, .exact = {.loosest = loosest}, .tree = {.leaf_faces = 16}});
  add_all(detector, {&soup, &body});
  std::size_t rebuilds = 0;
  for (int frame = 0; frame <= 10; ++frame) {
    std::vector<Point> now;
    for (std::size_t i = 0; i < from.size(); ++i) now.push_back(from[i] + 0.1 * frame * (to[i] - from[i]));
    place(soup, positions_of(pieces_at(now)));
    const Frame& result = detector.detect();
    EXPECT_EQ(expect_exhaustive(result, {&soup, &body}), 1U);
    rebuilds += result.statistics.repartitions;
    EXPECT_EQ(result.statistics.builds, frame == 0 ? 2U : 0U);
    EXPECT_EQ(result.statistics.seconds.repartition > 0, result.statistics.repartitions > 0);
  }
  return rebuilds;
}

TEST(Exact_rebuild, a_soup_whose_pieces_mix_is_built_anew_and_answered_right) {
  const auto rebuilds = rebuilds_while_mixing(2);
  EXPECT_GE(rebuilds, 1U);
  EXPECT_LE(rebuilds, 4U);  // not in every frame
}

TEST(Exact_rebuild, of_a_soup_that_mixes_is_not_kept_from_it_by_pieces_that_fly_off) {
  for (const std::size_t strays : {1U, 2U, 3U}) {
    const auto rebuilds = rebuilds_while_mixing(2, strays);
    EXPECT_GE(rebuilds, 1U) << strays;
    EXPECT_LE(rebuilds, 5U) << strays;
  }
}

TEST(Exact_rebuild, happens_more_often_with_a_lower_limit) {
  EXPECT_GT(rebuilds_while_mixing(1.2), rebuilds_while_mixing(2));
}

TEST(Exact_rebuild, never_happens_without_a_limit) {
  EXPECT_EQ(rebuilds_while_mixing(std::numeric_limits<double>::infinity()), 0U);
}

TEST(Exact_rebuild, vertices_that_scatter_are_followed) {
  auto a = sphere(12), b = sphere(12, 1, {1, 0, 0});
  Exact_detector detector({.mode = Mode::exact});
  add_all(detector, {&a, &b});
  EXPECT_EQ(detector.detect().statistics.repartitions, 0U);
  for (int i = 0; i < 3; ++i) {
    crumple(a, 1, 7);
    expect_exhaustive(detector.detect(), {&a, &b});
  }
  const auto again = sphere(12);
  for (const auto v : a.vertices()) a.point(v) = again.point(v);
  EXPECT_EQ(expect_exhaustive(detector.detect(), {&a, &b}), 1U);
}

TEST(Exact_rebuild, one_tree_is_built_anew_while_others_stay) {
  auto soup = pieces_at(places(1));
  const auto a = sphere(8), b = sphere(8, 1, {0.5, 0, 0});
  Exact_detector detector({.mode = Mode::exact, .tree = {.leaf_faces = 16}});
  add_all(detector, {&a, &soup, &b});
  detector.detect();
  place(soup, positions_of(pieces_at(places(2))));
  const Frame& frame = detector.detect();
  EXPECT_EQ(frame.statistics.repartitions, 1U);
  EXPECT_EQ(expect_exhaustive(frame, {&a, &soup, &b}), 3U);
  EXPECT_EQ(detector.detect().statistics.repartitions, 0U);
  const Numbered_mesh now(soup);
  EXPECT_EQ(detector.tree(1).validate(now.faces, now.coordinates()), "");
}

TEST(Exact_rebuild, does_not_happen_to_a_body_that_is_moved_or_turned) {
  auto a = potato(20), b = torus_knot();
  Exact_detector detector({.mode = Mode::exact});
  add_all(detector, {&a, &b});
  const Eigen::Matrix3d turn(Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()));
  for (int frame = 0; frame < 25; ++frame) {
    EXPECT_EQ(detector.detect().statistics.repartitions, 0U);
    for (auto* mesh : {&a, &b})
      deform(*mesh, [&](const Point& p) {
        const Eigen::Vector3d q = turn * coordinates(p);
        return Point(q.x() + 0.1, q.y(), q.z() - 0.3);
      });
  }
}

TEST(Exact_rebuild, does_not_happen_to_a_body_that_is_scaled) {
  auto a = potato(20), b = torus_knot();
  Exact_detector detector({.mode = Mode::exact});
  add_all(detector, {&a, &b});
  for (const double factor : {1.0, 3.0, 1e6, 1e200, 1e-220, 1e-300, 1e290, 1e20}) {
    for (auto* mesh : {&a, &b}) scale(*mesh, factor);
    const Frame& frame = detector.detect();
    EXPECT_EQ(frame.statistics.repartitions, 0U) << factor;
    scale(a, 1 / factor), scale(b, 1 / factor);
  }
}

TEST(Exact_rebuild, a_body_without_extent_may_unfold) {
  auto a = sphere(12), b = sphere(12, 1, {1, 0, 0});
  deform(a, [](const Point&) { return Point(0, 0, 0); });
  Exact_detector detector({.mode = Mode::exact});
  add_all(detector, {&a, &b});
  EXPECT_EQ(expect_exhaustive(detector.detect(), {&a, &b}), exhaustive_face_pairs(a, b).empty() ? 0U : 1U);
  const auto round = sphere(12);
  for (const auto v : round.vertices()) a.point(v) = round.point(v);
  const Frame& frame = detector.detect();
  EXPECT_EQ(frame.statistics.repartitions, 1U);
  EXPECT_EQ(expect_exhaustive(frame, {&a, &b}), 1U);
}

}  // namespace
}  // namespace lodestone
