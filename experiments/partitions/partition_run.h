// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

#include "partitions/partition_plan.h"

namespace lodestone {

/// Divides the mesh, measures the partition, and plays the scene with it.
///
/// @return the parameters; the measures of the partition; `seconds`, the least of some repetitions, and `lbg_seconds`,
///         the same of `lbg`; `peak_kib`, the memory beyond what the process held before; and the figures of its
///         particles in the scene, with the mode exact as truth
/// @throws Bad_argument  the strategy rejects the mesh or the number of regions
nlohmann::ordered_json execute(const Partition_run& run);

}  // namespace lodestone
