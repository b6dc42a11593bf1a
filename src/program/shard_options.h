// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "program/commands.h"

/// The command line of work in shards.
namespace lodestone {

struct Merge_command {
  std::filesystem::path folder;
  bool quiet = false;
};

/// Options of `detect` that play one shard.
void add_shard_options(CLI::App& app, Detect_command& command);
/// The command `submit`.
void add_submit(CLI::App& program, Submit_command& command);
/// The command `status`.
void add_status(CLI::App& program, Status_command& command);
/// The command `merge`.
void add_merge(CLI::App& program, Merge_command& command);

/// The command line that merges the shards of a folder. Enters the folder in which they were begun, since their inputs
/// may be relative to it.
std::vector<std::string> merging_words(const Merge_command& command);

}  // namespace lodestone
