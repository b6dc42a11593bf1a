// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "program/commands.h"

/// The options of `lodestone detect`.
namespace lodestone {

/// @param format  of the mesh on the standard input
void add_detect(CLI::App& program, Detect_command& command, std::string& format);
/// Once the command line is parsed: refuses options that would be ignored, and sets what follows from those given.
/// @throws Bad_argument  names the option
void complete(const CLI::App& app, Detect_command& command);

}  // namespace lodestone
