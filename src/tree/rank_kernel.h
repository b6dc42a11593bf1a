// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lodestone/volumes/leaf_faces.h"
#include "simd/widest_vector.h"

/// Sorting the few numbers of a leaf, built for several instruction sets and chosen at run time.
///
/// Highway's vqsort asks the operating system for random numbers at each call. To compare each number with all others
/// takes no system call and no branch that depends on them.
namespace lodestone::kernel {

/// Most numbers that are ranked at once: all corners of a leaf.
constexpr std::size_t most_ranked = 3 * most_leaf_faces;

/// The rank of each number, and room for a vector behind the last.
using Ranks = std::array<std::uint32_t, most_ranked + most_float_lanes>;

/// How many of the others are smaller than each of some numbers. O(n^2 / lanes).
/// @param numbers  all different, at most `most_ranked`
/// @param ranks    from the n-th on meaningless
void find_ranks(std::span<const std::uint32_t> numbers, Ranks& ranks);

/// Sorts numbers, ascending; they must all differ, and be at most `most_ranked`. O(n^2 / lanes).
void sort_few(std::span<std::uint32_t> numbers);

}  // namespace lodestone::kernel
