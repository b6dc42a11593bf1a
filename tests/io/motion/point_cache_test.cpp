// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "io/motion/point_cache_files.h"
#include "lodestone/io/motion/motion.h"
#include "lodestone/mesh/errors.h"

namespace lodestone::test {
namespace {

std::string pc2_header(double points, double samples, double version = 1) {
  return std::string("POINTCACHE2\0", 12) + packed<std::int32_t>({version, points}) + packed<float>({0, 1}) +
         packed<std::int32_t>({samples});
}

/// Two vertices, three frames; at frame t they are (t, 0, 0) and (0, t, -t).
std::string pc2_of_three_frames() {
  auto bytes = pc2_header(2, 3);
  for (const double t : {0, 1, 2}) bytes += packed<float>({t, 0, 0, 0, t, -t});
  return bytes;
}

class Point_cache : public Point_cache_files {
 protected:
  Point_cache() : Point_cache_files(read_point_cache, ".pc2") {}
};

TEST_F(Point_cache, gives_each_frame_in_any_order) { expect_three_frames(pc2_of_three_frames()); }

TEST_F(Point_cache, refuses_a_frame_past_the_end) {
  const auto motion = read_point_cache(folder.write("a.pc2", pc2_of_three_frames()), 2);
  std::vector<Point> positions(2);
  EXPECT_THROW(motion.pose(3, positions), Bad_motion);
}

TEST_F(Point_cache, refuses_to_write_to_a_wrong_number_of_positions) {
  const auto motion = read_point_cache(folder.write("a.pc2", pc2_of_three_frames()), 2);
  std::vector<Point> positions(1);
  EXPECT_THROW(motion.pose(0, positions), Bad_motion);
}

TEST_F(Point_cache, names_frame_and_vertex_of_a_non_finite_coordinate) {
  for (const double wrong : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    expect_error(pc2_header(2, 1) + packed<float>({0, 0, 0, 0, wrong, 0}), 2, ": frame 0, vertex 1 (counted from 0): ");
}

TEST_F(Point_cache, reads_valid_frames_before_a_broken_one) {
  const auto bytes = pc2_header(1, 2) + packed<float>({1, 2, 3, std::numeric_limits<double>::quiet_NaN(), 0, 0});
  const auto motion = read_point_cache(folder.write("a.pc2", bytes), 1);
  std::vector<Point> positions(1);
  motion.pose(0, positions);
  EXPECT_EQ(positions[0], Point(1, 2, 3));
  EXPECT_THROW(motion.pose(1, positions), Bad_motion);
}

TEST_F(Point_cache, refuses_a_wrong_number_of_vertices) {
  expect_error(pc2_of_three_frames(), 3, ": byte 16: the cache has 2 vertices, expected 3");
  expect_error(pc2_header(0, 3), 0, ": byte 16: the cache has 0 vertices, expected 1 or more");
}

TEST_F(Point_cache, refuses_negative_counts_and_no_frames) {
  expect_error(pc2_header(-2, 3), 2, ": byte 16: the cache has -2 vertices, expected 1 or more");
  expect_error(pc2_header(2, -3), 2, ": byte 28: the cache has -3 frames, expected 1 or more");
  expect_error(pc2_header(2, 0), 2, ": byte 28: the cache has 0 frames, expected 1 or more");
}

TEST_F(Point_cache, refuses_a_file_shorter_than_its_header_says) {
  auto bytes = pc2_of_three_frames();
  bytes.pop_back();
  expect_error(bytes, 2, ": 3 frames of 2 vertices are announced, but the file ends within frame 2 (counted from 0)");
}

TEST_F(Point_cache, refuses_counts_whose_product_overflows) {
  const double most = std::numeric_limits<std::int32_t>::max();
  const auto file = folder.write("huge.pc2", pc2_header(most, most) + packed<float>({0, 0, 0}));
  EXPECT_THROW(read_point_cache(file, static_cast<std::size_t>(most)), Bad_motion);
}

TEST_F(Point_cache, refuses_truncated_headers_and_other_files) {
  expect_error("", 2, ": byte 0: the file ends within the header");
  expect_error(pc2_of_three_frames().substr(0, 31), 2, ": byte 31: the file ends within the header");
  expect_error(std::string(100, 'x'), 2, ": byte 0: expected 'POINTCACHE2'");
  expect_error(pc2_header(2, 3, 2), 2, ": byte 12: expected version 1, found 2");
}

TEST_F(Point_cache, refuses_a_missing_file_and_a_folder) {
  EXPECT_THROW(read_point_cache(folder.path() / "none.pc2", 2), Bad_motion);
  EXPECT_THROW(read_point_cache(folder.path(), 2), Bad_motion);
}

TEST_F(Point_cache, notices_a_file_that_shrinks_while_in_use) {
  const auto file = folder.write("a.pc2", pc2_of_three_frames());
  const auto motion = read_point_cache(file, 2);
  resize_file(file, 40);
  std::vector<Point> positions(2);
  EXPECT_THROW(motion.pose(2, positions), Bad_motion);
}

}  // namespace
}  // namespace lodestone::test
