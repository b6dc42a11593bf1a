// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/results/animation_output.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "lodestone/io/motion/point_cache.h"
#include "lodestone/mesh/errors.h"
#include "support/mesh_samples.h"
#include "support/read_file.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

namespace fs = std::filesystem;

/// The position of a vertex of the square in a frame; not exactly representable as float.
Point place(std::size_t vertex, std::size_t frame) {
  const auto v = static_cast<double>(vertex), t = static_cast<double>(frame);
  return {v / 3 + t, std::sin(v + t), t * t / 7 - v};
}

/// The square with a fifth vertex that no face uses, for five frames.
Animation moving_square() {
  Animation animation{.kind = "test", .vertices = 5, .faces = {{0, 1, 2}, {0, 2, 3}}};
  animation.motion = {.frames = 5, .pose = [](std::size_t frame, std::span<Point> positions) {
                        for (std::size_t v = 0; v < positions.size(); ++v) positions[v] = place(v, frame);
                      }};
  return animation;
}

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

class Animation_output : public testing::Test {
 protected:
  /// The output must contain these frames of the square.
  void expect_frames(const Animation& found, const std::vector<std::size_t>& frames, double tolerance) const {
    ASSERT_EQ(found.motion.frames, frames.size());
    ASSERT_EQ(found.vertices, 5U);
    std::vector<Point> positions(5);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      found.motion.pose(i, positions);
      for (std::size_t v = 0; v < 5; ++v)
        EXPECT_LE(std::sqrt(CGAL::squared_distance(positions[v], place(v, frames[i]))), tolerance) << i << " " << v;
    }
  }

  Temporary_folder folder;
  Animation square = moving_square();
};

TEST_F(Animation_output, point_caches_are_read_back) {
  for (const std::string name : {"a.pc2", "a.mdd"}) {
    write_animation(folder.path() / name, square, {.frames_per_second = 24});
    const auto found = read_animation(folder.path() / name);
    expect_frames(found, {0, 1, 2, 3, 4}, 1e-6);
    EXPECT_TRUE(found.faces.empty());
  }
  EXPECT_NEAR(read_point_cache_header(folder.path() / "a.mdd").frames_per_second, 24, 1e-4);
}

TEST_F(Animation_output, numbered_mesh_files_are_read_back_digit_for_digit) {
  for (const std::string extension : {".off", ".obj", ".ply"}) {
    write_animation(folder.path() / "out" / ("f###" + extension), square, {.frames = {4, 2}});
    const auto found = read_animation(folder.path() / "out" / ("f*" + extension));
    expect_frames(found, {4, 2}, 0);
    EXPECT_EQ(found.faces, square.faces);
    EXPECT_TRUE(exists(folder.path() / "out" / ("f001" + extension)));
    EXPECT_FALSE(exists(folder.path() / "out" / ("f002" + extension)));
  }
}

TEST_F(Animation_output, one_frame_may_be_one_mesh_file) {
  write_animation(folder.path() / "a.ply", square, {.frames = {3}});
  expect_frames(read_animation(folder.path() / "a.ply"), {3}, 0);
  EXPECT_THROW(write_animation(folder.path() / "b.ply", square), Bad_argument);
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>{"a.ply"});
}

TEST_F(Animation_output, gltf_is_read_back_with_its_faces) {
  for (const std::string name : {"a b.gltf", "a.glb"}) {
    write_animation(folder.path() / name, square, {.frames_per_second = 24});
    const auto found = read_animation(folder.path() / name, {.frames_per_second = 24});
    expect_frames(found, {0, 1, 2, 3, 4}, 2e-6);
    EXPECT_EQ(found.faces, square.faces);
  }
  EXPECT_EQ(names_in(folder.path()), (std::set<std::string>{"a b.gltf", "a b.bin", "a.glb"}));
  // Twice as many frames: those in between lie halfway.
  const auto finer = read_animation(folder.path() / "a.glb", {.frames_per_second = 48});
  EXPECT_EQ(finer.motion.frames, 9U);
  std::vector<Point> positions(5);
  finer.motion.pose(3, positions);
  EXPECT_LT(CGAL::squared_distance(positions[2], CGAL::midpoint(place(2, 1), place(2, 2))), 1e-10);
}

