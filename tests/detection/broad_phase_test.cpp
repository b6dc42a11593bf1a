// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/broad_phase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

namespace lodestone {
namespace {

using Pairs = std::vector<Object_pair>;

using Ids = std::vector<std::uint32_t>;

Pairs found(Broad_phase& phase, const Ids& ids, const std::vector<Box>& boxes, const std::vector<double>& reach) {
  const auto pairs = phase.find(ids, boxes, reach);
  return {pairs.begin(), pairs.end()};
}
/// Of all objects.
Pairs found(Broad_phase& phase, const std::vector<Box>& boxes, const std::vector<double>& reach) {
  Ids ids(boxes.size());
  std::iota(ids.begin(), ids.end(), 0);
  return found(phase, ids, boxes, reach);
}

/// Every pair of boxes that overlap once one has grown by the larger reach on all sides.
Pairs expected(const Ids& ids, const std::vector<Box>& boxes, const std::vector<double>& reach) {
  Pairs pairs;
  for (const auto a : ids)
    for (const auto b : ids) {
      if (a >= b || boxes[a].isEmpty() || boxes[b].isEmpty()) continue;
      const Eigen::Vector3d grow = Eigen::Vector3d::Constant(std::max(reach[a], reach[b]));
      if (Box(boxes[a].min() - grow, boxes[a].max() + grow).intersects(boxes[b])) pairs.push_back({a, b});
    }
  return pairs;
}

Box unit_box(double x, double y, double z) { return {Eigen::Vector3d(x, y, z), Eigen::Vector3d(x + 1, y + 1, z + 1)}; }

TEST(Broad_phase, lie_within_the_larger_of_their_reaches) {
  Broad_phase phase;
  const std::vector<Box> boxes{unit_box(0, 0, 0), unit_box(3, 0, 0)};  // a gap of 2
  EXPECT_TRUE(found(phase, boxes, {1.5, 1.5}).empty());
  EXPECT_EQ(found(phase, boxes, {2.5, 0}), (Pairs{{0, 1}}));
  EXPECT_EQ(found(phase, boxes, {0, 2.5}), (Pairs{{0, 1}}));
}

TEST(Broad_phase, must_lie_near_along_every_axis) {
  Broad_phase phase;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d far = 3 * Eigen::Vector3d::Unit(axis);
    const std::vector<Box> boxes{unit_box(0, 0, 0), unit_box(far.x(), far.y(), far.z())};
    EXPECT_TRUE(found(phase, boxes, {1, 1}).empty());
    EXPECT_EQ(found(phase, boxes, {3, 3}).size(), 1U);
  }
}

TEST(Broad_phase, are_sorted_whatever_the_order_in_space) {
  Broad_phase phase;
  const std::vector<Box> boxes{unit_box(2, 0, 0), unit_box(1, 0, 0), unit_box(0, 0, 0)};
  EXPECT_EQ(found(phase, boxes, {5, 5, 5}), (Pairs{{0, 1}, {0, 2}, {1, 2}}));
}

TEST(Broad_phase, equal_brute_force_over_many_frames_of_moving_boxes) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> coordinate(0, 10), step(-0.7, 0.7), extent(0, 1.5);
  Broad_phase phase;
  std::size_t seen = 0;
  Ids ids;
  std::vector<Box> boxes;
  std::vector<double> reach;
  for (int frame = 0; frame < 300; ++frame) {
    for (auto& box : boxes) box.translate(Eigen::Vector3d(step(random), step(random), step(random)));
    if (frame % 60 == 0)  // newcomers
      for (int i = 0; i < 15; ++i) {
        const Eigen::Vector3d low(coordinate(random), coordinate(random), coordinate(random));
        boxes.emplace_back(low, low + Eigen::Vector3d(extent(random), extent(random), extent(random)));
        reach.push_back(extent(random));
        ids.push_back(static_cast<std::uint32_t>(boxes.size() - 1));
      }
    if (frame % 23 == 22) ids.erase(ids.begin() + static_cast<std::ptrdiff_t>(random() % ids.size()));
    if (frame % 37 == 0) boxes[random() % boxes.size()].translate(Eigen::Vector3d(-9, 9, 0));
    if (frame % 10 == 0) reach[random() % reach.size()] = 4 * extent(random);
    const auto pairs = found(phase, ids, boxes, reach);
    EXPECT_EQ(pairs, expected(ids, boxes, reach)) << frame;
    seen += pairs.size();
  }
  EXPECT_GT(seen, 1000U);
}

TEST(Broad_phase, equal_brute_force_where_boxes_turn_to_another_axis_or_change_places_at_once) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> along(0, 100), across(0, 1), extent(0, 1.5);
  Broad_phase phase;
  constexpr std::size_t count = 120;
  const std::vector<double> reach(count);
  std::vector<Box> boxes(count);
  std::size_t seen = 0;
  for (int frame = 0; frame < 24; ++frame) {
    const int axis = frame / 4 % 3;
    for (auto& box : boxes) {
      Eigen::Vector3d low(across(random), across(random), across(random));
      low[axis] = 1e9 + along(random);
      box = Box(low, low + Eigen::Vector3d(extent(random), extent(random), extent(random)));
    }
    const auto pairs = found(phase, boxes, reach);
    Ids ids(count);
    std::iota(ids.begin(), ids.end(), 0);
    EXPECT_EQ(pairs, expected(ids, boxes, reach)) << frame;
    seen += pairs.size();
  }
  EXPECT_GT(seen, 1000U);
}

TEST(Broad_phase, equal_brute_force_where_some_boxes_are_long_or_far_away_or_endless) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  constexpr double largest = std::numeric_limits<double>::max(), infinity = std::numeric_limits<double>::infinity();
  for (const double long_share : {0.0, 0.05, 0.4, 0.9})
    for (const double length : {5.0, 300.0, 1e9, largest}) {
      Broad_phase phase;
      std::vector<Box> boxes;
      std::vector<double> reach;
      for (int i = 0; i < 400; ++i) {
        const Eigen::Vector3d low = 20 * Eigen::Vector3d(unit(random), unit(random), unit(random));
        boxes.emplace_back(low, low + Eigen::Vector3d::Ones());
        reach.push_back(unit(random) < 0.1 ? unit(random) : 0);
        const auto axis = static_cast<Eigen::Index>(random() % 3);
        if (unit(random) < long_share) boxes.back().max()[axis] += length;
        if (unit(random) < 0.05) boxes.back().translate(Eigen::Vector3d(1e6 * unit(random), 0, 1e12));
      }
      boxes[7].setEmpty();
      boxes[8] = Box(Eigen::Vector3d::Constant(-largest / 2), Eigen::Vector3d::Constant(largest / 2));
      boxes[9] = Box(Eigen::Vector3d::Ones(), Eigen::Vector3d::Ones());
      reach[10] = length == 5 ? infinity : 0;
      Ids ids(boxes.size());
      std::iota(ids.begin(), ids.end(), 0);
      EXPECT_EQ(found(phase, boxes, reach), expected(ids, boxes, reach)) << long_share << ' ' << length;
    }
}

TEST(Broad_phase, of_fewer_than_two_objects_are_none) {
  Broad_phase phase;
  EXPECT_TRUE(found(phase, {}, {}).empty());
  EXPECT_TRUE(found(phase, {unit_box(0, 0, 0)}, {100}).empty());
}

}  // namespace
}  // namespace lodestone
