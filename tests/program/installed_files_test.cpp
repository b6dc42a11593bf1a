// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/installed_files.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "lodestone/version.h"
#include "program/run_program.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

namespace fs = std::filesystem;

TEST(Nearest_above, is_the_nearest_of_several_and_empty_where_there_is_none) {
  const Temporary_folder folder;
  const fs::path root = folder.path();
  create_directories(root / "usr/bin/deep");
  create_directories(root / "share/files");
  EXPECT_EQ(nearest_above(root / "usr/bin/deep", "share/files"), root / "share/files");
  create_directories(root / "usr/share/files");
  EXPECT_EQ(nearest_above(root / "usr/bin/deep", "share/files"), root / "usr/share/files");
  create_directories(root / "usr/bin/deep/share/files");
  EXPECT_EQ(nearest_above(root / "usr/bin/deep", "share/files"), root / "usr/bin/deep/share/files");
  EXPECT_EQ(nearest_above(root / "usr/bin/deep", "share/no_such_files"), fs::path());
  EXPECT_EQ(nearest_above("/proc/self", "proc"), fs::path()) << "the root is left out";
}

TEST(Installed_files, of_a_build_folder_are_those_of_the_source) {
  EXPECT_TRUE(equivalent(installed_files() / "scenes", LODESTONE_DATA "/scenes"));
  EXPECT_TRUE(equivalent(installed_files() / "characters", LODESTONE_DATA "/characters"));
  EXPECT_TRUE(is_directory(installed_files() / "experiments" / "volumes" / "plots"));
}

TEST(Installed_files, the_environment_names_another_folder) {
  ASSERT_EQ(::setenv("LODESTONE_FILES", "/another/folder", 1), 0);
  EXPECT_EQ(installed_files(), "/another/folder");
  ASSERT_EQ(::setenv("LODESTONE_FILES", "", 1), 0);
  EXPECT_NE(installed_files(), "");
  ASSERT_EQ(::unsetenv("LODESTONE_FILES"), 0);
}

TEST(Version, the_program_and_the_library_tell_that_of_the_headers) {
  EXPECT_EQ(version(), LODESTONE_VERSION_TEXT);
  EXPECT_EQ(run_program({"--version"}).out, "lodestone " LODESTONE_VERSION_TEXT "\n");
  EXPECT_EQ(std::string(LODESTONE_VERSION_TEXT), std::to_string(LODESTONE_VERSION_MAJOR) + "." +
                                                     std::to_string(LODESTONE_VERSION_MINOR) + "." +
                                                     std::to_string(LODESTONE_VERSION_PATCH));
  EXPECT_EQ(LODESTONE_VERSION / 10000, LODESTONE_VERSION_MAJOR);
  EXPECT_EQ(LODESTONE_VERSION / 100 % 100, LODESTONE_VERSION_MINOR);
  EXPECT_EQ(LODESTONE_VERSION % 100, LODESTONE_VERSION_PATCH);
}

}  // namespace
}  // namespace lodestone::test
