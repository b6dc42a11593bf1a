// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <pty.h>
#include <termios.h>

#include <string>
#include <vector>

#include "program/run_program.h"
#include "support/scene_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

struct Terminal_session {
  int exit_code = -1;
  std::string bytes;  ///< all output sent to the terminal
};

/// Runs the program with a terminal of 200 columns for all three streams.
Terminal_session run_on_terminal(const std::vector<std::string>& arguments) {
  Command_line command(arguments);

  winsize size{};
  size.ws_col = 200;
  size.ws_row = 50;
  int terminal = -1;
  const pid_t process = ::forkpty(&terminal, nullptr, nullptr, &size);
  if (process == 0) {
    ::alarm(60);
    ::execv(command.data()[0], command.data());
    ::_exit(127);
  }
  Terminal_session session;
  std::array<char, 4096> bytes{};
  while (true) {
    const auto count = ::read(terminal, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;  // an error means that the other side is closed
    session.bytes.append(bytes.data(), static_cast<std::size_t>(count));
  }
  ::close(terminal);
  int status = 0;
  ::waitpid(process, &status, 0);
  if (WIFEXITED(status)) session.exit_code = WEXITSTATUS(status);
  return session;
}

/// What remains visible on the terminal. Interprets line feed, carriage return and erasure to the end of the line.
std::string screen_of(const std::string& bytes) {
  std::vector<std::string> lines(1);
  std::size_t column = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    auto& line = lines.back();
    if (bytes[i] == '\r') {
      column = 0;
    } else if (bytes[i] == '\n') {
      lines.emplace_back();
    } else if (bytes.compare(i, 3, "\x1b[K") == 0) {
      line.resize(std::min(line.size(), column));
      i += 2;
    } else {
      EXPECT_NE(bytes[i], '\x1b') << "a control sequence that this terminal does not know";
      line.resize(std::max(line.size(), column + 1), ' ');
      line[column++] = bytes[i];
    }
  }
  std::string screen;
  for (const auto& line : lines) screen += line + '\n';
  return screen;
}

class Terminal : public testing::Test {
 protected:
  void SetUp() override {
    folder.write("a.off", tetrahedron_off());
    scene = folder
                .write("scene.json", R"({"frames": 500, "objects": [
                  {"name": "a", "mesh": "a.off"}, {"name": "b", "mesh": "a.off"}]})")
                .string();
  }
  Temporary_folder folder;
  std::string scene;
};

TEST_F(Terminal, shows_a_progress_bar_and_erases_it_at_the_end) {
  const auto session = run_on_terminal({"detect", "--mode", "particles", scene});
  EXPECT_EQ(session.exit_code, 0);
  EXPECT_NE(session.bytes.find("detect ["), std::string::npos) << session.bytes;
  EXPECT_NE(session.bytes.find("1/500"), std::string::npos);
  const auto screen = screen_of(session.bytes);
  EXPECT_EQ(screen.find("detect ["), std::string::npos) << screen;
  EXPECT_TRUE(screen.starts_with("scene: 2 objects, 500 frames\n")) << screen;
  EXPECT_NE(screen.find("|    500 |       500 |"), std::string::npos) << screen;
}

TEST_F(Terminal, shows_an_error_without_the_bar) {
  folder.write("f0.off", tetrahedron_off());
  folder.write("f1.off", tetrahedron_off());
  folder.write("f2.off", "broken");
  const auto file = folder.write("broken.json", R"({"objects": [{"name": "a", "mesh": "a.off",
    "motion": {"sequence": {"pattern": "f#.off", "first": 0, "last": 2}}}]})");
  const auto session = run_on_terminal({"detect", "--mode", "particles", file.string()});
  EXPECT_EQ(session.exit_code, 3);
  EXPECT_NE(session.bytes.find("detect ["), std::string::npos);
  const auto screen = screen_of(session.bytes);
  EXPECT_TRUE(screen.starts_with("lodestone: ")) << screen;
  EXPECT_EQ(screen.find("detect ["), std::string::npos) << screen;
}

TEST_F(Terminal, shows_one_line_when_quiet) {
  const auto bytes = run_on_terminal({"detect", "--mode", "particles", scene, "--quiet"}).bytes;
  EXPECT_TRUE(bytes.starts_with("scene: 1 colliding pair, ")) << bytes;
  EXPECT_EQ(bytes.find('\n'), bytes.size() - 1) << bytes;
}

TEST_F(Terminal, without_a_terminal_there_is_no_bar_and_no_control_sequence) {
  const auto result = run_program({"detect", "--mode", "particles", scene});
  expect_success(result);
  EXPECT_EQ(result.out.find('\x1b'), std::string::npos);
  EXPECT_EQ(result.out.find('\r'), std::string::npos);
  EXPECT_NE(result.out.find("|    500 |       500 |"), std::string::npos) << result.out;
}

// Help

void expect_parts(const std::string& text, const std::vector<std::string>& parts) {
  for (const auto& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << " in:\n" << text;
}

TEST(Help, lists_the_commands_and_exit_codes) {
  const auto result = run_program({"--help"});
  expect_success(result);
  expect_parts(result.out, {"detect", "partition", "experiment", "--version", "Exit codes:", "\n  0 ", "\n  1 ",
                            "\n  2 ", "\n  3 ", "\n  4 ", "\n  5 ", "\n  130 "});
}

TEST(Help, lists_the_options_of_each_command) {
  const auto help = [](const char* command) {
    const auto result = run_program({command, "--help"});
    expect_success(result);
    return result.out;
  };
  expect_parts(help("detect"), {"INPUT",           "--mode",
                                "particles",       "senin",
                                "--particles",     "--contacts",
                                "first",           "all",
                                "--points",        "--truth",
                                "--meetings",      "--opening-budget",
                                "--opening-reach", "--collision-distance",
                                "--candidates",    "--growth",
                                "--seed",          "--out",
                                "frames.jsonl",    "summary.json",
                                "--quiet",         "Exit codes:"});
  expect_parts(help("partition"), {"MESH", "--strategy", "lbg", "--regions", "--keep-islands", "--out", ".ply",
                                   "--json", "--quiet", "Exit codes:"});
  expect_parts(help("experiment"), {"NAME", "teapot_sphere", "scaling", "predecessor", "collision_distance", "growth",
                                    "--scenes", "--out", "--quiet", "Exit codes:"});
}

TEST(Help, can_be_shown_for_all_commands_at_once) {
  const auto result = run_program({"--help-all"});
  expect_success(result);
  expect_parts(result.out, {"--truth", "--keep-islands", "lodestone experiment --help"});
}

TEST(Help, shows_the_version) {
  const auto result = run_program({"--version"});
  expect_success(result);
  EXPECT_TRUE(result.out.starts_with("lodestone ") && result.out.ends_with('\n')) << result.out;
  EXPECT_EQ(std::ranges::count(result.out, '.'), 2) << result.out;
}

}  // namespace
}  // namespace lodestone::test
