// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lodestone/io/files/numbered_files.h"
#include "lodestone/mesh/errors.h"
#include "support/mesh_samples.h"
#include "support/scene_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

using Names = std::vector<std::string>;

class Numbered_files : public testing::Test {
 protected:
  void make(const Names& names) const {
    for (const auto& name : names) folder.write(name, square_off);
  }
  Names find(const std::string& pattern) const {
    Names names;
    for (const auto& file : find_numbered_files(folder.path() / pattern)) {
      EXPECT_EQ(file.parent_path(), folder.path());
      names.push_back(file.filename().string());
    }
    return names;
  }
  void expect_error(const std::string& pattern, const std::string& part) const {
    try {
      find(pattern);
      ADD_FAILURE() << "expected " << part;
    } catch (const Bad_motion& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }

  Temporary_folder folder;
};

TEST_F(Numbered_files, are_found_in_the_order_of_their_numbers) {
  make({"f10.off", "f9.off", "f8.off", "f11.off"});
  EXPECT_EQ(find("f*.off"), (Names{"f8.off", "f9.off", "f10.off", "f11.off"}));
}

TEST_F(Numbered_files, may_have_leading_zeros) {
  make({"f0008.off", "f0010.off", "f0009.off"});
  EXPECT_EQ(find("f*.off"), (Names{"f0008.off", "f0009.off", "f0010.off"}));
  EXPECT_EQ(find("f####.off"), find("f*.off"));
}

TEST_F(Numbered_files, of_a_run_of_marks_have_that_many_digits_or_more_without_leading_zeros) {
  make({"f99.off", "f100.off", "f0099.off", "f098.off", "f98.off"});
  EXPECT_EQ(find("f##.off"), (Names{"f98.off", "f99.off", "f100.off"}));
}

TEST_F(Numbered_files, names_without_a_number_are_skipped) {
  make({"f1.off", "f2.off", "frest.off", "f.off", "f3.obj", "f-3.off", "g5.off", "f1_.off", "f 3.off"});
  EXPECT_EQ(find("f*.off"), (Names{"f1.off", "f2.off"}));
}

TEST_F(Numbered_files, missing_files_are_named) {
  make({"f1.off", "f2.off", "f4.off"});
  expect_error("f*.off", (folder.path() / "f3.off").string() + ": there is no such file, but f2.off and f4.off exist");
  make({"g0099.off", "g0102.off"});
  expect_error("g*.off", "g0100.off: there is no such file");
  expect_error("g*.off", "list the files in a scene, as its `motion.sequence`");
  expect_error("h*.off", "h*.off: no file matches this");
  expect_error("none/h*.off", "none: the folder cannot be read");
}

TEST_F(Numbered_files, names_without_a_number_are_explained_if_there_are_no_others) {
  make({"f_b.off", "f_a.off"});
  expect_error("f_*.off", "f_*.off: no file matches this; * stands for a whole number, which f_a.off does not have");
  make({"g7.off"});
  expect_error("g##.off",
               "; ## stands for a whole number of 2 digits, with zeros in front, which g7.off does not have");
}

TEST_F(Numbered_files, two_files_with_one_number_and_a_number_too_large_are_refused) {
  make({"f1.off", "f01.off"});
  expect_error("f*.off", "f1.off: has the same number as f01.off");
  make({"g1234567890123456789.off"});
  expect_error("g*.off", "the number in the file's name is too large");
  make({"h0000000000000000000000000007.off"});
  EXPECT_EQ(find("h*.off").size(), 1U);
}

TEST_F(Numbered_files, need_exactly_one_mark_in_the_name) {
  for (const auto* pattern : {"f.off", "f*_*.off", "f#_#.off", "f*#.off", "f**.off", "f#*.off", "*/f.off", ""}) {
    EXPECT_THROW(find_numbered_files(folder.path() / pattern), Bad_argument) << pattern;
  }
  EXPECT_TRUE(is_pattern("a/f*.off"));
  EXPECT_TRUE(is_pattern("f##.off"));
  EXPECT_FALSE(is_pattern("a*/f.off"));
}

TEST_F(Numbered_files, names_that_match_are_all_that_have_a_number) {
  make({"f1.off", "f01.off", "f7.off", "f.off", "fa.off", "f1.obj"});
  EXPECT_EQ(names_that_match(folder.path() / "f*.off"), (Names{"f01.off", "f1.off", "f7.off"}));
  EXPECT_EQ(names_that_match(folder.path() / "f##.off"), Names{"f01.off"});
  EXPECT_EQ(names_that_match(folder.path() / "none/f*.off"), Names{});
  EXPECT_THROW(names_that_match(folder.path() / "f.off"), Bad_argument);
}

TEST_F(Numbered_files, get_their_names_for_writing_from_the_pattern) {
  EXPECT_EQ(numbered_file("a/f####.off", 7), "a/f0007.off");
  EXPECT_EQ(numbered_file("a/f####.off", 123456), "a/f123456.off");
  EXPECT_EQ(numbered_file("f*.off", 12), "f12.off");
}

TEST_F(Numbered_files, can_be_the_motion_of_a_scene) {
  make({"mesh.off", "f9.off", "f10.off"});
  Scene scene = read(folder, with_object(R"("mesh": "mesh.off", "motion": {"sequence": "f*.off"})"));
  EXPECT_EQ(scene.frames, 2U);
  for (const std::size_t frame : {0, 1}) EXPECT_NO_THROW(pose(scene.objects[0], frame));
}

TEST_F(Numbered_files, of_a_scene_stay_in_its_folder) {
  const Temporary_folder other;
  other.write("f1.off", square_off);
  make({"mesh.off", "f0.off"});
  create_symlink(other.path() / "f1.off", folder.path() / "f1.off");
  create_directory_symlink(other.path(), folder.path() / "link");
  for (const std::string pattern : {"f*.off", "link/f*.off", "../f*.off"})
    EXPECT_THROW(read(folder, with_object(R"("mesh": "mesh.off", "motion": {"sequence": ")" + pattern + "\"}")),
                 Bad_scene)
        << pattern;
}

}  // namespace
}  // namespace lodestone::test
