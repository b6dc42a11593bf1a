// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/frame.h"

#include <gtest/gtest.h>

#include <vector>

namespace lodestone {
namespace {

/// Three near pairs of three objects with two, no and one intersecting face pair.
Frame frame_of_three_pairs() {
  return {.number = 7,
          .pairs = {{.a = 0, .b = 1, .collides = true, .candidates = 3, .first_contact = 0, .contacts = 2},
                    {.a = 0, .b = 2, .collides = false, .candidates = 1, .first_contact = 2, .contacts = 0},
                    {.a = 1, .b = 2, .collides = true, .candidates = 1, .first_contact = 2, .contacts = 1}},
          .face_pairs = {{4, 9}, {5, 1}, {0, 3}},
          .contact_points = {},
          .contact_normals = {}};
}

std::vector<Face_pair> listed(const Frame& frame, std::size_t pair) {
  const auto contacts = frame.contacts(frame.pairs[pair]);
  return {contacts.begin(), contacts.end()};
}

TEST(Frame, the_contacts_of_a_pair_are_its_own_face_pairs) {
  const Frame frame = frame_of_three_pairs();
  EXPECT_EQ(listed(frame, 0), (std::vector<Face_pair>{{4, 9}, {5, 1}}));
  EXPECT_EQ(listed(frame, 1), std::vector<Face_pair>{});
  EXPECT_EQ(listed(frame, 2), (std::vector<Face_pair>{{0, 3}}));
}

TEST(Frame, the_contacts_of_a_pair_are_a_view_of_the_frame) {
  const Frame frame = frame_of_three_pairs();
  EXPECT_EQ(frame.contacts(frame.pairs[0]).data(), frame.face_pairs.data());
  EXPECT_EQ(frame.contacts(frame.pairs[2]).data(), frame.face_pairs.data() + 2);
}

TEST(Frame, a_pair_that_collides_without_listed_faces_has_no_contacts) {
  Frame frame;
  frame.pairs = {{.a = 0, .b = 1, .collides = true, .candidates = 1}};
  EXPECT_TRUE(frame.contacts(frame.pairs[0]).empty());
  EXPECT_TRUE(frame.collides());
}

TEST(Frame, finds_a_pair_by_its_objects_in_either_order) {
  const Frame frame = frame_of_three_pairs();
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(frame.find(frame.pairs[i].a, frame.pairs[i].b), &frame.pairs[i]);
    EXPECT_EQ(frame.find(frame.pairs[i].b, frame.pairs[i].a), &frame.pairs[i]);
  }
  EXPECT_EQ(frame.find(0, 0), nullptr);
  EXPECT_EQ(frame.find(1, 3), nullptr);
  EXPECT_EQ(Frame{}.find(0, 1), nullptr);
}

TEST(Frame, contacts_intersect_unless_they_are_said_to_be_only_near) {
  Frame frame = frame_of_three_pairs();
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(frame.intersects(i));
  frame.contact_intersects = {1, 0, 1};
  EXPECT_TRUE(frame.intersects(0));
  EXPECT_FALSE(frame.intersects(1));
}

TEST(Frame, collides_when_any_of_its_pairs_does) {
  Frame frame = frame_of_three_pairs();
  EXPECT_TRUE(frame.collides());
  frame.pairs[0].collides = false;
  EXPECT_TRUE(frame.collides());  // the last pair alone
  frame.pairs[2].collides = false;
  EXPECT_FALSE(frame.collides());
}

TEST(Frame, is_near_when_any_of_its_pairs_is) {
  Frame frame = frame_of_three_pairs();
  EXPECT_FALSE(frame.near());
  frame.pairs[1].near = true;
  EXPECT_TRUE(frame.near());
}

TEST(Frame, without_pairs_does_not_collide) { EXPECT_FALSE(Frame{}.collides()); }

TEST(Stage_times, total_is_the_sum_of_every_stage) {
  // Powers of two: a stage left out or counted twice shows, and the sum is exact.
  const Stage_times seconds{.build = 1,
                            .repartition = 2,
                            .refit = 4,
                            .broad_phase = 8,
                            .relaxation = 16,
                            .candidates = 32,
                            .confirmation = 64};
  EXPECT_EQ(seconds.total(), 127);
  EXPECT_EQ(seconds.without_build(), 126);
  EXPECT_EQ(Stage_times{}.total(), 0);
}

}  // namespace
}  // namespace lodestone
