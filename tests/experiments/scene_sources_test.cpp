// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/scene_sources.h"

#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "lodestone/mesh/errors.h"
#include "support/message_of.h"
#include "support/moving_mesh_files.h"
#include "support/scene_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

class Scene_sources : public testing::Test {
 protected:
  /// A subfolder for the files of one scene.
  std::filesystem::path subfolder(const std::string& name) const {
    auto path = folder.path() / name;
    create_directories(path);
    return path;
  }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& source : scene_sources(folder.path())) names.push_back(name_of_source(source));
    return names;
  }

  Temporary_folder folder;
};

TEST_F(Scene_sources, are_scene_files_and_folders_of_point_caches_in_the_order_of_their_names) {
  folder.write("c.json", "{}");
  folder.write("a.json", "{}");
  folder.write("readme.txt", "");
  write_moving_tetrahedron(subfolder("b") / "left", 2);
  EXPECT_EQ(names(), (std::vector<std::string>{"a", "b", "c"}));
}

TEST_F(Scene_sources, are_found_by_name_be_they_files_or_folders) {
  folder.write("a.json", "{}");
  folder.write("c.json", "{}");
  write_moving_tetrahedron(subfolder("b") / "left", 2);
  EXPECT_EQ(named_sources(folder.path(), std::vector<std::string>{"c", "b"}),
            (std::vector{folder.path() / "c.json", folder.path() / "b"}));
  EXPECT_EQ(message_of<Bad_scene>([&] { named_sources(folder.path(), std::vector<std::string>{"d"}); }),
            folder.path().string() + ": there is no scene d; the scenes are a, b, c");
}

TEST_F(Scene_sources, a_subfolder_with_a_scene_file_is_not_searched) {
  folder.write("a.json", "{}");
  write_moving_tetrahedron(subfolder("b") / "left", 2);
  folder.write("b/scene.json", "{}");
  EXPECT_EQ(names(), std::vector<std::string>{"a"});
}

TEST_F(Scene_sources, a_subfolder_without_a_mesh_that_has_a_point_cache_of_its_name_is_skipped) {
  folder.write("a.json", "{}");
  write_moving_tetrahedron(subfolder("b") / "left", 2);
  rename(folder.path() / "b/left.pc2", folder.path() / "b/right.pc2");
  write_moving_tetrahedron(subfolder("deep/er") / "left", 2);
  EXPECT_EQ(names(), std::vector<std::string>{"a"});
}

TEST_F(Scene_sources, a_folder_of_point_caches_is_a_scene_with_its_name_and_an_object_per_mesh) {
  const auto walk = subfolder("walk");
  write_moving_tetrahedron(walk / "right", 3);
  write_moving_tetrahedron(walk / "left", 2);
  folder.write("walk/floor.off", tetrahedron_off());
  const Scene scene = read_source(walk);
  EXPECT_EQ(scene.name, "walk");
  EXPECT_EQ(scene.frames, 3U);
  ASSERT_EQ(scene.objects.size(), 3U);
  EXPECT_EQ(scene.objects[0].name, "floor");
  EXPECT_EQ(scene.objects[1].name, "left");
  EXPECT_EQ(scene.objects[2].name, "right");
}

TEST_F(Scene_sources, meshes_without_a_point_cache_do_not_move) {
  const auto walk = subfolder("walk");
  write_moving_tetrahedron(walk / "moving", 3, 0, 1);
  folder.write("walk/still.off", tetrahedron_off(7));
  Scene scene = read_source(walk);
  ASSERT_EQ(scene.objects.size(), 2U);
  for (std::size_t frame = 0; frame < scene.frames; ++frame)
    for (auto& object : scene.objects) {
      pose(object, frame);
      const double x = object.name == "moving" ? static_cast<double>(frame) : 7;
      EXPECT_EQ(CGAL::Polygon_mesh_processing::bbox(object.mesh), CGAL::Bbox_3(x, 0, 0, x + 1, 1, 1)) << object.name;
    }
}

TEST_F(Scene_sources, subfolders_with_meshes_that_are_not_played_are_named) {
  folder.write("a.json", "{}");
  write_moving_tetrahedron(subfolder("played") / "left", 2);
  EXPECT_EQ(note_of_unplayed_subfolders(folder.path()), "");
  subfolder("figures"), subfolder("still"), subfolder("objs"), subfolder("beside");
  folder.write("figures/figures.json", "{}");
  folder.write("still/floor.off", tetrahedron_off());
  folder.write("objs/walk.OBJ", "");
  folder.write("beside/scene.json", "{}");
  folder.write("beside/left.off", tetrahedron_off());
  EXPECT_TRUE(
      note_of_unplayed_subfolders(folder.path()).starts_with("Not played: the meshes in beside, objs, still. "));
  remove(folder.path() / "a.json"), remove_all(folder.path() / "played");
  const auto message = message_of<Bad_scene>([&] { scene_sources(folder.path()); });
  EXPECT_NE(message.find("NAME.pc2. Not played: the meshes in beside, objs, still. "), std::string::npos) << message;
}

TEST_F(Scene_sources, a_scene_file_is_read_with_the_name_that_it_gives) {
  const auto file = folder.write("a.json", R"({"name": "dance", "objects": [{"name": "x", "shape": {"teapot": {}}}]})");
  EXPECT_EQ(read_source(file).name, "dance");
}

TEST_F(Scene_sources, components_of_an_only_object_are_objects) {
  const auto walk = subfolder("walk");
  write_two_tetrahedra_in_one_mesh(walk / "pair", 3);
  const Scene scene = read_source(walk);
  EXPECT_EQ(scene.frames, 3U);
  ASSERT_EQ(scene.objects.size(), 2U);
  EXPECT_EQ(scene.objects[0].name, "pair_1");
  EXPECT_EQ(scene.objects[1].name, "pair_2");
}

TEST_F(Scene_sources, components_stay_together_beside_another_object_or_where_the_object_does_not_meet_itself) {
  const auto walk = subfolder("walk");
  write_two_tetrahedra_in_one_mesh(walk / "pair", 3);
  write_moving_tetrahedron(walk / "other", 3);
  EXPECT_EQ(read_source(walk).objects.size(), 2U);
  const std::string pair = R"("objects": [{"name": "x", "mesh": "walk/pair.off"}])";
  EXPECT_EQ(read_source(folder.write("two.json", "{" + pair + "}")).objects.size(), 2U);
  EXPECT_EQ(read_source(folder.write("one.json", "{" + pair + R"(, "ignore": [["x", "x"]]})")).objects.size(), 1U);
}

TEST_F(Scene_sources, a_folder_without_scenes_is_refused_by_name) {
  subfolder("empty");
  for (const auto& path : {folder.path(), folder.path() / "missing"}) {
    try {
      scene_sources(path);
      ADD_FAILURE() << path;
    } catch (const Bad_scene& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(path.string() + ": ")) << error.what();
    }
  }
}

}  // namespace
}  // namespace lodestone::test
