// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "partitions/row_file.h"

namespace lodestone {

struct Sweep_options {
  std::size_t jobs = 1;  ///< runs at a time; >= 1
};

/// Executes the runs that have no row yet. Each has a process of its own, so that its memory is measured separately,
/// and a crash loses only that run.
///
/// @param ids       of all runs, in order
/// @param execute   makes the row of a run, without its id; called in the child process
/// @param progress  called with the number of finished runs and of all runs; may throw to stop, which
///                  ends the runs in progress
/// @return `id: cause` for each run that failed; these have no row and are tried again next time
std::vector<std::string> sweep(const std::vector<std::string>& ids, Row_file& rows, const Sweep_options& options,
                               const std::function<nlohmann::ordered_json(std::size_t run)>& execute,
                               const std::function<void(std::size_t done, std::size_t of)>& progress);

}  // namespace lodestone
