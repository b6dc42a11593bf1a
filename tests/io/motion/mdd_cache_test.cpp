// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "io/motion/point_cache_files.h"
#include "lodestone/io/motion/motion.h"
#include "lodestone/io/motion/point_cache.h"
#include "lodestone/mesh/errors.h"

namespace lodestone::test {
namespace {

std::string big_floats(std::initializer_list<double> values) { return packed<float>(values, std::endian::big); }

std::string mdd_header(double frames, double points) {
  return packed<std::int32_t>({frames, points}, std::endian::big);
}

/// Two vertices, three frames at 25 per second; at frame t they are (t, 0, 0) and (0, t, -t).
std::string mdd_of_three_frames() {
  auto bytes = mdd_header(3, 2) + big_floats({0, 0.04, 0.08});
  for (const double t : {0, 1, 2}) bytes += big_floats({t, 0, 0, 0, t, -t});
  return bytes;
}

class Mdd_cache : public Point_cache_files {
 protected:
  Mdd_cache() : Point_cache_files(read_mdd_cache, ".mdd") {}
};

TEST_F(Mdd_cache, gives_each_frame_in_any_order) { expect_three_frames(mdd_of_three_frames()); }

TEST_F(Mdd_cache, starts_at_its_first_time) {
  const auto file =
      folder.write("a.mdd", mdd_header(3, 1) + big_floats({2, 2.5, 3}) + big_floats({0, 0, 0, 1, 1, 1, 2, 2, 2}));
  EXPECT_EQ(read_point_cache_header(file).start, 2);
  EXPECT_EQ(read_mdd_cache(file, 1).start, 2);
  EXPECT_EQ(read_mdd_cache(file, 1).frames_per_second, 2);
}

TEST_F(Mdd_cache, header_gives_counts_and_rate) {
  const auto cache = read_point_cache_header(folder.write("a.MDD", mdd_of_three_frames()));
  EXPECT_EQ(cache.format, Cache_format::mdd);
  EXPECT_EQ(cache.vertices, 2U);
  EXPECT_EQ(cache.frames, 3U);
  EXPECT_NEAR(cache.frames_per_second, 25, 1e-5);
  EXPECT_THROW(read_point_cache_header(folder.write("a.mdc", mdd_of_three_frames())), Bad_motion);
}

TEST_F(Mdd_cache, refuses_a_frame_past_the_end_and_a_wrong_number_of_vertices) {
  const auto motion = read_mdd_cache(folder.write("a.mdd", mdd_of_three_frames()), 2);
  std::vector<Point> positions(2);
  EXPECT_THROW(motion.pose(3, positions), Bad_motion);
  positions.pop_back();
  EXPECT_THROW(motion.pose(0, positions), Bad_motion);
  expect_error(mdd_of_three_frames(), 3, ": byte 4: the cache has 2 vertices, expected 3");
}

TEST_F(Mdd_cache, names_frame_and_vertex_of_a_non_finite_coordinate) {
  for (const double wrong : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    expect_error(mdd_header(1, 2) + big_floats({0, 0, 0, 0, 0, wrong, 0}), 2, ": frame 0, vertex 1 (counted from 0): ");
}

TEST_F(Mdd_cache, refuses_counts_below_one) {
  expect_error(mdd_header(0, 2), 2, ": byte 0: the cache has 0 frames, expected 1 or more");
  expect_error(mdd_header(-3, 2), 2, ": byte 0: the cache has -3 frames, expected 1 or more");
  expect_error(mdd_header(3, -2), 2, ": byte 4: the cache has -2 vertices, expected 1 or more");
}

TEST_F(Mdd_cache, refuses_a_file_whose_length_contradicts_its_header) {
  const auto whole = mdd_of_three_frames();
  for (std::size_t length = 0; length < whole.size(); ++length) expect_error(whole.substr(0, length), 2, ":");
  expect_error(whole.substr(0, 8), 2, ": 3 frames are announced, but the file ends within their times");
  expect_error(whole.substr(0, whole.size() - 1), 2, ": 3 frames of 2 vertices are announced, but the file ends");
  expect_error(whole + 'x', 2, ": 3 frames of 2 vertices take 92 bytes, the file has 93: this is not an MDD");
}

TEST_F(Mdd_cache, refuses_counts_whose_product_overflows) {
  const double most = std::numeric_limits<std::int32_t>::max();
  const auto file = folder.write("huge.mdd", mdd_header(1, most) + big_floats({0, 0, 0}));
  EXPECT_THROW(read_mdd_cache(file, static_cast<std::size_t>(most)), Bad_motion);
  expect_error(mdd_header(most, most) + big_floats({0, 0, 0}), 2, ": 2147483647 frames are announced, but");
}

TEST_F(Mdd_cache, a_pc2_cache_under_another_name_is_refused) {
  expect_error(std::string("POINTCACHE2\0", 12) + packed<std::int32_t>({1, 2, 0, 0, 1}) + std::string(24, '\0'), 2,
               ": 1347373390 frames are announced");
}

TEST_F(Mdd_cache, refuses_a_missing_file_and_one_that_shrinks_while_in_use) {
  EXPECT_THROW(read_mdd_cache(folder.path() / "none.mdd", 2), Bad_motion);
  EXPECT_THROW(read_mdd_cache(folder.path(), 2), Bad_motion);
  const auto file = folder.write("a.mdd", mdd_of_three_frames());
  const auto motion = read_mdd_cache(file, 2);
  resize_file(file, 40);
  std::vector<Point> positions(2);
  EXPECT_THROW(motion.pose(2, positions), Bad_motion);
}

}  // namespace
}  // namespace lodestone::test
