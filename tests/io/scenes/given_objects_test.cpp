// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/scenes/given_objects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string>
#include <vector>

#include "lodestone/io/results/animation_output.h"
#include "lodestone/mesh/errors.h"
#include "support/gltf_samples.h"
#include "support/mesh_samples.h"
#include "support/moving_mesh_files.h"
#include "support/read_file.h"
#include "support/scene_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

class Given_objects : public testing::Test {
 protected:
  std::filesystem::path path(const std::string& name) const { return folder.path() / name; }
  void write_sequence(int frames) const {
    for (int frame = 0; frame < frames; ++frame)
      folder.write("s_" + std::to_string(frame) + ".off", tetrahedron_off(frame));
  }
  static Point first_vertex(Scene_object& object, std::size_t frame) {
    pose(object, frame);
    return object.mesh.point(Surface_mesh::Vertex_index(0));
  }
  std::filesystem::path write_cached_mover(float start) const;

  Temporary_folder folder;
};

TEST_F(Given_objects, a_scene_is_as_long_as_the_longest_motion_and_shorter_ones_hold_their_last_pose) {
  write_sequence(5);
  folder.write("t1.off", tetrahedron_off(10));
  folder.write("t2.off", tetrahedron_off(11));
  folder.write("still.off", tetrahedron_off());
  const std::vector<std::filesystem::path> inputs{path("s_*.off"), path("t#.off"), path("still.off")};
  Scene scene = scene_of(inputs);
  EXPECT_EQ(scene.frames, 5U);
  for (std::size_t frame = 0; frame < 5; ++frame) {
    EXPECT_EQ(first_vertex(scene.objects[0], frame), Point(double(frame), 0, 0));
    EXPECT_EQ(first_vertex(scene.objects[1], frame), Point(frame == 0 ? 10 : 11, 0, 0));
    EXPECT_EQ(first_vertex(scene.objects[2], frame), Point(0, 0, 0));
  }
}

TEST_F(Given_objects, are_named_after_their_files) {
  write_sequence(2);
  folder.write("a.off", tetrahedron_off());
  folder.write("a.obj", square_obj);
  folder.write("12.off", tetrahedron_off());
  const std::vector<std::filesystem::path> inputs{path("s_*.off"), path("a.off"), path("a.obj"), path("##.off")};
  const auto scene = scene_of(inputs);
  std::vector<std::string> names;
  for (const auto& object : scene.objects) names.push_back(object.name);
  EXPECT_EQ(names, (std::vector<std::string>{"s", "a", "a_2", "sequence"}));
}

TEST_F(Given_objects, names_that_are_no_utf8_differ_in_json_too) {
  const std::vector<std::filesystem::path> inputs{folder.write("a\xff.off", tetrahedron_off()),
                                                  folder.write("a\xfe.off", tetrahedron_off())};
  const auto scene = scene_of(inputs);
  EXPECT_EQ(scene.objects[0].name, "a\uFFFD");
  EXPECT_EQ(scene.objects[1].name, "a\uFFFD_2");
}

/// A tetrahedron that moves along x by 10 in a second, with a key per frame.
void write_mover(const std::filesystem::path& file, std::size_t frames_per_second) {
  Animation animation{.kind = "test", .vertices = 4, .faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  animation.motion.frames = frames_per_second + 1;
  animation.motion.pose = [frames_per_second](std::size_t frame, std::span<Point> positions) {
    const double x = 10 * static_cast<double>(frame) / static_cast<double>(frames_per_second);
    const Point corners[]{{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}, {x, 0, 1}};
    std::ranges::copy(corners, positions.begin());
  };
  write_animation(file, animation, {.frames_per_second = static_cast<double>(frames_per_second)});
}

TEST_F(Given_objects, gltf_files_of_different_rates_run_by_one_clock) {
  write_mover(path("fast.glb"), 60);
  write_mover(path("slow.glb"), 24);
  EXPECT_EQ(scene_of(std::vector{path("fast.glb")}).frames, 61U);
  EXPECT_EQ(scene_of(std::vector{path("slow.glb"), path("slow.glb")}).frames, 25U);
  folder.write("both.json", R"({"objects": [
      {"name": "fast", "mesh": "fast.glb", "motion": {"gltf": "fast.glb"}, "place": {"translate": [0, 0, 0]}},
      {"name": "slow", "mesh": "slow.glb", "motion": {"gltf": "slow.glb"}}]})");
  for (Scene scene : {scene_of(std::vector{path("fast.glb"), path("slow.glb")}), read_scene(path("both.json"))}) {
    EXPECT_EQ(scene.frames, 31U);
    for (std::size_t frame = 0; frame < scene.frames; ++frame)
      for (auto& object : scene.objects)
        EXPECT_NEAR(first_vertex(object, frame).x(), 10 * static_cast<double>(frame) / 30, 1e-4);
  }
}

