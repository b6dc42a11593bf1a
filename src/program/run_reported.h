// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

namespace lodestone {

/// Runs a program, flushes its standard output, and reports an error on one line.
/// @return the exit code
int run_reported(const std::function<int()>& program);

}  // namespace lodestone
