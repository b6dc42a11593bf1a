// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "lodestone/io/motion/animation.h"
#include "support/gltf_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {

/// The vertices of `square_gltf`.
inline const std::vector<Point> square_points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

inline void expect_near(const std::vector<Point>& found, const std::vector<Point>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t v = 0; v < found.size(); ++v)
    EXPECT_LT(std::sqrt(CGAL::squared_distance(found[v], expected[v])), 1e-6) << v << ": " << found[v];
}

/// The square moved by a function.
template <class Move>
std::vector<Point> moved(const Move& move) {
  std::vector<Point> points;
  for (const Point& p : square_points) points.push_back(move(p.x(), p.y(), p.z()));
  return points;
}

/// Writes glTF files and reads where their vertices are.
class Gltf : public testing::Test {
 protected:
  std::filesystem::path write(const Gltf_sample& sample) const { return folder.write("a.glb", sample.glb()); }
  /// All vertices at this time, at ten frames per second.
  std::vector<Point> at(const Gltf_sample& sample, double seconds) const {
    const auto animation = read_animation(write(sample), {.frames_per_second = 10});
    std::vector<Point> positions(animation.vertices);
    animation.motion.pose(static_cast<std::size_t>(std::lround(seconds * 10)), positions);
    return positions;
  }
  std::vector<Point> at_rest(const Gltf_sample& sample) const { return at(sample, 0); }

  Temporary_folder folder;
};

}  // namespace lodestone::test
