// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "lodestone/io/files/atomic_file.h"
#include "lodestone/io/files/atomic_files.h"
#include "lodestone/mesh/errors.h"
#include "support/read_file.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

std::ptrdiff_t files_in(const std::filesystem::path& folder) {
  using Iterator = std::filesystem::directory_iterator;
  return std::distance(Iterator(folder), Iterator());
}

/// Creating the file must fail with a one-line message that begins with `path`.
void expect_refused(const std::filesystem::path& target, const std::filesystem::path& path) {
  try {
    const Atomic_file file(target);
    ADD_FAILURE() << target << " was opened";
  } catch (const Bad_output& error) {
    const std::string message = error.what();
    EXPECT_TRUE(message.starts_with(path.string() + ": ")) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(Atomic_file, appears_with_all_its_bytes_at_the_commit) {
  const Temporary_folder folder;
  const auto target = folder.path() / "result";
  Atomic_file file(target);
  file.write("one ");
  file.write("");
  file.write(std::string_view("t\0wo", 4));
  EXPECT_FALSE(exists(target));
  file.commit();
  EXPECT_EQ(read_bytes(target), std::string("one t\0wo", 8));
  EXPECT_EQ(files_in(folder.path()), 1);
}

TEST(Atomic_file, that_is_not_committed_leaves_no_folder_that_it_made) {
  const Temporary_folder folder;
  const auto inner = folder.path() / "a" / "b";
  { const Atomic_file file(inner / "result"), beside(inner / "other"), above(folder.path() / "a" / "third"); }
  EXPECT_FALSE(exists(folder.path() / "a"));

  create_directory(folder.path() / "a");
  { const Atomic_file file(inner / "result"); }
  EXPECT_TRUE(exists(folder.path() / "a")) << "it was there before";
  EXPECT_FALSE(exists(inner));

  {
    const Atomic_file file(inner / "result");
    std::ofstream(inner / "foreign") << 1;
  }
  EXPECT_TRUE(exists(inner / "foreign"));
}

TEST(Atomic_file, may_be_longer_than_any_buffer) {
  const Temporary_folder folder;
  std::string all;
  Atomic_file file(folder.path() / "result");
  for (int i = 0; i < 50; ++i) {
    const std::string part(100'000 + i, static_cast<char>('a' + i % 26));
    file.write(part);
    all += part;
  }
  EXPECT_FALSE(exists(folder.path() / "result"));
  file.commit();
  EXPECT_TRUE(read_bytes(folder.path() / "result") == all);
}

TEST(Atomic_file, may_be_empty) {
  const Temporary_folder folder;
  Atomic_file(folder.path() / "result").commit();
  EXPECT_TRUE(exists(folder.path() / "result"));
  EXPECT_EQ(read_bytes(folder.path() / "result"), "");
}

TEST(Atomic_file, leaves_nothing_without_a_commit) {
  const Temporary_folder folder;
  {
    Atomic_file file(folder.path() / "result");
    file.write(std::string(5'000'000, 'x'));
  }
  EXPECT_EQ(files_in(folder.path()), 0);
}

TEST(Atomic_file, keeps_an_existing_file_without_a_commit) {
  const Temporary_folder folder;
  const auto target = folder.write("result", "old");
  { Atomic_file(target).write("new"); }
  EXPECT_EQ(read_bytes(target), "old");
  EXPECT_EQ(files_in(folder.path()), 1);
}

TEST(Atomic_file, replaces_an_existing_file) {
  const Temporary_folder folder;
  const auto target = folder.write("result", "a longer text than the new one");
  Atomic_file file(target);
  file.write("new");
  file.commit();
  EXPECT_EQ(read_bytes(target), "new");
  EXPECT_EQ(files_in(folder.path()), 1);
}

TEST(Atomic_file, has_the_permissions_of_the_file_that_it_replaces) {
  const Temporary_folder folder;
  const auto file = folder.write("private", "old");
  constexpr auto owner = std::filesystem::perms::owner_read | std::filesystem::perms::owner_write;
  std::filesystem::permissions(file, owner);
  write_whole(file, "new");
  EXPECT_EQ(std::filesystem::status(file).permissions(), owner);
  Atomic_files files(folder.path());
  Atomic_file one = files.open("private");
  one.commit();
  files.commit();
  EXPECT_EQ(std::filesystem::status(file).permissions(), owner);
  EXPECT_EQ(std::filesystem::file_size(file), 0U);
}

TEST(Atomic_file, replaces_a_link_not_its_target) {
  const Temporary_folder folder;
  const auto elsewhere = folder.write("elsewhere", "mine");
  create_symlink(elsewhere, folder.path() / "result");
  Atomic_file file(folder.path() / "result");
  file.write("new");
  file.commit();
  EXPECT_EQ(read_bytes(elsewhere), "mine");
  EXPECT_EQ(read_bytes(folder.path() / "result"), "new");
}

TEST(Atomic_file, refuses_names_that_lead_to_what_the_system_shows) {
  const Temporary_folder folder;
  const auto link = folder.path() / "stdout", again = folder.path() / "again";
  std::filesystem::create_symlink("/proc/self/fd/0", link);
  std::filesystem::create_symlink("stdout", again);
  // Standard input may be a regular file: then the link would be replaced.
  for (const auto& name : {link, again}) expect_refused(name, name);
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  for (const std::filesystem::path name : {"/dev/stdout", "/proc/self/fd/1", "/dev/no_such_file"})
    expect_refused(name, name);
}

TEST(Atomic_file, creates_the_folders_it_needs) {
  const Temporary_folder folder;
  const auto target = folder.path() / "a" / "b" / "c" / "result";
  Atomic_file file(target);
  file.write("new");
  file.commit();
  EXPECT_EQ(read_bytes(target), "new");
}

TEST(Atomic_file, refuses_a_folder_as_target_and_a_file_as_folder) {
  const Temporary_folder folder;
  const auto file = folder.write("file", "mine");
  create_directory(folder.path() / "folder");
  expect_refused(folder.path() / "folder", folder.path() / "folder");
  expect_refused(folder.path() / "none" / "", folder.path() / "none" / "");
  expect_refused(file / "result", file);
  expect_refused("/proc/lodestone/result", "/proc/lodestone");
  expect_refused("", "");
  EXPECT_EQ(read_bytes(file), "mine");
}

/// In a separate process with a file-size limit of 1000 bytes.
void write_on_full_disk(const std::filesystem::path& target, std::size_t size) {
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{1000, 1000};
  ::setrlimit(RLIMIT_FSIZE, &limit);
  int code = 0;
  try {
    Atomic_file file(target);
    file.write(std::string(size, 'x'));
    file.commit();
  } catch (const Bad_output& error) {
    code = std::string(error.what()).starts_with(target.string() + ": cannot be written: ") ? 1 : 2;
  }
  std::_Exit(code);
}

TEST(Atomic_file, a_full_disk_is_an_error_and_leaves_nothing) {
  const Temporary_folder folder;
  const auto target = folder.write("result", "old");
  for (const std::size_t size : {1001, 3'000'000}) {
    EXPECT_EXIT(write_on_full_disk(target, size), testing::ExitedWithCode(1), "");
    EXPECT_EQ(read_bytes(target), "old");
    EXPECT_EQ(files_in(folder.path()), 1);
  }
  EXPECT_EXIT(write_on_full_disk(target, 1000), testing::ExitedWithCode(0), "");
  EXPECT_EQ(file_size(target), 1000U);
}

TEST(Atomic_file, can_have_as_long_a_name_as_any) {
  const Temporary_folder folder;
  const auto file = folder.path() / std::string(255, 'n');
  write_whole(file, "text");
  EXPECT_EQ(read_bytes(file), "text");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

}  // namespace
}  // namespace lodestone::test
