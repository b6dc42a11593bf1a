// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "shared/experiment.h"

namespace lodestone {

/// All experiments that have been built, in the order of their help.
std::span<const Experiment> experiments();

}  // namespace lodestone
