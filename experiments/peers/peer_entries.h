// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "shared/entrant.h"

namespace lodestone {

/// Everything that takes part in the experiment `peers`, in the order of the tables.
std::vector<Entry> all_entries();

/// Lodestone's own rows.
std::vector<Entry> lodestone_entries();

}  // namespace lodestone
