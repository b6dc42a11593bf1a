// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "lodestone/io/scenes/given_objects.h"
#include "lodestone/io/scenes/scene_file.h"
#include "lodestone/mesh/errors.h"
#include "support/scene_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

class Scene_groups : public testing::Test {
 protected:
  Scene_groups() { folder.write("a.off", tetrahedron_off()); }

  /// A scene of objects named 0, 1, 2 and so on, with these keys.
  Scene scene(const std::vector<std::string>& keys, const std::string& more = "") const {
    std::string objects;
    for (std::size_t o = 0; o < keys.size(); ++o)
      objects += fmt::format(R"({}{{"name": "{}", "mesh": "a.off"{}{}}})", o == 0 ? "" : ", ", o,
                             keys[o].empty() ? "" : ", ", keys[o]);
    return read(folder, R"({"objects": [)" + objects + "]" + more + "}");
  }
  /// All pairs, of an object and itself too, that are not ignored.
  static std::set<std::string> pairs(const Scene& scene) {
    std::set<std::string> found;
    for (std::uint32_t a = 0; a < scene.objects.size(); ++a)
      for (std::uint32_t b = a; b < scene.objects.size(); ++b)
        if (!scene.ignores({a, b})) found.insert(fmt::format("{}-{}", a, b));
    return found;
  }
  std::string error_of(const std::vector<std::string>& keys) const {
    try {
      scene(keys);
    } catch (const Bad_scene& error) {
      return std::string(error.what()).substr(folder.path().string().size() + 1);
    }
    return "no error";
  }

  Temporary_folder folder;
};

TEST_F(Scene_groups, by_default_all_objects_meet) {
  EXPECT_EQ(pairs(scene({"", ""})), (std::set<std::string>{"0-0", "0-1", "1-1"}));
}

TEST_F(Scene_groups, two_objects_meet_if_both_agree) {
  const auto cloth = R"("groups": ["cloth"], "meets": ["body"])", body = R"("groups": ["body"], "meets": ["cloth"])";
  EXPECT_EQ(pairs(scene({cloth, body, body})), (std::set<std::string>{"0-1", "0-2"}));
  EXPECT_EQ(pairs(scene({cloth, R"("groups": ["body"], "meets": ["body"])"})), (std::set<std::string>{"1-1"}));
}

TEST_F(Scene_groups, an_object_can_be_in_several_groups) {
  EXPECT_EQ(pairs(scene({R"("groups": ["x", "y"], "meets": ["z"])", R"("groups": ["z"], "meets": ["y"])",
                         R"("groups": ["z"], "meets": ["x"])"})),
            (std::set<std::string>{"0-1", "0-2"}));
}

TEST_F(Scene_groups, objects_without_a_group_are_in_the_group_default) {
  EXPECT_EQ(pairs(scene({"", R"("groups": ["x"], "meets": ["default"])", R"("groups": ["x"], "meets": ["x"])"})),
            (std::set<std::string>{"0-0", "0-1", "2-2"}));
}

TEST_F(Scene_groups, an_object_that_meets_nothing_is_left_out) {
  EXPECT_EQ(pairs(scene({R"("meets": [])", "", ""})), (std::set<std::string>{"1-1", "1-2", "2-2"}));
}

TEST_F(Scene_groups, ignored_pairs_are_left_out_too) {
  EXPECT_EQ(pairs(scene({"", "", R"("meets": [])"}, R"(, "ignore": [["0", "1"]])")),
            (std::set<std::string>{"0-0", "1-1"}));
}

TEST_F(Scene_groups, up_to_32_have_names) {
  std::vector<std::string> keys;
  for (int group = 0; group < 32; ++group)
    keys.push_back(fmt::format(R"("groups": ["g{0}"], "meets": ["g{0}"])", group));
  auto expected = std::set<std::string>();
  for (int group = 0; group < 32; ++group) expected.insert(fmt::format("{0}-{0}", group));
  EXPECT_EQ(pairs(scene(keys)), expected);
  keys.emplace_back(R"("groups": ["g0", "more"])");
  EXPECT_TRUE(error_of(keys).starts_with(R"(scene.json: /objects/32/groups/1: group "more" is one too many: )"))
      << error_of(keys);
  keys.back() = "";
  EXPECT_TRUE(error_of(keys).starts_with(R"(scene.json: /objects/32: group "default" is one too many: )"))
      << error_of(keys);
}

TEST_F(Scene_groups, to_meet_must_have_an_object) {
  EXPECT_EQ(error_of({R"("groups": ["x"], "meets": ["x", "y"])"}),
            R"(scene.json: /objects/0/meets/1: there is no group "y": no object has it in its "groups")");
  EXPECT_EQ(error_of({R"("groups": ["x"], "meets": ["default"])"}).substr(0, 59),
            R"(scene.json: /objects/0/meets/0: there is no group "default")");
  EXPECT_EQ(error_of({R"("groups": [])"}), "scene.json: /objects/0/groups: is empty");
  EXPECT_EQ(error_of({R"("groups": "x")"}), "scene.json: /objects/0/groups: expected an array, found string");
}

TEST_F(Scene_groups, are_dropped_with_the_scene_of_an_object) {
  scene({R"("groups": ["x"], "meets": [])", R"("groups": ["y"], "meets": [])"});
  const auto file = (folder.path() / "scene.json").string();
  EXPECT_EQ(pairs(scene_of(std::vector<std::filesystem::path>{file + "#0", file + "#1"})).count("0-1"), 1U);
}

}  // namespace
}  // namespace lodestone::test
