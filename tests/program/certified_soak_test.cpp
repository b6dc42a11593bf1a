// SPDX-License-Identifier: GPL-3.0-or-later
#include "certified_soak/certified_soak.h"

#include <gtest/gtest.h>

namespace lodestone {
namespace {

TEST(Certified_soak, a_short_run_of_each_kind_finds_no_difference_and_can_be_repeated) {
  for (std::size_t index = 0; index < certified_soak_kinds(); ++index) {
    SCOPED_TRACE(certified_soak_name(index));
    std::size_t last = 0;
    const auto kind = certified_soak(3, index, 100, [&](std::size_t done) { last = done; });
    const auto again = certified_soak(3, index, 100);
    EXPECT_EQ(kind.name, certified_soak_name(index));
    EXPECT_EQ(last, 100U);
    EXPECT_GE(kind.frames, 100U);
    EXPECT_LT(kind.frames, 130U);
    EXPECT_EQ(kind.questions, kind.frames);
    EXPECT_EQ(kind.differences, 0U);
    EXPECT_EQ(kind.violations, 0U);
    EXPECT_EQ(kind.outside, 0U);
    EXPECT_GT(kind.boxes, kind.frames);
    EXPECT_EQ(again.colliding, kind.colliding);
    EXPECT_EQ(again.partly_read, kind.partly_read);
    EXPECT_EQ(again.boxes, kind.boxes);
  }
}

TEST(Certified_soak, plays_frames_with_and_without_collisions_and_reads_some_in_part) {
  std::size_t frames = 0, colliding = 0, partly_read = 0;
  for (std::size_t index = 0; index < certified_soak_kinds(); ++index) {
    const auto kind = certified_soak(4, index, 48);
    frames += kind.frames, colliding += kind.colliding, partly_read += kind.partly_read;
  }
  EXPECT_GT(colliding, frames / 4);
  EXPECT_LT(colliding, frames * 3 / 4);
  EXPECT_GT(partly_read, frames / 20);
}

}  // namespace
}  // namespace lodestone
