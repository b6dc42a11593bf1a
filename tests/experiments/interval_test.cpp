// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/interval.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lodestone/mesh/errors.h"

namespace lodestone {
namespace {

using Values = std::vector<double>;

TEST(Mean_interval, equals_the_table_of_student_s_t) {
  // Standard deviation 1, n = 3: t with two degrees of freedom is 4.303 at 97.5 %.
  const auto of_three = mean_interval(Values{1, 2, 3});
  EXPECT_DOUBLE_EQ(of_three.mean, 2);
  EXPECT_NEAR(of_three.high - 2, 4.303 / std::sqrt(3.0), 1e-3);
  EXPECT_NEAR(2 - of_three.low, 4.303 / std::sqrt(3.0), 1e-3);
  // Variance 2.5, n = 5: t is 2.776.
  EXPECT_NEAR(mean_interval(Values{1, 2, 3, 4, 5}).high - 3, 2.776 * std::sqrt(2.5 / 5), 1e-3);
}

TEST(Mean_interval, has_width_0_for_equal_values_or_a_single_value) {
  for (const auto& values : {Values{4, 4, 4}, Values{4}}) {
    const auto [mean, low, high] = mean_interval(values);
    EXPECT_EQ(mean, 4);
    EXPECT_EQ(low, 4);
    EXPECT_EQ(high, 4);
  }
}

TEST(Difference_interval, ends_where_differences_of_proportions_end) {
  const auto [mean, low, high] = difference_interval(Values{-0.2, 0.4});
  EXPECT_DOUBLE_EQ(mean, 0.1);
  EXPECT_EQ(low, -1);
  EXPECT_EQ(high, 1);
  EXPECT_EQ(difference_interval(Values{0.1, 0.12, 0.11}).high, mean_interval(Values{0.1, 0.12, 0.11}).high);
}

TEST(Proportion_interval, is_within_0_and_1_and_holds_the_mean) {
  for (const double low : {0.0, 0.2, 0.5, 0.8, 0.99, 1.0})
    for (const double high : {0.0, 0.7, 0.9, 1.0})
      for (const double trials : {1.0, 7.0, 1e6}) {
        const auto interval = proportion_interval(Values{low, high}, trials);
        EXPECT_LE(0, interval.low);
        EXPECT_LE(interval.low, interval.mean);
        EXPECT_LE(interval.mean, interval.high);
        EXPECT_LE(interval.high, 1);
        EXPECT_LT(interval.low, interval.high);
      }
}

TEST(Proportion_interval, of_certain_successes_is_wilson_s_with_all_trials) {
  // t with four degrees of freedom is 2.776; of n successes in n trials Wilson's interval is [n / (n + t^2), 1].
  const auto [mean, low, high] = proportion_interval(Values{1, 1, 1, 1, 1}, 100);
  EXPECT_EQ(mean, 1);
  EXPECT_NEAR(low, 100 / (100 + 2.776 * 2.776), 1e-4);
  EXPECT_EQ(high, 1);
}

TEST(Proportion_interval, has_wilson_s_ends) {
  // A proportion p is at the end of Wilson's interval exactly if |p - mean| is t standard errors of p.
  const Values values{0.9, 0.94, 0.97, 0.91, 0.98};
  const double mean = 0.94, variance = (0.0016 + 0 + 0.0009 + 0.0009 + 0.0016) / 4 / 5, t = 2.776445;
  const double trials = mean * (1 - mean) / variance;
  const auto interval = proportion_interval(values, 1e9);
  EXPECT_NEAR(interval.mean, mean, 1e-12);
  for (const double end : {interval.low, interval.high})
    EXPECT_NEAR(std::abs(end - mean), t * std::sqrt(end * (1 - end) / trials), 1e-6);
}

TEST(Proportion_interval, is_no_narrower_than_that_of_independent_trials) {
  // These values vary less than ten independent trials would.
  const auto few = proportion_interval(Values{0.5, 0.5001}, 10), many = proportion_interval(Values{0.5, 0.5001}, 1000);
  EXPECT_GT(few.high - few.low, 2 * (many.high - many.low));
}

TEST(Proportion_interval, of_a_single_value_is_that_value) {
  const auto interval = proportion_interval(Values{0.25}, 100);
  EXPECT_EQ(interval.low, 0.25);
  EXPECT_EQ(interval.high, 0.25);
}

TEST(Interval, without_values_is_refused) {
  EXPECT_THROW(mean_interval({}), Bad_argument);
  EXPECT_THROW(difference_interval({}), Bad_argument);
  EXPECT_THROW(proportion_interval({}, 1), Bad_argument);
}

}  // namespace
}  // namespace lodestone
