// SPDX-License-Identifier: GPL-3.0-or-later
// The unit of the coordinates does not matter.
#include <gtest/gtest.h>

#include <cmath>

#include "detection/detector_scenes.h"
#include "lodestone/detector.h"

namespace lodestone {
namespace {

constexpr int frames = 12;

/// Face pairs of a moving and growing scene in each frame, with all coordinates multiplied by `factor`.
std::vector<std::vector<Face_pair>> contacts(Mode mode, double factor) {
  Owned_meshes source{potato(20), potato(20, 2), sphere(14, 0.6, {0.4, 1.6, 0.3})};
  shift(source[1], 1.9, 0.2, 0.1);
  Owned_meshes scene = source;
  Detector<> detector({.mode = mode, .particles = 16, .contacts = Contact_query::all});
  add_all(detector, scene);
  std::vector<std::vector<Face_pair>> found;
  for (int frame = 0; frame < frames; ++frame) {
    for (std::size_t i = 0; i < scene.size(); ++i)
      for (const auto v : scene[i].vertices()) {
        const Point& p = source[i].point(v);
        const double growth = 1 + 0.05 * frame * std::sin(3 * p.x() + static_cast<double>(i));
        const double x = growth * p.x() - (i == 1 ? 0.05 * frame : 0), y = growth * p.y(), z = growth * p.z();
        scene[i].point(v) = Point(factor * x, factor * y, factor * z);
      }
    detector.update();
    found.push_back(detector.detect().face_pairs);
  }
  return found;
}

class Units : public testing::TestWithParam<Mode> {};

TEST_P(Units, powers_of_two_change_nothing) {
  const auto expected = contacts(GetParam(), 1);
  std::size_t count = 0;
  for (const auto& frame : expected) count += frame.size();
  EXPECT_GT(count, 100U);
  for (const double factor : {0x1p-300, 0x1p-30, 0x1p-1, 0x1p1, 0x1p40, 0x1p300})
    EXPECT_EQ(contacts(GetParam(), factor), expected) << factor;
}

INSTANTIATE_TEST_SUITE_P(modes, Units, testing::Values(Mode::particles, Mode::senin, Mode::exact),
                         [](const auto& mode) { return std::string(name_of(mode.param)); });

}  // namespace
}  // namespace lodestone
