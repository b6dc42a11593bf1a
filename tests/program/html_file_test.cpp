// SPDX-License-Identifier: GPL-3.0-or-later
// The file of a page: its size, its path, and what becomes of it when a run fails.
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "program/html_pages.h"
#include "support/mesh_samples.h"

namespace lodestone::test {
namespace {

TEST_F(Html, reports_what_was_written) {
  const auto all = run_program({"detect", "--mode", "particles", bodies_file(), "--html", page.string()});
  EXPECT_NE(all.out.find("page: " + page.string() + ", "), std::string::npos) << all.out;
  EXPECT_EQ(all.out.find("--html-frames"), std::string::npos) << all.out;
  const auto some =
      run_program({"detect", "--mode", "particles", bodies_file(), "--html", page.string(), "--html-frames", "5"});
  EXPECT_NE(some.out.find("5 of 10 frames: one of every 2 (see --html-frames)\n"), std::string::npos) << some.out;
  const auto quiet = run_program({"detect", "--mode", "particles", bodies_file(), "--html", page.string(), "--quiet"});
  EXPECT_EQ(quiet.out.find("page:"), std::string::npos) << quiet.out;
}

TEST_F(Html, of_the_paper_s_pair_is_small) {
  const auto shown =
      page_of({"detect", LODESTONE_DATA "/scenes/teapot_sphere_1.json", "--mode", "particles", "--particles", "32"});
  EXPECT_EQ(shown.header["frames"], 300);
  EXPECT_EQ(shown.header["frame_step"], 1);
  EXPECT_LT(file_size(page), 15'000'000U);
}

TEST_F(Html, a_name_that_does_not_end_in_html_is_refused) {
  const auto mesh = write("square.off", square_off);
  for (const std::string& target : {mesh, (folder.path() / "page").string(), (folder.path() / "a.json").string()}) {
    expect_error(run_program({"partition", mesh, "--html", target}), 2, ".html");
    expect_error(run_program({"detect", "--mode", "particles", mesh, mesh, "--html", target}), 2, ".html");
    expect_error(run_program({"experiment", "collision_distance", "--out", out.string(), "--html", target}), 2,
                 ".html");
  }
  EXPECT_EQ(read_bytes(mesh), square_off);
  EXPECT_EQ(content_of(folder.path()), std::set<std::string>{"square.off"});
}

TEST_F(Html, a_page_with_the_path_of_another_result_is_refused) {
  const auto mesh = write("square.off", square_off);
  const auto there = folder.path() / "here" / ".." / "page.html", here = folder.path() / "page.html";
  create_directory(folder.path() / "here");
  expect_error(run_program({"partition", mesh, "--html", here.string(), "--json", there.string()}), 2, "the same file");
  expect_error(
      run_program({"detect", "--mode", "particles", mesh, mesh, "--html", here.string(), "--out", there.string()}), 2,
      "the same file");
  EXPECT_EQ(content_of(folder.path()), (std::set<std::string>{"here", "square.off"}));
}

TEST_F(Html, a_limit_of_frames_needs_a_page) {
  expect_error(run_program({"detect", "--mode", "particles", bodies_file(), "--html-frames", "5"}), 2, "--html");
  expect_error(
      run_program({"detect", "--mode", "particles", bodies_file(), "--html", page.string(), "--html-frames", "-1"}), 2,
      "--html-frames");
}

TEST_F(Html, a_path_that_cannot_be_written_is_an_error_before_the_run) {
  const auto file = folder.write("file", "mine");
  const auto mesh = write("square.off", square_off);
  for (const std::string& target : {(file / "page.html").string(), std::string("/proc/lodestone/page.html")}) {
    expect_error(run_program({"detect", "--mode", "particles", bodies_file(), "--out", out.string(), "--html", target}),
                 4, "");
    expect_error(run_program({"partition", mesh, "--html", target}), 4, "");
    expect_error(run_program({"experiment", "modes", "--out", out.string(), "--html", target}), 4, "");
  }
  EXPECT_EQ(content_of(out), std::set<std::string>{});
}

TEST_F(Html, a_full_disk_leaves_nothing) {
  const auto input = bodies_file();
  detect({"--out", out.string()});
  const auto size = file_size(page);
  ASSERT_GT(size, file_size(out / "frames.jsonl"));
  remove_all(out);
  remove(page);
  expect_error(run_program({"detect", "--mode", "particles", input, "--out", out.string(), "--html", page.string()},
                           {.largest_file = static_cast<rlim_t>(size / 2)}),
               4, "page.html");
  EXPECT_EQ(content_of(out), std::set<std::string>{});
  EXPECT_EQ(content_of(page.parent_path()), std::set<std::string>{});
}

TEST_F(Html, a_bad_input_keeps_the_old_page) {
  detect();
  const auto old = read_bytes(page);
  const auto bad = write("bad.off", "OFF\n");
  expect_error(run_program({"partition", bad, "--html", page.string()}), 3, "bad.off");
  expect_error(run_program({"detect", "--mode", "particles", bad, bad, "--html", page.string()}), 3, "bad.off");
  EXPECT_TRUE(read_bytes(page) == old);
  EXPECT_EQ(content_of(page.parent_path()), std::set<std::string>{"page.html"});
}

TEST(Html_without_a_viewer, is_an_error_that_states_the_reason) {
  if (LODESTONE_HAS_VIEWER) GTEST_SKIP() << "the program has the viewer";
  const Temporary_folder folder;
  const auto mesh = folder.write("square.off", square_off).string(), page = (folder.path() / "page.html").string();
  expect_error(run_program({"partition", mesh, "--html", page}), 4, "without the viewer, because ");
  expect_error(run_program({"detect", "--mode", "particles", mesh, mesh, "--html", page}), 4,
               "without the viewer, because ");
  EXPECT_EQ(content_of(folder.path()), std::set<std::string>{"square.off"});
}

}  // namespace
}  // namespace lodestone::test
