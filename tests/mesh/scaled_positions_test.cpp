// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/scaled_positions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lodestone {
namespace {

TEST(Scaled_exactly, brings_the_largest_coordinate_between_a_half_and_one) {
  constexpr double least = std::numeric_limits<double>::denorm_min(), most = std::numeric_limits<double>::max();
  for (const double size : {least, 1e-300, 1e-150, 0.5, 1.0, 3.0, 1e150, most}) {
    const Positions positions = (Positions(2, 3) << 0, size / 2, 0, -size, 0, size / 4).finished();
    const Positions scaled = scaled_positions(positions);
    EXPECT_GE(scaled.cwiseAbs().maxCoeff(), 0.5);
    EXPECT_LT(scaled.cwiseAbs().maxCoeff(), 1);
  }
}

TEST(Scaled_exactly, multiplies_by_a_power_of_two) {
  const Positions positions = (Positions(2, 3) << 0.1, -7.3, 1e-5, 12.7, 3, 0).finished();
  EXPECT_EQ(scaled_positions(positions), positions / 16);
}

TEST(Scaled_exactly, leaves_zero_alone) {
  EXPECT_EQ(scaled_positions(Positions::Zero(3, 3)), Positions::Zero(3, 3));
  EXPECT_EQ(scaled_positions(Positions(0, 3)).rows(), 0);
}

}  // namespace
}  // namespace lodestone
