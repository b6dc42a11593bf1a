// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "program/command_description.h"
#include "program/commands.h"

/// Options that several commands have.
namespace lodestone {

/// Converts a name to its value, which CLI11 expects as a number.
template <class Value>
CLI::Validator one_of(const std::map<std::string, Value>& names) {
  std::vector<std::string> choices;
  for (const auto& entry : names) choices.push_back(entry.first);
  return {[names, choices](std::string& text) -> std::string {
            const auto found = names.find(CLI::detail::to_lower(text));
            if (found == names.end()) return fmt::format("expected {}, found '{}'", fmt::join(choices, " or "), text);
            text = std::to_string(static_cast<int>(found->second));
            return {};
          },
          "", choices_name(choices)};
}

/// The strategies, with a summary of each.
std::string strategy_list();
/// How surfaces are divided into regions.
/// @param seed_of  what the seed is for
void add_strategy_options(CLI::App& app, Strategy_choice& choice, const char* seed_of);
/// Whether regions stay in several pieces.
void add_keep_islands(CLI::App& app, Partition_options& options);
/// The format of the mesh on the standard input.
void add_format(CLI::App& app, std::string& format);
/// How files are read.
void add_reading(CLI::App& app, Scene_options& reading);
/// @param of  what the threads share
void add_threads(CLI::App& app, std::size_t& threads, const char* of);
/// Refuses --allow-outside where no input is a scene, or an object of one.
/// @throws Bad_argument
void refuse_allow_outside(const CLI::App& app, const std::vector<std::filesystem::path>& inputs);

}  // namespace lodestone