TEST_F(Animation_output, gltf_is_read_back_frame_by_frame_at_any_rate) {
  for (const double rate : {12.5, 24.0, 24000.0 / 1001, 25.0, 30.0, 60.0, 120.0, 8.0})
    for (const std::size_t frames : {2U, 3U, 5U, 97U, 1000U}) {
      SCOPED_TRACE(testing::Message() << rate << " " << frames);
      square.motion.frames = frames;
      write_animation(folder.path() / "a.glb", square, {.frames_per_second = rate});
      const auto found = read_animation(folder.path() / "a.glb");
      EXPECT_NEAR(found.frames_per_second, rate, 1e-5 * rate);
      std::vector<std::size_t> all(frames);
      std::iota(all.begin(), all.end(), 0U);
      expect_frames(found, all, 2e-6 + 1e-7 * static_cast<double>(frames * frames));
    }
}

TEST_F(Animation_output, gltf_is_read_back_frame_by_frame_wherever_it_starts_or_refused) {
  std::size_t refused = 0, read = 0;
  for (const double start : {0.0, 4.2, 8.4, 100.7, 3600.1, 5000.1, 20000.1, 40000.0, 3e5})
    for (const double rate : {5.0, 12.5, 24.0, 29.97, 48.0, 60.0, 144.0, 240.0})
      for (const std::size_t frames : {2U, 3U, 10U, 50U}) {
        SCOPED_TRACE(testing::Message() << start << " " << rate << " " << frames);
        square.motion.frames = frames;
        const auto last = static_cast<float>(start + static_cast<double>(frames) / rate);
        const double step_of_floats = std::nextafter(last, 1e9F) - last;
        try {
          write_animation(folder.path() / "a.glb", square, {.frames_per_second = rate, .start = start});
        } catch (const Bad_argument&) {
          EXPECT_GT(step_of_floats * rate, 0.2);
          ++refused;
          continue;
        }
        const auto found = read_animation(folder.path() / "a.glb");
        EXPECT_EQ(found.motion.frames, frames);
        const auto seconds = [frames](double of_rate) { return static_cast<double>(frames - 1) / of_rate; };
        EXPECT_NEAR(seconds(found.frames_per_second), seconds(rate), 2 * step_of_floats + 1e-5 * seconds(rate));
        std::vector<std::size_t> all(frames);
        std::iota(all.begin(), all.end(), 0U);
        expect_frames(found, all, 2e-6 + 1e-7 * static_cast<double>(frames * frames));
        ++read;
      }
  EXPECT_GT(refused, 8U);
  EXPECT_GT(read, 100U);
}

TEST_F(Animation_output, point_caches_come_back_through_gltf_with_the_same_frames_and_rate) {
  for (const std::string cache : {"a.mdd", "a.pc2"})
    for (const double rate : {12.5, 24.0, 25.0, 60.0}) {
      SCOPED_TRACE(cache + " " + std::to_string(rate));
      write_animation(folder.path() / cache, square, {.frames_per_second = rate});
      auto read = read_animation(folder.path() / cache);
      read.faces = square.faces;
      const double own = read.frames_per_second > 0 ? read.frames_per_second : rate;
      write_animation(folder.path() / "b.gltf", read, {.frames_per_second = own});
      const auto through = read_animation(folder.path() / "b.gltf");
      write_animation(folder.path() / "c.mdd", through, {.frames_per_second = through.frames_per_second});
      const auto back = read_animation(folder.path() / "c.mdd");
      expect_frames(back, {0, 1, 2, 3, 4}, 4e-6);
      EXPECT_NEAR(back.frames_per_second, rate, 1e-5 * rate);
    }
}

TEST_F(Animation_output, gltf_of_one_frame_is_read_back_as_one_frame) {
  write_animation(folder.path() / "a.glb", square, {.frames = {2}});
  expect_frames(read_animation(folder.path() / "a.glb"), {2}, 1e-6);
}

