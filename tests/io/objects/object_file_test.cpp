// SPDX-License-Identifier: GPL-3.0-or-later
// Files of saved objects: whole or not at all, and nothing in them is believed.
#include "lodestone/io/objects/object_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <random>
#include <string>

#include "lodestone/detection/saved_object.h"
#include "support/exact_truth.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"
#include "support/vandal.h"

namespace lodestone {
namespace {

using test::Temporary_folder;

TEST(Object_file, holds_what_was_saved) {
  const Temporary_folder folder;
  auto a = sphere(12), b = sphere(12, 1, {1.9, 0, 0});
  Exact_detector first, second;
  first.add(a), first.add(b), second.add(a), second.add(b);
  save_object(first, 0, folder.path() / "new" / "a.object");
  save_object(first, 1, folder.path() / "b.object");
  load_object(second, 0, folder.path() / "new" / "a.object");
  load_object(second, 1, folder.path() / "b.object");
  expect_same_frame(first.detect(), second.detect());
  EXPECT_EQ(second.detect().statistics.builds, 0U);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path() / "new"), {}), 1) << "no temporary file";
}

TEST(Object_file, that_cannot_be_read_is_named) {
  const Temporary_folder folder;
  auto mesh = sphere(4);
  Exact_detector detector;
  detector.add(mesh);
  const auto refusal = [&](const std::filesystem::path& file) {
    return message_of<Bad_saved_object>([&] { load_object(detector, 0, file); });
  };
  const auto file = folder.write("mesh.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_EQ(refusal(file), file.string() + ": this is no saved object");
  EXPECT_TRUE(refusal(folder.path() / "none").starts_with((folder.path() / "none").string() + ": "));
  EXPECT_TRUE(refusal(folder.path()).starts_with(folder.path().string() + ": "));
  EXPECT_TRUE(refusal(folder.write("empty", "")).starts_with((folder.path() / "empty").string() + ": "));
}

TEST(Object_file, that_cannot_be_written_is_an_error) {
  const Temporary_folder folder;
  auto mesh = sphere(4);
  Exact_detector detector;
  detector.add(mesh);
  EXPECT_THROW(save_object(detector, 0, folder.write("file", "") / "a.object"), Bad_output);
  EXPECT_THROW(save_object(detector, 0, folder.path()), Bad_output);
}

std::string text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The right hash, whatever the bytes are: what a forger would write.
std::vector<std::byte> forged(const std::string& rest) { return seal_saved(std::as_bytes(std::span(rest))); }

/// Replaces a number by one that could stand there.
std::string with_another_number(std::string bytes, std::mt19937& random) {
  const std::uint32_t number = random() % 300;
  std::memcpy(bytes.data() + 4 * (random() % (bytes.size() / 4)), &number, sizeof number);
  return bytes;
}

/// Damages what was saved many times, and loads it.
/// @return how often it was taken
std::size_t loaded_when_damaged(const Detector_options& options, const std::function<void(const Frame&)>& check) {
  auto a = sphere(6), b = sphere(6, 1, {1.8, 0, 0});
  Detector<> detector(options), victim(options);
  detector.add(a), detector.add(b), victim.add(a), victim.add(b);
  const auto saved = detector.save(0);
  const std::string rest = text_of(open_saved(saved));
  test::Vandal vandal;
  std::mt19937 random(1);
  std::size_t loaded = 0;
  for (int i = 0; i < 1000; ++i) {
    try {
      victim.load(0, forged(i % 2 == 0 ? vandal.damaged(rest) : with_another_number(rest, random)));
      ++loaded;
    } catch (const Bad_saved_object&) {
    }
    if (i % 10 == 0) victim.update();
    try {
      check(victim.detect());
    } catch (const Bad_mesh&) {
      victim.load(0, saved);
    }
  }
  return loaded;
}

TEST(Object_damage, leaves_the_answers_of_mode_exact_right) {
  const auto a = sphere(6), b = sphere(6, 1, {1.8, 0, 0});
  const auto truth = exhaustive_face_pairs(a, b);
  loaded_when_damaged({}, [&](const Frame& frame) { ASSERT_EQ(frame.face_pairs, truth); });
  loaded_when_damaged({.particles = 12}, [&](const Frame& frame) { ASSERT_EQ(frame.face_pairs, truth); });
}

/// Three tests, which can run side by side: sanitised they take long.
void expect_nothing_false(const Detector_options& options) {
  const auto a = sphere(6), b = sphere(6, 1, {1.8, 0, 0});
  const auto truth = exhaustive_face_pairs(a, b);
  const auto check = [&](const Frame& frame) { ASSERT_TRUE(std::ranges::includes(truth, frame.face_pairs)); };
  EXPECT_GT(loaded_when_damaged(options, check), 0U);
}

TEST(Object_damage, never_makes_particles_report_what_is_false) { expect_nothing_false({.mode = Mode::particles}); }
TEST(Object_damage, never_makes_particles_without_meetings_report_what_is_false) {
  expect_nothing_false({.mode = Mode::particles, .meetings = 0});
}
TEST(Object_damage, never_makes_particles_of_the_predecessor_report_what_is_false) {
  expect_nothing_false({.mode = Mode::senin});
}

}  // namespace
}  // namespace lodestone