/// A square whose x is 10 t at these times t.
std::string moving_square(std::initializer_list<double> times) {
  Gltf_sample sample = square_gltf();
  std::string positions;
  for (const double t : times) positions += packed<float>({10 * t, 0, 0});
  const auto values = sample.add_accessor(
      {{"bufferView", sample.add_view(positions)}, {"componentType", 5126}, {"count", times.size()}, {"type", "VEC3"}});
  sample.animate(0, "translation", sample.add_numbers(times), values);
  return sample.glb();
}

TEST_F(Given_objects, gltf_files_of_one_rate_that_start_at_different_times_run_from_time_0_on) {
  folder.write("early.glb", moving_square({0, 0.1, 0.2, 0.3}));
  folder.write("late.glb", moving_square({0.2, 0.3}));
  EXPECT_EQ(scene_of(std::vector{path("late.glb")}).frames, 2U);
  Scene scene = scene_of(std::vector{path("early.glb"), path("late.glb")});
  EXPECT_EQ(scene.frames, 4U);
  const double early[]{0, 1, 2, 3}, late[]{2, 2, 2, 3};
  for (std::size_t frame = 0; frame < scene.frames; ++frame) {
    EXPECT_NEAR(first_vertex(scene.objects[0], frame).x(), early[frame], 1e-4);
    EXPECT_NEAR(first_vertex(scene.objects[1], frame).x(), late[frame], 1e-4);
  }
}

/// Moves the times of the 25 frames of an MDD file, 32-bit numbers with the highest byte first.
void start_later(const std::filesystem::path& file, float seconds) {
  auto bytes = read_bytes(file);
  for (std::size_t frame = 0; frame < 25; ++frame) {
    char* const at = bytes.data() + 8 + 4 * frame;
    float time = 0;
    std::reverse_copy(at, at + 4, reinterpret_cast<char*>(&time));
    time += seconds;
    std::reverse_copy(reinterpret_cast<char*>(&time), reinterpret_cast<char*>(&time) + 4, at);
  }
  std::ofstream(file, std::ios::binary) << bytes;
}

/// The mover at 24 frames per second as a mesh with an MDD cache that starts at this time.
std::filesystem::path Given_objects::write_cached_mover(float start) const {
  folder.write("slow.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  write_mover(path("slow.mdd"), 24);
  start_later(path("slow.mdd"), start);
  return path("slow.off").string() + "+" + path("slow.mdd").string();
}

TEST_F(Given_objects, gltf_follows_the_rate_of_an_mdd_cache) {
  write_mover(path("fast.glb"), 60);
  write_mover(path("slow.glb"), 24);
  const auto cache = write_cached_mover(0);
  Scene scene = scene_of(std::vector{path("fast.glb"), cache});
  EXPECT_EQ(scene.frames, 25U);
  for (std::size_t frame = 0; frame < scene.frames; ++frame)
    for (auto& object : scene.objects)
      EXPECT_NEAR(first_vertex(object, frame).x(), 10 * static_cast<double>(frame) / 24, 1e-4);

  // The times in the cache are rounded. Frames of the same rate stay those of the file.
  Scene alone = scene_of(std::vector{path("slow.glb")}), beside = scene_of(std::vector{path("slow.glb"), cache});
  ASSERT_EQ(beside.frames, alone.frames);
  EXPECT_TRUE(beside.objects[0].motion.resampled) << "it has not been sampled again";
  for (std::size_t frame = 0; frame < alone.frames; ++frame)
    EXPECT_EQ(first_vertex(beside.objects[0], frame), first_vertex(alone.objects[0], frame));
}

TEST_F(Given_objects, gltf_begins_when_an_mdd_cache_begins) {
  write_mover(path("fast.glb"), 60);
  for (const float start : {0.25F, -0.25F}) {
    SCOPED_TRACE(start);
    const auto cache = write_cached_mover(start);
    Scene scene = scene_of(std::vector{path("fast.glb"), cache});
    EXPECT_EQ(scene.objects[0].motion.frames, start > 0 ? 19U : 31U) << "of 0.75 or 1.25 seconds";
    EXPECT_EQ(scene.frames, start > 0 ? 25U : 31U);
    for (std::size_t frame = 0; frame < 25; ++frame) {
      const double seconds = static_cast<double>(frame) / 24;
      EXPECT_NEAR(first_vertex(scene.objects[0], frame).x(), 10 * std::clamp(start + seconds, 0.0, 1.0), 1e-4);
      EXPECT_NEAR(first_vertex(scene.objects[1], frame).x(), 10 * seconds, 1e-4);
    }
  }
}

TEST_F(Given_objects, gltf_follows_the_rate_that_a_scene_gives_another) {
  write_mover(path("fast.glb"), 60);
  write_mover(path("slow.glb"), 24);
  folder.write("given.json", R"({"objects": [
      {"name": "fast", "mesh": "fast.glb", "motion": {"gltf": {"file": "fast.glb", "frames_per_second": 10}}},
      {"name": "slow", "mesh": "slow.glb", "motion": {"gltf": "slow.glb"}}]})");
  Scene scene = read_scene(path("given.json"));
  EXPECT_EQ(scene.frames, 11U);
  for (auto& object : scene.objects) EXPECT_NEAR(first_vertex(object, 7).x(), 7, 1e-4);
}