TEST_F(Animation_output, gltf_refers_only_to_what_it_holds) {
  write_animation(folder.path() / "a.gltf", square, {.regions = {0, 0, 1, 1, 2}});
  const auto json = read_json(folder.path() / "a.gltf");
  const auto expect_one_of = [&json](const char* list, const nlohmann::json& index) {
    EXPECT_LT(index.get<std::size_t>(), json.at(list).size()) << list;
  };
  const auto& primitive = json["meshes"][0]["primitives"][0];
  expect_one_of("materials", primitive["material"]);
  expect_one_of("accessors", primitive["indices"]);
  for (const auto& attribute : primitive["attributes"]) expect_one_of("accessors", attribute);
  for (const auto& target : primitive["targets"]) expect_one_of("accessors", target["POSITION"]);
  for (const auto& accessor : json["accessors"]) expect_one_of("bufferViews", accessor["bufferView"]);
  for (const auto& view : json["bufferViews"]) expect_one_of("buffers", view["buffer"]);
  for (const auto& sampler : json["animations"][0]["samplers"]) {
    expect_one_of("accessors", sampler["input"]);
    expect_one_of("accessors", sampler["output"]);
  }
  expect_one_of("nodes", json["animations"][0]["channels"][0]["target"]["node"]);
  expect_one_of("nodes", json["scenes"][0]["nodes"][0]);
  expect_one_of("meshes", json["nodes"][0]["mesh"]);
  expect_one_of("scenes", json["scene"]);
}

/// Readers store offsets within a view as 32-bit numbers, which the frames of a long animation exceed together.
TEST_F(Animation_output, gltf_has_no_offsets_within_views) {
  write_animation(folder.path() / "a.gltf", square, {.regions = {0, 0, 1, 1, 2}});
  const auto json = read_json(folder.path() / "a.gltf");
  EXPECT_EQ(json["accessors"].size(), 9U) << "corners, five frames, colours, times, weights";
  EXPECT_EQ(json["bufferViews"].size(), json["accessors"].size());
  for (const auto& accessor : json["accessors"]) EXPECT_EQ(accessor.value("byteOffset", 0), 0) << accessor;
}

TEST_F(Animation_output, gltf_tells_the_ranges_of_its_numbers) {
  write_animation(folder.path() / "a.gltf", square);
  const auto json = read_json(folder.path() / "a.gltf");
  const std::string bytes = read_bytes(folder.path() / "a.bin");
  std::size_t told = 0;
  for (const auto& accessor : json["accessors"]) {
    if (!accessor.contains("min")) continue;
    const auto width = accessor["min"].size(), count = accessor["count"].get<std::size_t>();
    const auto& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    const auto at = view.value("byteOffset", std::size_t{0}) + accessor.value("byteOffset", std::size_t{0});
    std::vector<float> numbers(width * count);
    ASSERT_LE(at + 4 * numbers.size(), bytes.size());
    std::memcpy(numbers.data(), bytes.data() + at, 4 * numbers.size());
    for (std::size_t axis = 0; axis < width; ++axis) {
      float least = numbers[axis], most = numbers[axis];
      for (std::size_t i = axis; i < numbers.size(); i += width)
        least = std::min(least, numbers[i]), most = std::max(most, numbers[i]);
      EXPECT_EQ(accessor["min"][axis].get<float>(), least);
      EXPECT_EQ(accessor["max"][axis].get<float>(), most);
    }
    ++told;
  }
  EXPECT_EQ(told, 5 + 1U);  // the positions of each frame, and the times
}

