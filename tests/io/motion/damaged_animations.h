// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "lodestone/io/meshes/mesh_file.h"
#include "lodestone/io/motion/animation.h"
#include "lodestone/mesh/errors.h"
#include "support/temporary_folder.h"

namespace lodestone::test {

/// Tests of a reader of animations with files that are damaged.
class Damaged_animations : public testing::Test {
 protected:
  /// Reads the file and its first and last frame. Anything but success and a typed error of one line is a failure.
  void read_all(const std::filesystem::path& file) {
    try {
      const auto animation = read_animation(file);
      std::vector<Point> positions(animation.vertices);
      for (const std::size_t frame : {std::size_t{0}, animation.motion.frames - 1})
        animation.motion.pose(frame, positions);
      EXPECT_TRUE(mesh_of(positions, animation.faces, file.string()).mesh.is_valid(false));
      ++good;
    } catch (const Error& error) {
      const std::string message = error.what();
      EXPECT_TRUE(message.starts_with(file.string())) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      EXPECT_EQ(message.find("tinygltf"), std::string::npos) << "the guard has not seen it: " << message;
      ++bad;
    }
  }

  Temporary_folder folder;
  std::size_t good = 0, bad = 0;
};

}  // namespace lodestone::test
