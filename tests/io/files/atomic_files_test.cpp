// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/files/atomic_files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "lodestone/io/files/atomic_file.h"
#include "lodestone/mesh/errors.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

namespace fs = std::filesystem;

class Atomic_files_test : public testing::Test {
 protected:
  static void write(Atomic_file file, const std::string& text) {
    file.write(text);
    file.commit();
  }
  std::set<std::string> visible() const {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
      if (entry.is_regular_file() && entry.path().string().find("/.new.") == std::string::npos)
        names.insert(fs::relative(entry.path(), folder.path()).string());
    return names;
  }
  std::string text_of(const std::string& name) const {
    std::string text;
    std::getline(std::ifstream(folder.path() / name), text);
    return text;
  }

  Temporary_folder folder;
};

TEST_F(Atomic_files_test, appear_together_and_replace_existing_files) {
  write(Atomic_file(folder.path() / "a"), "old");
  {
    Atomic_files files(folder.path());
    write(files.open("a"), "new");
    write(files.open("frames/b"), "b");
    EXPECT_EQ(visible(), std::set<std::string>{"a"});
    EXPECT_EQ(text_of("a"), "old");
    files.commit();
  }
  EXPECT_EQ(visible(), (std::set<std::string>{"a", "frames/b"}));
  EXPECT_EQ(text_of("a"), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 2);
}

TEST_F(Atomic_files_test, leave_nothing_behind_without_commit) {
  {
    Atomic_files files(folder.path());
    write(files.open("frames/b"), "b");
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST_F(Atomic_files_test, two_sets_in_one_folder_do_not_interfere) {
  Atomic_files first(folder.path()), second(folder.path());
  write(first.open("a"), "first");
  write(second.open("a"), "second");
  second.commit();
  EXPECT_EQ(text_of("a"), "second");
  first.commit();
  EXPECT_EQ(text_of("a"), "first");
}

TEST_F(Atomic_files_test, are_refused_in_an_impossible_folder_or_over_anything_but_a_file) {
  EXPECT_THROW(Atomic_files(folder.write("file", "") / "inner"), Bad_output);
  fs::create_directories(folder.path() / "a" / "b");
  Atomic_files files(folder.path());
  EXPECT_THROW(files.open("a"), Bad_output);
  EXPECT_EQ(::mkfifo((folder.path() / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(files.open("pipe"), Bad_output);
}

TEST_F(Atomic_files_test, that_are_not_committed_leave_no_folder_that_they_made) {
  {
    Atomic_files files(folder.path() / "a" / "b");
    write(files.open("one"), "1");
  }
  EXPECT_FALSE(exists(folder.path() / "a"));
}

TEST_F(Atomic_files_test, in_a_folder_that_cannot_be_made_leave_none_of_its_parents) {
  EXPECT_THROW(Atomic_files(folder.path() / "a" / "b" / std::string(300, 'n') / "c"), Bad_output);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST_F(Atomic_files_test, that_killed_runs_have_left_are_named_where_they_are_in_the_way) {
  const auto hidden = [&](int number) {
    return folder.path() / (".new." + std::to_string(::getpid()) + "." + std::to_string(number));
  };
  for (int number = 0; number < 99; ++number) fs::create_directory(hidden(number));
  EXPECT_NO_THROW(Atomic_files(folder.path()));
  fs::create_directory(hidden(99));
  EXPECT_NE(message_of<Bad_output>([&] { Atomic_files(folder.path()); }).find("remove them"), std::string::npos);
}

}  // namespace
}  // namespace lodestone::test
