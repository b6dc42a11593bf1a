// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/pair_memory.h"

#include <gtest/gtest.h>

#include <vector>

namespace lodestone {
namespace {

/// A meeting that can be told from others by its number.
Remembered_meeting meeting_number(std::uint32_t number) {
  return {.at = {.a = number, .b = number + 100}, .contact = {.a = number + 200, .b = number + 300}};
}

std::vector<std::uint32_t> numbers_recalled(const Meeting_memory& memory, Object_pair pair) {
  std::vector<std::uint32_t> numbers;
  for (const auto& meeting : memory.recall(pair)) {
    numbers.push_back(meeting.at.a);
    EXPECT_EQ(meeting.at.b, meeting.at.a + 100);
    EXPECT_EQ(meeting.contact, (Face_pair{meeting.at.a + 200, meeting.at.a + 300}));
  }
  return numbers;
}

using Meeting_numbers = std::vector<std::uint32_t>;

TEST(Meeting_memory, a_frame_recalls_what_the_last_one_kept_in_its_order) {
  Meeting_memory memory;
  memory.start_frame();
  EXPECT_TRUE(memory.recall({0, 1}).empty());
  for (const std::uint32_t number : {7, 3, 5}) memory.keep({0, 1}, meeting_number(number));
  memory.keep({0, 2}, meeting_number(9));
  memory.keep({2, 4}, meeting_number(1));
  EXPECT_TRUE(memory.recall({0, 1}).empty()) << "kept in this frame";
  memory.start_frame();
  EXPECT_EQ(numbers_recalled(memory, {0, 1}), (Meeting_numbers{7, 3, 5}));
  EXPECT_EQ(numbers_recalled(memory, {0, 2}), (Meeting_numbers{9}));
  EXPECT_TRUE(memory.recall({1, 2}).empty());
  EXPECT_EQ(numbers_recalled(memory, {2, 4}), (Meeting_numbers{1}));
  EXPECT_TRUE(memory.recall({3, 4}).empty());
}

TEST(Meeting_memory, every_pair_can_be_recalled_again_while_meetings_are_kept) {
  Meeting_memory memory;
  memory.start_frame();
  for (std::uint32_t pair = 0; pair < 5; ++pair) memory.keep({pair, pair + 1}, meeting_number(pair));
  memory.start_frame();
  for (std::uint32_t pair = 0; pair < 5; ++pair)
    EXPECT_EQ(numbers_recalled(memory, {pair, pair + 1}), (Meeting_numbers{pair}));
  for (std::uint32_t pair = 0; pair < 5; ++pair) {
    memory.keep({pair, pair + 1}, meeting_number(pair + 10));
    EXPECT_EQ(numbers_recalled(memory, {pair, pair + 1}), (Meeting_numbers{pair}));
  }
  memory.start_frame();
  for (std::uint32_t pair = 0; pair < 5; ++pair)
    EXPECT_EQ(numbers_recalled(memory, {pair, pair + 1}), (Meeting_numbers{pair + 10}));
}

TEST(Meeting_memory, a_pair_that_a_frame_does_not_keep_is_forgotten) {
  Meeting_memory memory;
  memory.start_frame();
  memory.keep({0, 1}, meeting_number(1));
  memory.keep({1, 2}, meeting_number(2));
  memory.start_frame();
  memory.keep({1, 2}, meeting_number(3));
  memory.start_frame();
  EXPECT_TRUE(memory.recall({0, 1}).empty());
  EXPECT_EQ(numbers_recalled(memory, {1, 2}), (Meeting_numbers{3}));
  memory.keep({0, 1}, meeting_number(4));
  memory.start_frame();
  EXPECT_EQ(numbers_recalled(memory, {0, 1}), (Meeting_numbers{4}));
  EXPECT_TRUE(memory.recall({1, 2}).empty());
}

TEST(Meeting_memory, an_object_that_is_forgotten_leaves_the_meetings_of_the_others) {
  for (const bool after_the_start : {false, true}) {
    Meeting_memory memory;
    memory.start_frame();
    const std::vector<Object_pair> pairs{{0, 1}, {0, 2}, {1, 2}, {2, 3}};
    for (std::uint32_t i = 0; i < pairs.size(); ++i) {
      memory.keep(pairs[i], meeting_number(2 * i));
      memory.keep(pairs[i], meeting_number(2 * i + 1));
    }
    if (after_the_start) memory.start_frame();
    memory.forget(1);
    if (!after_the_start) memory.start_frame();
    EXPECT_TRUE(memory.recall({0, 1}).empty());
    EXPECT_EQ(numbers_recalled(memory, {0, 2}), (Meeting_numbers{2, 3}));
    EXPECT_TRUE(memory.recall({1, 2}).empty());
    EXPECT_EQ(numbers_recalled(memory, {2, 3}), (Meeting_numbers{6, 7}));
  }
}

}  // namespace
}  // namespace lodestone
