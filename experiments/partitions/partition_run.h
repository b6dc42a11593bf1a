// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

#include "partitions/partition_plan.h"

namespace lodestone {

/// Divides the mesh, measures the partition, and plays the scene with it.
///
/// @return the parameters; the measures of the partition; `seconds` of it, the least of some repetitions, and
///         `lbg_seconds` of `lbg` beside it; `peak_kib` that it took beyond what the process held; and what its
///         particles found in the scene, held against the mode exact
/// @throws Bad_argument  the strategy refuses
nlohmann::ordered_json execute(const Partition_run& run);

}  // namespace lodestone