TEST_F(Given_objects, an_object_of_a_scene_plays_no_longer_than_the_scene) {
  write_mover(path("slow.glb"), 24);
  folder.write("short.json",
               R"({"frames": 5, "objects": [{"name": "a", "mesh": "slow.glb", "motion": {"gltf": "slow.glb"}}]})");
  EXPECT_EQ(scene_of(std::vector<std::filesystem::path>{path("short.json").string() + "#a"}).frames, 5U);
}

TEST_F(Given_objects, gltf_plays_its_first_animation) {
  folder.write("a.glb", rich_gltf().glb());
  EXPECT_EQ(scene_of(std::vector{path("a.glb")}).frames, 61U);
}

TEST_F(Given_objects, a_mesh_is_joined_to_its_point_cache_by_a_plus) {
  folder.write("a.off", square_off);
  folder.write("a.pc2", std::string("POINTCACHE2\0", 12) + packed<std::int32_t>({1, 4}) + packed<float>({0, 1}) +
                            packed<std::int32_t>({2}) + packed<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) +
                            packed<float>({7, 0, 0, 8, 0, 0, 8, 1, 0, 7, 1, 0}));
  Scene scene = scene_of(std::vector{path("a.off+") += path("a.pc2")});
  EXPECT_EQ(scene.frames, 2U);
  EXPECT_EQ(scene.objects[0].name, "a");
  EXPECT_EQ(first_vertex(scene.objects[0], 1), Point(7, 0, 0));
  EXPECT_THROW(scene_of(std::vector{path("a.pc2")}), Bad_argument);
}

TEST_F(Given_objects, a_mesh_is_joined_to_its_point_cache_in_folders_and_files_with_a_plus_in_their_names) {
  const auto inner = path("c++");
  create_directory(inner);
  write_moving_tetrahedron(inner / "a+b", 2);
  const Scene scene = scene_of(std::vector<std::filesystem::path>{inner / ("a+b.off+" + (inner / "a+b.pc2").string())});
  EXPECT_EQ(scene.frames, 2U);
  EXPECT_EQ(scene.objects[0].name, "a+b");
}

TEST_F(Given_objects, a_file_whose_name_has_a_plus_is_that_file) {
  folder.write("a+b.off", square_off);
  EXPECT_EQ(scene_of(std::vector{path("a+b.off")}).objects[0].name, "a+b");
}

TEST_F(Given_objects, an_object_of_a_scene_becomes_an_animation_of_its_file) {
  folder.write("a.obj", "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 2 3 4 5\n");
  const auto scene = read(folder, R"({"frames": 3, "objects": [{"name": "a", "mesh": "a.obj", "motion": {"deform":
      [{"travel": {"path": "linear", "way_points": [{"frame": 0, "at": [0, 0, 0]},
        {"frame": 2, "at": [4, 0, 0]}]}}]}}]})");
  const auto animation = animation_of(scene.objects[0], scene.frames);
  EXPECT_EQ(animation.motion.frames, 3U);
  EXPECT_EQ(animation.vertices, 5U);
  EXPECT_EQ(animation.faces, (std::vector<Corners>{{1, 2, 3}, {1, 3, 4}}));
  EXPECT_EQ(animation.file_face, (std::vector<std::uint32_t>{0, 0}));
  std::vector<Point> positions(5);
  animation.motion.pose(1, positions);
  EXPECT_EQ(positions[1], Point(2, 0, 0));
}

TEST_F(Given_objects, shapes_are_given_by_name_or_as_in_a_scene) {
  EXPECT_EQ(shape_object("teapot").mesh.number_of_faces(), 5680U);
  EXPECT_EQ(shape_object(R"({"icosphere": {"frequency": 3}})").mesh.number_of_faces(), 180U);
  for (const auto* wrong : {"icosphere", "kettle", "{", ""}) EXPECT_THROW(shape_object(wrong), Bad_scene) << wrong;
}

TEST_F(Given_objects, a_scene_may_name_files_outside_its_folder_if_allowed) {
  create_directory(path("scenes"));
  folder.write("a.off", tetrahedron_off());
  const auto file = folder.write("scenes/scene.json", R"({"objects": [{"name": "a", "mesh": "../a.off"}]})");
  EXPECT_THROW(read_scene(file), Bad_scene);
  EXPECT_EQ(read_scene(file, {.allow_outside = true}).objects.size(), 1U);
}

}  // namespace
}  // namespace lodestone::test
