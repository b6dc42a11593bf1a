// SPDX-License-Identifier: GPL-3.0-or-later
#include "partitions/interval.h"

#include <gtest/gtest.h>

#include <vector>

#include "lodestone/mesh/errors.h"

namespace lodestone {
namespace {

TEST(Confidence_interval, equals_the_table_of_student_s_t) {
  // Standard deviation 1, n = 3: t with two degrees of freedom is 4.303 at 97.5 %.
  const std::vector<double> three{1, 2, 3};
  EXPECT_DOUBLE_EQ(confidence_interval(three).mean, 2);
  EXPECT_NEAR(confidence_interval(three).half_width, 4.303 / std::sqrt(3.0), 1e-3);
  // Variance 2.5, n = 5: t is 2.776.
  const std::vector<double> five{1, 2, 3, 4, 5};
  EXPECT_NEAR(confidence_interval(five).half_width, 2.776 * std::sqrt(2.5 / 5), 1e-3);
}

TEST(Confidence_interval, has_width_0_for_equal_values_or_a_single_value) {
  EXPECT_EQ(confidence_interval(std::vector<double>{4, 4, 4}).half_width, 0);
  EXPECT_EQ(confidence_interval(std::vector<double>{4}).half_width, 0);
  EXPECT_EQ(confidence_interval(std::vector<double>{4}).mean, 4);
}

TEST(Confidence_interval, without_values_is_refused) { EXPECT_THROW(confidence_interval({}), Bad_argument); }

}  // namespace
}  // namespace lodestone
