// SPDX-License-Identifier: GPL-3.0-or-later
// Memory of this test program that runs out when a test says so.
#pragma once

#include <cstddef>
#include <limits>

namespace lodestone::test {

/// No allocation fails.
inline constexpr std::size_t never = std::numeric_limits<std::size_t>::max();

/// From now on the allocation of this number fails, the next one being 0, and no other.
void fail_allocation(std::size_t number);
/// Allocations since the last call of `fail_allocation`, in all threads.
std::size_t allocations();
/// Whether one has failed since.
bool allocation_failed();

/// Blocks that have been allocated and not freed.
std::ptrdiff_t live_blocks();
/// Bytes of the largest block that `operator new` has made since the last call of `fail_allocation`.
std::size_t largest_block();

}  // namespace lodestone::test
