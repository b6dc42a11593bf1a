// SPDX-License-Identifier: GPL-3.0-or-later
#include "partitions/sweep.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "lodestone/mesh/errors.h"
#include "support/temporary_folder.h"

namespace lodestone {
namespace {

using Row = nlohmann::ordered_json;

struct Sweep : ::testing::Test {
  test::Temporary_folder folder;
  std::vector<std::string> ids{"a", "b", "c", "d", "e", "f", "g"};

  std::filesystem::path file(const std::string& name = "rows.jsonl") const { return folder.path() / name; }
  static void no_progress(std::size_t /*done*/, std::size_t /*of*/) {}
  /// Each run leaves a mark, in whatever process it runs.
  auto marking() const {
    return [this](std::size_t run) {
      std::ofstream(folder.path() / "marks", std::ios::app) << ids[run];
      return Row{{"square", run * run}, {"process", ::getpid()}};
    };
  }
  std::string marks() const {
    std::string text;
    std::ifstream(folder.path() / "marks") >> text;
    std::ranges::sort(text);
    return text;
  }
};

TEST_F(Sweep, every_run_gets_its_row_from_a_separate_process) {
  for (const std::size_t jobs : {1, 3, 20}) {
    std::filesystem::remove(file());
    Row_file rows(file());
    EXPECT_TRUE(sweep(ids, rows, {.jobs = jobs}, marking(), no_progress).empty());
    std::set<int> processes{::getpid()};
    for (std::size_t run = 0; run < ids.size(); ++run) {
      EXPECT_EQ(rows.rows().at(ids[run])["square"], run * run);
      EXPECT_TRUE(processes.insert(rows.rows().at(ids[run])["process"].get<int>()).second);
    }
  }
}

TEST_F(Sweep, a_finished_sweep_does_nothing_and_an_interrupted_one_does_the_rest) {
  {
    Row_file rows(file());
    rows.add(Row{{"id", "b"}});
    rows.add(Row{{"id", "f"}});
    sweep(ids, rows, {}, marking(), no_progress);
  }
  EXPECT_EQ(marks(), "acdeg");
  Row_file rows(file());
  sweep(ids, rows, {}, marking(), no_progress);
  EXPECT_EQ(marks(), "acdeg");
}

TEST_F(Sweep, stopping_a_sweep_loses_only_the_runs_in_progress) {
  {
    Row_file rows(file());
    const auto stop = [](std::size_t done, std::size_t /*of*/) {
      if (done == 3) throw std::runtime_error("stop");
    };
    EXPECT_THROW(sweep(ids, rows, {}, marking(), stop), std::runtime_error);
  }
  EXPECT_EQ(read_rows(file()).size(), 3U);
  Row_file rows(file());
  sweep(ids, rows, {}, marking(), no_progress);
  EXPECT_EQ(rows.rows().size(), ids.size());
}

TEST_F(Sweep, a_run_that_fails_or_crashes_is_named_and_the_others_go_on) {
  Row_file rows(file());
  const auto execute = [](std::size_t run) -> Row {
    if (run == 1) throw std::runtime_error("too large");
    if (run == 3) std::raise(SIGKILL);
    if (run == 5) ::_exit(0);
    return Row{{"run", run}};
  };
  const auto failures = sweep(ids, rows, {.jobs = 2}, execute, no_progress);
  const std::set<std::string> expected{"b: too large", "d: ended by signal 9", "f: it gave no row"};
  EXPECT_EQ(std::set<std::string>(failures.begin(), failures.end()), expected);
  EXPECT_EQ(rows.rows().size(), 4U);
  EXPECT_FALSE(rows.has("b"));
}

TEST_F(Sweep, a_row_longer_than_a_pipe_holds_arrives_whole) {
  Row_file rows(file());
  const std::string text(3'000'000, 'x');
  sweep(
      {"a", "b"}, rows, {.jobs = 2},
      [&](std::size_t) {
        return Row{{"text", text}};
      },
      no_progress);
  EXPECT_EQ(rows.rows().at("b")["text"], text);
}

TEST_F(Sweep, several_jobs_run_at_a_time) {
  // Each run waits until both have started: with one at a time none would end.
  Row_file rows(file());
  const auto execute = [&](std::size_t run) -> Row {
    std::ofstream(folder.path() / ("begun" + std::to_string(run))) << "x";
    for (int wait = 0; wait < 2000; ++wait) {
      if (exists(folder.path() / "begun0") && exists(folder.path() / "begun1")) return Row{{"met", true}};
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return Row{{"met", false}};
  };
  sweep({"a", "b"}, rows, {.jobs = 2}, execute, no_progress);
  EXPECT_EQ(rows.rows().at("a")["met"], true);
  EXPECT_EQ(rows.rows().at("b")["met"], true);
}

TEST_F(Sweep, reports_its_progress) {
  Row_file rows(file());
  rows.add(Row{{"id", "c"}});
  std::vector<std::size_t> seen;
  sweep(ids, rows, {}, marking(), [&](std::size_t done, std::size_t of) {
    EXPECT_EQ(of, ids.size());
    seen.push_back(done);
  });
  EXPECT_EQ(seen.front(), 1U);
  EXPECT_EQ(seen.back(), ids.size());
  EXPECT_TRUE(std::ranges::is_sorted(seen));
}

TEST_F(Sweep, a_number_of_jobs_that_does_not_exist_is_refused) {
  Row_file rows(file());
  EXPECT_THROW(sweep(ids, rows, {.jobs = 0}, marking(), no_progress), Bad_argument);
}

}  // namespace
}  // namespace lodestone
