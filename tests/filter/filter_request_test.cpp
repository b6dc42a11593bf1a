// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter/filter_request.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lodestone {
namespace {

Aabb box(double x, double size_x, double size_y, double size_z) {
  return Aabb{{x, 0, 0, 0}, {x + size_x, size_y, size_z, 0}};
}

TEST(Filter_request, is_too_coarse_for_leaves_that_span_less_than_four_of_its_longest_steps) {
  const auto request = filter_request(box(0, 65533, 100, 100), box(0, 65533, 100, 100), 0);  // a step is 1
  EXPECT_FALSE(is_too_coarse(request, box(7, 4.1, 0, 0), box(7, 4.1, 0, 0)));
  EXPECT_FALSE(is_too_coarse(request, box(7, 0, 0, 4.1), box(7, 0, 4.1, 0)));
  EXPECT_TRUE(is_too_coarse(request, box(7, 3.9, 3.9, 3.9), box(7, 100, 100, 100)));
  EXPECT_TRUE(is_too_coarse(request, box(7, 100, 100, 100), box(7, 3.9, 0, 0)));
  const double most = std::numeric_limits<double>::max();
  EXPECT_FALSE(is_too_coarse(request, box(-most, 2 * most, 0, 0), box(-most, 2 * most, 0, 0)));
}

TEST(Filter_request, is_not_too_coarse_where_the_margin_is_as_long) {
  const auto request = filter_request(box(0, 65500, 10, 10), box(0, 65500, 10, 10), 33);
  EXPECT_FALSE(is_too_coarse(request, box(7, 1, 1, 1), box(7, 1, 1, 1)));
}

TEST(Filter_request, counts_steps_of_the_smaller_box_where_two_boxes_only_touch) {
  const auto small = box(0, 1, 1, 1), large = box(1, 1000, 1, 1);
  const auto request = filter_request(large, small, 0), other = filter_request(small, large, 0);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_EQ(request.steps_per_unit[axis] * request.scale, other.steps_per_unit[axis] * other.scale) << axis;
  EXPECT_GT(request.steps_per_unit[0] * request.scale, 65533 / (3 / 1024.0) * 0.99);
}

TEST(Filter_request, of_boxes_that_are_points_is_finite) {
  for (const double size : {0.0, std::numeric_limits<double>::denorm_min()}) {
    const auto request = filter_request(box(5, size, size, size), box(5, size, size, size), 0);
    EXPECT_TRUE(std::isfinite(request.scale) && request.scale > 0);
    for (int axis = 0; axis < 3; ++axis) EXPECT_TRUE(std::isfinite(request.steps_per_unit[axis]));
    EXPECT_FALSE(is_too_coarse(request, box(5, 0, 0, 0), box(5, 0, 0, 0)));
  }
}

}  // namespace
}  // namespace lodestone
