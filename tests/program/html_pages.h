// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "program/run_program.h"
#include "support/page_decoder.h"
#include "support/temporary_folder.h"

namespace lodestone::test {

/// A sphere that inflates and goes through another, and a third body, for ten frames.
inline constexpr std::string_view bodies_scene = R"({"name": "bodies <&> \"more\"", "frames": 10, "objects": [
  {"name": "balloon", "shape": {"icosphere": {"frequency": 6}},
   "motion": {"deform": [{"inflate": {"factor": 1.5, "frames": 8}},
                         {"travel": {"path": "linear", "way_points": [{"frame": 0, "at": [-3, 0, 0]},
                                                                      {"frame": 9, "at": [-1, 0, 0]}]}}]}},
  {"name": "ball", "shape": {"uv_sphere": {"slices": 14, "stacks": 9}}},
  {"name": "</script><script>alert(1)</script>", "shape": {"icosphere": {"frequency": 3}},
   "place": {"translate": [4, 3, 0]}}]})";

/// Runs the program with `--html`, and decodes the page.
class Html : public testing::Test {
 protected:
  void SetUp() override {
    if (!LODESTONE_HAS_VIEWER) GTEST_SKIP() << "the program was built without the viewer";
  }
  std::string write(const std::string& name, std::string_view bytes) const {
    return folder.write(name, bytes).string();
  }
  std::string bodies_file() const { return write("bodies.json", bodies_scene); }
  /// Runs a command with `--html`, which must succeed.
  Decoded_page page_of(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--html", page.string()});
    expect_success(run_program(arguments));
    return Decoded_page(data_of(read_bytes(page)));
  }
  /// A run by particles unless the options name a mode.
  Decoded_page detect(const std::vector<std::string>& options = {}) const {
    std::vector<std::string> arguments{bodies_file()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return page_of(detect_by_particles(arguments));
  }

  Temporary_folder folder;
  std::filesystem::path page = folder.path() / "pages" / "page.html", out = folder.path() / "out";
};

/// The lines of a section, each with its line break.
inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const auto end = text.find('\n', at) + 1;
    lines.push_back(text.substr(at, end - at));
    at = end;
  }
  return lines;
}

}  // namespace lodestone::test
