// SPDX-License-Identifier: GPL-3.0-or-later
// What readers take at most: the options decide, to the last byte, face, frame and object.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "lodestone/io/meshes/mesh_file.h"
#include "lodestone/io/motion/animation.h"
#include "lodestone/io/motion/motion.h"
#include "lodestone/io/scenes/given_objects.h"
#include "lodestone/io/scenes/scene_file.h"
#include "lodestone/io/scenes/separated_objects.h"
#include "lodestone/mesh/errors.h"
#include "support/gltf_samples.h"
#include "support/mesh_samples.h"
#include "support/message_of.h"
#include "support/moving_mesh_files.h"
#include "support/scene_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

class Input_limits : public testing::Test {
 protected:
  /// A scene of tetrahedra.
  std::filesystem::path write_scene(int objects, const std::string& keys = "") const {
    folder.write("a.off", tetrahedron_off());
    std::string list;
    for (int i = 0; i < objects; ++i)
      list += (i > 0 ? ", " : "") + (R"({"name": "o)" + std::to_string(i)) + R"(", "mesh": "a.off"})";
    return folder.write("scene.json", "{" + keys + R"("objects": [)" + list + "]}");
  }

  Temporary_folder folder;
};

TEST_F(Input_limits, are_those_of_the_bytes_of_a_mesh_file) {
  const auto glb = square_gltf().glb();
  const std::vector<std::filesystem::path> files{
      folder.write("a.off", square_off), folder.write("a.obj", square_obj), folder.write("b.stl", square_binary_stl()),
      folder.write("a.gltf", square_gltf().gltf()), folder.write("a.glb", glb)};
  for (const auto& file : files) {
    SCOPED_TRACE(file);
    const std::uintmax_t bytes = std::filesystem::file_size(file);
    EXPECT_NO_THROW(read_mesh(file, {.max_bytes = bytes}));
    EXPECT_EQ(message_of<Bad_mesh>([&] { read_mesh(file, {.max_bytes = bytes - 1}); }),
              file.string() + ": the file has " + std::to_string(bytes) + " bytes, where at most " +
                  std::to_string(bytes - 1) + " are allowed");
    EXPECT_THROW(read_animation(file, {.limits = {.max_bytes = bytes - 1}}), Bad_mesh);
  }
}

TEST_F(Input_limits, are_those_of_the_buffers_of_a_gltf_file_together) {
  const auto sample = square_gltf();
  folder.write("a.bin", sample.bytes + std::string(5000, ' '));
  auto document = nlohmann::json::parse(sample.gltf("a.bin"));
  document["buffers"].push_back({{"byteLength", 4000}, {"uri", "a.bin"}});
  const auto file = folder.write("a.gltf", document.dump());
  const std::uintmax_t together = sample.bytes.size() + 4000;
  ASSERT_LT(std::filesystem::file_size(file), together);
  EXPECT_NO_THROW(read_mesh(file, {.max_bytes = together}));
  const auto message = message_of<Bad_mesh>([&] { read_mesh(file, {.max_bytes = together - 1}); });
  EXPECT_TRUE(message.ends_with("/buffers/1: the buffers up to this one have " + std::to_string(together) +
                                " bytes together, where at most " + std::to_string(together - 1) + " are allowed"))
      << message;
}

TEST_F(Input_limits, are_those_of_the_frames_of_an_animation) {
  auto sample = square_gltf();
  sample.animate(0, "translation", sample.add_numbers({0, 0.1, 0.2, 0.3}),
                 sample.add_points({0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0}));
  const auto file = folder.write("a.glb", sample.glb());
  EXPECT_EQ(read_animation(file, {.limits = {.max_frames = 4}}).motion.frames, 4U);
  EXPECT_EQ(message_of<Bad_motion>([&] { read_animation(file, {.limits = {.max_frames = 3}}); }),
            file.string() + ": 4 frames, where at most 3 are allowed");
  EXPECT_EQ(read_animation(file, {.frames_per_second = 20, .limits = {.max_frames = 7}}).motion.frames, 7U);
  EXPECT_THROW(read_animation(file, {.frames_per_second = 20, .limits = {.max_frames = 6}}), Bad_motion);
  // A rate that is chosen later has the same limits.
  const auto motion = read_gltf_motion(file, 4, {.limits = {.max_frames = 6}});
  EXPECT_NO_THROW(motion.resampled(10, 0));
  EXPECT_THROW(motion.resampled(20, 0), Bad_motion);

  std::vector<std::filesystem::path> files;
  for (int i = 0; i < 3; ++i) files.push_back(folder.write("s_" + std::to_string(i) + ".off", tetrahedron_off(i)));
  EXPECT_EQ(read_mesh_sequence(files, 4, {.max_frames = 3}).frames, 3U);
  EXPECT_EQ(message_of<Bad_motion>([&] { read_mesh_sequence(files, 4, {.max_frames = 2}); }),
            files[0].string() + ": 3 frames, where at most 2 are allowed");
}

TEST_F(Input_limits, are_those_of_the_frames_of_a_scene) {
  const auto scene = write_scene(1, R"("frames": 12, )");
  EXPECT_EQ(read_scene(scene, {.limits = {.max_frames = 12}}).frames, 12U);
  EXPECT_EQ(message_of<Bad_scene>([&] { read_scene(scene, {.limits = {.max_frames = 11}}); }),
            scene.string() + ": /frames: 12 is not a whole number from 1 to 11");
  for (int i = 0; i < 3; ++i) folder.write("s_" + std::to_string(i) + ".off", tetrahedron_off(i));
  for (const std::string sequence :
       {R"("s_#.off")", R"(["s_0.off", "s_1.off", "s_2.off"])", R"({"pattern": "s_#.off", "first": 0, "last": 2})"}) {
    SCOPED_TRACE(sequence);
    const auto moving =
        folder.write("moving.json", with_object(R"("mesh": "s_0.off", "motion": {"sequence": )" + sequence + "}"));
    EXPECT_EQ(read_scene(moving, {.limits = {.max_frames = 3}}).frames, 3U);
    EXPECT_ANY_THROW(read_scene(moving, {.limits = {.max_frames = 2}}));
  }
}

TEST_F(Input_limits, are_those_of_the_frames_of_a_point_cache) {
  write_moving_tetrahedron(folder.path() / "a", 5);
  const auto cache = folder.path() / "a.pc2";
  const std::filesystem::path moving = (folder.path() / "a.off").string() + "+" + cache.string();
  const auto scene = folder.write("cached.json", with_object(R"("mesh": "a.off", "motion": {"pc2": "a.pc2"})"));
  EXPECT_EQ(read_animation(moving, {.limits = {.max_frames = 5}}).motion.frames, 5U);
  EXPECT_EQ(read_scene(scene, {.limits = {.max_frames = 5}}).frames, 5U);
  EXPECT_EQ(message_of<Bad_motion>([&] { read_animation(cache, {.limits = {.max_frames = 4}}); }),
            cache.string() + ": 5 frames, where at most 4 are allowed");
  EXPECT_THROW(scene_of(std::vector{moving}, {.limits = {.max_frames = 4}}), Bad_motion);
  EXPECT_EQ(message_of<Bad_scene>([&] { read_scene(scene, {.limits = {.max_frames = 4}}); }),
            scene.string() + ": /: the shortest motion has 5 frames, where at most 4 are allowed");
}

TEST_F(Input_limits, are_those_of_the_objects_of_a_scene) {
  const auto file = write_scene(3);
  EXPECT_EQ(read_scene(file, {.max_objects = 3}).objects.size(), 3U);
  const auto message = message_of<Bad_scene>([&] { read_scene(file, {.max_objects = 2}); });
  EXPECT_NE(message.find("/objects"), std::string::npos) << message;
  EXPECT_NE(message.find('2'), std::string::npos) << message;

  const auto two = folder.write("two.off", "OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n5 0 0\n6 0 0\n5 1 0\n3 0 1 2\n3 3 4 5\n");
  auto scene = scene_of(std::vector{two});
  EXPECT_EQ(message_of<Bad_scene>([&] { separate(scene, Separate::components, 1); }),
            "two: 2 connected components; expected at most 1. Vertices that coincide connect no faces before they are "
            "welded, as by lodestone convert --weld 0, if no frame moves them apart");
  separate(scene, Separate::components, 2);
  EXPECT_EQ(scene.objects.size(), 2U);

  EXPECT_EQ(scene_of(std::vector{two, two}, {.max_objects = 2}).objects.size(), 2U);
  EXPECT_EQ(message_of<Bad_scene>([&] {
              scene_of(std::vector{two, two}, {.max_objects = 1});
            }),
            "2 inputs, where at most 1 objects are allowed");
}

TEST_F(Input_limits, are_those_of_the_faces_of_all_objects_together) {
  const auto file = write_scene(3);  // of four faces each
  EXPECT_NO_THROW(read_scene(file, {.max_scene_faces = 12}));
  EXPECT_EQ(message_of<Bad_scene>([&] { read_scene(file, {.max_scene_faces = 11}); }),
            file.string() +
                ": /objects/2: the objects up to this one have 12 faces together, where at most 11 are "
                "allowed");
  const auto a = folder.path() / "a.off";
  EXPECT_NO_THROW(scene_of(std::vector{a, a}, {.max_scene_faces = 8}));
  EXPECT_EQ(message_of<Bad_scene>([&] {
              scene_of(std::vector{a, a}, {.max_scene_faces = 7});
            }),
            a.string() + ": the objects up to this one have 8 faces together, where at most 7 are allowed");
}

}  // namespace
}  // namespace lodestone::test
