// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>

/// What the command lines of the program and of the experiments share.
namespace lodestone {

/// A script whose variable is empty must not lose its results without a word.
CLI::Validator not_empty();

CLI::Option* add_html(CLI::App& app, std::filesystem::path& html, const char* what);

/// Parses the command line. Prints help or version if asked for, else one line about what is wrong.
/// @return the exit code, if there is nothing left to do
std::optional<int> parse(CLI::App& program, int argc, char** argv);

}  // namespace lodestone
