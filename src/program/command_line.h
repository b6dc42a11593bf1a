// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>

#include "program/exit_codes.h"
#include "program/printable.h"

/// What the command lines of the program and of the experiments share; in a header, since each program reads its
/// command line in one source file, and CLI11 takes long to compile.
namespace lodestone {

/// Rejects an empty text: a script whose variable is empty must not lose its results silently.
inline CLI::Validator not_empty() {
  return {[](const std::string& text) { return std::string(text.empty() ? "expected a name, found none" : ""); }, ""};
}

inline CLI::Option* add_html(CLI::App& app, std::filesystem::path& html, const char* what) {
  return app.add_option("--html", html, what)->type_name("FILE")->check(not_empty());
}

/// Parses the command line. Prints help or version if asked for, else one line about what is wrong.
/// @return the exit code, if there is nothing left to do
inline std::optional<int> parse(CLI::App& program, int argc, char** argv) {
  try {
    program.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    const bool asked_for_help = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
    if (asked_for_help) return program.exit(error);
    fmt::print(stderr, "lodestone: {} (see {} --help)\n", printable(error.what()), program.get_name());
    return exit_code::bad_usage;
  }
}

}  // namespace lodestone
