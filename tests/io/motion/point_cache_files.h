// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lodestone/io/motion/motion.h"
#include "lodestone/mesh/errors.h"
#include "support/mesh_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {

/// Tests of a format of point caches.
class Point_cache_files : public testing::Test {
 protected:
  using Reader = Motion (*)(const std::filesystem::path& file, std::size_t vertices);
  Point_cache_files(Reader read, std::string extension) : read_(read), extension_(std::move(extension)) {}

  /// Reading or posing frame 0 must fail with a message that begins with the file's name and `rest`.
  void expect_error(const std::string& bytes, std::size_t vertices, const std::string& rest) const {
    const auto file = folder.write("broken" + extension_, bytes);
    try {
      std::vector<Point> positions(vertices);
      read_(file, vertices).pose(0, positions);
      ADD_FAILURE() << "expected" << rest;
    } catch (const Bad_motion& error) {
      EXPECT_EQ(std::string(error.what()).substr(0, file.string().size() + rest.size()), file.string() + rest);
    }
  }

  /// The file holds three frames of two vertices: at frame t they are (t, 0, 0) and (0, t, -t).
  void expect_three_frames(const std::string& bytes) const {
    const auto motion = read_(folder.write("a" + extension_, bytes), 2);
    EXPECT_EQ(motion.frames, 3U);
    std::vector<Point> positions(2);
    for (const std::size_t frame : {2, 0, 1, 2}) {
      motion.pose(frame, positions);
      const auto t = static_cast<double>(frame);
      EXPECT_EQ(positions, (std::vector<Point>{{t, 0, 0}, {0, t, -t}}));
    }
  }

  Temporary_folder folder;

 private:
  Reader read_;
  std::string extension_;
};

}  // namespace lodestone::test