TEST_F(Animation_output, gltf_shows_regions_as_colours) {
  write_animation(folder.path() / "a.gltf", square, {.regions = {0, 0, 1, 1, 2}});
  const auto json = read_json(folder.path() / "a.gltf");
  const auto& colours =
      json["accessors"][json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"].get<std::size_t>()];
  EXPECT_EQ(colours["count"], 5);
  EXPECT_EQ(colours["componentType"], 5121);
  const auto at = json["bufferViews"][colours["bufferView"].get<std::size_t>()]["byteOffset"].get<std::size_t>();
  const std::string bytes = read_bytes(folder.path() / "a.bin");
  const auto colour = [&](std::size_t v) { return bytes.substr(at + 4 * v, 4); };
  EXPECT_EQ(colour(0), colour(1));
  EXPECT_EQ(colour(2), colour(3));
  EXPECT_NE(colour(1), colour(2));
  EXPECT_NE(colour(3), colour(4));
  EXPECT_EQ(colour(4), "\x63\xe2\x0c\xff") << "linear light of the sRGB colour 167, 242, 61";
  expect_frames(read_animation(folder.path() / "a.gltf"), {0, 1, 2, 3, 4}, 2e-6);
  EXPECT_THROW(write_animation(folder.path() / "b.glb", square, {.regions = {0}}), Bad_argument);
}

TEST_F(Animation_output, a_failed_output_leaves_no_file) {
  const fs::path out = folder.path() / "out";
  auto broken = square;
  broken.motion.pose = [pose = square.motion.pose](std::size_t frame, std::span<Point> positions) {
    pose(frame, positions);
    if (frame == 3) throw Bad_motion("broken");
  };
  auto large = square;
  large.motion.pose = [pose = square.motion.pose](std::size_t frame, std::span<Point> positions) {
    pose(frame, positions);
    if (frame == 3) positions[1] = Point(1e39, 0, 0);
  };
  for (const std::string name : {"a.pc2", "a.mdd", "a.gltf", "a.glb", "f#.off"})
    EXPECT_THROW(write_animation(out / name, broken), Bad_motion) << name;
  for (const std::string name : {"a.pc2", "a.mdd", "a.gltf", "a.glb"})
    EXPECT_THROW(write_animation(out / name, large), Bad_motion) << name;
  auto faceless = square;
  faceless.faces.clear();
  for (const std::string name : {"a.gltf", "a.glb", "f#.off"})
    EXPECT_THROW(write_animation(out / name, faceless), Bad_argument) << name;
  auto long_one = square;
  long_one.motion.frames = 2049;
  EXPECT_THROW(write_animation(out / "a.glb", long_one), Bad_argument);
  for (const std::string name : {"a.stl", "a", "a.json", "f#_#.off"})
    EXPECT_THROW(write_animation(out / name, square), Bad_argument) << name;
  for (const double rate : {0.0, -1.0, std::numeric_limits<double>::infinity()})
    EXPECT_THROW(write_animation(out / "a.mdd", square, {.frames_per_second = rate}), Bad_argument);
  if (exists(out)) {
    EXPECT_EQ(names_in(out), std::set<std::string>{});
  }
}

TEST_F(Animation_output, refuses_frames_that_are_too_small_for_floats) {
  auto small = square;
  small.motion.pose = [pose = square.motion.pose](std::size_t frame, std::span<Point> positions) {
    pose(frame, positions);
    if (frame == 2)
      for (Point& p : positions) p = Point(1e-300 * p.x(), 1e-300 * p.y(), 1e-300 * p.z());
  };
  for (const std::string name : {"a.pc2", "a.mdd", "a.gltf", "a.glb", "f#.stl"})
    EXPECT_THROW(write_animation(folder.path() / name, small), Bad_motion) << name;
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>{});
  EXPECT_NO_THROW(write_animation(folder.path() / "f#.ply", small));
}

TEST_F(Animation_output, a_name_can_be_meant_literally) {
  const auto file = folder.path() / "what#1*.off";
  EXPECT_THROW(write_animation(file, square, {.frames = {0}}), Bad_argument);
  write_animation(file, square, {.frames = {1}, .numbered = false});
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>{"what#1*.off"});
  expect_frames(read_animation(file), {1}, 0);
  EXPECT_THROW(write_animation(file, square, {.numbered = false}), Bad_argument);
}

TEST_F(Animation_output, can_be_abandoned_between_frames) {
  struct Enough {};
  for (const std::string name : {"a.pc2", "a.glb", "a.gltf", "f#.obj"}) {
    std::size_t calls = 0;
    EXPECT_THROW(write_animation(folder.path() / name, square,
                                 {.progress =
                                      [&](std::size_t done, std::size_t of) {
                                        EXPECT_LT(done, of);
                                        if (++calls == 3) throw Enough();
                                      }}),
                 Enough);
    EXPECT_EQ(names_in(folder.path()), std::set<std::string>{}) << name;
  }
}

}  // namespace
}  // namespace lodestone::test
