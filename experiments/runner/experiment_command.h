// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "program/shards.h"

namespace lodestone {

struct Experiment_command {
  std::string name;
  std::filesystem::path scenes;   ///< empty: those of the program
  std::filesystem::path out;      ///< empty: out/NAME
  std::vector<std::string> only;  ///< see Experiment_context, as the others here
  std::size_t jobs = 1;
  std::optional<Shard> shard;
  bool merge_shards = false;
  std::vector<std::string> words;
  std::size_t seeds = 1;
  std::vector<std::filesystem::path> strategy_files;
  std::filesystem::path write_meshes;
  std::filesystem::path html;  ///< empty: not written
  bool quiet = false;
};

/// Runs an experiment, prints its report to the standard output and returns the exit code.
int run(const Experiment_command& command);

}  // namespace lodestone
