// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/command_line.h"

#include <fmt/format.h>

#include <cstdio>

#include "program/exit_codes.h"
#include "program/printable.h"

namespace lodestone {

CLI::Validator not_empty() {
  return {[](const std::string& text) { return std::string(text.empty() ? "expected a name, found none" : ""); }, ""};
}

CLI::Option* add_html(CLI::App& app, std::filesystem::path& html, const char* what) {
  return app.add_option("--html", html, what)->type_name("FILE")->check(not_empty());
}

std::optional<int> parse(CLI::App& program, int argc, char** argv) {
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
