// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>

/// Command-line parsing for the program and the experiments.
namespace lodestone {

/// Refuses an empty name: a script with an empty variable must not silently lose its results.
CLI::Validator not_empty();

CLI::Option* add_html(CLI::App& app, std::filesystem::path& html, const char* what);

/// Parses the command line. Prints help or version on request, and one line if an argument is wrong.
/// @return the exit code, if the program is to end
std::optional<int> parse(CLI::App& program, int argc, char** argv);

}  // namespace lodestone
