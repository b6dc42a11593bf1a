// SPDX-License-Identifier: GPL-3.0-or-later
// What the experiment `every_frame` counts of answers that are wrong.
#include "every_frame/frame_check.h"

#include <gtest/gtest.h>

#include <vector>

namespace lodestone {
namespace {

const std::vector<Face_pair> truth{{0, 4}, {1, 2}, {7, 3}};

/// The pair of objects 1 and 2, after another pair that has a contact of its own.
Frame frame_with(bool collides, const std::vector<Face_pair>& found) {
  Frame frame;
  frame.face_pairs = {{9, 9}};
  frame.face_pairs.insert(frame.face_pairs.end(), found.begin(), found.end());
  frame.pairs = {{.a = 0, .b = 1, .collides = true, .first_contact = 0, .contacts = 1},
                 {.a = 1, .b = 2, .collides = collides, .first_contact = 1, .contacts = found.size()}};
  return frame;
}

Frame_checks checked_of(const Frame& answer, const std::vector<Face_pair>& true_pairs,
                        const Detector_options& options) {
  Frame_checks checked;
  compare_with_truth(answer, {1, 2}, true_pairs, options, checked);
  return checked;
}

TEST(Frame_check, a_right_answer_adds_nothing) {
  for (const Mode mode : {Mode::exact, Mode::certified, Mode::particles, Mode::senin}) {
    for (const Frame_checks& checked :
         {checked_of(frame_with(true, truth), truth, {.mode = mode}), checked_of(Frame(), {}, {.mode = mode}),
          checked_of(frame_with(false, {}), {}, {.mode = mode}),
          checked_of(frame_with(true, {}), truth, {.mode = mode, .contacts = Contact_query::yes_no})})
      EXPECT_EQ(checked.wrong_answers + checked.wrong_sets + checked.invented, 0U) << name_of(mode);
  }
}

TEST(Frame_check, modes_that_find_all_must_answer_right_and_list_the_true_pairs) {
  for (const Mode mode : {Mode::exact, Mode::certified}) {
    SCOPED_TRACE(name_of(mode));
    const auto expect = [&](const Frame& answer, const std::vector<Face_pair>& true_pairs, std::size_t answers,
                            std::size_t sets) {
      const Frame_checks checked = checked_of(answer, true_pairs, {.mode = mode});
      EXPECT_EQ(checked.wrong_answers, answers);
      EXPECT_EQ(checked.wrong_sets, sets);
    };
    expect(frame_with(false, truth), truth, 1, 0);                            // says no, but lists them
    expect(frame_with(true, {}), {}, 1, 0);                                   // says yes for nothing
    expect(Frame(), truth, 1, 1);                                             // has lost the pair of objects
    expect(frame_with(true, {{0, 4}, {1, 2}}), truth, 0, 1);                  // has lost a contact
    expect(frame_with(true, {{0, 4}, {1, 2}, {7, 4}}), truth, 0, 1);          // another face
    expect(frame_with(true, {{0, 4}, {0, 4}, {1, 2}, {7, 3}}), truth, 0, 1);  // one twice
    const Frame_checks yes_no =
        checked_of(frame_with(false, {}), truth, {.mode = mode, .contacts = Contact_query::yes_no});
    EXPECT_EQ(yes_no.wrong_answers, 1U);
  }
}

TEST(Frame_check, modes_with_particles_may_miss_but_not_invent) {
  for (const Mode mode : {Mode::particles, Mode::senin}) {
    SCOPED_TRACE(name_of(mode));
    const auto invented = [&](const Frame& answer, const std::vector<Face_pair>& true_pairs) {
      return checked_of(answer, true_pairs, {.mode = mode}).invented;
    };
    EXPECT_EQ(invented(frame_with(false, {}), truth), 0U);
    EXPECT_EQ(invented(frame_with(true, {{1, 2}}), truth), 0U);
    EXPECT_EQ(invented(frame_with(true, {{1, 2}, {5, 5}, {6, 6}}), truth), 2U);
    EXPECT_EQ(invented(frame_with(true, {}), {}), 1U);
    EXPECT_EQ(invented(frame_with(true, {{1, 2}}), {}), 2U);  // the collision, and its contact
  }
}

}  // namespace
}  // namespace lodestone
