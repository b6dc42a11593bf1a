// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>

/// What the command lines of the program and of the experiments share.
namespace lodestone {

/// Rejects an empty text: a script whose variable is empty must not lose its results silently.
CLI::Validator not_empty();

/// Accepts a finite number of a range. CLI::Range accepts nan, and prints large limits with up to 309 digits.
/// @param range  the range in words
CLI::Validator finite_number(double least, double most, const std::string& range);

/// Accepts a number above 0.
CLI::Validator number_above_0(bool may_be_infinite);

CLI::Option* add_html(CLI::App& app, std::filesystem::path& html, const char* what);

/// Parses the command line. Prints help or version if asked for, else one line about what is wrong. The help does not
/// list `--describe`, which prints JSON for the build: see command_description.h.
/// @return the exit code, if there is nothing left to do
std::optional<int> parse(CLI::App& program, int argc, char** argv);

}  // namespace lodestone
