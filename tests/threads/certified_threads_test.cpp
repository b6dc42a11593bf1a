// SPDX-License-Identifier: GPL-3.0-or-later
// Mode certified gives the same frames for any number of threads, and reads the same.
#include <gtest/gtest.h>

#include "detection/certified_scene.h"

namespace lodestone {
namespace {

std::vector<Frame> certified_frames(Detector_options options, std::size_t threads) {
  options.threads = threads;
  Certified_scene scene;
  Detector<> detector(in_mode(Mode::certified, options));
  scene.add_to(detector);
  std::vector<Frame> frames;
  for (int frame = 0; frame < 6; ++frame) {
    scene.pose(frame);
    frames.push_back(detector.detect());
  }
  return frames;
}

TEST(Certified_threads, frames_do_not_depend_on_their_number) {
  for (const auto& options : questions()) {
    const auto expected = certified_frames(options, 1);
    for (const std::size_t threads : {2, 3, 5}) {
      const auto found = certified_frames(options, threads);
      for (std::size_t i = 0; i < expected.size(); ++i) {
        expect_same_frame(found[i], expected[i]);
        EXPECT_EQ(found[i].statistics.vertices_read, expected[i].statistics.vertices_read);
        EXPECT_EQ(found[i].statistics.leaves_posed, expected[i].statistics.leaves_posed);
      }
    }
  }
}

}  // namespace
}  // namespace lodestone
