// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace lodestone::kernel {

/// As many planes as the widest vectors hold.
inline constexpr std::size_t most_planes = 8;

}  // namespace lodestone::kernel
