// SPDX-License-Identifier: GPL-3.0-or-later
#include "queries/distinct_directions.h"

#include <gtest/gtest.h>

namespace lodestone {
namespace {

using Directions = std::vector<Eigen::Vector3d>;

Eigen::Vector3d leaning(double angle) { return {std::sin(angle), 0, std::cos(angle)}; }

TEST(Distinct_directions, are_all_if_they_are_few) {
  const Directions alike(64, leaning(0));
  EXPECT_EQ(distinct_directions(alike), alike);
  EXPECT_TRUE(distinct_directions(Directions()).empty());
}

TEST(Distinct_directions, beyond_the_first_lead_elsewhere) {
  Directions directions(64, leaning(0));
  for (const double angle : {0.0, 0.09, -0.09, 0.11, 0.15, 3.1, 1.5, 1.5 + 3.14159})
    directions.push_back(leaning(angle));
  const Directions distinct = distinct_directions(directions);
  EXPECT_EQ(Directions(distinct.begin() + 64, distinct.end()), (Directions{leaning(0.11), leaning(1.5)}));
}

TEST(Distinct_directions, are_not_zero) {
  EXPECT_EQ(distinct_directions(Directions{Eigen::Vector3d::Zero(), leaning(1)}), Directions{leaning(1)});
}

}  // namespace
}  // namespace lodestone
