// SPDX-License-Identifier: GPL-3.0-or-later
// Modes with particles give the same frames for any number of threads.
#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <limits>
#include <string>

#include "support/exact_truth.h"

namespace lodestone {
namespace {

std::deque<Surface_mesh> two_fine_spheres() { return {sphere(40), sphere(40, 1, {1.6, 0.1, 0.2})}; }

/// Two spheres that are pushed through each other, with enough particles and faces for several threads.
std::vector<Frame> frames_of_spheres(Detector_options options, std::size_t threads) {
  std::deque<Surface_mesh> scene = two_fine_spheres();
  options.threads = threads;
  Lbg_options lbg;
  lbg.threads = threads;
  Detector<> detector(options, Lbg{.options = lbg});
  for (const auto& mesh : scene) detector.add(std::as_const(mesh));
  std::vector<Frame> frames;
  for (int frame = 0; frame < 3; ++frame) {
    detector.update();
    frames.push_back(detector.detect());
    shift(scene[1], -0.13, 0.05);
  }
  return frames;
}

void expect_equal_particle_frames(const Detector_options& options) {
  const auto expected = frames_of_spheres(options, 1);
  for (const auto& frame : expected) EXPECT_TRUE(frame.collides());
  for (const std::size_t threads : {2, 3, 5, 0}) {
    const auto found = frames_of_spheres(options, threads);
    for (std::size_t i = 0; i < expected.size(); ++i) expect_same_frame(found[i], expected[i]);
  }
}

constexpr std::array queries{Contact_query::yes_no, Contact_query::first, Contact_query::all};

TEST(Particle_threads, frames_with_meetings_do_not_depend_on_their_number) {
  for (const auto query : queries) expect_equal_particle_frames({.mode = Mode::particles, .contacts = query});
}

TEST(Particle_threads, frames_of_the_published_method_do_not_depend_on_their_number) {
  for (const std::size_t particles : {12, 400})
    for (const auto query : queries)
      expect_equal_particle_frames(
          {.mode = Mode::particles, .particles = particles, .meetings = 0, .collision_distance = 4, .contacts = query});
}

TEST(Particle_threads, frames_of_the_predecessor_do_not_depend_on_their_number) {
  expect_equal_particle_frames({.mode = Mode::senin, .particles = 400, .collision_distance = 4});
}

TEST(Particle_threads, the_error_of_a_frame_does_not_depend_on_their_number) {
  std::vector<std::string> messages;
  for (const std::size_t threads : {1, 2, 3, 5}) {
    std::deque<Surface_mesh> scene = two_fine_spheres();
    Detector<> detector({.mode = Mode::particles, .particles = 400, .meetings = 0, .threads = threads});
    for (const auto& mesh : scene) detector.add(std::as_const(mesh));
    detector.detect();
    // The particles themselves are read first, so only their neighbours are broken, of all particles.
    const auto& at = detector.object(0).particles().at;
    for (const auto v : scene[0].vertices())
      if (std::ranges::find(at, v.idx()) == at.end())
        scene[0].point(v) = Point(std::numeric_limits<double>::quiet_NaN(), 0, 0);
    try {
      detector.detect();
      FAIL() << "no error";
    } catch (const Bad_mesh& error) {
      messages.emplace_back(error.what());
    }
  }
  for (const auto& message : messages) EXPECT_EQ(message, messages.front());
}

}  // namespace
}  // namespace lodestone
